//! `nbrdf speed`: how fast evaluation, codes and spheres are on this machine.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::cost::{REPEATS, peak_fma};
use nbrdf_core::metric::Spread;
use nbrdf_core::simd::InstructionSet;
use serde_json::{Value, json};

use super::Global;
use crate::catalog::Reference;
use crate::material::Sources;
use crate::measure::speed::{Evaluation, Saving, codes, evaluation, fitting, pruning, spheres};
use crate::report::table::Table;
use crate::{progress, report};

/// Measures speed on this machine: evaluation beside the plain loop, pruning, codes, spheres.
///
/// Takes some seconds; other work on the machine shows in the nanoseconds, less in the ratios.
#[derive(Debug, Args)]
pub struct Speed {
    /// Networks to prune and time; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Material whose network stands beside formulas and tables.
    #[arg(long, value_name = "MATERIAL", default_value = "gold-paint")]
    material: String,
    #[command(flatten)]
    sources: Sources,
}

impl Speed {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let reference = Reference::load(self.reference.as_deref())?;
        let shelf = self.sources.open()?;
        let material = &shelf.material(&self.material)?.material;
        shelf.catalog.check_used()?;
        let network = material.network.as_ref().with_context(|| format!("{}: has no network", material.name))?;
        let bar = progress::bar(reference.materials.len() as u64, "timing", global.quiet);
        let rows = evaluation(material, network, 2 * REPEATS);
        let savings = pruning(&reference.materials, 9, &|| bar.inc(1));
        bar.finish_and_clear();
        let threads = rayon::current_num_threads().min(2);
        let pictures = spheres(network, threads, REPEATS)?;
        let codes = codes(&shelf.catalog.autoencoder(), material, REPEATS)?;
        let sets = InstructionSet::available();
        let peaks: Vec<Value> = sets.iter().map(|set| json!({"name": set.name(), "gflops": peak_fma(*set)})).collect();
        let summary = json!({
            "schema": 1, "reference": reference.kind, "material": material.name, "processor": processor(),
            "instruction_set": InstructionSet::fastest().name(), "peaks": peaks,
            "evaluation": rows, "pruning": pruned(&savings), "codes": codes, "fit": fitting(material, 5)?, "spheres": pictures,
        });
        report::print(global, &summary, || text(&summary, &rows))
    }
}

/// What the system calls its processor, else the architecture.
fn processor() -> String {
    let known = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |key: &str| {
        let of =
            |line: &str| line.split_once(':').filter(|(name, _)| name.trim() == key).map(|(_, v)| v.trim().to_owned());
        known.lines().find_map(of)
    };
    let Some(name) = field("model name") else { return std::env::consts::ARCH.to_owned() };
    // A guest's name may say no more than the maker's.
    match (field("cpu family"), field("model")) {
        (Some(family), Some(model)) => format!("{name} (family {family}, model {model})"),
        _ => name,
    }
}

/// The savings, their spread, and how much faster pruned networks are on average.
fn pruned(savings: &[Saving]) -> Value {
    let spread = |value: &dyn Fn(&Saving) -> f64| {
        json!(Spread::new(savings.iter().map(|saving| (saving.name.as_str(), value(saving))), false))
    };
    let mean = |value: &dyn Fn(&Saving) -> f64| savings.iter().map(value).sum::<f64>() / savings.len().max(1) as f64;
    json!({
        "multiply_adds": spread(&|saving| saving.multiply_adds as f64),
        "live": [mean(&|saving| saving.live[0] as f64), mean(&|saving| saving.live[1] as f64)],
        "times_faster": mean(&|saving| saving.ns[0] / saving.ns[1]),
        "times_faster_prepared": mean(&|saving| saving.prepared_ns[0] / saving.prepared_ns[1]),
        "materials": savings,
    })
}

fn text(summary: &Value, rows: &[Evaluation]) -> String {
    let head = ["model", "given", "ns", "x reference_loop", "of peak", "bytes"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    for row in rows {
        let efficiency = row.efficiency.map_or_else(|| "-".to_owned(), |share| format!("{:.0} %", 100.0 * share));
        let ratio = report::figure(row.cost.ratio_to_reference_loop);
        let ns = report::figure(row.cost.ns);
        table.push(vec![row.name.clone(), row.given.to_owned(), ns, ratio, efficiency, row.bytes.to_string()]);
    }
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN);
    let peaks: Vec<String> = summary["peaks"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|peak| {
            format!("{} {:.0}", peak["name"].as_str().unwrap_or_default(), peak["gflops"].as_f64().unwrap_or(0.0))
        })
        .collect();
    format!(
        "One thread of {}, batches of 4096 directions; multiply-add peak in GFLOP/s: {}\n\n{table}\n\
         Pruning, {} networks ({}): {:.1} + {:.1} of 21 + 21 units can fire, {:.0} of 630 multiply-adds ({:.0} at most);\n\
         {:.2} times faster from directions, {:.2} times with half and difference vectors given\n\
         Codes: encoder alone {:.0} us, encode {:.1} ms, decode {:.0} us, refine {:.0} ms; one step of a fit {:.0} us\n\
         Spheres on {} threads, three lamps: four of 256 x 256 in {:.2} ms ({:.2} ms with display bytes), \
         one of 1024 x 1024 in {:.1} ms\n",
        summary["processor"].as_str().unwrap_or_default(),
        peaks.join(", "),
        summary["pruning"]["materials"].as_array().map_or(0, Vec::len),
        summary["reference"].as_str().unwrap_or_default(),
        number("/pruning/live/0"),
        number("/pruning/live/1"),
        number("/pruning/multiply_adds/mean"),
        number("/pruning/multiply_adds/max"),
        number("/pruning/times_faster"),
        number("/pruning/times_faster_prepared"),
        1e6 * number("/codes/encoder_s"),
        1e3 * number("/codes/encode_s"),
        1e6 * number("/codes/decode_s"),
        1e3 * number("/codes/refine_s"),
        1e6 * number("/fit/step_s"),
        number("/spheres/threads"),
        1e3 * number("/spheres/four_of_256_s"),
        1e3 * number("/spheres/four_of_256_displayed_s"),
        1e3 * number("/spheres/one_of_1024_s"),
    )
}
