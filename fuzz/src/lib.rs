//! What all fuzz targets share: a reader, and the memory that it may take.
//!
//! A reader may take a base and so many bytes more for each byte of its input ([`Limit`]), everything that is done with what
//! was read included; the allocator counts. Each target states its own limit. Time is watched by libFuzzer itself (`-timeout`).

pub mod readers;

use peak_alloc::PeakAlloc;

#[global_allocator]
static COUNTED: PeakAlloc = PeakAlloc;

/// Bytes that a reader may take, whatever it reads, unless its target says otherwise.
pub const BASE: usize = 16 << 20;

/// Memory that a reader may take.
pub struct Limit {
    /// Bytes, whatever it reads.
    pub base: usize,
    /// Bytes for each byte of its input.
    pub per_byte: usize,
}

/// Reads `bytes`, and stops the fuzzer where that took more memory than the limit says.
pub fn check(limit: Limit, reader: fn(&[u8]) -> bool, bytes: &[u8]) {
    COUNTED.reset_peak_usage();
    let before = COUNTED.current_usage();
    reader(bytes);
    let taken = COUNTED.peak_usage().saturating_sub(before);
    let most = limit.base + limit.per_byte * bytes.len();
    assert!(taken <= most, "{taken} bytes of memory for {} bytes of input: more than {most}", bytes.len());
}

/// Panics within other people's decoders are caught where these are called, and are no failure. libFuzzer would stop at
/// them before they can be caught; those that are not caught stop it still. `NBRDF_FUZZ_PANICS` lets all be told.
pub fn let_panics_be_caught() {
    std::panic::set_hook(Box::new(|panic| {
        if std::env::var_os("NBRDF_FUZZ_PANICS").is_some() {
            eprintln!("{panic}");
        }
    }));
}
