//! Which materials walks lead through: names in order, each with others at fixed distances.

use nbrdf_core::Material;

use crate::measure::standard_pairs;

/// The standard pairs, evenly picked.
pub(super) fn pairs(ends: &[Material], count: usize) -> Vec<Vec<Material>> {
    let all: Vec<(usize, usize)> = standard_pairs(ends.len()).collect();
    let step = all.len().div_ceil(count).max(1);
    all.iter().step_by(step).map(|&(i, j)| vec![ends[i].clone(), ends[j].clone()]).collect()
}

/// Three ends a third of the list apart.
pub(super) fn triples(ends: &[Material], count: usize) -> Vec<Vec<Material>> {
    apart(ends, 3, count)
}

/// Six ends a sixth apart.
pub(super) fn sixes(ends: &[Material], count: usize) -> Vec<Vec<Material>> {
    apart(ends, 6, count)
}

fn apart(ends: &[Material], together: usize, count: usize) -> Vec<Vec<Material>> {
    let distance = ends.len() / together;
    let starts = (0..distance).step_by(distance.div_ceil(count).max(1));
    starts.map(|start| (0..together).map(|k| ends[start + k * distance].clone()).collect()).collect()
}
