//! What is told of files that were written: what they are, of what, and how they are made again.

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::Representation as _;
use nbrdf_core::axis::Axis;
use serde_json::{Value, json};

use super::job::Job;
use super::made::Made;
use super::{Goods, PictureForm, SAMPLES};
use crate::exported;
use crate::worker::{Card, Edits, Lighting, Office, Shape, Timing, Tour};

/// The bytes of the manifest of these files.
pub(super) fn of(office: &Office, job: &Job, Made { files, point, errors }: &Made) -> Result<Vec<u8>> {
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
    let convention = match goods {
        Goods::Material { form, .. } | Goods::Steps { form, .. } => Some(form.convention),
        Goods::Picture { .. } | Goods::Strip { .. } | Goods::Curve { .. } => None,
    };
    let error = match (goods, errors.as_slice()) {
        (Goods::Material { .. }, [error]) => Some(error.clone()),
        (Goods::Steps { .. }, errors) => Some(json!(errors)),
        _ => None,
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
        "convention": convention,
        "error": error,
        "material": end,
        "materials": shown.ends.iter().map(|name| exported::material(name, office.material(name).as_ref())).collect::<Vec<_>>(),
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
        "files": files.iter().map(exported::file).collect::<Vec<_>>(),
        "command": job.command.as_ref().ok(),
        "remark": job.command.as_ref().err(),
    });
    Ok(format!("{manifest:#}\n").into_bytes())
}

fn lit(office: &Office, light: Lighting) -> Value {
    match light {
        Lighting::Studio => json!({"name": "studio"}),
        Lighting::Point(to) => json!({"name": "point", "direction": to.to_array()}),
        Lighting::Around { map, turn } => {
            let shown = office.maps.get(map).0;
            json!({
                "name": "environment", "map": shown.name, "file": shown.asset.file(), "turn_degrees": turn.to_degrees(),
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
    match shape {
        Shape::Sphere => json!({"name": "sphere"}),
        Shape::Plane => json!({"name": "plane"}),
        Shape::Mesh(mesh) => {
            let shown = office.meshes.get(mesh).0;
            json!({"name": "mesh", "mesh": shown.name, "file": shown.asset.file()})
        }
    }
}
