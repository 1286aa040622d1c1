//! Long work off the UI thread: prepares paths, renders spheres, compares them, reads and writes files.
//!
//! A thread for each kind of work. Where only the newest request matters, it waits in a mailbox and replaces older ones:
//! *paths* encodes materials and learns bases; *edits* moves qualities of points on them; *studio* renders, coarse first and
//! fine when nothing newer came; *point* evaluates at one place; *curves* works out figures; *chart* measures all
//! representations; *map* lays codes out in a plane; *properties* measures what lists are sorted by; *scene* plans scenes.
//! In order: *files* reads what is opened, *fitting* fits networks to measurements, *thumbnails* makes small pictures,
//! *export* writes. Nothing here knows a window: answers wait in a channel, and `wake` says that they do.

mod activity;
mod answer;
mod asset;
mod assets;
mod background;
mod cache;
mod chart;
mod curves;
mod dialog;
mod difference;
mod edits;
pub mod export;
mod figures;
mod files;
mod films;
mod fits;
mod fitting;
mod guarded;
mod here;
mod mailbox;
mod map;
mod materials;
mod office;
mod opened;
mod opening;
mod pasted;
mod paths;
mod picture;
mod plates;
mod point;
mod properties;
mod request;
pub mod scene;
mod sets;
mod spheres;
mod start;
mod stock;
mod strips;
mod studio;
mod surround;
mod thumbnails;
mod walk;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};

pub use answer::{Answer, Card};
pub use asset::Asset;
pub use assets::Listed;
pub use background::prepare;
pub use cache::Cache;
pub use chart::{ChartNews, Rival};
pub use curves::{Along, Findings, Found, Place, Price, Profile, Question, Told, Topic};
pub use difference::Difference;
pub use edits::Measured;
pub use figures::Figures;
pub use fits::Job;
pub(crate) use mailbox::Mailbox;
pub use map::{Course, Explored, MapAnswer, MapRequest, Projection, Spot, Track};
pub use materials::Origins;
pub use office::BUILT_IN;
pub use pasted::PastedCode;
pub use picture::Picture;
pub use plates::Plates;
pub use point::{Incidence, Point, Probe, Reading};
pub use properties::{Inquiry, Property};
pub use request::{Closeup, Lighting, Request, Scale, Scenery, Shape, Timing};
pub use stock::Stock;
pub use walk::{Edits, Tour, Walk};

use files::Letter;
use fits::Fits;
use guarded::guarded;
use office::Office;

/// The threads.
pub struct Worker {
    files: mpsc::Sender<Letter>,
    orders: mpsc::Sender<export::Order>,
    /// Whether writing is to end.
    stop: Arc<AtomicBool>,
    fits: Arc<Fits>,
    is_choosing: Arc<AtomicBool>,
    answers: mpsc::Receiver<Answer>,
    scenes: scene::Scenes,
    office: Office,
    number: u64,
}

impl Worker {
    /// Asks for spheres; replaces what was asked before. The number comes back in [`Answer::Done`].
    pub fn show(&mut self, request: Request) -> u64 {
        self.number += 1;
        self.office.requests.put((self.number, request));
        self.number
    }

    /// Whether qualities of what is shown are asked for, beside the pictures; [`Answer::Measured`] follows.
    pub fn measure(&self, is_measured: bool) {
        self.office.is_measured.store(is_measured, Ordering::Relaxed);
        self.office.changes.again();
    }

    /// Asks for directions and values at a place; replaces what was asked before, none asks for nothing more.
    pub fn probe(&self, probe: Option<Probe>) {
        self.office.points.put(probe);
    }

    /// Asks for a figure; replaces what was asked before.
    pub fn ask(&self, question: Question) {
        self.office.questions.put(question);
    }

    /// Asks for the chart of all representations with these materials on it, or stops the one that is being made.
    pub fn chart(&self, materials: Option<Arc<[String]>>) {
        self.office.charts.put(materials);
    }

    /// Asks for the latent map; replaces what was asked before.
    pub fn map(&self, request: MapRequest) {
        self.office.map_requests.put(request);
    }

    /// Where buffers of pictures go back to once they are shown.
    pub fn plates(&self) -> Plates {
        self.office.plates.clone()
    }

    /// What to do with something that went wrong elsewhere: it becomes a notice.
    pub fn complaints(&self) -> impl Fn(String) + Send + 'static {
        let office = self.office.clone();
        move |why| office.say(Answer::Notice(why))
    }

    /// Asks something about a scene; where that is news, its number, which comes back in [`scene::News::Done`].
    pub fn plan(&mut self, ask: scene::Ask, wish: Option<scene::Wish>) -> Option<u64> {
        self.scenes.ask(ask, wish)
    }

    /// Asks for something of every material; replaces what was asked before. [`Answer::Property`] follows for each.
    pub fn inquire(&self, inquiry: Inquiry) {
        self.office.inquiries.put(inquiry);
    }

    /// Asks which of these files are there.
    pub fn look_for(&self, files: Vec<PathBuf>) {
        let _ = self.orders.send(export::Order::Look(files));
    }

    /// Asks to write files.
    pub fn write(&self, job: export::Job) {
        self.stop.store(false, Ordering::Relaxed);
        let _ = self.orders.send(export::Order::Write(Box::new(job)));
    }

    /// Asks to give up what is being written.
    pub fn stop_writing(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Asks for the code of the point that a request shows.
    pub fn code(&self, request: Request) {
        let _ = self.orders.send(export::Order::Code(Box::new(request)));
    }

    /// What the threads said since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> {
        self.answers.try_iter()
    }
}
