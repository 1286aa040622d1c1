//! What a file stands for: the forms that are read are told apart by their extensions.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::extensions::listed;
use nbrdf_core::library::is_name;
use nbrdf_core::measured::{self, Measured, is_measured};
use nbrdf_core::nbrdf::file::{Form, read_anisotropic};
use nbrdf_core::{Library, Material};

use super::{Item, code_file};
use crate::failure::Failure;
use crate::input;

/// An archive of networks.
const ARCHIVE: &str = "zip";

/// A path, rather than a misspelt name: it has an extension, or says where it lies, or is there.
pub(super) fn means_a_file(argument: &str) -> bool {
    let path = Path::new(argument);
    let is_placed = argument.starts_with("./") || argument.starts_with("../") || path.is_absolute();
    path.extension().is_some() || is_placed || path.exists()
}

/// What a file should be, by its extension.
fn expected(path: &Path) -> &'static str {
    let extension = extension(path);
    match extension.as_str() {
        code_file::EXTENSION => "the file of a code",
        ARCHIVE => "an archive of networks",
        form if Form::EXTENSIONS.contains(&form) => "the file of a network",
        _ if is_measured(path) => "the file of a measurement",
        _ => "the name or the file of a material",
    }
}

/// The failure of a file that is not there; names that may have been meant are told.
pub(super) fn missing(path: &Path, names: &[String]) -> Failure {
    let list = "`nbrdf list` names the materials";
    let more = match names.first() {
        Some(name) => format!("; {list}, such as `{name}`"),
        None => format!("; {list}"),
    };
    input::missing(path.display(), expected(path), &more)
}

/// The material in a file; `names` are those of the library that come near.
pub(super) fn item_in(path: &Path, names: &[String]) -> Result<Item> {
    if input::is_missing(path) {
        return Err(missing(path, names).into());
    }
    if is_measured(path) {
        return measured_in(path);
    }
    if !path.is_dir() && !is_read(path) {
        let path = path.display();
        let found =
            format!("{path}: expected {}, found another extension: rename the file if it is one of these", forms());
        return Err(Failure::InvalidFile(found).into());
    }
    if let Some(network) = read_anisotropic(path)? {
        check_name(path)?;
        return Ok(Item::of_file(measured::material(path, Arc::new(network)), true));
    }
    let mut entries = Library::load(path)?.into_entries();
    match (entries.pop(), entries.len()) {
        (Some(entry), 0) => Ok(Item::of_entry(entry)),
        (_, others) => {
            let path = path.display();
            let found = format!("{path} holds {} materials: name one of them, with --library {path}", others + 1);
            Err(Failure::Usage(found).into())
        }
    }
}

/// A measured table is a material; a list of samples is none yet.
fn measured_in(path: &Path) -> Result<Item> {
    input::check_file(path, expected(path))?;
    check_name(path)?;
    let of = |table| -> Material { measured::material(path, table) };
    match Measured::load(path)? {
        Measured::Everywhere(table) => Ok(Item::of_file(of(table), false)),
        Measured::Turning(table) => Ok(Item::of_file(of(table), true)),
        Measured::Somewhere(_) => {
            let path = path.display();
            let found = format!(
                "{path} holds samples at some directions: `nbrdf fit {path} -o NETWORK.npz` makes a material of them"
            );
            Err(Failure::Usage(found).into())
        }
    }
}

/// Refuses a file whose name makes no material's name.
fn check_name(path: &Path) -> Result<()> {
    if !is_name(&measured::name_of(path)) {
        let path = path.display();
        return Err(Failure::InvalidFile(format!("{path}: expected a printable name: rename the file")).into());
    }
    Ok(())
}

/// Whether an extension is one that [`forms`] lists, or that of a file in a library.
fn is_read(path: &Path) -> bool {
    let extension = extension(path);
    Form::EXTENSIONS.contains(&&*extension) || [ARCHIVE, code_file::EXTENSION].contains(&&*extension)
}

/// All forms that materials are read in, for messages.
fn forms() -> String {
    let (networks, measurements) = (listed(&Form::EXTENSIONS), listed(&measured::EXTENSIONS));
    let code = code_file::EXTENSION;
    format!("a network ({networks}; .{ARCHIVE} or a folder of one), a measurement ({measurements}) or a code (.{code})")
}

fn extension(path: &Path) -> String {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_an_extension_or_says_where_it_lies() {
        assert!(["a.npz", "a.foo", "./chrome", "../a", "/a"].into_iter().all(means_a_file));
        assert!(["chrome", "rgl/paper_white", "a/b/c", ""].iter().all(|name| !means_a_file(name)));
    }

    #[test]
    fn every_form_that_is_read_is_listed() {
        let all = [&Form::EXTENSIONS[..], &measured::EXTENSIONS, &[ARCHIVE, code_file::EXTENSION]].concat();
        for extension in all {
            assert!(forms().contains(&format!(".{extension}")), "{extension}");
            assert_ne!(expected(Path::new(&format!("a.{extension}"))), expected(Path::new("a.foo")), "{extension}");
        }
    }
}
