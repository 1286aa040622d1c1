//! Spheres along a walk: for looking at, or for computing with.

use std::path::Path;

use nbrdf_core::render::Sphere;
use nbrdf_core::{Brdf, Image};

use super::Blend;
use crate::strip::{Cell, ground};

pub(super) enum Painter {
    Cell(Cell, f32),
    Exact(Sphere, f32),
}

impl Painter {
    pub fn new(blend: &Blend) -> Self {
        let (size, light, gain) = (usize::from(blend.size), blend.light.light(), blend.exposure.exp2());
        match is_exr(&blend.output) {
            true => Self::Exact(Sphere::new(size, &light), gain),
            false => Self::Cell(Cell::new(size, &light), gain),
        }
    }

    pub fn draw(&self, brdf: &dyn Brdf) -> Image {
        match self {
            Self::Cell(cell, gain) => cell.draw(brdf, *gain, ground()),
            Self::Exact(sphere, gain) => sphere.render(brdf).map(|pixel| pixel * *gain),
        }
    }
}

pub(super) fn is_exr(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "exr")
}
