//! The session's file: written while one works, read at the next start, so that a crash loses a second at most.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use nbrdf_core::atomic;
use serde::{Deserialize, Serialize};

use super::{Layout, Session};
use crate::worker::Mailbox;

/// Names the file instead of the system's place for it; empty for none.
const VARIABLE: &str = "NBRDF_SESSION";
const SCHEMA: u32 = 1;
/// Between two writes.
const PATIENCE: Duration = Duration::from_secs(1);

/// Everything that is remembered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    schema: u32,
    /// What the user chose.
    pub session: Session,
    /// Where the panes are.
    pub layout: Layout,
    /// Size of the window \[points\].
    pub window: Option<[f32; 2]>,
}

impl Saved {
    /// For the file.
    pub fn new(session: &Session, layout: &Layout, window: Option<[f32; 2]>) -> Self {
        Self { schema: SCHEMA, session: session.clone(), layout: layout.clone(), window }
    }
}

/// Keeps a session in a file.
pub struct Store {
    letters: Arc<Mailbox<Saved>>,
    writer: Option<JoinHandle<()>>,
    last: Option<Saved>,
    next: Instant,
}

/// What a file held.
pub enum Found {
    /// No file.
    Nothing,
    /// A session.
    Session(Box<Saved>),
    /// Something else: what is wrong, and where it was put.
    Damaged(String),
}

/// Where sessions are kept on this system.
pub fn file() -> Option<PathBuf> {
    match std::env::var_os(VARIABLE) {
        Some(own) => (!own.is_empty()).then(|| own.into()),
        None => Some(directories::ProjectDirs::from("", "", "nbrdf")?.data_local_dir().join("session.json")),
    }
}

/// Reads a session. A file that is none is put aside, so that nothing is lost.
pub fn read(file: &std::path::Path) -> Found {
    let text = match nbrdf_core::bounded::read(file, MOST_BYTES) {
        Ok(Some(text)) => text,
        Ok(None) => return Found::Damaged(format!("{}: too large for a session", file.display())),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Found::Nothing,
        Err(error) => return Found::Damaged(format!("{}: {error}", file.display())),
    };
    let why = match serde_json::from_slice::<Saved>(&text) {
        Ok(saved) if saved.schema == SCHEMA => {
            return Found::Session(Box::new(saved));
        }
        Ok(saved) => format!("expected schema {SCHEMA}, found {}", saved.schema),
        Err(error) => format!("expected a session, found {error}"),
    };
    let aside = file.with_extension("damaged.json");
    let kept = match std::fs::rename(file, &aside) {
        Ok(()) => format!("it is kept as {}", aside.display()),
        Err(error) => format!("it could not be put aside: {error}"),
    };
    Found::Damaged(format!("{}: {why}; {kept}, and a new session begins", file.display()))
}

/// A session is some kilobytes.
const MOST_BYTES: u64 = 16 << 20;

impl Store {
    /// Writes to this file from now on, on a thread of its own.
    pub fn new(file: PathBuf, complain: impl Fn(String) + Send + 'static) -> Self {
        let letters: Arc<Mailbox<Saved>> = Arc::default();
        let inbox = Arc::clone(&letters);
        let writer = std::thread::spawn(move || {
            while let Some(saved) = inbox.take() {
                if let Err(error) = write(&file, &saved) {
                    complain(format!("{}: the session is not saved: {error}", file.display()));
                }
            }
        });
        Self { letters, writer: Some(writer), last: None, next: Instant::now() }
    }

    /// Keeps what is there now, if it is news and the last is a while ago.
    pub fn keep(&mut self, session: &Session, layout: &Layout, window: Option<[f32; 2]>) {
        if Instant::now() >= self.next {
            self.put(Saved::new(session, layout, window));
        }
    }

    /// Keeps what is there at the end; returns once it is written.
    pub fn finish(&mut self, saved: Saved) {
        self.put(saved);
        self.letters.finish();
        self.writer.take().map(JoinHandle::join);
    }

    fn put(&mut self, saved: Saved) {
        self.next = Instant::now() + PATIENCE;
        if self.last.as_ref() != Some(&saved) {
            self.last = Some(saved.clone());
            self.letters.put(saved);
        }
    }
}

fn write(file: &std::path::Path, saved: &Saved) -> std::io::Result<()> {
    file.parent().map_or(Ok(()), std::fs::create_dir_all)?;
    atomic::write(file, &serde_json::to_vec_pretty(saved)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("deep").join("session.json");
        assert!(matches!(read(&file), Found::Nothing));
        let mut session = Session::default();
        session.blend.go_to(0.125);
        let mut store = Store::new(file.clone(), |why| panic!("{why}"));
        store.keep(&Session::default(), &Layout::default(), None);
        let saved = Saved::new(&session, &Layout::default(), Some([900.0, 600.0]));
        store.finish(saved.clone());
        let Found::Session(found) = read(&file) else { panic!("no session") };
        assert_eq!(*found, saved);
    }

    #[test]
    fn a_damaged_file_is_put_aside() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("session.json");
        for text in ["{", r#"{"schema": 1}"#, "[]"] {
            std::fs::write(&file, text).unwrap();
            let Found::Damaged(why) = read(&file) else { panic!("{text} was taken") };
            assert!(why.contains("session.json") && why.contains("damaged"), "{why}");
            assert_eq!(std::fs::read_to_string(folder.path().join("session.damaged.json")).unwrap(), text);
            assert!(!file.exists());
        }
    }
}
