//! What is told of files that were written: what they are, of what, and how they are made again.

use std::path::PathBuf;

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::axis::Axis;
use nbrdf_core::hash::{sha256, short_hash};
use nbrdf_core::{Database, Representation as _};
use serde_json::{Value, json};

use super::job::Job;
use super::made::Made;
use super::{Goods, PictureForm, SAMPLES};
use crate::worker::{Card, Edits, Lighting, Office, Shape, Timing, Tour};

/// The bytes of the manifest of these files.
pub(super) fn of(office: &Office, job: &Job, Made { files, point }: &Made) -> Result<Vec<u8>> {
    let Job { goods, shown, t, .. } = job;
    let own = match goods {
        Goods::Material { card, .. } | Goods::Picture { card, .. } => Some(*card),
        Goods::Steps { method, .. } => Some(Card::Method(method)),
        Goods::Strip { .. } | Goods::Curve { .. } => None,
    };
    let methods = match own {
        Some(Card::Method(method)) => vec![method],
        Some(Card::End(_) | Card::Explored) => Vec::new(),
        None => shown.methods.clone(),
    };
    let end = if let Some(Card::End(end)) = own { shown.ends.get(end) } else { None };
    let edited = point.as_ref().and_then(|point| point.edited.as_ref());
    let is_png =
        matches!(goods, Goods::Picture { form: PictureForm::Png, .. } | Goods::Strip { form: PictureForm::Png, .. });
    let frame = matches!(goods, Goods::Picture { .. }).then_some(shown.scenery.frame);
    let file = |(path, bytes): &(PathBuf, Vec<u8>)| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        json!({"name": name, "bytes": bytes.len(), "sha256": sha256(bytes)})
    };
    let is_lit = goods.size().is_some() || matches!(goods, Goods::Curve { .. });
    let light = match (goods, shown.scenery.lighting) {
        (Goods::Curve { .. }, Lighting::Around { .. }) => Lighting::Studio,
        (_, lighting) => lighting,
    };
    let explored = shown.explored.filter(|_| own == Some(Card::Explored));
    let manifest = json!({
        "schema": 1,
        "explored": explored,
        "nbrdf": env!("CARGO_PKG_VERSION"),
        "what": goods.name(),
        "form": goods.form(),
        "material": end,
        "materials": shown.ends.iter().map(|name| material(office, name)).collect::<Vec<_>>(),
        "methods": methods,
        "weights": point.as_ref().map(|point| point.weights.as_slice()),
        "t": t.filter(|_| point.is_some()),
        "edits": edited.map(|_| edits(&shown.walk.edits)),
        "edited_code": edited,
        "steps": goods.steps(),
        "tour": goods.steps().map(|_| tour(shown.walk.tour)),
        "places": goods.steps().map(|steps| job.course(steps)),
        "timing": if shown.timing == Timing::Even { "even" } else { "straight" },
        "light": is_lit.then(|| lit(office, light)),
        "exposure": is_lit.then_some(shown.exposure),
        "tone": is_png.then_some(shown.tone),
        "shape": goods.size().map(|_| shape(office, shown.scenery.shape)),
        "frame": frame,
        "size": goods.size(),
        "checkpoint": Autoencoder::built_in(Architecture::Znbrdf).checkpoint(),
        "chosen": job.chosen,
        "files": files.iter().map(file).collect::<Vec<_>>(),
        "command": job.command.as_ref().ok(),
        "remark": job.command.as_ref().err(),
    });
    Ok(format!("{manifest:#}\n").into_bytes())
}

/// A material by name, database and network.
fn material(office: &Office, name: &str) -> Value {
    let network = office.material(name).and_then(|material| material.network);
    let hash = network.map(|network| short_hash(network.weights().iter().copied()));
    json!({"name": name, "database": Database::of(name).to_string(), "network": hash})
}

fn lit(office: &Office, light: Lighting) -> Value {
    match light {
        Lighting::Studio => json!({"name": "studio"}),
        Lighting::Point(to) => json!({"name": "point", "direction": to.to_array()}),
        Lighting::Around { map, turn } => {
            let maps = office.maps.read().unwrap_or_else(std::sync::PoisonError::into_inner);
            let file = maps.get(map).and_then(|map| map.file.as_ref()).map(|file| file.display().to_string());
            let name = maps.get(map).map(|map| &map.name);
            json!({
                "name": "environment", "map": name, "file": file, "turn_degrees": turn.to_degrees(),
                "samples": SAMPLES,
            })
        }
    }
}

/// By how much each quality is moved.
fn edits(amounts: &Edits) -> Value {
    let moved = Axis::ALL.into_iter().zip(amounts).filter(|(_, amount)| **amount != 0.0);
    moved.map(|(axis, amount)| (axis.name().to_owned(), json!(amount))).collect::<serde_json::Map<_, _>>().into()
}

const fn tour(tour: Tour) -> &'static str {
    match tour {
        Tour::Along => "along",
        Tour::Beyond => "beyond",
        Tour::Around => "around",
    }
}

fn shape(office: &Office, shape: Shape) -> Value {
    let place = match shape {
        Shape::Sphere => return json!({"name": "sphere"}),
        Shape::Plane => return json!({"name": "plane"}),
        Shape::Mesh(place) => place,
    };
    let solids = office.solids.read().unwrap_or_else(std::sync::PoisonError::into_inner);
    let solid = solids.get(place).or_else(|| solids.first());
    let file = solid.and_then(|solid| solid.file.as_ref()).map(|file| file.display().to_string());
    json!({"name": "mesh", "mesh": solid.map(|solid| &solid.name), "file": file})
}
