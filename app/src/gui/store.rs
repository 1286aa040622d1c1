//! The session's file: written while one works, read at the next start, so that a crash loses a second at most.

mod earlier;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use nbrdf_core::atomic;
use serde::{Deserialize, Serialize};
use serde_json::Value;

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
    /// Where the panes are, if they were ever shown.
    pub layout: Option<Layout>,
    /// Size of the window \[points\].
    pub window: Option<[f32; 2]>,
}

impl Saved {
    /// For the file.
    pub fn new(session: &Session, layout: Option<&Layout>, window: Option<[f32; 2]>) -> Self {
        Self { schema: SCHEMA, session: session.clone(), layout: layout.cloned(), window }
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
    /// The same, but it stays where it is: nothing may be written there.
    Stuck(String),
}

/// Where sessions are kept on this system.
pub fn file() -> Option<PathBuf> {
    match std::env::var_os(VARIABLE) {
        Some(_) => named(),
        None => Some(directories::ProjectDirs::from("", "", "nbrdf")?.data_local_dir().join("session.json")),
    }
}

/// Where sessions are kept by the user's own word.
pub fn named() -> Option<PathBuf> {
    std::env::var_os(VARIABLE).filter(|own| !own.is_empty()).map(PathBuf::from)
}

/// Reads a session. A file that is none is put aside, so that nothing is lost.
pub fn read(file: &Path) -> Found {
    let why = match nbrdf_core::bounded::read(file, MOST_BYTES) {
        Ok(Some(text)) => match parse(&text) {
            Ok(saved) => return Found::Session(Box::new(saved)),
            Err(why) => why,
        },
        Ok(None) => "too large for a session".to_owned(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Found::Nothing,
        Err(error) => error.to_string(),
    };
    match put_aside(file, "damaged.json") {
        Ok(aside) => {
            let kept = format!("it is kept as {}, and a new session begins", aside.display());
            Found::Damaged(format!("{}: {why}; {kept}", file.display()))
        }
        Err(error) => {
            let kept = format!("it could not be put aside ({error}), so that this session is not saved");
            Found::Stuck(format!("{}: {why}; {kept}", file.display()))
        }
    }
}

/// Gives a file another name, so that a new one does not take its place; that name.
///
/// # Errors
/// What the file system reports.
pub fn put_aside(file: &Path, ending: &str) -> std::io::Result<PathBuf> {
    let aside = free(&file.with_extension(ending));
    std::fs::rename(file, &aside).map(|()| aside)
}

/// A session in range; panes that are not understood are arranged anew.
fn parse(text: &[u8]) -> Result<Saved, String> {
    let found: Value = serde_json::from_slice(text).map_err(|error| format!("expected a session, found {error}"))?;
    let schema = found.get("schema").and_then(Value::as_u64);
    if schema != Some(SCHEMA.into()) {
        return Err(format!("expected a session of schema {SCHEMA}, found {schema:?}"));
    }
    let part = |name: &str| found.get(name).cloned().unwrap_or_default();
    let mut session = part("session");
    earlier::renew(&mut session);
    let session: Session =
        serde_json::from_value(session).map_err(|error| format!("expected a session, found {error}"))?;
    let layout = serde_json::from_value(part("layout")).ok().flatten();
    let window = serde_json::from_value(part("window")).ok().flatten();
    Ok(Saved { schema: SCHEMA, session: session.mended(), layout, window })
}

/// The path, or the first with a number that is not taken.
fn free(path: &Path) -> PathBuf {
    let numbered = |number: u32| match number {
        0 => path.to_owned(),
        _ => path.with_extension(format!("{number}.json")),
    };
    (0..1000).map(numbered).find(|path| !path.exists()).unwrap_or_else(|| path.to_owned())
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

    /// Keeps what is there now, if it is news and the last is a while ago; else how long to wait with it.
    pub fn keep(&mut self, session: &Session, layout: Option<&Layout>, window: Option<[f32; 2]>) -> Option<Duration> {
        let rest = self.next.saturating_duration_since(Instant::now());
        if !rest.is_zero() {
            return Some(rest);
        }
        self.put(Saved::new(session, layout, window));
        None
    }

    /// Keeps what is there at the end; returns once it is written.
    pub fn finish(&mut self, saved: Saved) {
        // Also what was put before: it may have been refused.
        self.letters.put(saved);
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

fn write(file: &Path, saved: &Saved) -> std::io::Result<()> {
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
        store.keep(&Session::default(), None, None);
        let saved = Saved::new(&session, Some(&Layout::of(1280.0)), Some([900.0, 600.0]));
        store.finish(saved.clone());
        let Found::Session(found) = read(&file) else { panic!("no session") };
        assert_eq!(*found, saved);
    }

    #[test]
    fn a_damaged_file_is_put_aside() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("session.json");
        let asides = ["session.damaged.json", "session.damaged.1.json", "session.damaged.2.json"];
        for (text, aside) in ["{", r#"{"schema": 1}"#, "[]"].into_iter().zip(asides) {
            std::fs::write(&file, text).unwrap();
            let Found::Damaged(why) = read(&file) else { panic!("{text} was taken") };
            assert!(why.contains("session.json") && why.contains("damaged"), "{why}");
            assert_eq!(std::fs::read_to_string(folder.path().join(aside)).unwrap(), text);
            assert!(!file.exists());
        }
        std::fs::File::create(&file).unwrap().set_len(MOST_BYTES + 1).unwrap();
        let Found::Damaged(why) = read(&file) else { panic!("no limit") };
        assert!(why.contains("too large") && folder.path().join("session.damaged.3.json").exists(), "{why}");
        let foreign = r#"{"schema": 1, "session": {"blend": {"t": 0.25}}, "layout": {"root": 7}, "window": "wide"}"#;
        std::fs::write(&file, foreign).unwrap();
        let Found::Session(found) = read(&file) else { panic!("a session of another version") };
        assert_eq!((found.session.blend.t, found.layout, found.window), (0.25, None, None));
    }
}
