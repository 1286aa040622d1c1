//! The chosen models as files.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::merl::Merl;
use nbrdf_core::nbrdf::file;
use nbrdf_core::plan::{Kept, Model, Plan, Planner};
use nbrdf_core::{Code, Material, atomic};
use serde_json::{Value, json};

use super::Opened;

/// Writes every model once, and `plan.json`, which tells the file of every object.
pub fn export(folder: &Path, opened: &Opened, planner: &Planner, plan: &Plan) -> Result<()> {
    let mut written: BTreeMap<(usize, usize), String> = BTreeMap::new();
    let mut objects: Vec<Value> = Vec::new();
    for (place, choice) in plan.choices.iter().enumerate() {
        let key = (opened.material[place], choice.rung);
        let (material, kind) = (&opened.materials[key.0], &opened.ladder[key.1].name);
        if !written.contains_key(&key) {
            let model = planner.models().get(key.0, key.1)?;
            written.insert(key, write(folder, material, kind, &model)?);
        }
        objects.push(json!({
            "name": opened.scene.objects[place].name, "material": material.name, "model": kind, "file": written[&key],
        }));
    }
    let path = folder.join("plan.json");
    let text = format!("{:#}\n", json!({"schema": 1, "objects": objects}));
    atomic::write(&path, text.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Writes one model; the file's name.
fn write(folder: &Path, material: &Material, kind: &str, model: &Model) -> Result<String> {
    let plain = |letter: char| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '-' };
    let stem = format!("{}.{kind}", material.name.chars().map(plain).collect::<String>());
    let named = |extension: &str| (format!("{stem}.{extension}"), folder.join(format!("{stem}.{extension}")));
    let network = match (&model.kept, &material.network) {
        (Kept::Network(network), _) | (Kept::Itself, Some(network)) => Some(network),
        _ => None,
    };
    let (name, path) = match (&model.kept, network) {
        (_, Some(_)) => named("npz"),
        (Kept::Code(_), None) => named("json"),
        _ => named("binary"),
    };
    let written = match (&model.kept, network) {
        (_, Some(network)) => file::write(&path, network),
        (Kept::Code(code), None) => {
            let code = Code { material: Some(material.name.clone()), ..code.clone() };
            atomic::write(&path, (serde_json::to_string(&code)? + "\n").as_bytes())
        }
        _ => Merl::tabulate(model.brdf.as_ref()).save(&path),
    };
    written.with_context(|| format!("{}: cannot be written", path.display()))?;
    Ok(name)
}
