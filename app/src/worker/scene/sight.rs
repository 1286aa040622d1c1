//! What is seen of a scene: pictures, and whose each pixel is.

use std::fmt;

use nbrdf_core::Image;
use nbrdf_core::scene::View;

/// An opaque picture for the display.
#[derive(Clone, PartialEq, Eq)]
pub struct Still {
    /// Pixels per row, and rows.
    pub size: [usize; 2],
    /// Red, green, blue of each pixel, row by row from the top left.
    pub rgb: Vec<u8>,
}

impl Still {
    /// A linear picture times `gain`, display encoded.
    pub(super) fn of(linear: &Image, gain: f32) -> Self {
        let mut rgb = Vec::new();
        linear.display_bytes_into(gain, &mut rgb);
        Self { size: [linear.width(), linear.height()], rgb }
    }
}

impl fmt::Debug for Still {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Still({} x {})", self.size[0], self.size[1])
    }
}

/// From a corner of a pixel to another in the same row or column, counted from the top left: x and y of both.
pub type Run = [[usize; 2]; 2];

/// What the materials themselves look like, and who is where.
#[derive(Debug)]
pub struct Sight {
    /// The picture of the materials themselves.
    pub reference: Still,
    /// Names of the objects.
    pub objects: Vec<String>,
    /// The object that each pixel shows.
    pub owners: Vec<Option<usize>>,
    /// The rim of every object.
    pub outlines: Vec<Vec<Run>>,
}

impl Sight {
    /// Of a view of objects with these names, whose own materials look like this.
    pub(super) fn new(view: &View, objects: Vec<String>, reference: Still) -> Self {
        let [width, height] = reference.size;
        let pixels: Vec<Vec<usize>> = (0..objects.len()).map(|object| view.pixels_of(object)).collect();
        let outlines = pixels.iter().map(|pixels| outline(pixels, width)).collect();
        let mut order: Vec<usize> = (0..objects.len()).collect();
        // What is too small to have a pixel for itself is found nevertheless.
        order.sort_by_key(|&object| std::cmp::Reverse(pixels[object].len()));
        let mut owners = vec![None; width * height];
        for object in order {
            pixels[object].iter().for_each(|&pixel| owners[pixel] = Some(object));
        }
        Self { reference, objects, owners, outlines }
    }
}

/// The rim of some pixels.
fn outline(pixels: &[usize], width: usize) -> Vec<Run> {
    let columns = || pixels.iter().map(|pixel| pixel % width);
    let rows = || pixels.iter().map(|pixel| pixel / width);
    let (Some(left), Some(top)) = (columns().min(), rows().min()) else { return Vec::new() };
    let wide = columns().max().unwrap_or(left) - left + 1;
    let high = rows().max().unwrap_or(top) - top + 1;
    let mut mask = vec![false; wide * high];
    columns().zip(rows()).for_each(|(x, y)| mask[(y - top) * wide + x - left] = true);
    let across = runs([wide, high], |x, y| mask[y * wide + x]);
    let down = runs([high, wide], |y, x| mask[y * wide + x]);
    let placed = |[x, y]: [usize; 2]| [x + left, y + top];
    let turned = |[y, x]: [usize; 2]| [x, y];
    across.into_iter().chain(down.into_iter().map(|run| run.map(turned))).map(|run| run.map(placed)).collect()
}

/// Horizontal parts of a rim.
fn runs([wide, high]: [usize; 2], is_in: impl Fn(usize, usize) -> bool) -> Vec<Run> {
    let mut runs = Vec::new();
    for y in 0..=high {
        let is_edge = |x: usize| (y > 0 && is_in(x, y - 1)) != (y < high && is_in(x, y));
        let mut start = None;
        for x in 0..=wide {
            match (start, x < wide && is_edge(x)) {
                (None, true) => start = Some(x),
                (Some(from), false) => {
                    runs.push([[from, y], [x, y]]);
                    start = None;
                }
                _ => {}
            }
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_of_two_pixels_side_by_side_is_a_rectangle() {
        let mut rim = outline(&[6, 7], 5);
        rim.sort_unstable();
        let expected = [[[1, 1], [1, 2]], [[1, 1], [3, 1]], [[1, 2], [3, 2]], [[3, 1], [3, 2]]];
        assert_eq!(rim, expected);
        assert!(outline(&[], 5).is_empty());
    }
}
