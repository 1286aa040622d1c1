//! Programs made of source code by a compiler, and run.

use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

use super::{bytes, compare, directions, materials, numbers, values};

/// A compiler that makes `program` of one file.
pub struct Compiler {
    /// The environment variable that names it.
    pub variable: &'static str,
    /// Its name otherwise.
    pub program: &'static str,
    /// The file.
    pub source: &'static str,
    /// What it is told before the file's name.
    pub words: &'static [&'static str],
    /// And after it.
    pub libraries: &'static [&'static str],
}

impl Compiler {
    /// Compiles in a folder of its own, without a warning; the folder. None, said loudly, where there is no such compiler.
    pub fn compile(&self, source: &str) -> Option<TempDir> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(self.source), source).unwrap();
        let named = std::env::var_os(self.variable).filter(|name| !name.is_empty());
        let program = named.unwrap_or_else(|| OsString::from(self.program));
        let words = self.words.iter().chain([&self.source]).chain(self.libraries);
        let done = Command::new(&program).args(words).current_dir(folder.path()).output();
        match done {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let required = format!("NBRDF_REQUIRE_{}", self.variable);
                assert!(std::env::var_os(&required).is_none_or(|v| v != "1"), "no {}: {required} is set", self.program);
                let skipped = format!("*** TEST SKIPPED: no {}: set {} to one ***", self.program, self.variable);
                // Straight to the stream: the test harness swallows `eprintln!` of tests that pass.
                let _ = writeln!(std::io::stderr(), "{skipped}");
                None
            }
            done => {
                let done = done.unwrap();
                let said = String::from_utf8_lossy(&done.stderr);
                assert!(done.status.success() && said.is_empty(), "{program:?}: {said}");
                Some(folder)
            }
        }
    }

    /// Compiles a program that reads pairs, six numbers each, and writes three numbers for each material and pair; compares
    /// them with the library's.
    pub fn compare(&self, source: &str) {
        let Some(folder) = self.compile(source) else { return };
        let found = values(&run(&folder.path().join("program"), &bytes(&numbers(&directions()))));
        let each = 3 * directions().len();
        for ((shader, brdf), found) in materials().iter().zip(found.chunks(each)) {
            compare(self.source, shader, brdf.as_ref(), found);
        }
        assert_eq!(found.len(), each * materials().len());
    }
}

fn run(program: &Path, input: &[u8]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let given = folder.path().join("input");
    std::fs::write(&given, input).unwrap();
    let input = Stdio::from(std::fs::File::open(&given).unwrap());
    let done = Command::new(program).stdin(input).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    done.stdout
}
