//! Geometry that pictures share: what pixels see is found once per shape and zoom, and lit anew when lamps move.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use nbrdf_core::render::{Frame, METRIC_SIZE, Model, Sphere, Surfaces};

use super::Scenery;
use super::films::Set;

/// Sizes kept, each on the sphere of the figures or on something else.
const KEPT: usize = 6;
/// Seconds that a ray takes, to begin with.
const RAY: f64 = 2e-6;

/// What pixels see, and how opaque they are where it is shown.
#[derive(Clone)]
pub(super) struct Sight {
    pub surfaces: Arc<Surfaces>,
    pub opacity: Arc<[f32]>,
}

/// Size, and whether it is on the sphere of the figures.
type Key = (usize, bool);

/// The geometry of a few sizes.
pub(super) struct Sets {
    sights: HashMap<Key, (Frame, Sight)>,
    spheres: HashMap<Key, (Scenery, Arc<Sphere>)>,
    /// Running mean of seconds per ray of meshes.
    pace: f64,
}

impl Default for Sets {
    fn default() -> Self {
        Self { sights: HashMap::new(), spheres: HashMap::new(), pace: RAY }
    }
}

impl Sets {
    /// Seconds until the geometry is there: rays of a mesh, to its pixels and to lamps.
    pub fn expected(&self, set: Set, size: usize) -> f64 {
        let key = (size, set.is_plain());
        if !matches!(set.model, Model::Mesh(_)) || self.lit(key, set).is_some() {
            return 0.0;
        }
        let lamps = set.light.lamps.len() as f64;
        let rays = if self.known(key, set.model, set.scenery.frame).is_some() { lamps } else { lamps + 1.0 };
        rays * (size * size) as f64 * self.pace
    }

    /// What the pixels see; none where it was stopped.
    pub fn sight(
        &mut self,
        (scenery, model): (Scenery, &Model),
        size: usize,
        stops: &(dyn Fn() -> bool + Sync),
    ) -> Option<Sight> {
        let (frame, key) = (scenery.frame, (size, scenery == scenery.plain()));
        if let Some(known) = self.known(key, model, frame) {
            return Some(known);
        }
        let surfaces = Surfaces::unless(stops, size, model, frame)?;
        let sight = Sight { opacity: surfaces.opacity().into(), surfaces: Arc::new(surfaces) };
        make_room(&mut self.sights, size);
        self.sights.insert(key, (frame, sight.clone()));
        Some(sight)
    }

    /// The same under lamps.
    pub fn sphere(&mut self, set: Set, size: usize, stops: &(dyn Fn() -> bool + Sync)) -> Option<Arc<Sphere>> {
        let key = (size, set.is_plain());
        if let Some(known) = self.lit(key, set) {
            return Some(known);
        }
        let (start, expected) = (Instant::now(), self.expected(set, size));
        let sight = self.sight((set.scenery, set.model), size, stops)?;
        let sphere = Arc::new(Sphere::unless(stops, sight.surfaces, set.light)?);
        if expected > 0.0 {
            self.pace *= 0.8 + 0.2 * start.elapsed().as_secs_f64() / expected;
        }
        make_room(&mut self.spheres, size);
        self.spheres.insert(key, (set.scenery, Arc::clone(&sphere)));
        Some(sphere)
    }

    /// Forgets everything: a shape has become another.
    pub fn clear(&mut self) {
        *self = Self { pace: self.pace, ..Self::default() };
    }

    fn known(&self, key: Key, model: &Model, frame: Frame) -> Option<Sight> {
        let (own, sight) = self.sights.get(&key)?;
        (*own == frame && sight.surfaces.model() == model).then(|| sight.clone())
    }

    fn lit(&self, key: Key, set: Set) -> Option<Arc<Sphere>> {
        let (own, sphere) = self.spheres.get(&key)?;
        (*own == set.scenery && sphere.surfaces().model() == set.model).then(|| Arc::clone(sphere))
    }
}

/// For one more of this size. Of large ones, which take tens of megabytes, only one size is of use.
fn make_room<T>(kept: &mut HashMap<Key, T>, size: usize) {
    kept.retain(|(of, _), _| *of <= METRIC_SIZE || *of == size);
    if kept.len() >= KEPT {
        kept.clear();
    }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Vec3;
    use nbrdf_core::render::Light;
    use nbrdf_core::scene::Mesh;

    use super::*;
    use crate::worker::{Asset, Lighting, Shape};

    #[test]
    fn while_the_lamp_moves_what_pixels_see_stays() {
        let (mut sets, model) = (Sets::default(), Model::Mesh(Arc::new(Mesh::knot())));
        let mut sight = |direction: Vec3| {
            let scenery = Scenery { shape: Shape::Mesh(Asset::BuiltIn), ..Scenery::of(Lighting::Point(direction)) };
            let light = Light::directional(direction);
            let set = Set { scenery, light: &light, model: &model };
            let sphere = sets.sphere(set, 16, &|| false).unwrap();
            (Arc::clone(sphere.surfaces()), sets.expected(set, 16), sets.expected(set, 32) > 0.0)
        };
        let (first, cost, is_more) = sight(Vec3::Z);
        let (second, ..) = sight(Vec3::X);
        assert!(Arc::ptr_eq(&first, &second));
        assert!(cost == 0.0 && is_more, "what is there costs nothing");
    }

    #[test]
    fn a_mesh_in_the_place_of_another_is_lit_anew() {
        let (mut sets, light) = (Sets::default(), Light::studio());
        let scenery = Scenery { shape: Shape::Mesh(Asset::BuiltIn), ..Scenery::of(Lighting::Studio) };
        for _ in 0..2 {
            let model = Model::Mesh(Arc::new(Mesh::knot()));
            let sphere = sets.sphere(Set { scenery, light: &light, model: &model }, 16, &|| false).unwrap();
            assert!(*sphere.surfaces().model() == model);
        }
    }

    #[test]
    fn the_sphere_of_the_figures_is_kept_beside_what_is_shown() {
        let mut sets = Sets::default();
        let (light, stops) = (Light::point(), || false);
        let plain = Scenery::of(Lighting::Studio);
        let near = Scenery { frame: Frame { zoom: 4.0, centre: [0.0; 2] }, ..plain };
        let set = |scenery| Set { scenery, light: &light, model: &Model::Sphere };
        let figures = sets.sphere(set(plain), 16, &stops).unwrap();
        let shown = sets.sphere(set(near), 16, &stops).unwrap();
        assert!(shown.covered().iter().all(|&on| on) && !figures.covered()[0]);
        assert!(Arc::ptr_eq(&figures, &sets.sphere(set(plain), 16, &stops).unwrap()));
        assert!(sets.sphere(set(near.whole()), 17, &|| true).is_none(), "stopped");
    }
}
