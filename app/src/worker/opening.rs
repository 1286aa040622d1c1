//! Asking for files to be read.

use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::{Arc, mpsc};

use super::files::Letter;
use super::office::{Office, whole};
use super::{Answer, Origins, PastedCode, Worker, guarded, scene};

impl Worker {
    /// Asks to read the materials of a file, a folder or an archive, an environment map, or a mesh; of a scene it only says
    /// that there is one.
    pub fn open(&self, path: PathBuf) {
        open(&self.office, &self.files, path);
    }

    /// The same of what was open when the last session ended, and of codes that were pasted into it; [`Answer::Reopened`]
    /// follows. Materials of files have the names that they had then, by these origins.
    pub fn reopen(&self, paths: Vec<PathBuf>, origins: Origins, codes: Vec<PastedCode>) {
        self.office.materials.claim(origins);
        let _ = self.files.send(Letter::Reopen(paths, codes));
    }

    /// Shows the system's dialog and opens what is chosen; [`Answer::Dialog`] follows. Nothing while one is shown.
    pub fn choose(&self) {
        if self.is_choosing.swap(true, Ordering::Relaxed) {
            return;
        }
        let (office, files, is_choosing) = (self.office.clone(), self.files.clone(), Arc::clone(&self.is_choosing));
        std::thread::spawn(move || {
            let chosen = guarded("The dialog for files", || (office.stock.dialog)()).flatten();
            is_choosing.store(false, Ordering::Relaxed);
            let why = chosen.map(|paths| paths.into_iter().for_each(|path| open(&office, &files, path)));
            office.say(Answer::Dialog(why.err()));
        });
    }

    /// Ends a fit, or takes it out of the queue.
    pub fn cancel(&self, job: u64) {
        let Some(path) = self.fits.remove(job) else { return };
        self.office.say(Answer::Jobs(self.fits.shown()));
        self.office.say(Answer::Lost(path));
    }

    /// Asks to read a code as a material.
    pub fn open_code(&self, text: String) {
        let _ = self.files.send(Letter::Paste(text));
    }
}

/// Sends a file to who reads it.
fn open(office: &Office, files: &mpsc::Sender<Letter>, path: PathBuf) {
    let path = whole(path);
    if path.to_str().is_none() {
        // Sessions are text.
        return office.say(Answer::Notice(format!("{}: expected a path in UTF-8: rename the file", path.display())));
    }
    if scene::is_scene(&path) {
        return office.say(Answer::Scene(scene::News::Named(path)));
    }
    // The thread outlives the sender, unless the process is about to end.
    let _ = files.send(Letter::Open(path));
}
