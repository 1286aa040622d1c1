//! Files to be written: refused before the work, not after it.

use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::extensions::listed;
use nbrdf_core::{Image, atomic};

use crate::failure::Failure;
use crate::report::png::png;

/// Extensions of pictures.
pub const PICTURES: [&str; 2] = ["png", "exr"];
/// Extensions of networks.
pub const NETWORKS: [&str; 3] = ["npz", "safetensors", "npy"];

/// Refuses a path of another extension, and one that cannot be written.
pub fn check(path: &Path, extensions: &[&str]) -> Result<()> {
    // A terminal, a pipe or a device has no extension.
    if std::fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return check_writable(path);
    }
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if !extensions.contains(&extension) {
        let path = path.display();
        return Err(Failure::Usage(format!("{path}: expected the extension {}", listed(extensions))).into());
    }
    check_writable(path)
}

/// Refuses a path that cannot be written.
pub fn check_writable(path: &Path) -> Result<()> {
    let refused = |error| Failure::InvalidFile(format!("{}: cannot be written: {error}", path.display()));
    atomic::check(path).map_err(|error| refused(error).into())
}

/// Refuses to write over a file that is read.
pub fn check_no_input(path: &Path, inputs: &[String]) -> Result<()> {
    let Ok(there) = path.canonicalize() else { return Ok(()) };
    let is_read = inputs.iter().any(|input| Path::new(input).canonicalize().is_ok_and(|input| input == there));
    if is_read {
        let path = path.display();
        return Err(Failure::Usage(format!("{path}: is read and would be written over: choose another name")).into());
    }
    Ok(())
}

/// Makes a folder to write into, and refuses one that cannot be written into.
pub fn make_folder(folder: &Path) -> Result<()> {
    let refused = |error| Failure::InvalidFile(format!("{}: cannot be written: {error}", folder.display()));
    let writable = std::fs::create_dir_all(folder).and_then(|()| atomic::check(&folder.join(".nbrdf")));
    writable.map_err(|error| refused(error).into())
}

/// Writes a picture in the form of its extension.
pub fn write_picture(path: &Path, picture: &Image) -> Result<()> {
    match path.extension().is_some_and(|extension| extension == "exr") {
        true => picture.write_exr(path)?,
        false => picture.write_png(path)?,
    }
    Ok(())
}

/// Writes a chart in the form of its extension: pixels as .png, else the SVG itself.
pub fn write_chart(path: &Path, svg: &str) -> Result<()> {
    let written = match path.extension().is_some_and(|extension| extension == "png") {
        true => atomic::write(path, &png(svg)?),
        false => atomic::write(path, svg.as_bytes()),
    };
    written.with_context(|| format!("{}: cannot be written", path.display()))
}
