//! A network of fewer units that is near a given one: where fits of small networks begin.
//!
//! Units are left out one by one, whichever is missed least when the layer after it makes up for it by least squares
//! (J.-H. Luo, J. Wu, W. Lin, *ThiNet: A Filter Level Pruning Method for Deep Neural Network Compression*, 2017, section
//! 3.2). Differs: dense layers, and units are removed rather than collected.

use faer::Mat;

use super::{INPUTS, Nbrdf};
use crate::direction::HalfDiff;
use crate::linear_system::LinearSystem;
use crate::sampling::{even_shares, half_difference};

/// Pairs of directions at which units are missed or not.
const PAIRS: usize = 2048;
/// Damping of the least squares, as a share of the mean square.
const DAMPING: f64 = 1e-7;

impl Nbrdf {
    /// A network of these hidden widths near this one; none where this one is narrower.
    pub fn shrunk(&self, hidden: [usize; 2]) -> Option<Self> {
        if hidden[0] == 0 || hidden[1] == 0 || hidden[0] > self.hidden[0] || hidden[1] > self.hidden[1] {
            return None;
        }
        let [first, second, third] = self.layers();
        let inputs = inputs();
        let once: Vec<Vec<f64>> = inputs.iter().map(|x| first.of(x).into_iter().map(relu).collect()).collect();
        let sums: Vec<Vec<f64>> = once.iter().map(|a| second.of(a)).collect();
        let twice: Vec<Vec<f64>> = sums.iter().map(|z| z.iter().copied().map(relu).collect()).collect();
        let outputs: Vec<Vec<f64>> = twice.iter().map(|a| third.of(a)).collect();
        let (kept_second, third) = kept(&twice, &outputs, hidden[1])?;
        // A sum counts as much as what comes after makes of it.
        let counts: Vec<f64> =
            third.kernel.iter().map(|row| row.iter().map(|w| w * w).sum::<f64>().sqrt().max(1e-6)).collect();
        let wanted: Vec<Vec<f64>> = sums
            .iter()
            .map(|z| kept_second.iter().zip(&counts).map(|(&unit, count)| z[unit] * count).collect())
            .collect();
        let (kept_first, mut second) = kept(&once, &wanted, hidden[0])?;
        for row in second.kernel.iter_mut().chain([&mut second.bias]) {
            row.iter_mut().zip(&counts).for_each(|(w, count)| *w /= count);
        }
        let first = Layer {
            kernel: first.kernel.iter().map(|row| kept_first.iter().map(|&unit| row[unit]).collect()).collect(),
            bias: kept_first.iter().map(|&unit| first.bias[unit]).collect(),
        };
        let weights = [first, second, third].iter().flat_map(Layer::flat).collect();
        Self::new(hidden, weights).ok()
    }

    fn layers(&self) -> [Layer; 3] {
        self.layout().layers.map(|(kernel, bias)| {
            let bias: Vec<f64> = self.weights[bias].iter().map(|&w| w.into()).collect();
            let rows = self.weights[kernel].chunks_exact(bias.len());
            Layer { kernel: rows.map(|row| row.iter().map(|&w| w.into()).collect()).collect(), bias }
        })
    }
}

/// Weights \[inputs, units\] and biases \[units\].
struct Layer {
    kernel: Vec<Vec<f64>>,
    bias: Vec<f64>,
}

impl Layer {
    fn of(&self, inputs: &[f64]) -> Vec<f64> {
        let mut sums = self.bias.clone();
        for (input, row) in inputs.iter().zip(&self.kernel) {
            sums.iter_mut().zip(row).for_each(|(sum, weight)| *sum += input * weight);
        }
        sums
    }

    fn flat(&self) -> impl Iterator<Item = f32> {
        self.kernel.iter().flatten().chain(&self.bias).map(|&w| w as f32)
    }
}

const fn relu(v: f64) -> f64 {
    v.max(0.0)
}

/// What networks read at pairs that see narrow highlights, none of which is one of the metric's.
fn inputs() -> Vec<[f64; INPUTS]> {
    let pairs = even_shares().map(|[u, diff, around]| half_difference([u * u, diff, around]));
    let read = |HalfDiff { half, diff }: HalfDiff| [half.x, half.y, half.z, diff.x, diff.y, diff.z].map(f64::from);
    pairs.filter(|at| at.is_above()).take(PAIRS).map(|at| read(at.half_diff())).collect()
}

/// The `count` units that are missed most, and the layer that makes `wanted` of them.
fn kept(units: &[Vec<f64>], wanted: &[Vec<f64>], count: usize) -> Option<(Vec<usize>, Layer)> {
    let width = units.first()?.len();
    // A last unit that is always 1 stands for the biases.
    let with_one: Vec<Vec<f64>> = units.iter().map(|row| row.iter().copied().chain([1.0]).collect()).collect();
    let gram = products(&with_one, &with_one);
    let slopes = products(&with_one, wanted);
    let mut left: Vec<usize> = (0..width).collect();
    while left.len() > count {
        let without = |place: usize| {
            let others: Vec<usize> = left.iter().copied().filter(|&unit| unit != left[place]).collect();
            Some((explained(&gram, &slopes, &others, width)?.0, place))
        };
        let best = (0..left.len()).filter_map(without).max_by(|a, b| a.0.total_cmp(&b.0))?;
        left.remove(best.1);
    }
    let (_, mut kernel) = explained(&gram, &slopes, &left, width)?;
    let bias = kernel.pop()?;
    Some((left, Layer { kernel, bias }))
}

/// How much of the squares of what is wanted these units explain, and by which weights \[units + 1, wanted\].
fn explained(gram: &[Vec<f64>], slopes: &[Vec<f64>], units: &[usize], one: usize) -> Option<(f64, Vec<Vec<f64>>)> {
    let all: Vec<usize> = units.iter().copied().chain([one]).collect();
    let part = Mat::from_fn(all.len(), all.len(), |i, j| gram[all[i]][all[j]]);
    let damping = DAMPING * (0..all.len()).map(|i| part[(i, i)]).sum::<f64>() / all.len() as f64;
    let system = LinearSystem::of_gram(&part).ok()?;
    let columns = slopes.first()?.len();
    let mut weights = vec![vec![0.0; columns]; all.len()];
    let mut sum = 0.0;
    for column in 0..columns {
        let slope: Vec<f64> = all.iter().map(|&unit| slopes[unit][column]).collect();
        for (row, (w, s)) in system.solve(&slope, damping).into_iter().zip(&slope).enumerate() {
            weights[row][column] = w;
            sum += w * s;
        }
    }
    Some((sum, weights))
}

/// Sums of products over all rows \[columns of a, columns of b\].
fn products(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (rows, columns) = (a.first().map_or(0, Vec::len), b.first().map_or(0, Vec::len));
    let mut sums = vec![vec![0.0; columns]; rows];
    for (a, b) in a.iter().zip(b) {
        for (sums, a) in sums.iter_mut().zip(a) {
            sums.iter_mut().zip(b).for_each(|(sum, b)| *sum += a * b);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use crate::library::builtin;
    use crate::metric::{LogError, Metric};
    use crate::nbrdf::fit::random_hidden;

    #[test]
    fn units_that_never_fire_are_not_missed() {
        let network = &builtin::shared().get("pink-felt").unwrap().network;
        let live = network.compact().hidden();
        assert!(live[0] < 21 || live[1] < 21, "{live:?}");
        let apart = LogError.distance(network, &network.shrunk(live).unwrap());
        assert!(apart < 1e-3, "{apart}");
    }

    #[test]
    fn a_shrunk_network_is_nearer_than_a_random_one_and_the_wider_the_nearer() {
        for name in ["gold-paint", "red-plastic", "chrome"] {
            let network = &builtin::shared().get(name).unwrap().network;
            let apart = |hidden| LogError.distance(network, &network.shrunk(hidden).unwrap());
            let random = LogError.distance(network, &random_hidden(0, 0, [10, 10]));
            assert!(apart([16, 16]) <= apart([10, 10]) * 1.2 && apart([10, 10]) < random, "{name}");
        }
    }

    #[test]
    fn a_network_does_not_shrink_to_more_units() {
        let network = random_hidden(0, 0, [8, 4]);
        assert!(
            network.shrunk([8, 4]).is_some() && network.shrunk([9, 4]).is_none() && network.shrunk([4, 5]).is_none()
        );
        assert!(network.shrunk([0, 4]).is_none());
    }
}
