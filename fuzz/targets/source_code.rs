//! Networks as source code.

#![no_main]

use nbrdf_fuzz::{BASE, Limit, check, readers};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| check(Limit { base: BASE, per_byte: 1024 }, readers::source_code, bytes));
