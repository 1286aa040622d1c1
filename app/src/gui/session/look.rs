//! How materials are looked at: light and exposure.

use nbrdf_core::Vec3;
use nbrdf_core::image::Tone;
use nbrdf_core::render::{Frame, Model};
use serde::{Deserialize, Serialize};

use crate::worker::{Asset, Lighting, Listed, Scenery, Shape};

/// Exposure goes this many stops either way.
pub const MAX_EXPOSURE: f32 = 4.0;

/// The lamp of light `point`: 45° to the right.
pub const LAMP: Lighting =
    Lighting::Point(Vec3::new(std::f32::consts::FRAC_1_SQRT_2, 0.0, std::f32::consts::FRAC_1_SQRT_2));

/// How materials are looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// What they are seen on, and in which light.
    pub scenery: Scenery,
    /// Exposure in stops.
    pub exposure: f32,
    /// How pictures are shown.
    pub tone: Tone,
}

impl Default for Look {
    fn default() -> Self {
        Self { scenery: Scenery::of(Lighting::Studio), exposure: 0.0, tone: Tone::Clip }
    }
}

impl Look {
    /// Light, exposure and zoom as at the start; shape and tone curve stay.
    pub fn reset(&mut self) {
        let (start, shape) = (Self::default(), self.scenery.shape);
        *self = Self { scenery: Scenery { shape, ..start.scenery }, tone: self.tone, ..start };
    }

    /// Moves the point light so that a mirror of this shape shows it at `x` (right), `y` (up), in radii from the middle of
    /// the picture; a sphere in place of a mesh.
    pub fn point_at(&mut self, x: f32, y: f32) {
        let place = self.scenery.frame.place([x.into(), y.into()]);
        if self.scenery.shape == Shape::Plane {
            // Where the plane is seen, every direction is of use.
            if let Some(direction) = Model::Plane.mirrored(place) {
                self.scenery.lighting = Lighting::Point(direction.as_vec3());
            }
            return;
        }
        let [x, y] = place.map(|place| place as f32);
        // Further out the lamp would stand behind the sphere and show nothing.
        let scale = 0.75 / x.hypot(y).max(0.75);
        let (x, y) = (x * scale, y * scale);
        let z = (1.0 - x * x - y * y).sqrt();
        self.scenery.lighting = Lighting::Point(Vec3::new(2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0));
    }

    /// Turns the map that surrounds the spheres by so many radii of a sphere; false where there is none.
    pub fn turn_by(&mut self, radii: f32) -> bool {
        let Lighting::Around { turn, .. } = &mut self.scenery.lighting else { return false };
        // Half a sphere across is a quarter of a turn; the far side is reached by going on.
        let around = std::f32::consts::TAU;
        *turn = (*turn + radii * std::f32::consts::FRAC_PI_2 + 0.5 * around).rem_euclid(around) - 0.5 * around;
        true
    }

    /// Where a mirror of this shape shows the point light, in radii from the middle of the picture, if it does; a sphere in
    /// place of a mesh.
    pub fn highlight(&self) -> Option<[f32; 2]> {
        let Lighting::Point(direction) = self.scenery.lighting else { return None };
        let place = if self.scenery.shape == Shape::Plane {
            Model::Plane.mirror(direction.as_dvec3().normalize())?
        } else {
            let half = (direction.normalize() + Vec3::Z).normalize();
            [half.x.into(), half.y.into()]
        };
        let seen = self.scenery.frame.seen_at(place);
        seen.iter().all(|place| place.abs() <= 1.0).then(|| seen.map(|place| place as f32))
    }

    /// Shows another shape, as a whole.
    pub fn show_on(&mut self, shape: Shape) {
        (self.scenery.shape, self.scenery.frame) = (shape, Frame::WHOLE);
    }

    /// Studio, point, then one of these maps after the other.
    pub fn next_light(&mut self, maps: &[Listed]) {
        self.scenery.lighting = match self.scenery.lighting {
            Lighting::Studio => LAMP,
            Lighting::Point(_) => Lighting::Around { map: Asset::BuiltIn, turn: 0.0 },
            Lighting::Around { map, .. } => {
                let next = maps.iter().skip_while(|listed| listed.asset != map).nth(1);
                next.map_or(Lighting::Studio, |listed| Lighting::Around { map: listed.asset, turn: 0.0 })
            }
        };
    }

    /// Whether light comes from all around, which is too grainy for figures.
    pub fn is_around(&self) -> bool {
        matches!(self.scenery.lighting, Lighting::Around { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highlight_follows_the_pointer() {
        let mut look = Look::default();
        look.point_at(0.3, -0.4);
        let [x, y] = look.highlight().unwrap();
        assert!((x - 0.3).abs() < 1e-5 && (y + 0.4).abs() < 1e-5);
        look.point_at(5.0, 0.0);
        assert!((look.highlight().unwrap()[0] - 0.75).abs() < 1e-5);
    }

    #[test]
    fn the_highlight_follows_the_pointer_when_zoomed_and_on_a_plane() {
        for shape in [Shape::Sphere, Shape::Plane, Shape::Mesh(Asset::BuiltIn)] {
            let mut look = Look::default();
            look.show_on(shape);
            look.scenery.frame = Frame::WHOLE.zoomed(3.0, [0.5, 0.25]);
            look.point_at(0.3, -0.4);
            let [x, y] = look.highlight().unwrap();
            assert!((x - 0.3).abs() < 1e-4 && (y + 0.4).abs() < 1e-4, "{shape:?}: {x} {y}");
        }
    }

    #[test]
    fn a_reset_keeps_the_shape_and_a_session_of_before_has_one() {
        let mut look = Look { exposure: 1.0, tone: Tone::Filmic, ..Look::default() };
        look.show_on(Shape::Plane);
        look.scenery.frame = Frame::WHOLE.zoomed(3.0, [0.0; 2]);
        look.reset();
        assert_eq!((look.exposure, look.tone, look.scenery.shape), (0.0, Tone::Filmic, Shape::Plane));
        assert_eq!(look.scenery.frame, Frame::WHOLE);
        let before: Look = serde_json::from_str(r#"{"scenery": {"lighting": "Studio"}, "exposure": 1.0}"#).unwrap();
        assert_eq!(before, Look { exposure: 1.0, ..Look::default() });
    }

    #[test]
    fn dragging_turns_a_map_and_never_beyond_half_a_turn() {
        let mut look =
            Look { scenery: Scenery::of(Lighting::Around { map: Asset::BuiltIn, turn: 0.0 }), ..Look::default() };
        for (radii, quarters) in [(1.0, 1.0), (2.0, -1.0)] {
            assert!(look.turn_by(radii));
            let Lighting::Around { turn, .. } = look.scenery.lighting else { panic!("{:?}", look.scenery.lighting) };
            assert!((turn - quarters * std::f32::consts::FRAC_PI_2).abs() < 1e-5, "{turn}");
        }
        assert!(!Look::default().turn_by(1.0));
    }
}
