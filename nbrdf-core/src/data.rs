//! Published files that are no part of the repository: networks, measured tables, fits.
//!
//! They are looked for in the folder named by the environment variable `NBRDF_DATA`; without it in `../shared/data`
//! beside the repository (seen from the current folder, or from the package that cargo runs).

use std::{
    env,
    io::{Write, stderr},
    path::PathBuf,
};

/// The folder of published files, whether it exists or not.
pub fn folder() -> PathBuf {
    if let Some(folder) = env::var_os("NBRDF_DATA").filter(|folder| !folder.is_empty()) {
        return folder.into();
    }
    // Asked at run time: no path of the machine that built it goes into the binary.
    match env::var_os("CARGO_MANIFEST_DIR") {
        Some(package) => PathBuf::from(package).join("../../shared/data"),
        None => PathBuf::from("../shared/data"),
    }
}

/// A published file or folder by its name in [`folder`] (`merl_nbrdf.zip`); none where it is absent.
pub fn published(file: &str) -> Option<PathBuf> {
    Some(folder().join(file)).filter(|path| path.exists())
}

/// [`published`] for tests: says so loudly on stderr where the file is absent; the test then returns.
///
/// # Panics
/// If the file is absent and `NBRDF_REQUIRE_DATA` is `1`.
pub fn published_or_skip(file: &str) -> Option<PathBuf> {
    let found = published(file);
    if found.is_none() {
        let missing = format!("{file} is not in {}: set NBRDF_DATA to the folder that holds it", folder().display());
        assert!(env::var_os("NBRDF_REQUIRE_DATA").is_none_or(|v| v != "1"), "{missing}");
        // Straight to the stream: the test harness swallows `eprintln!` of tests that pass.
        let _ = writeln!(stderr(), "*** TEST SKIPPED: {missing} ***");
    }
    found
}
