//! The beginning and the end of all threads.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, mpsc};

use super::files::Desk;
use super::fits::Fits;
use super::office::Office;
use super::opened::Opened;
use super::{
    Stock, Worker, background, chart, curves, edits, export, files, fitting, map, paths, point, properties, scene,
    studio, thumbnails,
};

impl Worker {
    /// Starts the threads; `wake` is called from them whenever an answer waits.
    pub fn start(stock: Stock, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, answers) = mpsc::channel();
        let (orders, ordered) = mpsc::channel();
        let (files, letters) = mpsc::channel();
        let (thumbnails, materials) = mpsc::channel();
        let stop: Arc<AtomicBool> = Arc::default();
        let office = Office::new(stock, sender, wake);
        let works: [fn(&Office); 8] =
            [paths::run, edits::run, studio::run, point::run, curves::run, chart::run, map::run, properties::run];
        for work in works {
            let office = office.clone();
            background::spawn(move || work(&office));
        }
        // The receiver is here still.
        let _ = thumbnails.send(office.stock.materials.clone());
        let fits: Arc<Fits> = Arc::default();
        let desk = Desk { office: office.clone(), fits: Arc::clone(&fits), opened: Opened::default(), thumbnails };
        let for_fitting = desk.clone();
        let [for_thumbnails, for_scenes, for_export, for_cache] = std::array::from_fn(|_| office.clone());
        let (scenes, may_stop) = (scene::Scenes::default(), Arc::clone(&stop));
        let wishes = Arc::clone(&scenes.letters);
        background::spawn(move || files::run(&desk, &letters));
        background::spawn(move || fitting::run(&for_fitting));
        background::spawn(move || thumbnails::run(&for_thumbnails, &materials));
        background::spawn(move || scene::run(&for_scenes, &wishes));
        background::spawn(move || export::run(for_export, may_stop, &ordered));
        background::spawn(move || for_cache.stock.cache.prune());
        Self { files, orders, stop, fits, is_choosing: Arc::default(), answers, scenes, office, number: 0 }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.office.close();
        self.stop_writing();
        self.fits.close();
    }
}
