//! Pairs of directions, and the half/difference coordinates of Rusinkiewicz, both ways.
//!
//! S. Rusinkiewicz, *A New Change of Variables for Efficient BRDF Representation* (1998), section 3:
//! the half vector h of light and view, and the light as seen in the frame whose pole is h.

use glam::{DVec3, Vec3};

use crate::Warning;

/// Light and view whose sum is shorter have no half vector worth the name (both within 0.03° of the horizon, on opposite
/// sides): the normal takes its place.
pub(crate) const OPPOSITE: f32 = 1e-3;

/// How far from 1 the length of a direction may be.
const LENGTH: f32 = 1e-3;

/// Light and view, unit vectors away from the surface, in the shading frame (normal is +z).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directions {
    /// ω_i, towards the light.
    pub light: Vec3,
    /// ω_o, towards the viewer.
    pub view: Vec3,
}

/// Half vector and difference vector: what a network reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfDiff {
    /// (sin θ_half, 0, cos θ_half), φ_half rotated away; as it is from [`Directions::turning_half_diff`].
    pub half: Vec3,
    /// The light rotated into the half vector's frame.
    pub diff: Vec3,
}

/// The four angles \[rad\] of a pair of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rusinkiewicz {
    /// Polar angle of the half vector, 0..π/2.
    pub theta_half: f32,
    /// Angle between light and half vector, 0..π/2.
    pub theta_diff: f32,
    /// Azimuth of the light around the half vector, −π..π.
    pub phi_diff: f32,
    /// Azimuth of the half vector, −π..π; isotropic materials do not depend on it.
    pub phi_half: f32,
}

impl Directions {
    /// Light and view, both unit vectors: they are taken as they are, since evaluations have no time to look; vectors that
    /// may be of other lengths go through [`normalized`](Self::normalized), doubtful pairs are told by
    /// [`warning`](Self::warning).
    pub const fn new(light: Vec3, view: Vec3) -> Self {
        Self { light, view }
    }

    /// Light and view of any length; none where one vanishes or is not finite.
    pub fn normalized(light: Vec3, view: Vec3) -> Option<Self> {
        Some(Self::new(light.try_normalize()?, view.try_normalize()?))
    }

    /// That one of the two is no unit vector, by more than rounding.
    pub fn warning(self) -> Option<Warning> {
        let lengths = [self.light, self.view].map(Vec3::length);
        let odd = lengths.into_iter().find(|length| length.is_nan() || (length - 1.0).abs() > LENGTH)?;
        Some(Warning::OutOfRange {
            what: "the length of a direction",
            found: odd.into(),
            low: (1.0 - LENGTH).into(),
            high: (1.0 + LENGTH).into(),
        })
    }

    /// From polar and azimuth angles \[rad\] of light and view.
    pub fn from_angles(theta_i: f32, phi_i: f32, theta_o: f32, phi_o: f32) -> Self {
        Self::new(spherical(theta_i, phi_i), spherical(theta_o, phi_o))
    }

    /// Whether both directions are above the surface. False for NaN.
    pub fn is_above(self) -> bool {
        self.light.z > 0.0 && self.view.z > 0.0
    }

    /// Light and view exchanged (Helmholtz reciprocity).
    pub const fn swapped(self) -> Self {
        Self::new(self.view, self.light)
    }

    /// Half and difference vectors without trigonometry.
    ///
    /// sin θ_half is `hypot(h.x, h.y)`: `sqrt(1 − h.z²)` loses three digits near the normal.
    pub fn half_diff(self) -> HalfDiff {
        self.half_diff_and_azimuth().0
    }

    /// As [`half_diff`](Self::half_diff), with the half vector as it is: what networks of anisotropic materials read.
    pub fn turning_half_diff(self) -> HalfDiff {
        let (HalfDiff { half, diff }, (cos, sin)) = self.half_diff_and_azimuth();
        HalfDiff { half: Vec3::new(half.x * cos, half.x * sin, half.z), diff }
    }

    /// The four angles.
    pub fn rusinkiewicz(self) -> Rusinkiewicz {
        let (HalfDiff { half, diff }, azimuth) = self.half_diff_and_azimuth();
        Rusinkiewicz {
            theta_half: half.x.atan2(half.z),
            theta_diff: diff.x.hypot(diff.y).atan2(diff.z),
            phi_diff: diff.y.atan2(diff.x),
            phi_half: azimuth.1.atan2(azimuth.0),
        }
    }

    /// The vectors, and (cos, sin) of φ_half. In f64: rounding here would be seen through a glossy network.
    fn half_diff_and_azimuth(self) -> (HalfDiff, (f32, f32)) {
        let l = self.light.as_dvec3();
        let sum = l + self.view.as_dvec3();
        let sum = if sum.length() < f64::from(OPPOSITE) { DVec3::Z } else { sum };
        let h = sum / sum.length();
        let sin = h.x.hypot(h.y);
        let (cos_phi, sin_phi) = if sin > 0.0 { (h.x / sin, h.y / sin) } else { (1.0, 0.0) };
        let x = cos_phi * l.x + sin_phi * l.y;
        let y = cos_phi * l.y - sin_phi * l.x;
        let diff = DVec3::new(h.z * x - sin * l.z, y, (sin * x + h.z * l.z).abs());
        let half = DVec3::new(sin, 0.0, h.z);
        (HalfDiff { half: half.as_vec3(), diff: diff.as_vec3() }, (cos_phi as f32, sin_phi as f32))
    }
}

impl Rusinkiewicz {
    /// Light and view; the inverse of [`Directions::rusinkiewicz`].
    pub fn directions(self) -> Directions {
        let (sin_h, cos_h) = self.theta_half.sin_cos();
        let (sin_p, cos_p) = self.phi_half.sin_cos();
        let to_surface = |v: Vec3| {
            let x = cos_h * v.x + sin_h * v.z;
            Vec3::new(cos_p * x - sin_p * v.y, sin_p * x + cos_p * v.y, cos_h * v.z - sin_h * v.x)
        };
        let d = spherical(self.theta_diff, self.phi_diff);
        Directions::new(to_surface(d), to_surface(Vec3::new(-d.x, -d.y, d.z)))
    }
}

/// Light and view turned about the normal by an angle \[rad\].
pub fn turned(at: Directions, angle: f32) -> Directions {
    let (sin, cos) = angle.sin_cos();
    let turn = |v: Vec3| Vec3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z);
    Directions::new(turn(at.light), turn(at.view))
}

/// Unit vector from polar angle and azimuth \[rad\].
pub fn spherical(theta: f32, phi: f32) -> Vec3 {
    let (sin, cos) = theta.sin_cos();
    Vec3::new(sin * phi.cos(), sin * phi.sin(), cos)
}
