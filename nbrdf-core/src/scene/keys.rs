//! The keys of a scene's file.

use std::path::PathBuf;

use serde::Deserialize;

pub(super) type Vector = [f64; 3];

/// One file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    #[serde(default)]
    pub include: Vec<PathBuf>,
    pub tolerance: Option<f64>,
    pub image: Option<ImageKeys>,
    pub camera: Option<CameraKeys>,
    #[serde(default)]
    pub light: Vec<LightKeys>,
    #[serde(default)]
    pub object: Vec<ObjectKeys>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImageKeys {
    pub width: i64,
    pub height: i64,
    #[serde(default = "sixteen")]
    pub samples: i64,
    #[serde(default)]
    pub exposure: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraKeys {
    pub from: Vector,
    pub to: Vector,
    #[serde(default = "y")]
    pub up: Vector,
    /// Vertical \[degrees\].
    pub field: f64,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub(super) enum LightKeys {
    Point {
        at: Vector,
        intensity: Vector,
    },
    Area {
        centre: Vector,
        u: Vector,
        v: Vector,
        radiance: Vector,
    },
    Environment {
        map: String,
        /// \[degrees\]
        #[serde(default)]
        rotate: f64,
        #[serde(default = "one")]
        strength: f64,
        #[serde(default = "yes")]
        seen: bool,
    },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectKeys {
    pub name: Option<String>,
    pub material: String,
    pub sphere: Option<SphereKeys>,
    pub plane: Option<PlaneKeys>,
    pub rectangle: Option<RectangleKeys>,
    pub mesh: Option<MeshKeys>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereKeys {
    pub centre: Vector,
    pub radius: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneKeys {
    pub point: Vector,
    pub normal: Vector,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RectangleKeys {
    pub centre: Vector,
    pub u: Vector,
    pub v: Vector,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshKeys {
    pub file: PathBuf,
    #[serde(default = "one")]
    pub scale: f64,
    #[serde(default)]
    pub at: Vector,
}

const fn sixteen() -> i64 {
    16
}

const fn one() -> f64 {
    1.0
}

const fn yes() -> bool {
    true
}

const fn y() -> Vector {
    [0.0, 1.0, 0.0]
}
