//! How the latent map is looked at.

use nbrdf_core::axis::{Axis, GREY};
use serde::{Deserialize, Serialize};

use crate::worker::{Projection, Spot};

/// How far the map is enlarged at most.
const MOST_ZOOM: f32 = 60.0;
const LEAST_ZOOM: f32 = 0.5;

/// Which map, which part of it, and in which colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MapView {
    /// Which map.
    pub projection: Projection,
    /// What colours mean.
    pub tint: Tint,
    /// What is in the middle of the pane, from the middle of all materials, in units of the map.
    pub centre: [f32; 2],
    /// 1 where all materials fit the pane.
    pub zoom: f32,
}

/// What colours on the map mean.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Tint {
    /// Nothing.
    Plain,
    /// A measured quality.
    Quality(Axis),
    /// The error to expect of the code.
    Error,
    /// How far the code is from those of training.
    Distance,
    /// Who measured the material.
    Database,
}

impl Default for MapView {
    fn default() -> Self {
        Self { projection: Projection::Pca, tint: Tint::Plain, centre: [0.0; 2], zoom: 1.0 }
    }
}

impl MapView {
    /// All materials in view.
    pub fn reset(&mut self) {
        (self.centre, self.zoom) = ([0.0; 2], 1.0);
    }

    /// Another map, as a whole.
    pub fn choose(&mut self, projection: Projection) {
        if self.projection != projection {
            self.projection = projection;
            self.reset();
        }
    }

    /// Enlarges; what is at `about`, from the middle of all materials, stays where it is.
    pub fn zoom_by(&mut self, factor: f32, about: [f32; 2]) {
        let zoom = (self.zoom * factor).clamp(LEAST_ZOOM, MOST_ZOOM);
        let kept = self.zoom / zoom;
        self.centre = [0, 1].map(|axis| about[axis] - (about[axis] - self.centre[axis]) * kept);
        self.zoom = zoom;
    }
}

impl Tint {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        let own = [Self::Error, Self::Distance, Self::Database];
        std::iter::once(Self::Plain).chain(Axis::ALL.map(Self::Quality)).chain(own)
    }

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Plain => "No colour",
            Self::Quality(Axis::Lightness) => "Lightness",
            Self::Quality(Axis::Hue) => "Hue",
            Self::Quality(Axis::Chroma) => "Chroma",
            Self::Quality(Axis::Gloss) => "Gloss",
            Self::Quality(Axis::Roughness) => "Roughness",
            Self::Quality(Axis::Metalness) => "Metalness",
            Self::Quality(Axis::Sheen) => "Sheen",
            Self::Error => "Encoding error",
            Self::Distance => "Distance",
            Self::Database => "Database",
        }
    }

    /// What is measured, and in which unit.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Plain => "Pictures alone",
            Self::Quality(Axis::Lightness) => "L* / 100 of the albedo seen from the front, 0 to 1",
            Self::Quality(Axis::Hue) => "Angle of the colour in u'v', in turns from red; grey has none",
            Self::Quality(Axis::Chroma) => "Distance of the colour from grey, in tenths of u'v'",
            Self::Quality(Axis::Gloss) => "Cube root of the share of light in the highlight",
            Self::Quality(Axis::Roughness) => "Square root of the highlight's mean half angle, in √rad",
            Self::Quality(Axis::Metalness) => "Share of the highlight in all that is reflected, 0 to 1",
            Self::Quality(Axis::Sheen) => "ln of grazing over front albedo; 0 for a matte material",
            Self::Error => "log_error to expect of the material's code",
            Self::Distance => "Of the code from the nearest one of training; 1 is how far these are from each other",
            Self::Database => "Who measured the material",
        }
    }

    /// The figure of a material, where colours mean one.
    pub fn value(self, spot: &Spot) -> Option<f64> {
        let value = match self {
            Self::Plain | Self::Database => None,
            Self::Quality(Axis::Hue) if Axis::Chroma.value(&spot.qualities) < GREY => None,
            Self::Quality(quality) => Some(quality.value(&spot.qualities)),
            Self::Error => Some(spot.error),
            Self::Distance => spot.distance,
        };
        value.filter(|value| value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_under_the_pointer_stays_there_when_zooming() {
        let mut view = MapView { centre: [0.4, -0.2], zoom: 2.0, ..MapView::default() };
        let about = [1.0, 0.5];
        let on_screen = |view: &MapView| [0, 1].map(|axis| (about[axis] - view.centre[axis]) * view.zoom);
        let before = on_screen(&view);
        for factor in [1.5, 0.3, 1e6] {
            view.zoom_by(factor, about);
            let after = on_screen(&view);
            assert!([0, 1].iter().all(|&axis| (after[axis] - before[axis]).abs() < 1e-4), "{before:?} {after:?}");
        }
        assert_eq!(view.zoom, MOST_ZOOM);
        view.choose(Projection::Charting);
        assert_eq!((view.zoom, view.centre), (1.0, [0.0; 2]));
    }
}
