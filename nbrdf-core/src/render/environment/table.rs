//! Drawing pixels in proportion to their weights: first a row by the sums of rows, then a pixel of that row.

/// Running sums over rows, and over the pixels of each row; f64, so that a sun does not swallow the sky.
#[derive(Debug)]
pub(super) struct Table {
    width: usize,
    /// Sum of the rows up to and including each.
    rows: Vec<f64>,
    /// Of each row, sum of the pixels up to and including each.
    pixels: Vec<f64>,
}

/// A pixel, and a place in it, uniform in \[0, 1)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drawn {
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) within: [f64; 2],
}

impl Table {
    /// Pixel (x, y) weighs `weight(x, y) * row(y)`: finite, not negative, and not zero everywhere.
    pub(super) fn new(
        width: usize,
        height: usize,
        weight: impl Fn(usize, usize) -> f64,
        row: impl Fn(usize) -> f64,
    ) -> Self {
        let mut table = Self { width, rows: Vec::with_capacity(height), pixels: Vec::with_capacity(width * height) };
        let mut total = 0.0;
        for y in 0..height {
            let mut sum = 0.0;
            for x in 0..width {
                sum += weight(x, y);
                table.pixels.push(sum);
            }
            total += sum * row(y);
            table.rows.push(total);
        }
        table
    }

    /// A pixel and a place in it from `u`, uniform in \[0, 1)²; pixels without weight are never drawn.
    pub(super) fn draw(&self, u: [f64; 2]) -> Drawn {
        let (y, v) = invert(&self.rows, u[1]);
        let (x, u) = invert(&self.pixels[y * self.width..(y + 1) * self.width], u[0]);
        Drawn { x, y, within: [u, v] }
    }
}

/// The step of the running `sums` that holds the share `u` of their total, and how far into it.
fn invert(sums: &[f64], u: f64) -> (usize, f64) {
    let total = sums[sums.len() - 1];
    // Below the total, also after rounding: the first sum above it is then one that has risen.
    let target = (u * total).min(total.next_down());
    let step = sums.partition_point(|&sum| sum <= target).min(sums.len() - 1);
    let before = if step == 0 { 0.0 } else { sums[step - 1] };
    (step, ((target - before) / (sums[step] - before)).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_without_weight_are_never_drawn() {
        let sums = [0.0, 0.0, 1.0, 1.0, 4.0, 4.0];
        assert_eq!(invert(&sums, 0.0), (2, 0.0));
        assert_eq!(invert(&sums, 0.125), (2, 0.5));
        assert_eq!(invert(&sums, 0.25), (4, 0.0));
        assert_eq!(invert(&sums, 1.0_f64.next_down()).0, 4);
    }

    #[test]
    fn a_pixel_is_drawn_as_often_as_it_weighs() {
        let table = Table::new(2, 2, |x, y| [[1.0, 0.0], [2.0, 6.0]][y][x], |y| [4.0, 0.5][y]);
        let n = 64;
        let mut counts = [[0; 2]; 2];
        for i in 0..n * n {
            let drawn = table.draw([(i % n) as f64 / n as f64, (i / n) as f64 / n as f64]);
            counts[drawn.y][drawn.x] += 1;
        }
        assert_eq!(counts, [[2048, 0], [512, 1536]]);
    }
}
