//! Moving one quality of a code and leaving the others.
//!
//! No fixed direction does: what a number of the code does differs from material to material. So the direction is found
//! anew at every point. Let q be the measured [`Qualities`], J = ∂q/∂z, and C the covariance of the codes of known
//! materials. Of all changes of the code that move one quality and hold others, C Jᵀ (J C Jᵀ)⁻¹ Δq is the likeliest;
//! the edit follows it in small steps, each of which corrects what the last one missed.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::Axis;
use crate::Representation;
use crate::quality::Qualities;
use crate::representation::DecodeError;

/// Largest change of a quality in one step; a step that is further behind catches up first.
const STEP: f64 = 0.04;
/// Steps that only correct, at the end.
const CORRECTIONS: usize = 3;
/// Relative damping of the normal equations.
const DAMPING: f64 = 1e-3;
/// Largest change of the code in one step, in spreads of the known codes (root mean square).
const LARGEST: f64 = 0.35;
/// Smallest share of the squared miss that a step has to win.
const ENOUGH: f64 = 0.01;
/// A step that wins less is halved, this often at most.
const HALVINGS: usize = 4;

/// How the codes of known materials are spread.
pub struct Prior {
    /// Covariance \[numbers, numbers\].
    covariance: Mat<f64>,
    spread: Vec<f64>,
}

impl Prior {
    /// Of these codes, all of one length. A tenth of the variances is added, so that few codes do not forbid a direction.
    pub fn of(codes: &[Vec<f32>]) -> Self {
        let dim = codes.first().map_or(0, Vec::len);
        let count = codes.len().max(1) as f64;
        let mean: Vec<f64> = (0..dim).map(|i| codes.iter().map(|c| f64::from(c[i])).sum::<f64>() / count).collect();
        let product = |i: usize, j: usize| {
            let one = |c: &Vec<f32>| (f64::from(c[i]) - mean[i]) * (f64::from(c[j]) - mean[j]);
            codes.iter().map(one).sum::<f64>() / count
        };
        let covariance = Mat::from_fn(dim, dim, |i, j| product(i, j) * if i == j { 1.1 } else { 1.0 });
        let spread = (0..dim).map(|i| covariance[(i, i)].sqrt().max(1e-6)).collect();
        Self { covariance, spread }
    }
}

/// A material's code with one quality moved by `amount`, and the qualities it has then.
///
/// Stops short where the quality ends (nothing is more than all metal), where codes cease to decode, and where no step
/// brings moved and held qualities together nearer to what they should be; compare the qualities. An amount that is not
/// finite moves nothing.
///
/// # Errors
/// If `code` itself does not decode.
pub fn edit(
    representation: &dyn Representation,
    prior: &Prior,
    code: &[f32],
    axis: Axis,
    amount: f64,
) -> Result<(Vec<f32>, Qualities), DecodeError> {
    let measure = |code: &[f32]| -> Result<Qualities, DecodeError> {
        Ok(Qualities::of(representation.decode(&representation.code(code.to_vec()))?.as_ref()))
    };
    let start = measure(code)?;
    let (mut code, mut now) = (code.to_vec(), start);
    if amount == 0.0 || !amount.is_finite() {
        return Ok((code, now));
    }
    // How much of the way is asked for, and how often all of it has been.
    let (mut share, mut corrections) = (0.0, 0);
    while corrections <= CORRECTIONS {
        let missing = |q: &Qualities, share: f64| -> Vec<f64> {
            axis.rows(q).iter().zip(axis.wanted(&start, share * amount)).map(|(own, wanted)| wanted - own).collect()
        };
        if square(&missing(&now, share)) < STEP * STEP {
            share = (share + STEP / amount.abs()).min(1.0);
        }
        corrections += usize::from(share >= 1.0);
        let missing_now = missing(&now, share);
        // Where a neighbour cannot be measured, no direction is known.
        let Ok(slopes) = slopes(&measure, axis, prior, &code) else { break };
        let change = likeliest(&slopes, prior, &missing_now);
        let size = change.iter().zip(&prior.spread).map(|(c, s)| (c / s) * (c / s)).sum::<f64>() / code.len() as f64;
        let whole = (LARGEST / size.sqrt().max(1e-12)).min(1.0);
        let try_step = |halving: usize| {
            let scale = whole * 0.5f64.powi(halving as i32);
            let next: Vec<f32> = code.iter().zip(&change).map(|(v, c)| v + (scale * c) as f32).collect();
            let then = measure(&next).ok()?;
            // No number is no gain.
            let gains = square(&missing(&then, share)) < (1.0 - ENOUGH) * square(&missing_now);
            gains.then_some((next, then))
        };
        match (0..=HALVINGS).find_map(try_step) {
            Some(next) => (code, now) = next,
            None => break,
        }
    }
    Ok((code, now))
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum()
}

/// ∂rows/∂number, by central differences.
fn slopes(
    measure: &dyn Fn(&[f32]) -> Result<Qualities, DecodeError>,
    axis: Axis,
    prior: &Prior,
    code: &[f32],
) -> Result<Mat<f64>, DecodeError> {
    let mut columns = Vec::with_capacity(code.len());
    for i in 0..code.len() {
        let offset = (0.02 * prior.spread[i]).max(1e-4) as f32;
        let rows = |by: f32| {
            let mut code = code.to_vec();
            code[i] += by;
            Ok::<_, DecodeError>(axis.rows(&measure(&code)?))
        };
        let (high, low) = (rows(offset)?, rows(-offset)?);
        let column: Vec<f64> = high.iter().zip(&low).map(|(a, b)| (a - b) / (2.0 * f64::from(offset))).collect();
        columns.push(column);
    }
    Ok(Mat::from_fn(columns[0].len(), code.len(), |row, number| columns[number][row]))
}

/// C Jᵀ (J C Jᵀ + damping)⁻¹ Δ.
fn likeliest(slopes: &Mat<f64>, prior: &Prior, missing: &[f64]) -> Vec<f64> {
    let spread = slopes * &prior.covariance;
    let mut normal = &spread * slopes.transpose();
    let rows = missing.len();
    let mean = (0..rows).map(|i| normal[(i, i)]).sum::<f64>() / rows as f64;
    for i in 0..rows {
        normal[(i, i)] += DAMPING * (normal[(i, i)] + 0.1 * mean) + 1e-12;
    }
    let solved = normal.partial_piv_lu().solve(Mat::from_fn(rows, 1, |i, _| missing[i]));
    (0..prior.spread.len()).map(|number| (0..rows).map(|row| spread[(row, number)] * solved[(row, 0)]).sum()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::representation::{Code, EncodeError};
    use crate::{Brdf, Material, Rgb};

    /// A material of five numbers, each of which means something: body colour, strength and width of the highlight.
    struct Five;

    impl Representation for Five {
        fn name(&self) -> &'static str {
            "five"
        }

        fn dim(&self) -> usize {
            5
        }

        fn checkpoint(&self) -> &str {
            "none"
        }

        fn shared_bytes(&self) -> usize {
            0
        }

        fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
            Err(EncodeError::NotFinite { material: target.name.clone() })
        }

        fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
            let z = &code.code;
            let share = |v: f32| 1.0 / (1.0 + (-v).exp());
            let diffuse = Rgb([share(z[0]), share(z[1]), share(z[2])]) * 0.8;
            Ok(Box::new(Ggx { diffuse, f0: Rgb::splat(share(z[3])), alpha: 0.05 + 0.7 * share(z[4]) }))
        }
    }

    fn moved(axis: Axis, amount: f64) -> (Qualities, Qualities) {
        let start = [0.5, -0.5, -1.0, -2.0, -1.0];
        // Spread along every number, alike.
        let known: Vec<Vec<f32>> = (0..10)
            .map(|k| {
                start
                    .iter()
                    .enumerate()
                    .map(|(i, v)| v + if k / 2 == i { 1.0 - 2.0 * (k % 2) as f32 } else { 0.0 })
                    .collect()
            })
            .collect();
        let before = Qualities::of(Five.decode(&Five.code(start.to_vec())).unwrap().as_ref());
        let (_, after) = edit(&Five, &Prior::of(&known), &start, axis, amount).unwrap();
        (before, after)
    }

    #[test]
    fn a_rougher_material_keeps_its_lightness_and_colour() {
        let (before, after) = moved(Axis::Roughness, 0.1);
        // Five numbers for six quantities: least squares between the way and what is held would end at 0.052.
        assert!(Axis::Roughness.difference(&before, &after) > 0.04, "{before:?} {after:?}");
        assert!(Axis::Lightness.difference(&before, &after).abs() < 0.05);
        assert!(Axis::Hue.difference(&before, &after).abs() < 0.01);
    }

    #[test]
    fn hue_turns_and_chroma_stays() {
        let (before, after) = moved(Axis::Hue, 0.1);
        assert!((Axis::Hue.difference(&before, &after) - 0.1).abs() < 0.02, "{before:?} {after:?}");
        assert!(Axis::Chroma.difference(&before, &after).abs() < 0.05);
        assert!(Axis::Lightness.difference(&before, &after).abs() < 0.02);
    }

    #[test]
    fn grey_takes_on_colour() {
        let grey = Qualities { colour: [0.0; 2], ..moved(Axis::Gloss, 0.0).0 };
        let [u, v, ..] = Axis::Chroma.wanted(&grey, 0.2);
        assert!((u.hypot(v) - 0.2).abs() < 1e-12, "{u} {v}");
        let [u, v, ..] = Axis::Chroma.wanted(&grey, -0.2);
        assert_eq!((u, v), (0.0, 0.0));
    }

    #[test]
    fn nothing_asked_is_nothing_done() {
        for amount in [0.0, f64::NAN, f64::INFINITY] {
            let (before, after) = moved(Axis::Gloss, amount);
            assert_eq!(before, after, "{amount}");
        }
    }

    #[test]
    fn what_is_out_of_reach_is_not_paid_for_with_what_is_held() {
        for (axis, amount) in [(Axis::Lightness, 5.0), (Axis::Roughness, -5.0), (Axis::Sheen, 5.0)] {
            let (before, after) = moved(axis, amount);
            assert!(axis.difference(&before, &after) * amount > 0.0, "{axis:?} {before:?} {after:?}");
            for held in [Axis::Lightness, Axis::Hue, Axis::Roughness].into_iter().filter(|held| *held != axis) {
                let drift = held.difference(&before, &after);
                assert!(drift.abs() < 0.1, "{axis:?} moved {held:?} by {drift}: {before:?} {after:?}");
            }
        }
    }

    #[test]
    fn hues_are_compared_the_shorter_way_round() {
        let at = |u: f64, v: f64| Qualities { colour: [u, v], ..moved(Axis::Gloss, 0.0).0 };
        let difference = Axis::Hue.difference(&at(-0.1, 0.01), &at(-0.1, -0.01));
        assert!((0.0..0.1).contains(&difference), "{difference}");
        // Three quarters forwards is a quarter back.
        let missed = Axis::Hue.missed(&at(0.1, 0.0), &at(0.0, -0.1), 0.75);
        assert!(missed.abs() < 1e-9, "{missed}");
    }
}
