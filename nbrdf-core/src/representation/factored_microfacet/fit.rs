//! Alternating weighted least squares: one factor and the base at a time, the others held.
//!
//! M. Bagher, J. Snyder, D. Nowrouzezahrai, *A Non-Parametric Factor Microfacet Model for Isotropic BRDFs* (2016): with
//! the other factors fixed f is linear in one, and compressive weights stand for the logarithm that f is judged through.
//! Differs: the weights follow the fit instead of the data alone, such that what falls is the mean of
//! |ln(1 + f c) − ln(1 + g c)| itself, `log_error` but for more pairs in highlights; ρ_d is solved for together with every factor; G(θ_i) G(θ_o), no
//! linear function of G, is replaced by its tangent; curvature of a factor costs a little, so that entries which hardly
//! any pair tells about follow their neighbours. A step that does not lower the loss is shortened or not taken.

use faer::Mat;

use super::sites::{Factor, Place, Site, Sites};
use super::start::start;
use crate::least_squares::damped_step;

/// Differences of logarithms below this count as squares: what nobody sees should not steer the fit.
const SEEN: f64 = 1e-3;
/// What a squared second difference of a factor costs, in its units.
const CURVATURE: f64 = 1e-6;
/// Rounds over the three factors at most, and the share by which one must lower the loss to be followed by another.
const ROUNDS: usize = 20;
const WORTHWHILE: f64 = 5e-3;
/// Damping of a factor's first step, and of the next one where none was found.
const DAMPING: f64 = 1e-2;

/// What is solved for: ρ_d, and the entries of D, F and G, G from the horizon. ρ_s is a part of D.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    pub diffuse: f64,
    pub tables: [Vec<f64>; 3],
}

/// A fitted channel and the loss after every step towards it.
pub(super) struct Fit {
    pub unknowns: Unknowns,
    pub losses: Vec<f64>,
}

impl Fit {
    fn loss(&self) -> f64 {
        self.losses[self.losses.len() - 1]
    }
}

/// Fits one channel to the values \[1/sr\] at all sites.
pub(super) fn fit(sites: &Sites, values: &[f64]) -> Fit {
    let (unknowns, unit) = start(sites, values);
    let target = sites.sites.iter().zip(values).map(|(site, f)| (f * site.cosine).ln_1p()).collect();
    let problem = Problem { sites: &sites.sites, target, unit };
    let mut damping = [DAMPING; 3];
    let mut fit = Fit { losses: vec![problem.loss(&unknowns)], unknowns };
    for _ in 0..ROUNDS {
        let (before, from) = (fit.loss(), fit.unknowns.clone());
        for factor in Factor::ALL {
            problem.step(factor, &mut fit, &mut damping[factor as usize]);
        }
        problem.leap(&from, &mut fit);
        if fit.loss() > (1.0 - WORTHWHILE) * before {
            break;
        }
    }
    fit
}

struct Problem<'a> {
    sites: &'a [Site],
    /// ln(1 + f c).
    target: Vec<f64>,
    /// Entries are solved for in units of these.
    unit: Unknowns,
}

/// One row of the least-squares problem: the base, and up to four entries.
type Row = [(usize, f64); 5];

impl Problem<'_> {
    /// Mean difference of logarithms, and what curvature costs.
    fn loss(&self, unknowns: &Unknowns) -> f64 {
        let difference = |(site, target): (&Site, &f64)| {
            let residual = (unknowns.value(site) * site.cosine).ln_1p() - target;
            residual.hypot(SEEN) - SEEN
        };
        let sum: f64 = self.sites.iter().zip(&self.target).map(difference).sum();
        let bent = Factor::ALL.map(|factor| self.bends(unknowns, factor).map(|bend| bend * bend).sum::<f64>());
        sum / self.sites.len() as f64 + 0.5 * CURVATURE * bent.iter().sum::<f64>()
    }

    /// Second differences of a factor in its units.
    fn bends(&self, unknowns: &Unknowns, factor: Factor) -> impl Iterator<Item = f64> {
        let (table, unit) = (&unknowns.tables[factor as usize], &self.unit.tables[factor as usize]);
        let scaled: Vec<f64> = table.iter().zip(unit).map(|(entry, unit)| entry / unit).collect();
        (2..scaled.len()).map(move |k| scaled[k - 2] - 2.0 * scaled[k - 1] + scaled[k])
    }

    /// A step of one factor and the base; the loss never rises.
    fn step(&self, factor: Factor, fit: &mut Fit, damping: &mut f64) {
        let (normal, slope) = self.normal_equations(&fit.unknowns, factor);
        for _ in 0..8 {
            let Some(step) = damped_step(&normal, &slope, *damping) else { break };
            let next = self.moved(&fit.unknowns, factor, &step);
            let loss = self.loss(&next);
            if loss < fit.loss() {
                *damping = (*damping * 0.3).max(1e-6);
                fit.unknowns = next;
                fit.losses.push(loss);
                return;
            }
            *damping *= 5.0;
        }
        *damping = DAMPING;
    }

    /// Farther the way that a round went, as long as that lowers the loss: factors that trade a slope between them
    /// approach their balance slowly (as R. Harshman, *Foundations of the PARAFAC Procedure* (1970), between rounds).
    fn leap(&self, from: &Unknowns, fit: &mut Fit) {
        let to = fit.unknowns.clone();
        for stride in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0] {
            let farther = |from: f64, to: f64| (to + stride * (to - from)).max(0.0);
            let table = |factor: Factor| {
                let [from, to] = [from, &to].map(|unknowns| &unknowns.tables[factor as usize]);
                from.iter().zip(to).map(|(from, to)| farther(*from, *to)).collect()
            };
            let next = Unknowns { diffuse: farther(from.diffuse, to.diffuse), tables: Factor::ALL.map(table) };
            let loss = self.loss(&next);
            if loss >= fit.loss() {
                break;
            }
            fit.unknowns = next;
            fit.losses.push(loss);
        }
    }

    /// The unknowns less a step in their units, nothing below 0.
    fn moved(&self, unknowns: &Unknowns, factor: Factor, step: &[f64]) -> Unknowns {
        let mut next = unknowns.clone();
        let table = next.tables[factor as usize].iter_mut().zip(&self.unit.tables[factor as usize]);
        let all = std::iter::once((&mut next.diffuse, &self.unit.diffuse)).chain(table);
        all.zip(step).for_each(|((entry, unit), step)| *entry = (*entry - unit * step).max(0.0));
        next
    }

    /// JᵀWJ and JᵀWr of the base and one factor, in their units. What is 0 and would fall is held.
    fn normal_equations(&self, unknowns: &Unknowns, factor: Factor) -> (Mat<f64>, Vec<f64>) {
        let count = 1 + factor.entries();
        let (mut normal, mut slope) = (vec![0.0; count * count], vec![0.0; count]);
        for (site, target) in self.sites.iter().zip(&self.target) {
            let grown = 1.0 + unknowns.value(site) * site.cosine;
            let residual = grown.ln() - target;
            let weight = 1.0 / residual.hypot(SEEN) / self.sites.len() as f64;
            let row = self.row(unknowns, factor, site, site.cosine / grown);
            // Only G is read twice.
            let row = if factor == Factor::Shadowing { &row[..] } else { &row[..3] };
            for &(i, a) in row {
                let weighted = weight * a;
                slope[i] += weighted * residual;
                row.iter().for_each(|&(j, b)| normal[i * count + j] += weighted * b);
            }
        }
        for (k, bend) in self.bends(unknowns, factor).enumerate() {
            let row = [(k + 1, 1.0), (k + 2, -2.0), (k + 3, 1.0)];
            for (i, a) in row {
                slope[i] += CURVATURE * a * bend;
                row.iter().for_each(|&(j, b)| normal[i * count + j] += CURVATURE * a * b);
            }
        }
        let entry = |i: usize| if i == 0 { unknowns.diffuse } else { unknowns.tables[factor as usize][i - 1] };
        let horizon = |i: usize| factor == Factor::Shadowing && i == 1;
        let held: Vec<bool> = (0..count).map(|i| horizon(i) || entry(i) <= 0.0 && slope[i] >= 0.0).collect();
        (0..count).filter(|&i| held[i]).for_each(|i| slope[i] = 0.0);
        let free =
            |i: usize, j: usize| if held[i] || held[j] { f64::from(u8::from(i == j)) } else { normal[i * count + j] };
        (Mat::from_fn(count, count, free), slope)
    }

    /// ∂ ln(1 + g c) by the base and the entries that a site reads; `lean` is ∂ ln(1 + g c) / ∂g.
    fn row(&self, unknowns: &Unknowns, factor: Factor, site: &Site, lean: f64) -> Row {
        let [distribution, fresnel, light, view] = unknowns.read(site);
        let unit = &self.unit.tables[factor as usize];
        let mut row = [(0, 0.0); 5];
        row[0] = (0, lean * self.unit.diffuse);
        let mut put = |at: usize, (low, t): Place, slope: f64| {
            row[at] = (1 + low, slope * (1.0 - t) * unit[low]);
            row[at + 1] = (2 + low, slope * t * unit[low + 1]);
        };
        let lean = lean * site.over;
        match factor {
            Factor::Distribution => put(1, site.places[0], lean * fresnel * light * view),
            Factor::Fresnel => put(1, site.places[1], lean * distribution * light * view),
            Factor::Shadowing => {
                put(1, site.places[2], lean * distribution * fresnel * view);
                put(3, site.places[3], lean * distribution * fresnel * light);
            }
        }
        row
    }
}

impl Unknowns {
    /// D, F, G(θ_i) and G(θ_o) at a site.
    pub fn read(&self, site: &Site) -> [f64; 4] {
        let read = |table: &[f64], (low, t): Place| table[low] + t * (table[low + 1] - table[low]);
        let [half, diff, light, view] = site.places;
        let [distribution, fresnel, shadowing] = &self.tables;
        [read(distribution, half), read(fresnel, diff), read(shadowing, light), read(shadowing, view)]
    }

    fn value(&self, site: &Site) -> f64 {
        let [distribution, fresnel, light, view] = self.read(site);
        self.diffuse + distribution * fresnel * light * view * site.over
    }
}
