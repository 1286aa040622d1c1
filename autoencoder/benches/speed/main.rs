//! Everything that must be fast, side by side in one run: `cargo bench -p autoencoder`.
//!
//! Ratios count: machines differ, and a busy one slows all alike.

mod codes;
mod evaluation;
mod pictures;
mod plain_candle;
mod training;

use criterion::{criterion_group, criterion_main};

criterion_group!(
    benches,
    evaluation::from_directions,
    evaluation::network_alone,
    evaluation::threads,
    pictures::spheres,
    codes::codes,
    training::fits,
    training::steps
);
criterion_main!(benches);
