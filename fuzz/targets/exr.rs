//! OpenEXR pictures.

#![no_main]

use nbrdf_fuzz::{BASE, Limit, check, readers};

libfuzzer_sys::fuzz_target!(init: nbrdf_fuzz::let_panics_be_caught(), |bytes: &[u8]| check(Limit { base: BASE, per_byte: 16384 }, readers::exr, bytes));
