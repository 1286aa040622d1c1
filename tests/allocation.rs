//! Scrubbing asks the system for no memory: from the slider's value to the bytes on the display.

use std::sync::Arc;

use dhat::{Alloc, HeapStats, Profiler};
use nbrdf::catalog::{Catalog, Reference};
use nbrdf_core::Weights;
use nbrdf_core::library::builtin;
use nbrdf_core::render::{Scrub, Sphere};

#[global_allocator]
static ALLOCATOR: Alloc = Alloc;

#[test]
fn a_frame_of_scrubbing_allocates_nothing() {
    let _profiler = Profiler::builder().testing().build();
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let ends = ["gold-paint", "blue-acrylic"].map(|name| builtin::shared().get(name).unwrap().material());
    let sphere = Arc::new(Sphere::new(96, Sphere::studio().light()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    for method in ["latent", "latent_refined", "raw_weights", "aligned_weights", "shared_start"] {
        let path = Arc::from(catalog.interpolation(method).unwrap().between(&ends).unwrap());
        let mut scrub = Scrub::new(Arc::clone(&sphere), path, &Weights::two(0.0)).unwrap();
        let before = scrub.display_bytes().to_vec();
        assert!(HeapStats::get().total_blocks > 0, "allocations are counted");
        let mut frames = |count: usize| {
            for frame in 0..count {
                scrub.show(&Weights::two(frame as f32 / count as f32), 1.0).unwrap();
            }
        };
        // The first frames warm up what each thread keeps.
        let counted = pool.install(|| {
            frames(32);
            let start = HeapStats::get().total_blocks;
            frames(100);
            HeapStats::get().total_blocks - start
        });
        assert_eq!(counted, 0, "{method}: {counted} allocations in 100 frames");
        assert_ne!(scrub.display_bytes(), before, "{method}: the picture has moved");
    }
}
