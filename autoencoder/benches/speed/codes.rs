//! Codes of the built-in checkpoint: encode, decode, refine.

use std::sync::Arc;

use autoencoder::{Architecture, Autoencoder};
use criterion::Criterion;
use nbrdf_core::Representation;
use nbrdf_core::library::builtin;
use nbrdf_core::representation::refined::Refined;

/// On one thread.
pub fn codes(criterion: &mut Criterion) {
    let znbrdf = Autoencoder::built_in(Architecture::Znbrdf);
    let material = builtin::shared().get("gold-paint").expect("a built-in material").material();
    let code = znbrdf.encode(&material).expect("a code");
    let mut place = znbrdf.decode(&code).expect("a reflectance");
    let (unrolled, refined) = (Refined::briefly(Arc::clone(&znbrdf)), Refined::new(Arc::clone(&znbrdf)));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = criterion.benchmark_group("codes");
    group.bench_function("encoder alone", |bencher| bencher.iter(|| znbrdf.encode(&material)));
    group.bench_function("decode", |bencher| bencher.iter(|| znbrdf.decode(&code)));
    group.bench_function("decode in place", |bencher| bencher.iter(|| znbrdf.decode_into(&code.code, &mut place)));
    group.bench_function("derivatives by the code", |bencher| bencher.iter(|| znbrdf.linearize(&code.code)));
    group.sample_size(10);
    group.bench_function("encode", |bencher| one.install(|| bencher.iter(|| unrolled.encode(&material))));
    group.bench_function("refine", |bencher| one.install(|| bencher.iter(|| refined.encode(&material))));
}
