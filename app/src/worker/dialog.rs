//! The system's own dialog for opening files.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use nbrdf_core::measured;
use nbrdf_core::scene::Mesh;

/// Nobody closes a dialog as fast as it fails.
const FASTEST: Duration = Duration::from_millis(300);
/// Networks, libraries, codes, environment maps and scenes.
const OTHERS: [&str; 10] = ["npz", "npy", "safetensors", "h5", "hdf5", "zip", "json", "hdr", "exr", "toml"];

/// Shows the dialog and waits until it is closed; the files chosen.
///
/// # Errors
/// If the system has no such dialog.
pub(super) fn native() -> Result<Vec<PathBuf>, String> {
    let start = Instant::now();
    let extensions: Vec<&str> = OTHERS.into_iter().chain(Mesh::ENDINGS).chain(measured::EXTENSIONS).collect();
    let dialog = rfd::FileDialog::new().set_title("Open materials, maps, meshes or scenes");
    let dialog = dialog.add_filter("Materials, maps, meshes and scenes", &extensions);
    match dialog.add_filter("All files", &["*"]).pick_files() {
        Some(files) => Ok(files),
        // It gives no reason; the time tells one that was closed from one that was never shown.
        None if start.elapsed() < FASTEST => Err("This system shows no file dialog".to_owned()),
        None => Ok(Vec::new()),
    }
}
