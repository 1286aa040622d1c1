//! A place on the surface that a picture shows: which directions meet there.

use glam::Vec3;

use super::{Model, Surface};
use crate::Directions;

/// A place on a surface, with its shading frame.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    model: &'a Model,
    surface: Surface,
}

impl<'a> Place<'a> {
    /// What a whole picture shows at \[across, up\] in −1..1; none beside the surface.
    pub fn on(model: &'a Model, [across, up]: [f32; 2]) -> Option<Self> {
        Some(Self { model, surface: model.surface([across.into(), up.into()])? })
    }

    /// Light from a direction (unit vector in view space, as [`Lamp`](super::Lamp)) and the view, in the shading frame.
    pub fn under(&self, direction: Vec3) -> Directions {
        let light = self.surface.to_view().transpose() * direction.as_dvec3();
        Directions::new(light.as_vec3(), self.view())
    }

    /// Whether light from a direction reaches it: a mesh may be in its own light.
    pub fn is_open(&self, direction: Vec3) -> bool {
        self.model.is_open(&self.surface, direction.as_dvec3())
    }

    /// Light from where a mirror would show it, and the view.
    pub fn mirrored(&self) -> Directions {
        let view = self.view();
        Directions::new(Vec3::new(-view.x, -view.y, view.z), view)
    }

    fn view(&self) -> Vec3 {
        (self.surface.to_view().transpose() * self.surface.view).as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{Brdf as _, ggx::Ggx};
    use std::sync::Arc;

    use crate::render::{Frame, Light, Sphere, Surfaces};
    use crate::scene::Mesh;
    use crate::{Image, Rgb};

    #[test]
    fn what_is_seen_at_a_place_is_what_its_pixel_shows() {
        let glossy = Ggx { diffuse: Rgb([0.2, 0.1, 0.0]), f0: Rgb::splat(0.04), alpha: 0.2 };
        let (size, light) = (33, Light::studio());
        for model in [Model::Sphere, Model::Plane, Model::Mesh(Arc::new(Mesh::knot()))] {
            let surfaces = Arc::new(Surfaces::new(size, &model, Frame::WHOLE));
            let image: Image = Sphere::of(surfaces, &light).render(&glossy);
            for (x, y) in [(16, 16), (20, 9), (5, 24), (10, 14)] {
                let across = |pixel: usize| (2 * pixel + 1) as f32 / size as f32 - 1.0;
                let pixel = image.get(x, y);
                let Some(place) = Place::on(&model, [across(x), -across(y)]) else {
                    assert_eq!(pixel, Rgb::BLACK);
                    continue;
                };
                let lit = light.lamps.iter().filter(|lamp| place.is_open(lamp.direction)).map(|lamp| {
                    let at = place.under(lamp.direction);
                    glossy.eval(at) * lamp.irradiance * at.light.z.max(0.0)
                });
                let sum = lit.fold(Rgb::BLACK, |sum, term| sum + term);
                assert!(sum.zip(pixel, |a, b| (a - b).abs()).max() < 1e-4 * pixel.max().max(1e-3), "{sum:?} {pixel:?}");
            }
        }
        assert!(Place::on(&Model::Sphere, [0.9, 0.9]).is_none());
    }

    #[test]
    fn a_mirror_sends_the_view_as_far_to_the_other_side() {
        let at = Place::on(&Model::Sphere, [0.4, -0.3]).unwrap().mirrored();
        assert!((at.light.z - at.view.z).abs() < 1e-6);
        assert!(at.rusinkiewicz().theta_half < 1e-3);
    }
}
