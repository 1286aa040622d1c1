//! What the pixels of a picture see.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::model::RADIUS;
use super::{Frame, Model};

/// Up to this many pixels what they see of a mesh is kept (some 100 MB); beyond, it is found again row by row.
const KEPT_PIXELS: usize = 1 << 20;
/// Rays across a pixel's neighbourhood where a mesh begins.
const ACROSS: usize = 4;

/// What one pixel sees: unit vectors in view space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// To shade with, on the viewer's side.
    pub normal: DVec3,
    /// Towards the viewer.
    pub view: DVec3,
    /// Of the surface itself.
    pub(super) geometric: DVec3,
    /// Where rays leave a mesh, in its own space.
    pub(super) place: DVec3,
}

impl Surface {
    /// Of what shadows nothing.
    pub(super) const fn lone(normal: DVec3, view: DVec3) -> Self {
        Self { normal, view, geometric: normal, place: DVec3::ZERO }
    }

    /// The shading frame as columns: east, north, out. From the surface to view space; its transpose leads back.
    pub(super) fn to_view(self) -> DMat3 {
        // At the poles every direction is as good as east.
        let tangent = DVec3::Y.cross(self.normal).try_normalize().unwrap_or(DVec3::X);
        DMat3::from_cols(tangent, self.normal.cross(tangent), self.normal)
    }
}

/// What all pixels of a square picture see of a [`Model`]; light and materials come later.
#[derive(Clone, Debug)]
pub struct Surfaces {
    size: usize,
    model: Model,
    frame: Frame,
    /// Row by row where it takes rays to find them, else empty.
    kept: Vec<Option<Surface>>,
}

impl Surfaces {
    /// `size` × `size` pixels of that part of the picture.
    pub fn new(size: usize, model: &Model, frame: Frame) -> Self {
        let found = Self::unless(&|| false, size, model, frame);
        found.unwrap_or_else(|| Self { size, model: model.clone(), frame, kept: Vec::new() })
    }

    /// The whole sphere.
    pub fn sphere(size: usize) -> Self {
        Self::new(size, &Model::Sphere, Frame::WHOLE)
    }

    /// As [`new`](Self::new); none as soon as `stops`, which is asked before every row.
    pub fn unless(stops: &(dyn Fn() -> bool + Sync), size: usize, model: &Model, frame: Frame) -> Option<Self> {
        let mut found = Self { size, model: model.clone(), frame: frame.within(), kept: Vec::new() };
        if matches!(model, Model::Mesh(_)) && size * size <= KEPT_PIXELS {
            let row = |y| (!stops()).then(|| (0..size).map(|x| found.through(centre(x), centre(y))).collect());
            let rows: Vec<Vec<_>> = (0..size).into_par_iter().map(row).collect::<Option<_>>()?;
            found.kept = rows.concat();
        }
        Some(found)
    }

    /// Pixels per side.
    pub const fn size(&self) -> usize {
        self.size
    }

    /// What is seen.
    pub const fn model(&self) -> &Model {
        &self.model
    }

    /// Which part of the picture.
    pub const fn frame(&self) -> Frame {
        self.frame
    }

    /// What the centre of a pixel sees, in column `x` from the left and row `y` from the top.
    pub fn at(&self, x: usize, y: usize) -> Option<Surface> {
        match self.kept.get(y * self.size + x) {
            Some(kept) => *kept,
            None => self.through(centre(x), centre(y)),
        }
    }

    /// What any place sees, in pixels from the left and from the top.
    pub fn through(&self, x: f64, y: f64) -> Option<Surface> {
        let across = |pixels: f64| 2.0 * pixels / self.size as f64 - 1.0;
        // Downwards until the end: the sphere's middle row keeps the sign of its zero.
        let Frame { zoom, centre } = self.frame;
        let (x, down) = (across(x) / zoom + centre[0], across(y) / zoom - centre[1]);
        self.model.surface([x, -down])
    }

    /// Whether each pixel sees something, row by row.
    pub fn covered(&self) -> Vec<bool> {
        (0..self.size * self.size).into_par_iter().map(|i| self.at(i % self.size, i / self.size).is_some()).collect()
    }

    /// Whether light from a direction in view space reaches what is seen.
    pub(super) fn is_open(&self, surface: &Surface, direction: DVec3) -> bool {
        self.model.is_open(surface, direction)
    }

    /// How opaque each pixel is when it is put over something else, row by row, 0..1: the surface fades out over the last
    /// pixel before its rim, so that what is black beside it never shows.
    pub fn opacity(&self) -> Vec<f32> {
        let row = |y: usize| (0..self.size).map(move |x| self.opacity_at(x, y));
        let rows: Vec<Vec<f32>> = (0..self.size).into_par_iter().map(|y| row(y).collect()).collect();
        rows.concat()
    }

    fn opacity_at(&self, x: usize, y: usize) -> f32 {
        match self.model {
            Model::Sphere => {
                let middle = 0.5 * self.size as f64;
                let from = self.frame.seen_at([0.0, 0.0]);
                let (x, y) = (centre(x) - middle * (1.0 + from[0]), centre(y) - middle * (1.0 - from[1]));
                (RADIUS * middle * self.frame.zoom - x.hypot(y)).clamp(0.0, 1.0) as f32
            }
            Model::Plane => f32::from(u8::from(self.at(x, y).is_some())),
            Model::Mesh(_) if self.at(x, y).is_none() => 0.0,
            Model::Mesh(_) if self.is_surrounded(x, y) => 1.0,
            Model::Mesh(_) => {
                // Of a straight rim d pixels away, the two pixels around see (1 + d) / 2.
                let sub = |i: usize| 2.0 * (i as f64 + 0.5) / ACROSS as f64 - 1.0;
                let is_on =
                    |i: &usize| self.through(centre(x) + sub(i % ACROSS), centre(y) + sub(i / ACROSS)).is_some();
                let share = (0..ACROSS * ACROSS).filter(is_on).count() as f32 / (ACROSS * ACROSS) as f32;
                (2.0 * share - 1.0).clamp(0.0, 1.0)
            }
        }
    }

    /// Whether all neighbours see something; beyond the picture may be anything.
    fn is_surrounded(&self, x: usize, y: usize) -> bool {
        let near = |at: usize| at.saturating_sub(1)..(at + 2).min(self.size);
        near(y).all(|y| near(x).all(|x| self.at(x, y).is_some()))
    }
}

/// Of a pixel.
fn centre(pixel: usize) -> f64 {
    pixel as f64 + 0.5
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::scene::Mesh;

    fn knot() -> Model {
        Model::Mesh(Arc::new(Mesh::knot()))
    }

    #[test]
    fn a_part_shows_what_the_whole_shows_there() {
        for model in [Model::Sphere, Model::Plane, knot()] {
            let whole = Surfaces::new(32, &model, Frame::WHOLE);
            // A quarter of the picture: its pixels are half pixels of the whole.
            let part = Surfaces::new(32, &model, Frame { zoom: 2.0, centre: [0.5, 0.5] });
            for (x, y) in [(3, 5), (4, 28), (17, 30), (9, 9)] {
                let (near, same) = (part.at(x, y), whole.through(16.0 + 0.5 * centre(x), 0.5 * centre(y)));
                assert_eq!(near.is_some(), same.is_some());
                let is_near = |(a, b): (Surface, Surface)| (a.normal - b.normal).length() < 1e-9;
                assert!(near.zip(same).is_none_or(is_near), "{model:?} {x} {y}");
            }
        }
    }

    #[test]
    fn opacity_is_the_share_that_is_covered() {
        for model in [Model::Sphere, knot()] {
            let surfaces = Surfaces::new(64, &model, Frame::WHOLE);
            let opacity = surfaces.opacity();
            let seen = |i: usize| surfaces.at(i % 64, i / 64).is_some();
            assert!(opacity.iter().enumerate().all(|(i, &opacity)| opacity == 0.0 || seen(i)), "black never shows");
            let (covered, sum) = ((0..64 * 64).filter(|&i| seen(i)).count() as f32, opacity.iter().sum::<f32>());
            let partly = opacity.iter().filter(|&&opacity| opacity > 0.0 && opacity < 1.0).count();
            assert!(sum < covered && sum > 0.75 * covered && partly > 100, "{model:?}: {sum} of {covered}, {partly}");
        }
        assert!(Surfaces::new(8, &Model::Plane, Frame::WHOLE).opacity().iter().all(|&opacity| opacity == 1.0));
    }

    #[test]
    fn what_is_kept_is_what_is_found_anew() {
        let kept = Surfaces::new(24, &knot(), Frame { zoom: 1.5, centre: [0.1, 0.0] });
        let anew = Surfaces { kept: Vec::new(), ..kept.clone() };
        assert!((0..24 * 24).all(|i| kept.at(i % 24, i / 24) == anew.at(i % 24, i / 24)));
        assert!(kept.kept.iter().any(Option::is_some));
    }

    #[test]
    fn nothing_is_found_once_it_is_to_stop() {
        assert!(Surfaces::unless(&|| true, 8, &knot(), Frame::WHOLE).is_none());
    }
}
