//! `nbrdf info`: what is known about one material.

use std::collections::BTreeMap;

use anyhow::Result;
use autoencoder::Autoencoder;
use clap::Args;
use nbrdf_core::metric::{ImageMetric, Metric, Physics, Rendered, directional_albedo, log_error};
use nbrdf_core::nbrdf::Live;
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::stress::directions::undecided;
use nbrdf_core::{Database, Material, Nbrdf, Representation, Split, Warning};
use serde_json::{Value, json};

use super::{Global, of_code};
use crate::material::{Item, Sources};
use crate::measure::{Target, guard};
use crate::report;

/// Viewing angles at which albedo is told \[degrees\].
const ANGLES: [u16; 5] = [0, 30, 60, 75, 85];
/// Distance from known materials from where on a code is called far: twice of what these are apart.
const FAR: f64 = 2.0;

/// Tells albedo, energy, reciprocity, size, and how well the model knows a material.
#[derive(Debug, Args)]
pub struct Info {
    /// Name of a material, the file of a network or measurement, or a code (`-` for standard input).
    #[arg(value_name = "MATERIAL|FILE|CODE")]
    material: String,
    /// Another material, measurement or code: how far the first is from it, by every metric.
    #[arg(long, value_name = "MATERIAL|FILE|CODE")]
    against: Option<String>,
    #[command(flatten)]
    sources: Sources,
}

/// How far a material is from its own code, decoded.
struct Known {
    checkpoint: String,
    log_error: f64,
    studio_psnr: f64,
    distance: Option<f64>,
}

impl Info {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let shelf = self.sources.open()?;
        let item = shelf.material_or_code(&self.material)?;
        let physics = Physics::of(item.material.brdf.as_ref());
        let znbrdf = shelf.catalog.representation("znbrdf", false)?;
        let known = Known::of(&item.material, znbrdf.as_ref(), &shelf.catalog.autoencoder())?;
        let own = guard::of_reflectance(item.material.brdf.as_ref());
        let source = guard::of_source(item.material.brdf.as_ref());
        let warnings: Vec<Warning> = own
            .into_iter()
            .chain(undecided(item.material.brdf.as_ref()))
            .chain(source)
            .chain(of_code(&item, &shelf)?)
            .collect();
        let live = item.material.network.as_ref().map(|network| (network.live(), Live::all(network.hidden())));
        let lobe = Lobe::fit(item.material.brdf.as_ref());
        let albedo: Vec<_> = ANGLES.map(|angle| (angle, albedo(&item.material, angle))).to_vec();
        let against = match &self.against {
            Some(reference) => {
                let reference = shelf.material_or_code(reference)?.material;
                let figures = Target::new(reference.brdf.as_ref()).figures(item.material.brdf.as_ref());
                Some((reference.name, figures))
            }
            None => None,
        };
        shelf.catalog.check_used()?;
        let summary = json!({
            "schema": 1, "name": item.material.name, "database": Database::of(&item.material.name),
            "split": item.split(), "held_out": item.split() == Some(Split::HeldOut),
            "hidden": item.material.network.as_ref().map(Nbrdf::hidden),
            "live": live.as_ref().map(|(live, whole)| json!({
                "units": live.units.each_ref().map(Vec::len), "multiply_adds": live.multiply_adds(),
                "of_multiply_adds": whole.multiply_adds(),
            })),
            "lobe": lobe,
            "bytes": bytes(&item, znbrdf.dim()),
            "albedo": albedo.iter().map(|(angle, rgb)| json!({"degrees": angle, "rgb": rgb})).collect::<Vec<_>>(),
            "warnings": warnings,
            "albedo_max": physics.albedo_max, "negative_share": physics.negative_share,
            "reciprocity": physics.reciprocity,
            "znbrdf": {
                "checkpoint": known.checkpoint, "log_error": known.log_error, "studio_psnr": known.studio_psnr,
                "distance": known.distance,
            },
            "against": against.as_ref().map(|(name, figures)| json!({"name": name, "figures": figures})),
        });
        // A share below zero is told by its own line; most stored networks have some.
        let told = warnings.into_iter().filter(|warning| !matches!(warning, Warning::Negative { .. }));
        global.warn_of(&item.material.name, told)?;
        report::print(global, &summary, || {
            Text { item: &item, physics, albedo, known, live, lobe, against }.lines(znbrdf.dim())
        })
    }
}

impl Known {
    fn of(material: &Material, model: &dyn Representation, autoencoder: &Autoencoder) -> Result<Self> {
        let code = model.encode(material)?;
        let decoded = model.decode(&code)?;
        let values = |brdf| evaluate(brdf, rus32k());
        let log_error = log_error(rus32k(), &values(material.brdf.as_ref()), &values(decoded.as_ref()));
        let studio_psnr = Rendered::studio(ImageMetric::Psnr).distance(material.brdf.as_ref(), decoded.as_ref());
        Ok(Self {
            checkpoint: model.checkpoint().to_owned(),
            log_error,
            studio_psnr,
            distance: autoencoder.distance(&code)?,
        })
    }
}

fn albedo(material: &Material, degrees: u16) -> [f32; 3] {
    directional_albedo(material.brdf.as_ref(), f32::from(degrees).to_radians()).0
}

/// Size of each form as f32; what is shared by all materials is not counted.
fn bytes(item: &Item, dim: usize) -> Value {
    let weights = item.material.network.as_ref().map(|network| size_of_val(network.weights()));
    json!({ "weights": weights, "code": 4 * item.code.as_ref().map_or(dim, |code| code.code.len()) })
}

/// Everything that is told, for people.
struct Text<'a> {
    item: &'a Item,
    physics: Physics,
    albedo: Vec<(u16, [f32; 3])>,
    known: Known,
    /// What of a network can ever fire, and all of it.
    live: Option<(Live, Live)>,
    lobe: Lobe,
    /// Name and figures of what it is compared with.
    against: Option<(String, BTreeMap<String, f64>)>,
}

impl Text<'_> {
    fn lines(&self, dim: usize) -> String {
        let Self { item, physics, albedo, known, live, lobe, against } = self;
        let mut lines = vec![item.material.name.clone()];
        let mut line = |key: &str, value: String| lines.push(format!("  {key:16}{value}"));
        let split = match item.split() {
            Some(Split::HeldOut) => ", held out",
            // Of RGL nothing is learned, held out or not.
            Some(_) if Database::of(&item.material.name) == Database::Rgl => ", not learned from",
            Some(_) => ", learned from",
            None => "",
        };
        line("database", format!("{}{split}", Database::of(&item.material.name)));
        if let Some(network) = &item.material.network {
            let [first, second] = network.hidden();
            let (count, bytes) = (network.weights().len(), size_of_val(network.weights()));
            line("network", format!("6-{first}-{second}-3, {count} weights, {bytes} bytes"));
        }
        if let Some((live, whole)) = live {
            let [[fire, also], [first, second]] = [live, whole].map(|live| live.units.each_ref().map(Vec::len));
            let [own, all] = [live, whole].map(Live::multiply_adds);
            line("can fire", format!("{fire} + {also} of {first} + {second} units: {own} of {all} multiply-adds"));
        }
        line("lobe to sample", format!("share {:.3}, width {:.4}", lobe.share, lobe.width));
        let (model, numbers) = item.code.as_ref().map_or(("znbrdf", dim), |code| (&code.model, code.code.len()));
        line("code", format!("{model}, {numbers} numbers, {} bytes", 4 * numbers));
        for (angle, [r, g, b]) in albedo {
            line(&format!("albedo at {angle}°"), format!("{r:.3}  {g:.3}  {b:.3}"));
        }
        let verdict = if physics.albedo_max > 1.0 { "more light leaves than arrives" } else { "keeps energy" };
        line("albedo_max", format!("{:.3}  {verdict}", physics.albedo_max));
        line("reciprocity", format!("{:.4}  0 is reciprocal", physics.reciprocity));
        line("negative_share", format!("{:.4}  below 0 before the clamp", physics.negative_share));
        line("after its code", format!("log_error {:.4}, studio_psnr {:.1} dB", known.log_error, known.studio_psnr));
        if let Some(distance) = known.distance {
            let verdict = if distance > FAR { "far from all that training saw" } else { "near what training saw" };
            line("code's distance", format!("{distance:.2}  {verdict}; 1 is how far training materials are apart"));
        }
        if let Some((name, figures)) = against {
            line("against", name.clone());
            for (key, value) in figures {
                line(&format!("  {key:19}"), report::figure(*value));
            }
        }
        lines.join("\n") + "\n"
    }
}
