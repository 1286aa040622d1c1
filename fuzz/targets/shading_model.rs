//! Parameters of standard shading models.

#![no_main]

use nbrdf_fuzz::{BASE, Limit, check, readers};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| check(Limit { base: BASE, per_byte: 1024 }, readers::shading_model, bytes));
