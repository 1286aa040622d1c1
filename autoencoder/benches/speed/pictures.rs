//! Frames of spheres under the three keys of light `studio`.

use criterion::Criterion;
use nbrdf_core::Image;
use nbrdf_core::render::{Light, Sphere};

use crate::evaluation::network;

/// One sphere of 256² with prepared geometry, and one of 1024² whose geometry is derived for every picture.
pub fn spheres(criterion: &mut Criterion) {
    let network = network();
    let light = Light { name: "keys", lamps: Light::studio().lamps[..3].to_vec() };
    let mut group = criterion.benchmark_group("sphere, three lamps");
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        for size in [256, 1024] {
            let sphere = Sphere::new(size, &light);
            let mut image = Image::black(size, size);
            group.bench_function(format!("{size} x {size}, threads: {threads}"), |bencher| {
                pool.install(|| bencher.iter(|| sphere.render_into(&network, &mut image)));
            });
        }
    }
}
