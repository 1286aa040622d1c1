//! Directions at which reflectances are hard to know, and such as no renderer should ask for.

use std::f32::consts::{PI, TAU};

use super::hazard::{BY_HALF, Group, Hazard, WITHIN_A_FIFTH};
use crate::direction::spherical;
use crate::metric::relative_log;
use crate::sampling::{evaluate, even_shares};
use crate::{Brdf, Directions, Rgb, Rusinkiewicz, Vec3, Warning};

/// Pairs asked of each kind.
const PAIRS: usize = 1024;
/// What is added before logarithms \[1/sr\], as in `relative_log`.
const OFFSET: f32 = 1e-3;

/// A hazard, and how it is measured of a model against the material itself.
pub struct Exposure {
    /// The hazard.
    pub hazard: Hazard,
    /// Whether only glossy materials are exposed to it.
    pub only_glossy: bool,
    /// Reference, then model.
    pub value: fn(&dyn Brdf, &dyn Brdf) -> f64,
    /// What the library says to who asks it about such directions of a model.
    pub said: Option<fn(&dyn Brdf) -> Option<Warning>>,
}

const RELATIVE: &str = "mean |ln(f cos + 0.001) − ln(g cos + 0.001)|";
const RATIO: &str = "largest |ln(f + 0.001) − ln(g + 0.001)| where both should be the same";
const WRONG: &str = "share of answers that are not what they must be";

/// All of them.
pub const EXPOSURES: [Exposure; 11] = [
    relative("grazing_75", "Light or view between 75° and 85°", |f, g| error_at(&grazing(75.0, 85.0), f, g)),
    relative("grazing_85", "Light or view between 85° and 89.5°", |f, g| error_at(&grazing(85.0, 89.5), f, g)),
    relative("grazing_89", "Light or view beyond 89.5°", |f, g| error_at(&grazing(89.5, 90.0), f, g)),
    Exposure {
        only_glossy: true,
        ..relative("mirror", "Within 1° of the mirror direction, glossy materials", |f, g| error_at(&mirror(), f, g))
    },
    relative("retro", "Light and view within 4° of each other", |f, g| error_at(&retro(), f, g)),
    Exposure {
        hazard: Hazard {
            holds: 0.01,
            measure: RATIO,
            ..hazard("normal_half", "Half vectors 0.01° to 0.05° from the normal: digits are lost there")
        },
        ..relative("", "", |_, model| beside_the_normal(model))
    },
    Exposure {
        hazard: Hazard {
            measure: RATIO,
            ..hazard("normal_azimuth", "Half vector at the normal, which has no azimuth: rounding chooses one")
        },
        said: Some(undecided),
        ..relative("", "", |_, model| at_the_normal(model))
    },
    Exposure {
        hazard: Hazard {
            holds: 0.01,
            fails: WITHIN_A_FIFTH,
            measure: RATIO,
            ..hazard("rounded_vectors", "Vectors longer or shorter than 1 by a millionth")
        },
        ..relative("", "", |_, model| of_other_length(model, &[(1.0 + 1e-6, 1.0), (1.0, 1.0 - 1e-6)]))
    },
    Exposure {
        hazard: Hazard {
            holds: 0.01,
            fails: WITHIN_A_FIFTH,
            measure: RATIO,
            ..hazard("unnormalized", "Vectors of half and twice unit length")
        },
        said: Some(|_| Directions::new(2.0 * Vec3::Z, Vec3::Z).warning()),
        ..relative("", "", |_, model| of_other_length(model, &[(0.5, 0.5), (2.0, 2.0), (0.5, 2.0)]))
    },
    wrong("horizon", "Light or view at the horizon or below it: must be black", |_, model| not_black(model)),
    wrong("no_number", "NaN, infinite, vanishing and huge directions: finite and not negative", |_, model| {
        not_sound(model)
    }),
];

const fn hazard(name: &'static str, title: &'static str) -> Hazard {
    Hazard { name, group: Group::Directions, title, measure: RELATIVE, holds: WITHIN_A_FIFTH, fails: BY_HALF }
}

const fn relative(name: &'static str, title: &'static str, value: fn(&dyn Brdf, &dyn Brdf) -> f64) -> Exposure {
    Exposure { hazard: hazard(name, title), only_glossy: false, value, said: None }
}

const fn wrong(name: &'static str, title: &'static str, value: fn(&dyn Brdf, &dyn Brdf) -> f64) -> Exposure {
    let hazard = Hazard { measure: WRONG, holds: 0.0, fails: 0.0, ..hazard(name, title) };
    Exposure { hazard, only_glossy: false, value, said: None }
}

fn error_at(at: &[Directions], reference: &dyn Brdf, model: &dyn Brdf) -> f64 {
    relative_log(at, &evaluate(reference, at), &evaluate(model, at))
}

/// Pairs of which light and view in turns have polar angles in a range \[degrees\], the other one any up to that.
pub fn grazing(from: f32, to: f32) -> Vec<Directions> {
    let pair = |(index, [steep, other, around]): (usize, [f32; 3])| {
        let steep = (from + (to - from) * steep).to_radians();
        let at = Directions::from_angles(steep, 0.0, steep * other, TAU * around);
        if index.is_multiple_of(2) { at } else { at.swapped() }
    };
    even_shares().enumerate().map(pair).filter(|at| at.is_above()).take(PAIRS).collect()
}

fn mirror() -> Vec<Directions> {
    pairs(1.0, 80.0)
}

fn retro() -> Vec<Directions> {
    pairs(85.0, 2.0)
}

/// Pairs up to these θ_half and θ_diff \[degrees\].
fn pairs(half: f32, diff: f32) -> Vec<Directions> {
    let pair = |[h, d, around]: [f32; 3]| Rusinkiewicz {
        theta_half: h * half.to_radians(),
        theta_diff: d * diff.to_radians(),
        phi_diff: TAU * around,
        phi_half: 0.0,
    };
    even_shares().map(|shares| pair(shares).directions()).filter(|at| at.is_above()).take(PAIRS).collect()
}

/// How much a model changes where the half vector is so near to the normal that no material changes any more: azimuths stay, so that what is left is lost digits.
fn beside_the_normal(model: &dyn Brdf) -> f64 {
    let spread = |diff: u8, around: u8| {
        let at = |step: u8| Rusinkiewicz {
            theta_half: (0.01 * 5f32.powf(f32::from(step) / 32.0)).to_radians(),
            theta_diff: f32::from(diff).to_radians(),
            phi_diff: TAU * f32::from(around) / 7.0,
            phi_half: 0.4,
        };
        log_range(model, &(0..=32).map(|step| at(step).directions()).collect::<Vec<_>>())
    };
    let places = [5, 20, 40, 60, 75].into_iter().flat_map(|diff| (0..7).map(move |around| (diff, around)));
    places.map(|(diff, around)| spread(diff, around)).fold(0.0, f64::max)
}

/// That rounding decides what a model reflects where light and view mirror each other, by a factor of two and more. The half
/// vector is at the normal then and has no azimuth: no isotropic material depends on it, networks and tables do.
pub fn undecided(model: &dyn Brdf) -> Option<Warning> {
    let spread = at_the_normal(model);
    (spread > BY_HALF).then(|| Warning::Undecided { ratio: spread.exp() })
}

/// How much the same mirror pairs differ when they are moved by as much as rounding does.
fn at_the_normal(model: &dyn Brdf) -> f64 {
    const MOVED: f32 = 1e-6;
    let spread = |degrees: u8| {
        let (theta, moved) = (f32::from(degrees).to_radians(), |[x, y, z]: [f32; 3]| Vec3::new(x, y, z) - 0.5);
        let (light, view) = (spherical(theta, 0.0), spherical(theta, PI));
        let near = |shares| Directions::new((light + 2.0 * MOVED * moved(shares)).normalize(), view);
        log_range(model, &even_shares().map(near).take(64).collect::<Vec<_>>())
    };
    [5, 20, 40, 60, 75].into_iter().map(spread).fold(0.0, f64::max)
}

/// Logarithm of the largest over the smallest f + 0.001, of the channel where that is most.
fn log_range(model: &dyn Brdf, at: &[Directions]) -> f64 {
    let values = evaluate(model, at);
    if !values.iter().all(|f| f.is_finite()) {
        return f64::INFINITY;
    }
    let channel = |c: usize| {
        let logs = values.iter().map(move |f| f64::from(f[c] + OFFSET).ln());
        logs.clone().fold(f64::NEG_INFINITY, f64::max) - logs.fold(f64::INFINITY, f64::min)
    };
    (0..3).map(channel).fold(0.0, f64::max)
}

/// Lengths of light and view, other than 1.
fn of_other_length(model: &dyn Brdf, lengths: &[(f32, f32)]) -> f64 {
    let at: Vec<Directions> = pairs(70.0, 60.0).into_iter().step_by(4).collect();
    let wanted = evaluate(model, &at);
    let worst = |&(light, view): &(f32, f32)| {
        let scaled: Vec<Directions> = at.iter().map(|at| Directions::new(at.light * light, at.view * view)).collect();
        let ratio = |(a, b): (Rgb, &Rgb)| {
            let is_finite = a.is_finite() && b.is_finite();
            if is_finite { a.zip(*b, |a, b| ((a + OFFSET) / (b + OFFSET)).ln().abs()).max() } else { f32::INFINITY }
        };
        evaluate(model, &scaled).into_iter().zip(&wanted).map(ratio).map(f64::from).fold(0.0, f64::max)
    };
    lengths.iter().map(worst).fold(0.0, f64::max)
}

/// Share of pairs at or below the horizon that are not black.
fn not_black(model: &dyn Brdf) -> f64 {
    let above = [0.0f32, 0.5, 1.2].map(|theta| spherical(theta, 0.3));
    let heights = [0.0, -0.0, -1e-7, -1e-3, -0.5, -1.0f32];
    let below = heights.map(|z| Vec3::new((1.0 - z * z).sqrt(), 0.0, z));
    let mixed = above.iter().flat_map(|&a| below.map(|b| Directions::new(a, b)));
    let all: Vec<Directions> =
        mixed.flat_map(|at| [at, at.swapped()]).chain(below.map(|b| Directions::new(b, b))).collect();
    share(model, &all, |f| f == Rgb::BLACK)
}

/// Share of pairs with an impossible number in some place whose reflectance is not finite, or negative.
fn not_sound(model: &dyn Brdf) -> f64 {
    const ODD: [f32; 8] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, 1e-40, 1e-20, 1e20, f32::MAX];
    let usual = Directions::from_angles(0.6, 0.3, 0.9, 2.0);
    let place = |at: Directions, place: usize, odd: f32| {
        let mut numbers = [at.light.to_array(), at.view.to_array()];
        match place {
            0..6 => numbers[place / 3][place % 3] = odd,
            6 | 7 => numbers[place - 6] = [odd; 3],
            _ => numbers = [[odd; 3]; 2],
        }
        let [light, view] = numbers.map(Vec3::from_array);
        Directions::new(light, view)
    };
    let all: Vec<Directions> = ODD.into_iter().flat_map(|odd| (0..9).map(move |p| place(usual, p, odd))).collect();
    share(model, &all, |f| f.is_finite() && f.min() >= 0.0)
}

/// Share of answers that are wrong, asked one by one and many at a time.
fn share(model: &dyn Brdf, at: &[Directions], is_right: fn(Rgb) -> bool) -> f64 {
    let alone = at.iter().map(|&at| model.eval(at));
    let wrong = alone.chain(evaluate(model, at)).filter(|&f| !is_right(f)).count();
    wrong as f64 / (2 * at.len()) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{ggx::Ggx, lambert::Lambert};
    use crate::stress::Verdict;

    fn value(name: &str, reference: &dyn Brdf, model: &dyn Brdf) -> f64 {
        (EXPOSURES.iter().find(|exposure| exposure.hazard.name == name).unwrap().value)(reference, model)
    }

    #[test]
    fn grazing_pairs_have_one_direction_in_the_range_and_none_beyond_it() {
        for at in grazing(85.0, 89.5) {
            let steepest = at.light.z.min(at.view.z).acos().to_degrees();
            assert!((84.99..89.51).contains(&steepest), "{steepest}");
        }
    }

    #[test]
    fn a_formula_holds_wherever_it_is_its_own_reference() {
        let formula = Ggx { diffuse: Rgb([0.2, 0.15, 0.1]), f0: Rgb::splat(0.04), alpha: 0.3 };
        for Exposure { hazard, value, .. } in EXPOSURES.iter().filter(|e| e.hazard.name != "unnormalized") {
            assert!(value(&formula, &formula) <= hazard.holds, "{}", hazard.name);
        }
    }

    #[test]
    fn each_hazard_is_found_where_it_is() {
        struct Odd(fn(Directions) -> f32);

        impl Brdf for Odd {
            fn eval(&self, at: Directions) -> Rgb {
                Rgb::splat((self.0)(at))
            }
        }

        let grey = Lambert { albedo: Rgb::splat(0.5) };
        let black = Lambert { albedo: Rgb::BLACK };
        assert!(value("grazing_85", &grey, &black) > BY_HALF);
        assert_eq!(value("horizon", &grey, &Odd(|_| 0.1)), 1.0);
        let turning = Odd(|at| 1.5 + at.rusinkiewicz().phi_diff.sin());
        assert!(value("normal_azimuth", &turning, &turning) > 1.0);
        assert!(matches!(undecided(&turning), Some(Warning::Undecided { ratio }) if ratio > 2.0));
        assert_eq!(undecided(&grey), None);
        // cos θ_half instead of sin θ_half: 1 − cos² has no digits left.
        let blind = Odd(|at| (1.0 - at.rusinkiewicz().theta_half.cos().powi(2)).max(0.0).sqrt() * 1e3);
        assert!(value("normal_half", &blind, &blind) > 0.2);
        let nothing = Odd(|_| f32::NAN);
        for Exposure { hazard, value, .. } in EXPOSURES.iter().filter(|e| e.hazard.name != "horizon") {
            let value = value(&grey, &nothing);
            assert_eq!(hazard.verdict(value), Verdict::Fails, "{}: {value}", hazard.name);
        }
        let unguarded = Odd(|at| at.light.x.abs() / at.view.z);
        assert!(value("no_number", &grey, &unguarded) > 0.1 && value("unnormalized", &grey, &unguarded) > 0.6);
    }
}
