//! Measured tables that are not what they should be, damaged on purpose: the same for the same seed.

use rand::RngExt;

use super::hazard::{Group, Hazard};
use crate::brdf::table::{Lookup, Table, middles};
use crate::direction::spherical;
use crate::nbrdf::fit::generator;
use crate::sampling::evaluate;
use crate::{Brdf, Directions, Rgb, Vec3};

/// Errors of which half, and twice, what a code of 32 numbers loses is added.
pub(super) const ADDED: &str = "log_error against the truth, less that from clean measurements";
pub(super) const LITTLE: f64 = 0.002;
pub(super) const MUCH: f64 = 0.01;

/// What is not measured is none.
type Cells = Vec<Option<Rgb>>;

/// A hazard, and what it does to a table.
pub struct Damage {
    /// The hazard.
    pub hazard: Hazard,
    /// What all of the material is multiplied by: nobody can tell from the measurements, but a fit should carry it along,
    /// so that it can be undone. None where there is a truth to come back to.
    pub scale: Option<Rgb>,
    apply: fn(&dyn Brdf, u64) -> Cells,
}

/// All of them.
pub const DAMAGES: [Damage; 6] = [
    damage("noise", "Every cell of the table off by 10 % (standard deviation)", |brdf, seed| {
        let rng = &mut generator(seed, 1);
        changed(brdf, |f| f * even(rng, 0.1))
    }),
    damage("outliers", "One cell in a thousand ten times too bright", |brdf, seed| {
        let rng = &mut generator(seed, 2);
        changed(brdf, |f| if rng.random_range(0..1000) == 0 { f * 10.0 } else { f })
    }),
    damage("missing", "Nothing measured beyond 75°, and a third of all other cells lost", |brdf, seed| {
        let rng = &mut generator(seed, 3);
        let lowest = 75f32.to_radians().cos();
        let kept = |(f, at): (Option<Rgb>, &Directions)| {
            let is_lost = rng.random_range(0..3) == 0;
            f.filter(|_| !is_lost && at.light.z.min(at.view.z) >= lowest)
        };
        cells(brdf, middles()).into_iter().zip(middles()).map(kept).collect()
    }),
    damage("misaligned", "The sample tilted by 1°: half vectors are not where they seem", |brdf, _| {
        let tilted: Vec<Directions> = middles().iter().map(|&at| tilted(at, 1f32.to_radians())).collect();
        let above = |(f, at): (Option<Rgb>, &Directions)| f.filter(|_| at.is_above());
        cells(brdf, &tilted).into_iter().zip(middles()).map(above).collect()
    }),
    damage("clipped", "Highlights cut where f cos is a quarter of its largest", |brdf, _| {
        let lit = |(f, at): (&Option<Rgb>, &Directions)| f.map_or(0.0, |f| f.max() * at.light.z);
        let clean = cells(brdf, middles());
        let limit = 0.25 * clean.iter().zip(middles()).map(lit).fold(0.0, f32::max);
        let cut = |(f, at): (Option<Rgb>, &Directions)| f.map(|f| f.map(|f| f.min(limit / at.light.z)));
        clean.into_iter().zip(middles()).map(cut).collect()
    }),
    Damage {
        hazard: Hazard {
            measure: "log_error against what clean measurements give, times the wrong scale",
            ..hazard("miscalibrated", "Green and blue without their scales (1.15 and 1.66)")
        },
        scale: Some(RED_FOR_ALL),
        apply: |brdf, _| changed(brdf, |f| f.zip(RED_FOR_ALL, |f, scale| f * scale)),
    },
];

/// Factors of a reader that takes the scale of red for all channels.
pub const RED_FOR_ALL: Rgb = Rgb([1.0, 1.0 / 1.15, 1.0 / 1.66]);

const fn hazard(name: &'static str, title: &'static str) -> Hazard {
    Hazard { name, group: Group::Data, title, measure: ADDED, holds: LITTLE, fails: MUCH }
}

const fn damage(name: &'static str, title: &'static str, apply: fn(&dyn Brdf, u64) -> Cells) -> Damage {
    Damage { hazard: hazard(name, title), scale: None, apply }
}

impl Damage {
    /// A material as it is measured under this damage.
    pub fn measured(&self, brdf: &dyn Brdf, seed: u64) -> Table {
        Table::of_cells((self.apply)(brdf, seed).into_iter(), Lookup::Trilinear)
    }
}

/// f_r at the middles of cells that are above the horizon.
fn cells(brdf: &dyn Brdf, at: &[Directions]) -> Cells {
    evaluate(brdf, at).into_iter().zip(at).map(|(f, at)| at.is_above().then_some(f)).collect()
}

fn changed(brdf: &dyn Brdf, mut change: impl FnMut(Rgb) -> Rgb) -> Cells {
    cells(brdf, middles()).into_iter().map(|f| f.map(&mut change)).collect()
}

/// A factor e^x of evenly distributed x with this standard deviation.
pub(super) fn even(rng: &mut impl RngExt, deviation: f32) -> f32 {
    (rng.random_range(-1.0f32..1.0) * 3f32.sqrt() * deviation).exp()
}

/// Directions as a sample sees them whose normal leans by an angle \[rad\]: the highlight moves by twice as much.
pub(super) fn tilted(at: Directions, angle: f32) -> Directions {
    let normal = spherical(angle, 0.0);
    let (side, across) = (Vec3::new(normal.z, 0.0, -normal.x), Vec3::Y);
    let turn = |v: Vec3| Vec3::new(v.dot(side), v.dot(across), v.dot(normal));
    Directions::new(turn(at.light), turn(at.view))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::metric::{LogError, Metric};

    const GLOSSY: Ggx = Ggx { diffuse: Rgb([0.2, 0.15, 0.1]), f0: Rgb::splat(0.5), alpha: 0.1 };

    #[test]
    fn every_damage_is_seen_is_no_catastrophe_and_comes_again_with_its_seed() {
        for Damage { hazard, .. } in &DAMAGES {
            let damage = DAMAGES.iter().find(|damage| damage.hazard.name == hazard.name).unwrap();
            let [once, again] = [0, 0].map(|seed| damage.measured(&GLOSSY, seed));
            let error = LogError.distance(&GLOSSY, &once);
            println!("{}: {error:.4}", hazard.name);
            assert!((1e-4..0.2).contains(&error), "{}: {error}", hazard.name);
            assert_eq!(LogError.distance(&once, &again), 0.0, "{}", hazard.name);
        }
    }

    #[test]
    fn a_tilt_turns_both_directions_and_keeps_their_angle() {
        let at = Directions::from_angles(0.7, 0.4, 0.2, 2.0);
        let turned = tilted(at, 0.1);
        assert!((turned.light.dot(turned.view) - at.light.dot(at.view)).abs() < 1e-6);
        assert!((tilted(Directions::new(spherical(0.1, 0.0), at.view), 0.1).light.z - 1.0).abs() < 1e-6);
    }
}
