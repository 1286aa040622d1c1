//! A sphere of a material under directional lights; or a plane, or a mesh ([`Model`]), in whole or in part ([`Frame`]).
//!
//! Orthographic view along +z, y up, the sphere's radius 0.99 of half the image; L = Σ f_r E cos θ_i over the lamps,
//! no interreflection; only meshes cast shadows, on themselves. The shading frame follows the globe: tangent to the east
//! (y × n), bitangent north. Isotropic materials do not see it; brushed ones show their grooves along the latitudes.
//!
//! Under an [`Environment`] the same surface is a [`Progressive`] picture.

pub mod environment;
mod frame;
mod light;
mod model;
mod place;
mod progressive;
mod scrub;
pub(crate) mod sequence;
mod surface;

use std::cell::Cell;
use std::sync::{Arc, OnceLock};

pub use environment::Environment;
pub use frame::{Frame, MAX_ZOOM};
use glam::DVec3;
pub use light::{Lamp, Light};
pub use model::Model;
pub use place::Place;
pub use progressive::Progressive;
use rayon::prelude::*;
pub use scrub::Scrub;
pub use surface::{Surface, Surfaces};

use crate::brdf::Prepared;
use crate::{Brdf, Directions, Image, Rgb};

/// Pixels per side of the sphere in all metrics.
pub const METRIC_SIZE: usize = 128;
/// Up to this many pixels times lamps the geometry is kept (some 60 MB); beyond, each render derives it again row by row.
const KEPT_PAIRS: usize = 1 << 20;
/// Bytes of the shadows that a mesh casts on itself, which take rays to derive: up to so many are kept beyond that, too.
const KEPT_SHADOWS: usize = 32 << 20;

/// The geometry of one picture, ready for any number of materials; of a sphere, unless it is [of](Self::of) another
/// surface.
#[derive(Clone, Debug)]
pub struct Sphere {
    surfaces: Arc<Surfaces>,
    light: Light,
    covered: Vec<bool>,
    rows: Vec<Row>,
    /// Where rows are not kept, which lamps each pixel of a mesh sees; empty where that is not kept either.
    shadows: Vec<Seen>,
}

/// Which of the first lamps a pixel sees, one bit each.
type Seen = u32;

/// What one row of pixels asks of a material.
#[derive(Clone, Debug, Default)]
struct Row {
    /// Column of each covered pixel, and how many entries of `at` belong to it.
    pixels: Vec<(usize, usize)>,
    /// Lit pairs, in the frame of their pixel.
    at: Prepared,
    /// E cos θ_i of each pair.
    weights: Vec<Rgb>,
}

impl Sphere {
    /// A picture of `size` × `size` pixels under `light`.
    pub fn new(size: usize, light: &Light) -> Self {
        Self::of(Arc::new(Surfaces::sphere(size)), light)
    }

    /// A picture of any surface under `light`.
    pub fn of(surfaces: Arc<Surfaces>, light: &Light) -> Self {
        let found = Self::unless(&|| false, Arc::clone(&surfaces), light);
        found.unwrap_or_else(|| Self::with((Vec::new(), Vec::new()), surfaces, light))
    }

    /// As [`of`](Self::of); none as soon as `stops`, which is asked before every row.
    pub fn unless(stops: &(dyn Fn() -> bool + Sync), surfaces: Arc<Surfaces>, light: &Light) -> Option<Self> {
        let (size, lamps) = (surfaces.size(), light.lamps.len());
        let is_shadowed = matches!(surfaces.model(), Model::Mesh(_)) && lamps <= Seen::BITS as usize;
        let (mut rows, mut shadows) = (Vec::new(), Vec::new());
        if size * size * lamps <= KEPT_PAIRS {
            let row = |y| (!stops()).then(|| Row::new(&surfaces, y, light, None));
            rows = (0..size).into_par_iter().map(row).collect::<Option<_>>()?;
        } else if is_shadowed && size * size * size_of::<Seen>() <= KEPT_SHADOWS {
            let row = |y| (!stops()).then(|| (0..size).map(|x| seen(&surfaces, (x, y), light)).collect());
            let rows: Vec<Vec<Seen>> = (0..size).into_par_iter().map(row).collect::<Option<_>>()?;
            shadows = rows.concat();
        }
        Some(Self::with((rows, shadows), surfaces, light))
    }

    fn with((rows, shadows): (Vec<Row>, Vec<Seen>), surfaces: Arc<Surfaces>, light: &Light) -> Self {
        Self { covered: surfaces.covered(), rows, shadows, light: light.clone(), surfaces }
    }

    /// At the size of the metrics under light `point`; made once.
    pub fn point() -> &'static Self {
        static SPHERE: OnceLock<Sphere> = OnceLock::new();
        SPHERE.get_or_init(|| Self::new(METRIC_SIZE, &Light::point()))
    }

    /// At the size of the metrics under light `studio`; made once.
    pub fn studio() -> &'static Self {
        static SPHERE: OnceLock<Sphere> = OnceLock::new();
        SPHERE.get_or_init(|| Self::new(METRIC_SIZE, &Light::studio()))
    }

    /// Pixels per side.
    pub fn size(&self) -> usize {
        self.surfaces.size()
    }

    /// What its pixels see.
    pub const fn surfaces(&self) -> &Arc<Surfaces> {
        &self.surfaces
    }

    /// The light it stands in.
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// For each pixel, row by row from the top left, whether its centre is on the surface.
    pub fn covered(&self) -> &[bool] {
        &self.covered
    }

    /// The linear picture, black beside the surface; exposure is left to whoever shows it.
    ///
    /// Rows are shaded in parallel; the result does not depend on the number of threads.
    pub fn render(&self, brdf: &dyn Brdf) -> Image {
        let mut image = Image::black(self.size(), self.size());
        self.render_into(brdf, &mut image);
        image
    }

    /// As [`render`](Self::render), over an earlier picture; allocates nothing where the geometry is kept.
    ///
    /// # Panics
    /// If the image is not of this [`size`](Self::size) (a bug of the caller).
    pub fn render_into(&self, brdf: &dyn Brdf, image: &mut Image) {
        self.render_into_unless(&|| false, brdf, image);
    }

    /// As [`render_into`](Self::render_into); gives up as soon as `stops`, which is asked before every row. Whether the
    /// picture is whole.
    ///
    /// # Panics
    /// As [`render_into`](Self::render_into).
    pub fn render_into_unless(&self, stops: &(dyn Fn() -> bool + Sync), brdf: &dyn Brdf, image: &mut Image) -> bool {
        let size = self.size();
        assert_eq!((image.width(), image.height()), (size, size), "a picture of the sphere's size");
        let rows = image.pixels_mut().par_chunks_mut(size.max(1)).enumerate();
        let shaded = rows.map(|(y, out)| {
            if stops() {
                return None;
            }
            match self.rows.get(y) {
                Some(row) => row.shade(brdf, out),
                None => {
                    let shadows = self.shadows.get(y * size..(y + 1) * size);
                    Row::new(&self.surfaces, y, &self.light, shadows).shade(brdf, out);
                }
            }
            Some(())
        });
        shaded.collect::<Option<()>>().is_some()
    }
}

/// The covered pixels of a sphere as sums over pairs, for those who need more than a picture.
pub(crate) struct Lit {
    /// Lit pairs of each covered pixel.
    pub lamps: Vec<usize>,
    /// E cos θ_i of each pair.
    pub weights: Vec<Rgb>,
}

impl Lit {
    /// The pairs in the order of the pixels, and what they are weighted with.
    pub fn new(size: usize, light: &Light) -> (Prepared, Self) {
        let (mut lamps, mut at, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        let surfaces = Surfaces::sphere(size);
        for pixel in 0..size * size {
            if let Some(surface) = surfaces.at(pixel % size, pixel / size) {
                let before = at.len();
                light_up(&surfaces, surface, light, None, (&mut at, &mut weights));
                lamps.push(at.len() - before);
            }
        }
        (Prepared::new(at), Self { lamps, weights })
    }
}

thread_local! {
    /// Each thread's reflectances of one row.
    static VALUES: Cell<Vec<Rgb>> = const { Cell::new(Vec::new()) };
}

impl Row {
    /// Traces shadows, unless it is known what each pixel sees.
    fn new(surfaces: &Surfaces, y: usize, light: &Light, shadows: Option<&[Seen]>) -> Self {
        let (mut pixels, mut at, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        for x in 0..surfaces.size() {
            if let Some(surface) = surfaces.at(x, y) {
                let before = at.len();
                light_up(surfaces, surface, light, shadows.map(|seen| seen[x]), (&mut at, &mut weights));
                pixels.push((x, at.len() - before));
            }
        }
        Self { pixels, at: Prepared::new(at), weights }
    }

    fn shade(&self, brdf: &dyn Brdf, out: &mut [Rgb]) {
        out.fill(Rgb::BLACK);
        // Taken out, not borrowed: whatever the material does on this thread, nobody else holds them.
        let mut values = VALUES.take();
        values.resize(self.at.len(), Rgb::BLACK);
        brdf.eval_prepared(&self.at, &mut values);
        let mut terms = values.iter().zip(&self.weights);
        for &(x, lamps) in &self.pixels {
            let mut radiance = [0.0_f64; 3];
            for (value, weight) in terms.by_ref().take(lamps) {
                for (channel, sum) in radiance.iter_mut().enumerate() {
                    *sum += f64::from(value[channel]) * f64::from(weight[channel]);
                }
            }
            out[x] = Rgb(radiance.map(|sum| sum as f32));
        }
        VALUES.set(values);
    }
}

/// Which lamps shine on the front of what a pixel sees, and are not hidden from it.
fn seen(surfaces: &Surfaces, (x, y): (usize, usize), light: &Light) -> Seen {
    let Some(surface) = surfaces.at(x, y) else { return 0 };
    let to_surface = surface.to_view().transpose();
    let view = (to_surface * surface.view).as_vec3();
    let is_lit = |direction: DVec3| Directions::new((to_surface * direction).as_vec3(), view).is_above();
    let bits = light.lamps.iter().enumerate().map(|(lamp, own)| {
        let direction = own.direction.as_dvec3();
        Seen::from(is_lit(direction) && surfaces.is_open(&surface, direction)) << lamp
    });
    bits.sum()
}

/// Adds the pairs of one pixel: one for each lamp that shines on the front of its surface. Rays tell which are hidden,
/// unless it is known what the pixel sees.
fn light_up(
    surfaces: &Surfaces,
    surface: Surface,
    light: &Light,
    seen: Option<Seen>,
    (at, weights): (&mut Vec<Directions>, &mut Vec<Rgb>),
) {
    let to_surface = surface.to_view().transpose();
    let view = (to_surface * surface.view).as_vec3();
    for (place, lamp) in light.lamps.iter().enumerate() {
        let direction = lamp.direction.as_dvec3();
        let pair = Directions::new((to_surface * direction).as_vec3(), view);
        let is_open = || seen.map_or_else(|| surfaces.is_open(&surface, direction), |seen| (seen >> place) & 1 == 1);
        if pair.is_above() && is_open() {
            at.push(pair);
            weights.push(lamp.irradiance * pair.light.z);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Vec3,
        brdf::{ggx::Ggx, lambert::Lambert},
        scene::Mesh,
    };

    const WHITE: Lambert = Lambert { albedo: Rgb::splat(1.0) };
    const GLOSSY: Ggx = Ggx { diffuse: Rgb([0.2, 0.1, 0.0]), f0: Rgb::splat(0.04), alpha: 0.2 };

    #[test]
    fn nothing_is_left_of_an_earlier_picture() {
        let sphere = Sphere::new(17, &Light::point());
        let mut image = Image::new(17, 17, vec![Rgb::splat(9.0); 17 * 17]);
        sphere.render_into(&GLOSSY, &mut image);
        assert_eq!(image, sphere.render(&GLOSSY));
    }

    #[test]
    fn white_facing_the_point_light_shows_one() {
        let image = Sphere::point().render(&WHITE);
        let brightest = image.pixels().iter().map(|pixel| pixel[1]).fold(0.0, f32::max);
        assert!((brightest - 1.0).abs() < 2e-4, "{brightest}");
    }

    #[test]
    fn lambert_shows_the_cosine_of_light_and_normal() {
        let sphere = Sphere::new(9, &Light::directional(Vec3::new(0.0, 2.0, 0.0)));
        let image = sphere.render(&WHITE);
        assert!((image.get(4, 2)[0] - (4.0 / 9.0) / 0.99).abs() < 1e-6, "two pixels above the centre");
        assert_eq!(image.get(4, 6), Rgb::BLACK, "the lower half is in the dark");
    }

    #[test]
    fn the_disc_covers_its_share_of_the_image() {
        let share = Sphere::point().covered().iter().filter(|&&on| on).count() as f64 / (128.0 * 128.0);
        assert!((share - std::f64::consts::PI / 4.0 * 0.99 * 0.99).abs() < 2e-3);
    }

    #[test]
    fn light_from_the_left_mirrors_light_from_the_right() {
        let from = |x: f32| Sphere::new(32, &Light::directional(Vec3::new(x, 0.3, 0.5))).render(&GLOSSY);
        let (left, right) = (from(-0.7), from(0.7));
        for y in 0..32 {
            for x in 0..32 {
                assert!((left.get(x, y)[0] - right.get(31 - x, y)[0]).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn the_number_of_threads_does_not_change_a_bit() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Sphere::studio().render(&GLOSSY))
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn large_pictures_do_not_keep_their_geometry_and_are_no_different() {
        let kept = Sphere::new(256, &Light::studio());
        let derived = Sphere { rows: Vec::new(), ..kept.clone() };
        assert!(!kept.rows.is_empty() && Sphere::new(1025, &Light::point()).rows.is_empty());
        assert_eq!(kept.render(&GLOSSY), derived.render(&GLOSSY));
    }

    #[test]
    fn kept_shadows_of_a_mesh_change_no_bit() {
        let knot = Model::Mesh(Arc::new(Mesh::knot()));
        let light = Light::studio();
        let sphere = Sphere::of(Arc::new(Surfaces::new(312, &knot, Frame::WHOLE)), &light);
        assert!(sphere.rows.is_empty() && sphere.shadows.len() == 312 * 312);
        let traced = Sphere { shadows: Vec::new(), ..sphere.clone() };
        assert_eq!(sphere.render(&GLOSSY), traced.render(&GLOSSY));
    }

    #[test]
    fn a_picture_that_is_stopped_is_not_whole() {
        let mut image = Image::black(128, 128);
        assert!(!Sphere::point().render_into_unless(&|| true, &WHITE, &mut image));
        assert_eq!(image, Image::black(128, 128));
        assert!(Sphere::point().render_into_unless(&|| false, &WHITE, &mut image));
        assert_eq!(image, Sphere::point().render(&WHITE));
    }

    #[test]
    fn a_mesh_of_a_ball_shows_what_a_ball_shows() {
        let ball = Model::Mesh(Arc::new(Mesh::of_obj(&ball()).unwrap()));
        let picture = Sphere::of(Arc::new(Surfaces::new(48, &ball, Frame::WHOLE)), &Light::point()).render(&WHITE);
        let expected = Sphere::new(48, &Light::point()).render(&WHITE);
        // Seen from nearer, the rim is another.
        for (x, y) in [(24, 24), (30, 24), (24, 16), (20, 30)] {
            let (found, expected) = (picture.get(x, y)[0], expected.get(x, y)[0]);
            assert!((found - expected).abs() < 0.06, "{x} {y}: {found} {expected}");
        }
    }

    /// A ball in OBJ, of rings around the y axis.
    fn ball() -> Vec<u8> {
        let (rings, around) = (40_usize, 80_usize);
        let mut text = String::new();
        for (ring, step) in (0..=rings).flat_map(|ring| (0..around).map(move |step| (ring, step))) {
            let (polar, azimuth) = (ring as f64 / rings as f64, 2.0 * step as f64 / around as f64);
            let ((s, c), (sin, cos)) =
                ((polar * std::f64::consts::PI).sin_cos(), (azimuth * std::f64::consts::PI).sin_cos());
            text += &format!("v {} {c} {}\n", s * sin, s * cos);
        }
        for (ring, step) in (0..rings).flat_map(|ring| (0..around).map(move |step| (ring, step))) {
            let at = |ring: usize, step: usize| ring * around + step % around + 1;
            let corners = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
            text += &format!("f {} {} {} {}\n", corners[0], corners[1], corners[2], corners[3]);
        }
        text.into_bytes()
    }

    #[test]
    fn every_model_is_lit_and_stops_when_told() {
        for model in [Model::Plane, Model::Mesh(Arc::new(Mesh::knot()))] {
            let surfaces = Arc::new(Surfaces::new(24, &model, Frame::WHOLE));
            let sphere = Sphere::of(Arc::clone(&surfaces), &Light::studio());
            let image = sphere.render(&GLOSSY);
            let lit = image.pixels().iter().zip(sphere.covered()).filter(|(pixel, _)| pixel.max() > 0.0);
            assert!(lit.clone().count() > 100 && lit.clone().all(|(pixel, &on)| on && pixel.is_finite()), "{model:?}");
            assert!(Sphere::unless(&|| true, surfaces, &Light::studio()).is_none());
        }
    }
}
