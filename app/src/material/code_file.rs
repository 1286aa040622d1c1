//! Codes as files: small JSON, from a file or a pipe, believed only after a look.

use std::fmt::Display;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::Result;
use nbrdf_core::Code;
use nbrdf_core::library::is_name;

use crate::failure::Failure;
use crate::input::{check_file, is_missing, missing};

/// Extension of files of codes.
pub const EXTENSION: &str = "json";
/// Stands for standard input.
pub const STDIN: &str = "-";
/// What a path to a code should lead to.
const EXPECTED: &str = "a code";
/// Largest code read \[bytes\]; one of 32 numbers has some 600.
const MAX_BYTES: u64 = 1 << 20;
/// Longest code written: at most 16 digits, sign and comma included, of each number are below [`MAX_BYTES`].
pub const MAX_NUMBERS: usize = 1 << 15;

/// Whether an argument names a code rather than a material or a network.
pub fn means_a_code(argument: &str) -> bool {
    let extension = Path::new(argument).extension();
    argument == STDIN || extension.is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// What an error message calls it.
pub fn shown(argument: &str) -> String {
    if argument == STDIN { "standard input".to_owned() } else { argument.to_owned() }
}

/// Reads a code from a file, or from standard input for `-`. Its model has still to check its numbers.
pub fn read_code(argument: &str) -> Result<Code> {
    if argument != STDIN {
        let path = Path::new(argument);
        if is_missing(path) {
            return Err(missing(argument, EXPECTED, ", or make one with `nbrdf encode`").into());
        }
        check_file(path, EXPECTED)?;
    }
    let mut bytes = Vec::new();
    let read = match argument {
        STDIN => std::io::stdin().lock().take(MAX_BYTES + 1).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes)),
    };
    read.map_err(|error| invalid(argument, &format_args!("found none ({error})")))?;
    parse_code(argument, &bytes)
}

/// The same from bytes that came from `argument`.
pub fn parse_code(argument: &str, bytes: &[u8]) -> Result<Code> {
    let invalid = |found: &dyn Display| invalid(argument, found);
    if bytes.len() as u64 > MAX_BYTES {
        return Err(invalid(&format_args!("found more than {MAX_BYTES} bytes")).into());
    }
    let code: Code = serde_json::from_slice(bytes).map_err(|error| invalid(&format_args!("found {error}")))?;
    if code.schema != Code::SCHEMA {
        return Err(invalid(&format_args!("found schema {}", code.schema)).into());
    }
    if code.material.as_deref().is_some_and(|name| !is_name(name)) {
        return Err(invalid(&"found a material's name that is empty, too long or not printable").into());
    }
    if let Some(index) = code.code.iter().position(|v| !v.is_finite()) {
        return Err(invalid(&format_args!("found a number beyond all bounds at place {index}")).into());
    }
    Ok(code)
}

fn invalid(argument: &str, found: &dyn Display) -> Failure {
    let expected = format!("expected {EXPECTED} ({{\"schema\": 1, ...}})");
    Failure::InvalidFile(format!("{}: {expected}, {found}: make one with `nbrdf encode`", shown(argument)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message_for(json: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("code.json");
        std::fs::write(&path, json).unwrap();
        read_code(path.to_str().unwrap()).unwrap_err().to_string()
    }

    #[test]
    fn what_is_no_code_is_refused_with_what_was_found() {
        assert!(message_for("{}").contains("missing field"));
        assert!(message_for(r#"{"schema": 2, "model": "m", "checkpoint": "c", "code": []}"#).contains("schema 2"));
        let huge = r#"{"schema": 1, "model": "m", "checkpoint": "c", "code": [0, 1e39]}"#;
        assert!(message_for(huge).contains("place 1"));
        // Deep nesting is refused at its first bracket, not followed.
        assert!(message_for(&"[".repeat(100_000)).contains("invalid type"));
        assert!(message_for(&" ".repeat(2 << 20)).contains("more than 1048576 bytes"));
    }

    #[test]
    fn only_json_and_a_dash_mean_codes() {
        assert!(means_a_code("-") && means_a_code("a/b.JSON"));
        assert!(!means_a_code("chrome") && !means_a_code("chrome.npz"));
    }
}
