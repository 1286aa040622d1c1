//! The shortest way through codes, as it is seen.
//!
//! Codes z₀ … z_K between two ends minimize the energy K Σ |P(z_k₊₁) − P(z_k)|² of a sphere's pictures P in ITP: a curve of
//! least energy is a shortest one, walked at an even pace (M. do Carmo, *Riemannian Geometry* (1992), section 9.2). A
//! second term keeps the mean colour of every picture between those of the ends in u′v′, and a small third one keeps
//! numbers that nothing shows where the straight path has them. Damped Gauss–Newton steps on all codes together, with
//! exact derivatives of code to weights to pictures.

mod seen;

use std::sync::Arc;

use faer::Mat;
use rayon::prelude::*;

use super::code_path::{CodePath, codes_of};
use super::{Interpolation, Path, PathError, Weights, with_weighted_sum};
use crate::least_squares::damped_step;
use crate::metric::{change_of_detour, detour};
use crate::{Brdf, Code, Material, Representation};
use seen::{Canvas, Seen};

/// Pieces of a path.
const PIECES: usize = 10;
/// Gauss–Newton steps at most.
const STEPS: usize = 8;
/// A step that gains less than this share of the energy is the last.
const ENOUGH: f64 = 1e-3;
/// Weight of the squared distance in u′v′, against mean squared ITP.
const COLOUR: f64 = 300.0;
/// Weight of leaving the straight path, relative to the energy of the straight path.
const STRAIGHT: f64 = 0.1;

/// Encodes the ends and takes the shortest way between their codes; straight where codes do not decode to networks
/// smoothly, and between three ends and more.
pub struct Geodesic {
    name: &'static str,
    representation: Arc<dyn Representation>,
}

impl Geodesic {
    /// Under the name that reports use.
    pub fn new(name: &'static str, representation: Arc<dyn Representation>) -> Self {
        Self { name, representation }
    }
}

impl Interpolation for Geodesic {
    fn name(&self) -> &'static str {
        self.name
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        let codes = codes_of(self.representation.as_ref(), ends)?;
        let representation = Arc::clone(&self.representation);
        match codes.as_slice() {
            [a, b] => Ok(Box::new(Knots { knots: shortest(representation.as_ref(), a, b)?, representation })),
            _ => Ok(Box::new(CodePath { representation, codes })),
        }
    }
}

/// Codes from one end to the other, straight from each to the next.
struct Knots {
    representation: Arc<dyn Representation>,
    knots: Vec<Vec<f32>>,
}

impl Knots {
    /// Hands the numbers at these weights to `then`. Beyond the ends the path goes on as it came.
    fn with_numbers<T>(
        &self,
        weights: &Weights,
        then: impl FnOnce(&[f32]) -> Result<T, PathError>,
    ) -> Result<T, PathError> {
        let last = self.knots.len() - 1;
        let place = weights.for_ends(2)?[1] * last as f32;
        // NaN becomes 0 here and is refused as a number of the code.
        let before = (place.max(0.0) as usize).min(last - 1);
        with_weighted_sum(&Weights::two(place - before as f32), &self.knots[before..=before + 1], then)
    }
}

impl Path for Knots {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        self.with_numbers(weights, |code| Ok(self.representation.decode(&self.representation.code(code.to_vec()))?))
    }

    fn code(&self, weights: &Weights) -> Result<Option<Code>, PathError> {
        self.with_numbers(weights, |code| Ok(Some(self.representation.code(code.to_vec()))))
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        self.with_numbers(weights, |code| Ok(self.representation.decode_into(code, point)?))
    }
}

/// Codes from `a` to `b`, both included.
fn shortest(representation: &dyn Representation, a: &[f32], b: &[f32]) -> Result<Vec<Vec<f32>>, PathError> {
    let straight = |k: usize| {
        let t = k as f32 / PIECES as f32;
        a.iter().zip(b).map(|(a, b)| (1.0 - t) * a + t * b).collect::<Vec<f32>>()
    };
    let straight: Vec<Vec<f32>> = (0..=PIECES).map(straight).collect();
    let canvas = Canvas::new();
    let see = |codes: &[Vec<f32>]| {
        let one = |code: &Vec<f32>| Seen::of(representation, &canvas, code);
        codes.par_iter().map(one).collect::<Result<Option<Vec<_>>, _>>()
    };
    let Some(mut seen) = see(&straight)? else { return Ok(straight) };
    let mut knots = straight.clone();
    let problem = Problem::new(&straight, &seen);
    let (mut energy, mut damping) = (problem.energy(&knots, &seen), 1e-3);
    for _ in 0..STEPS {
        let (normal, slope) = problem.normal_equations(&knots, &seen);
        let Some(step) = damped_step(&normal, &slope, damping) else { break };
        let moved = |(k, knot): (usize, &Vec<f32>)| match k {
            0 | PIECES => knot.clone(),
            _ => knot.iter().zip(&step[(k - 1) * knot.len()..]).map(|(v, s)| v - *s as f32).collect(),
        };
        let next: Vec<Vec<f32>> = knots.iter().enumerate().map(moved).collect();
        // A step to where nothing can be decoded is a step too far.
        let Ok(Some(next_seen)) = see(&next) else {
            damping *= 8.0;
            continue;
        };
        let next_energy = problem.energy(&next, &next_seen);
        if next_energy >= energy || next_energy.is_nan() {
            damping *= 8.0;
            continue;
        }
        let gain = 1.0 - next_energy / energy;
        (knots, seen, energy) = (next, next_seen, next_energy);
        damping = (0.3 * damping).max(1e-6);
        if gain < ENOUGH {
            break;
        }
    }
    Ok(knots)
}

/// What is minimized.
struct Problem<'a> {
    straight: &'a [Vec<f32>],
    /// Mean colours of the ends in u′v′.
    colours: [[f64; 2]; 2],
    /// Weight of each number's squared distance from the straight path.
    stay: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(straight: &'a [Vec<f32>], seen: &[Seen]) -> Self {
        let colours = [&seen[0], &seen[PIECES]].map(|end| end.colour);
        // Numbers count by how much they show: those that show nothing are held by a floor.
        let dim = straight[0].len();
        let shown = |i: usize| seen.iter().map(|seen| seen.squares(i)).sum::<f64>() / seen.len() as f64;
        let shown: Vec<f64> = (0..dim).map(shown).collect();
        let floor = shown.iter().sum::<f64>() / dim as f64;
        Self { straight, colours, stay: shown.iter().map(|shown| STRAIGHT * (shown + floor)).collect() }
    }

    fn energy(&self, knots: &[Vec<f32>], seen: &[Seen]) -> f64 {
        let steps: f64 = seen.windows(2).map(|pair| pair[0].square_distance(&pair[1])).sum();
        let colour: f64 = seen.iter().map(|seen| self.detour(seen).iter().map(|v| v * v).sum::<f64>()).sum();
        let stay: f64 = knots.iter().zip(self.straight).map(|(knot, straight)| self.distance(knot, straight)).sum();
        PIECES as f64 * steps + COLOUR * colour + stay
    }

    fn distance(&self, knot: &[f32], straight: &[f32]) -> f64 {
        let term = |((a, b), weight): ((&f32, &f32), &f64)| weight * f64::from(a - b).powi(2);
        knot.iter().zip(straight).zip(&self.stay).map(term).sum()
    }

    /// From the nearest colour between the ends to that of a picture.
    fn detour(&self, seen: &Seen) -> [f64; 2] {
        detour(seen.colour, self.colours[0], self.colours[1])
    }

    /// JᵀJ and Jᵀr of all inner knots: blocks on the diagonal and beside it.
    fn normal_equations(&self, knots: &[Vec<f32>], seen: &[Seen]) -> (Mat<f64>, Vec<f64>) {
        let dim = knots[0].len();
        let inner = PIECES - 1;
        let mut normal = Mat::<f64>::zeros(inner * dim, inner * dim);
        let mut slope = vec![0.0; inner * dim];
        let pieces = PIECES as f64;
        let own: Vec<Mat<f64>> = (1..PIECES).into_par_iter().map(|k| seen[k].product(&seen[k])).collect();
        let beside: Vec<Mat<f64>> = (1..inner).into_par_iter().map(|k| seen[k].product(&seen[k + 1])).collect();
        for k in 1..PIECES {
            let at = (k - 1) * dim;
            let pull = seen[k].pull(&seen[k - 1], &seen[k + 1]);
            let detour = self.detour(&seen[k]);
            let [from, to] = self.colours;
            let by_colour: Vec<[f64; 2]> =
                (0..dim).map(|i| change_of_detour(seen[k].colour, from, to, seen[k].colour_by(i))).collect();
            for (i, by_own) in by_colour.iter().enumerate() {
                let stays = self.stay[i] * f64::from(knots[k][i] - self.straight[k][i]);
                let colour = by_own[0] * detour[0] + by_own[1] * detour[1];
                slope[at + i] = pieces * pull[i] + COLOUR * colour + stays;
                for (j, by_other) in by_colour.iter().enumerate() {
                    let colour = COLOUR * (by_own[0] * by_other[0] + by_own[1] * by_other[1]);
                    normal[(at + i, at + j)] = 2.0 * pieces * own[k - 1][(i, j)] + colour;
                    if k < inner {
                        let coupling = -pieces * beside[k - 1][(i, j)];
                        normal[(at + i, at + dim + j)] = coupling;
                        normal[(at + dim + j, at + i)] = coupling;
                    }
                }
                normal[(at + i, at + i)] += self.stay[i];
            }
        }
        (normal, slope)
    }
}
