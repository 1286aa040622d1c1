//! `nbrdf edit`: one quality of a material moved, the others left.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::axis::Axis;
use nbrdf_core::quality::Qualities;
use nbrdf_core::{Code, Representation, atomic};
use serde_json::{Value, json};

use super::Global;
use crate::editor::{Editor, MOST};
use crate::failure::Failure;
use crate::material::Sources;
use crate::{output, report};

/// Moves qualities of a material (lightness, hue, chroma, gloss, roughness, metalness, sheen) and writes its new code.
#[derive(Debug, Args)]
pub struct Edit {
    /// A material: its name, the file of a network, or a code.
    #[arg(value_name = "MATERIAL")]
    material: String,
    /// Edits in order: gloss+0.3, roughness-0.1, hue+0.25 (in turns), ...
    #[arg(required = true, num_args = 1.., value_name = "EDIT", value_parser = parse)]
    edits: Vec<(Axis, f64)>,
    #[command(flatten)]
    sources: Sources,
    /// File of the code; standard output by default.
    #[arg(short, long, value_name = "CODE")]
    output: Option<PathBuf>,
}

/// `gloss+0.3` as an axis and an amount.
fn parse(text: &str) -> Result<(Axis, f64), String> {
    let names = || Axis::ALL.map(Axis::name).join(", ");
    let expected = || format!("expected a quality and an amount, as in gloss+0.3; qualities: {}", names());
    let at = text.find(['+', '-']).ok_or_else(expected)?;
    let (name, amount) = text.split_at(at);
    let axis = Axis::ALL.into_iter().find(|axis| axis.name() == name).ok_or_else(expected)?;
    let amount: f64 = amount.parse().map_err(|_| expected())?;
    if !(-f64::from(MOST)..=f64::from(MOST)).contains(&amount) {
        return Err(format!("{amount} is out of range: qualities are moved by -{MOST} to {MOST}"));
    }
    Ok((axis, amount))
}

impl Edit {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let output = self.output.as_deref().filter(|path| path.as_os_str() != "-");
        if let Some(path) = output {
            output::check(path, &["json"])?;
            output::check_no_input(path, std::slice::from_ref(&self.material))?;
        }
        let shelf = self.sources.open()?;
        let item = shelf.material_or_code(&self.material)?;
        shelf.catalog.check_used()?;
        let editor = Editor::of(&shelf.catalog)?;
        let known = editor.model();
        let start = match &item.code {
            Some(code) if code.model == known.name() => code.clone(),
            Some(code) => {
                let found =
                    format!("{}: edits move codes of {}, found one of {}", self.material, known.name(), code.model);
                return Err(Failure::InvalidFile(found).into());
            }
            None => shelf.catalog.representation(known.name(), false)?.encode(&item.material)?,
        };
        let moved = editor.edit(&start, self.edits.iter().copied())?;
        moved.shortfalls.iter().try_for_each(|shortfall| global.warn(format_args!("{shortfall}")))?;
        let (before, now) = (moved.before, moved.after);
        let edited = known.code(moved.code);
        let distance = known.distance(&edited)?;
        let code = Code { material: Some(self.name(&item.material.name)), distance, ..edited };
        let json = serde_json::to_string(&code)? + "\n";
        if let Some(path) = output {
            atomic::write(path, json.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))?;
        }
        match (output, global.json) {
            (None, false) => report::write(&json),
            _ => report::print(global, &summary(&code, &before, &now), || text(&before, &now, distance)),
        }
    }

    fn name(&self, material: &str) -> String {
        let edit = |(axis, amount): &(Axis, f64)| format!(" {}{amount:+}", axis.name());
        format!("{material}{}", self.edits.iter().map(edit).collect::<String>())
    }
}

fn summary(code: &Code, before: &Qualities, now: &Qualities) -> Value {
    json!({"schema": 1, "code": code, "before": before, "after": now})
}

fn text(before: &Qualities, now: &Qualities, distance: Option<f64>) -> String {
    let line = |axis: Axis| {
        let (was, is) = (axis.value(before), axis.value(now));
        format!("{:10} {was:7.3} {is:7.3}  {:+.3}\n", axis.name(), axis.difference(before, now))
    };
    let lines: String = Axis::ALL.into_iter().map(line).collect();
    let distance = distance.map_or_else(String::new, |distance| {
        format!("distance to known materials {distance:.2}; 1 is how far these are apart\n")
    });
    format!("{:10} {:>7} {:>7}\n{lines}{distance}", "", "before", "after")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_a_quality_and_a_signed_amount() {
        assert_eq!(parse("gloss+0.3"), Ok((Axis::Gloss, 0.3)));
        assert_eq!(parse("hue-0.25"), Ok((Axis::Hue, -0.25)));
        for wrong in ["gloss", "gloss+", "shine+0.1", "gloss+nan", "gloss+7", ""] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
