//! Running the real program in a folder of its own.

use std::io::Write;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::npy;
use serde_json::Value;
use tempfile::TempDir;

/// A folder, and the program run in it.
pub struct Place(TempDir);

impl Place {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn file(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn write(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.path().join(name), bytes).unwrap();
    }

    /// A folder of built-in networks.
    pub fn library<'a>(&self, folder: &str, materials: impl IntoIterator<Item = &'a str>) {
        std::fs::create_dir(self.path().join(folder)).unwrap();
        for name in materials {
            let network = &builtin::shared().get(name).unwrap().network;
            self.write(&format!("{folder}/{name}.npz"), &npy::write_npz(network));
        }
    }

    /// Names in the folder, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Starts the program and does not wait for it; what it says is thrown away.
    #[allow(dead_code, reason = "not every test binary stops programs")]
    pub fn start(&self, arguments: &[&str]) -> Child {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nbrdf"));
        command.args(arguments).current_dir(self.path());
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    }

    pub fn run(&self, arguments: &[&str]) -> Run {
        self.run_with_input(arguments, b"")
    }

    pub fn run_with_input(&self, arguments: &[&str], input: &[u8]) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nbrdf"));
        command.args(arguments).current_dir(self.path());
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().unwrap();
        // A program that does not read its input may be gone already.
        let _ = child.stdin.take().unwrap().write_all(input);
        Run { arguments: arguments.join(" "), output: child.wait_with_output().unwrap() }
    }
}

/// How a run went.
pub struct Run {
    arguments: String,
    output: Output,
}

impl Run {
    /// Expects success; standard output.
    #[track_caller]
    pub fn ok(self) -> Vec<u8> {
        assert_eq!(self.output.status.code(), Some(0), "nbrdf {}: {}", self.arguments, self.talk());
        self.output.stdout
    }

    /// Expects success; standard output as text.
    #[track_caller]
    pub fn text(self) -> String {
        String::from_utf8(self.ok()).unwrap()
    }

    /// Expects success and nothing but a report on standard output.
    #[track_caller]
    pub fn json(self) -> Value {
        let value: Value = serde_json::from_slice(&self.ok()).unwrap();
        assert_eq!(value["schema"], 1);
        value
    }

    /// Expects this exit code and nothing on standard output; what was said on standard error.
    #[track_caller]
    pub fn fails(self, code: i32) -> String {
        assert_eq!(self.output.status.code(), Some(code), "nbrdf {}: {}", self.arguments, self.talk());
        assert!(self.output.stdout.is_empty(), "nbrdf {} fails, yet prints data", self.arguments);
        self.talk()
    }

    /// Standard error.
    pub fn talk(&self) -> String {
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }
}
