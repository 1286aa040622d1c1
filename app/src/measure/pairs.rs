//! Pairs of materials whose paths and middles are judged.

/// Distance of the second end in the sorted names (PROTOCOL of this project, "Interpolation quality").
const OFFSET: usize = 37;

/// (i, i + 37) of `count` materials sorted by name, cyclically; none is paired with itself.
pub fn standard_pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).map(move |i| (i, (i + OFFSET) % count)).filter(|(i, j)| i != j)
}
