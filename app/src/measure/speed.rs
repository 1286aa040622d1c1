//! How fast everything is here and now: evaluation beside the plain loop, pruning, codes, spheres.

use std::sync::Arc;

use anyhow::Result;
use autoencoder::Autoencoder;
use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::lambert::Lambert;
use nbrdf_core::brdf::table::{Lookup, Table};
use nbrdf_core::cost::{Cost, FixedArrays, Given, NETWORK_FLOP, Track, WithSet, peak_fma, seconds};
use nbrdf_core::nbrdf::fit::{FitOptions, fit, random_network};
use nbrdf_core::render::{Light, Sphere};
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::simd::InstructionSet;
use nbrdf_core::{Brdf, Image, Material, Nbrdf, Representation, Rgb};
use rayon::prelude::*;
use serde::Serialize;

/// One model's evaluation.
#[derive(Debug, Serialize)]
pub struct Evaluation {
    /// Name of the model.
    pub name: String,
    /// `directions`: conversion included; `prepared`: half and difference vectors known.
    pub given: &'static str,
    /// Nanoseconds, and how many times the reference loop takes as long.
    #[serde(flatten)]
    pub cost: Cost,
    /// Share of the multiply-add peak of its instruction set; only for whole networks.
    pub efficiency: Option<f64>,
    /// Bytes that evaluation reads of the model.
    pub bytes: usize,
}

/// What pruning saves of one material's network.
#[derive(Debug, Serialize)]
pub struct Saving {
    /// The material.
    pub name: String,
    /// Units of both layers that can fire.
    pub live: [usize; 2],
    /// Of 630 multiplications.
    pub multiply_adds: usize,
    /// Nanoseconds of the whole and of the pruned network, from directions.
    pub ns: [f64; 2],
    /// The same, network alone.
    pub prepared_ns: [f64; 2],
}

/// A model to be timed.
struct Contestant {
    name: String,
    given: Given,
    /// The limit of its instruction set \[GFLOP/s\], for whole networks in vectors.
    peak: Option<f64>,
    bytes: usize,
    brdf: Box<dyn Brdf>,
}

/// One network in all its forms beside formulas and tables, `repeats` runs each. The reference loop is the first.
pub fn evaluation(material: &Material, network: &Nbrdf, repeats: usize) -> Vec<Evaluation> {
    let weights = size_of_val(network.weights());
    let contestants: Vec<Contestant> = networks(network, weights).into_iter().chain(others(material)).collect();
    let models: Vec<(&dyn Brdf, Given)> = contestants.iter().map(|own| (own.brdf.as_ref(), own.given)).collect();
    let costs = Track::new(0).measure(&models, repeats);
    let reference = costs.first().map(|cost| Evaluation {
        name: "reference_loop".to_owned(),
        given: name(Given::Directions),
        cost: Cost { ns: cost.ns * cost.ratio_to_reference_loop, ratio_to_reference_loop: 1.0 },
        efficiency: None,
        bytes: weights,
    });
    let row = |(own, cost): (Contestant, Cost)| Evaluation {
        efficiency: own.peak.map(|peak| NETWORK_FLOP / cost.ns / peak),
        given: name(own.given),
        name: own.name,
        cost,
        bytes: own.bytes,
    };
    reference.into_iter().chain(contestants.into_iter().zip(costs).map(row)).collect()
}

const fn name(given: Given) -> &'static str {
    match given {
        Given::Directions => "directions",
        Given::Prepared => "prepared",
    }
}

/// The network with every kind of vectors, as it is used, and pruned.
fn networks(network: &Nbrdf, bytes: usize) -> Vec<Contestant> {
    let mut all = Vec::new();
    if let Some(arrays) = FixedArrays::new(network) {
        let name = "fixed_arrays".to_owned();
        all.push(Contestant { name, given: Given::Directions, peak: None, bytes, brdf: Box::new(arrays) });
    }
    for given in [Given::Directions, Given::Prepared] {
        for set in InstructionSet::available() {
            let name = format!("nbrdf_{}", set.name());
            let peak = set.is_vector().then(|| peak_fma(set));
            all.push(Contestant {
                name,
                given,
                peak,
                bytes,
                brdf: Box::new(WithSet { network: network.clone(), set }),
            });
        }
        let pruned = network.pruned();
        let bytes = size_of::<f32>() * pruned.evaluated().weights();
        all.push(Contestant { name: "nbrdf_pruned".to_owned(), given, peak: None, bytes, brdf: Box::new(pruned) });
    }
    all
}

/// Formulas and tables, in vectors too.
fn others(material: &Material) -> [Contestant; 4] {
    let grey = Rgb::splat(0.2);
    let nearest = Table::tabulate(material.brdf.as_ref(), Lookup::Nearest);
    let (bytes, trilinear) = (nearest.bytes(), nearest.clone().with_lookup(Lookup::Trilinear));
    let lambert = Lambert { albedo: grey };
    let ggx = Ggx { diffuse: grey, f0: Rgb::splat(0.04), alpha: 0.2 };
    let of = |name: &str, bytes, brdf| Contestant {
        name: name.to_owned(),
        given: Given::Directions,
        peak: None,
        bytes,
        brdf,
    };
    [
        of("lambert", size_of_val(&lambert), Box::new(lambert)),
        of("ggx", size_of_val(&ggx), Box::new(ggx)),
        of("table_nearest", bytes, Box::new(nearest)),
        of("table_trilinear", bytes, Box::new(trilinear)),
    ]
}

/// What pruning saves of every material that has a network, `repeats` runs each.
pub fn pruning(materials: &[Material], repeats: usize, done: &dyn Fn()) -> Vec<Saving> {
    let networks: Vec<(&str, &Nbrdf)> =
        materials.iter().filter_map(|material| Some((material.name.as_str(), material.network.as_ref()?))).collect();
    let pruned: Vec<Nbrdf> = networks.par_iter().map(|(_, network)| network.pruned()).collect();
    let track = Track::new(0);
    let one = |((name, whole), pruned): (&(&str, &Nbrdf), &Nbrdf)| {
        let whole: &dyn Brdf = *whole;
        let forms = [Given::Directions, Given::Prepared].map(|given| [(whole, given), (pruned as &dyn Brdf, given)]);
        let costs = track.measure(forms.as_flattened(), repeats);
        let live = pruned.evaluated();
        done();
        Saving {
            name: (*name).to_owned(),
            live: [live.units[0].len(), live.units[1].len()],
            multiply_adds: live.multiply_adds(),
            ns: [costs[0].ns, costs[1].ns],
            prepared_ns: [costs[2].ns, costs[3].ns],
        }
    };
    networks.iter().zip(&pruned).map(one).collect()
}

/// Seconds of encoding, decoding and refining on one thread.
#[derive(Debug, Serialize)]
pub struct Codes {
    /// One pass of the encoder.
    pub encoder_s: f64,
    /// The encoder and the unrolled steps.
    pub encode_s: f64,
    /// A network from a code.
    pub decode_s: f64,
    /// The encoder, then refined against the material.
    pub refine_s: f64,
}

/// Of this material.
pub fn codes(znbrdf: &Arc<Autoencoder>, material: &Material, repeats: usize) -> Result<Codes> {
    let code = znbrdf.encode(material)?;
    let mut place = znbrdf.decode(&code)?;
    let (unrolled, refined) = (Refined::briefly(Arc::clone(znbrdf)), Refined::new(Arc::clone(znbrdf)));
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    Ok(one_thread.install(|| Codes {
        encoder_s: seconds(repeats, || drop(znbrdf.encode(material))),
        encode_s: seconds(repeats, || drop(unrolled.encode(material))),
        decode_s: seconds(repeats, || drop(znbrdf.decode_into(&code.code, &mut place))),
        refine_s: seconds(repeats.div_ceil(4), || drop(refined.encode(material))),
    }))
}

/// Fitting one network on one thread.
#[derive(Debug, Serialize)]
pub struct Fit {
    /// Steps of 512 directions.
    pub steps: usize,
    /// Seconds per step, the drawing of directions included.
    pub step_s: f64,
}

/// Of this material, from a random start.
pub fn fitting(material: &Material, repeats: usize) -> Result<Fit> {
    let (options, start) = (FitOptions::default(), random_network(0, 0));
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let whole =
        one_thread.install(|| seconds(repeats, || drop(fit(&start, material.brdf.as_ref(), options, &|| false))));
    Ok(Fit { steps: options.steps, step_s: whole / options.steps as f64 })
}

/// Seconds of pictures under the three keys of light `studio`.
#[derive(Debug, Serialize)]
pub struct Spheres {
    /// Threads used.
    pub threads: usize,
    /// Four spheres of 256², geometry prepared, weights changed before each: a frame of scrubbing.
    pub four_of_256_s: f64,
    /// The same with display bytes.
    pub four_of_256_displayed_s: f64,
    /// One of 1024², geometry derived anew.
    pub one_of_1024_s: f64,
}

/// Of this network.
pub fn spheres(network: &Nbrdf, threads: usize, repeats: usize) -> Result<Spheres> {
    let light = Light { name: "keys", lamps: Light::studio().lamps[..3].to_vec() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    Ok(pool.install(|| {
        let (small, large) = (Sphere::new(256, &light), Sphere::new(1024, &light));
        let (mut image, mut big) = (Image::black(256, 256), Image::black(1024, 1024));
        let mut bytes = Vec::new();
        let mut network = network.clone();
        let weights = network.weights().to_vec();
        let mut frame = |displayed: bool| {
            for _ in 0..4 {
                // The weights were valid before.
                let _ = network.set_weights(&weights);
                small.render_into(&network, &mut image);
                if displayed {
                    image.display_bytes_into(1.0, &mut bytes);
                }
            }
        };
        let four_of_256_s = seconds(repeats, || frame(false));
        let four_of_256_displayed_s = seconds(repeats, || frame(true));
        let one_of_1024_s = seconds(repeats.div_ceil(4), || large.render_into(&network, &mut big));
        Spheres { threads, four_of_256_s, four_of_256_displayed_s, one_of_1024_s }
    }))
}
