//! Functions of the unit square, tabulated for several values of parameters, and their warps.
//!
//! Bilinear between the corners of a patch, linear between parameters (J. Dupuy, W. Jakob, *An Adaptive Parameterization
//! for Efficient Material Acquisition and Rendering* (2018), section 4, and its supplemental code).

/// A parameter's tabulated places, rising.
pub(super) type Places = Vec<f32>;

/// Values \[parameters ..., rows, columns\].
pub(super) struct Grid {
    rows: usize,
    columns: usize,
    /// Places of every parameter, slowest first.
    parameters: Vec<Places>,
    values: Vec<f32>,
}

/// A few slices and how much each counts.
pub(super) struct Slices {
    /// Up to 2 to the number of parameters.
    list: [(usize, f32); 8],
    count: usize,
}

impl Grid {
    /// # Panics
    /// If there are not as many values as the sizes say, or more than three parameters (a bug of the caller).
    pub fn new(columns: usize, rows: usize, parameters: Vec<Places>, values: Vec<f32>) -> Self {
        let slices: usize = parameters.iter().map(Vec::len).product();
        assert!(parameters.len() <= 3 && columns >= 2 && rows >= 2 && values.len() == slices * rows * columns);
        Self { rows, columns, parameters, values }
    }

    /// Slices around these parameters, clamped to the tabulated ones.
    pub fn slices(&self, at: &[f32]) -> Slices {
        let mut slices = Slices { list: [(0, 0.0); 8], count: 1 };
        slices.list[0].1 = 1.0;
        for (places, &at) in self.parameters.iter().zip(at) {
            let (low, share) = between(places, at);
            let before = slices;
            slices = Slices { list: [(0, 0.0); 8], count: 0 };
            for &(slice, weight) in &before.list[..before.count] {
                for (place, weight) in [(low, weight * (1.0 - share)), (low + 1, weight * share)] {
                    if weight > 0.0 {
                        slices.list[slices.count] = (slice * places.len() + place, weight);
                        slices.count += 1;
                    }
                }
            }
        }
        slices
    }

    /// A number of the table.
    #[inline]
    fn number(&self, slices: &Slices, row: usize, column: usize) -> f32 {
        let index = row * self.columns + column;
        let slice = self.rows * self.columns;
        slices.list[..slices.count].iter().map(|&(place, weight)| weight * self.values[place * slice + index]).sum()
    }

    /// The four corners around a place of the unit square, \[row\]\[column\], and where between them it is.
    fn patch(&self, slices: &Slices, [x, y]: [f32; 2]) -> Patch {
        let cell = |at: f32, count: usize| {
            let at = (at * (count - 1) as f32).clamp(0.0, (count - 1) as f32);
            let low = (at as usize).min(count - 2);
            (low, at - low as f32)
        };
        let ((column, x), (row, y)) = (cell(x, self.columns), cell(y, self.rows));
        let corners = [row, row + 1].map(|row| [column, column + 1].map(|column| self.number(slices, row, column)));
        Patch { row, column, corners, x, y }
    }

    /// The interpolated value.
    pub fn eval(&self, slices: &Slices, at: [f32; 2]) -> f32 {
        self.patch(slices, at).value()
    }
}

struct Patch {
    row: usize,
    column: usize,
    corners: [[f32; 2]; 2],
    x: f32,
    y: f32,
}

impl Patch {
    fn value(&self) -> f32 {
        let [low, high] = self.columns();
        low + self.x * (high - low)
    }

    /// The left and the right column, interpolated between rows.
    fn columns(&self) -> [f32; 2] {
        [0, 1].map(|column| self.corners[0][column] + self.y * (self.corners[1][column] - self.corners[0][column]))
    }
}

/// The place at or below `at`, and the share of the way to the next.
fn between(places: &[f32], at: f32) -> (usize, f32) {
    let after = places.partition_point(|&place| place <= at);
    let Some(low) = after.checked_sub(1) else { return (0, 0.0) };
    match places.get(after) {
        Some(next) => (low, (at - places[low]) / (next - places[low])),
        // The last place, exactly.
        None => (low, 0.0),
    }
}

/// A density over the unit square and the map that makes it uniform.
pub(super) struct Warp {
    density: Grid,
    /// Integrals from the left end of every row \[..., rows, columns\].
    along_rows: Vec<f32>,
    /// Integrals of rows below \[..., rows\].
    below: Vec<f32>,
}

impl Warp {
    /// From a density of any scale; every slice is brought to the integral 1.
    pub fn new(mut density: Grid) -> Self {
        let (rows, columns) = (density.rows, density.columns);
        let mut along_rows = vec![0.0; density.values.len()];
        let mut below = Vec::with_capacity(density.values.len() / columns);
        for (values, integrals) in
            density.values.chunks_exact_mut(rows * columns).zip(along_rows.chunks_exact_mut(rows * columns))
        {
            let along = |(values, integrals): (&[f32], &mut [f32])| {
                let mut sum = 0.0f64;
                for (pair, integral) in values.windows(2).zip(&mut integrals[1..]) {
                    sum += 0.5 * f64::from(pair[0] + pair[1]);
                    *integral = sum as f32;
                }
                sum
            };
            let whole: Vec<f64> =
                values.chunks_exact(columns).zip(integrals.chunks_exact_mut(columns)).map(along).collect();
            let mut sum = 0.0f64;
            let mut rising = vec![0.0f64; rows];
            for row in 1..rows {
                sum += 0.5 * (whole[row - 1] + whole[row]);
                rising[row] = sum;
            }
            let scale = if sum > 0.0 { 1.0 / sum } else { 0.0 };
            below.extend(rising.iter().map(|v| (v * scale) as f32));
            integrals.iter_mut().chain(values).for_each(|v| *v = (f64::from(*v) * scale) as f32);
        }
        Self { density, along_rows, below }
    }

    /// Slices around these parameters.
    pub fn slices(&self, at: &[f32]) -> Slices {
        self.density.slices(at)
    }

    /// The uniform variates that the warp takes to this place, 0..1.
    pub fn invert(&self, slices: &Slices, at: [f32; 2]) -> [f32; 2] {
        let Grid { rows, columns, .. } = self.density;
        let weighted = |values: &[f32], slice: usize, index: usize| -> f32 {
            slices.list[..slices.count].iter().map(|&(place, weight)| weight * values[place * slice + index]).sum()
        };
        let patch = self.density.patch(slices, at);
        let [left, right] = patch.columns();
        let partly = patch.x * (left + 0.5 * patch.x * (right - left));
        let row_integral =
            |row: usize, column: usize| weighted(&self.along_rows, rows * columns, row * columns + column);
        let blend = |low: f32, high: f32| low + patch.y * (high - low);
        let before = blend(row_integral(patch.row, patch.column), row_integral(patch.row + 1, patch.column));
        let [low, high] = [patch.row, patch.row + 1].map(|row| row_integral(row, columns - 1));
        let whole = blend(low, high);
        let x = if whole > 0.0 { (partly + before) / whole } else { 0.0 };
        let y = patch.y * (low + 0.5 * patch.y * (high - low)) + weighted(&self.below, rows, patch.row);
        [x, y].map(|v| v.clamp(0.0, 1.0))
    }
}
