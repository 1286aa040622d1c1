//! MERL tables.

#![no_main]

use nbrdf_core::merl::FILE_BYTES;
use nbrdf_fuzz::{BASE, Limit, check, readers};

/// The whole table is made from a few bytes: it is there as bytes, as numbers, and as bytes again.
const TABLE: usize = BASE + 4 * FILE_BYTES;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| check(Limit { base: TABLE, per_byte: 1024 }, readers::merl, bytes));
