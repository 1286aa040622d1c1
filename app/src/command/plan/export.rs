//! The chosen models as files.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::merl::Merl;
use nbrdf_core::nbrdf::file;
use nbrdf_core::plan::{Kept, Model, Plan, Planner};
use nbrdf_core::{Code, atomic, bounded};
use serde_json::{Value, json};

use super::Opened;

/// What tells the file of every object.
const INDEX: &str = "plan.json";
/// Key of the files that are to be taken away.
const SUPERSEDED: &str = "superseded";
/// Longest name of a material within a file's name.
const LONGEST: usize = 96;
/// Largest index of before that is read, and largest material that is copied \[bytes\].
const MOST_BYTES: u64 = 1 << 30;

/// Writes every model once, then `plan.json`; what an earlier plan has written there and this one has not is taken away
/// at last: at any moment, every file that the index names is there and whole.
pub fn export(folder: &Path, opened: &Opened, planner: &Planner, plan: &Plan) -> Result<()> {
    let _held = atomic::hold(folder);
    let before = listed(folder);
    let mut written: BTreeMap<(usize, usize), String> = BTreeMap::new();
    let mut names = BTreeSet::new();
    let mut objects: Vec<Value> = Vec::new();
    for (place, choice) in plan.choices.iter().enumerate() {
        let key = (opened.material[place], choice.rung);
        let (material, kind) = (&opened.materials[key.0], &opened.ladder[key.1].name);
        let file = match written.entry(key) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(new) => {
                let model = planner.models().get(key.0, key.1)?;
                let stem = stem(&material.name, kind, &mut names);
                new.insert(write(folder, &stem, opened, key.0, &model)?).clone()
            }
        };
        let mut object = json!({
            "name": opened.scene.objects[place].name, "material": material.name, "model": kind, "file": file,
        });
        if kind == "table_nearest" {
            object["lookup"] = "nearest".into();
        }
        objects.push(object);
    }
    let now: BTreeSet<String> = written.values().map(|name| name.to_lowercase()).collect();
    let gone: Vec<String> = before.into_iter().filter(|name| !now.contains(&name.to_lowercase())).collect();
    let path = folder.join(INDEX);
    let list = |index: Value| {
        let text = format!("{index:#}\n");
        atomic::write(&path, text.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
    };
    if !gone.is_empty() {
        // Should this be stopped before all are taken away, the next one knows of them.
        list(json!({"schema": 1, "objects": objects, SUPERSEDED: gone}))?;
        for name in &gone {
            // What is gone already need not be taken away.
            let _ = std::fs::remove_file(folder.join(name));
        }
    }
    list(json!({"schema": 1, "objects": objects}))
}

/// The files that an earlier index lists, plain names only.
fn listed(folder: &Path) -> Vec<String> {
    let index = bounded::read(&folder.join(INDEX), MOST_BYTES).ok().flatten();
    let before: Value = index.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
    let names = before["objects"].as_array().into_iter().flatten().filter_map(|object| object["file"].as_str());
    let superseded = before[SUPERSEDED].as_array().into_iter().flatten().filter_map(Value::as_str);
    names.chain(superseded).filter(|name| !name.contains(['/', '\\']) && *name != INDEX).map(str::to_owned).collect()
}

/// A file's name without its extension; another one for every model.
fn stem(material: &str, kind: &str, names: &mut BTreeSet<String>) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || "-_".contains(letter) { letter } else { '-' };
    let material: String = material.chars().map(plain).take(LONGEST).collect();
    let stem = (1..).map(|count| match count {
        1 => format!("{material}.{kind}"),
        _ => format!("{material}.{kind}.{count}"),
    });
    // Names on some systems do not tell capitals apart.
    let free = stem.into_iter().find(|stem| names.insert(stem.to_lowercase()));
    free.unwrap_or_default()
}

/// Writes one model; the file's name.
fn write(folder: &Path, stem: &str, opened: &Opened, material: usize, model: &Model) -> Result<String> {
    let own = &opened.materials[material];
    let (extension, bytes) = match (&model.kept, &opened.files[material], &own.network) {
        (Kept::Network(network), ..) | (Kept::Itself, None, Some(network)) => {
            let name = format!("{stem}.npz");
            let path = folder.join(&name);
            // Nothing that never fires is written.
            file::write(&path, &network.pruned().compact())
                .with_context(|| format!("{}: cannot be written", path.display()))?;
            return Ok(name);
        }
        (Kept::Itself, Some(file), _) => {
            let extension = file.extension().unwrap_or_default().to_string_lossy().into_owned();
            let bytes = bounded::read(file, MOST_BYTES).with_context(|| file.display().to_string())?;
            (extension, bytes.with_context(|| format!("{}: more than {MOST_BYTES} bytes", file.display()))?)
        }
        (Kept::Code(code), ..) => {
            let code = Code { material: Some(own.name.clone()), ..code.clone() };
            ("json".to_owned(), (serde_json::to_string(&code)? + "\n").into_bytes())
        }
        (Kept::Table | Kept::Itself, ..) => ("binary".to_owned(), Merl::tabulate(model.brdf.as_ref()).to_bytes()),
    };
    let name = format!("{stem}.{extension}");
    let path = folder.join(&name);
    atomic::write(&path, &bytes).with_context(|| format!("{}: cannot be written", path.display()))?;
    Ok(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_models_share_a_file() {
        let mut names = BTreeSet::new();
        let mut next = |material: &str| stem(material, "nbrdf", &mut names);
        assert_eq!(next("rgl/satin"), "rgl-satin.nbrdf");
        assert_eq!(next("rgl-satin"), "rgl-satin.nbrdf.2");
        assert_eq!(next("RGL satin"), "RGL-satin.nbrdf.3");
        assert!(next(&"ü".repeat(500)).len() < 120);
    }
}
