//! How far a model is from its material in the picture.

use std::sync::OnceLock;

use crate::metric::{Seen, flip_of_colors};
use crate::scene::{Demand, View};
use crate::{Brdf, Image, Rgb};

/// Pixels of an object that are looked at first.
const FIRST_PIXELS: usize = 256;
/// Objects of fewer pixels are looked at in whole: that is as quick.
const SMALL: usize = 1024;

/// The picture of the materials themselves, and what it takes to compare others with it.
pub(super) struct Judge<'a> {
    view: &'a View,
    gain: f32,
    /// Radiance of every object's pixels.
    radiances: Vec<Vec<Rgb>>,
    reference: Image,
    seen: Seen,
    objects: Vec<OnceLock<Seat>>,
}

/// An object's place in the picture.
struct Seat {
    /// Pixels that are compared.
    pixels: Vec<usize>,
    /// The part of the picture that these depend on.
    crop: Crop,
    seen: Seen,
    /// Some pixels with all that they ask for, and their places among the object's.
    some: (Demand, Vec<usize>),
}

/// A rectangle of the picture.
#[derive(Clone, Copy)]
struct Crop {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl<'a> Judge<'a> {
    /// Looks at the objects' own materials.
    pub fn new(view: &'a View, own: &[&dyn Brdf]) -> Self {
        let gain = (view.picture().exposure as f32).exp2();
        let radiances: Vec<Vec<Rgb>> = view.demands().iter().zip(own).map(|(d, brdf)| d.radiance(*brdf)).collect();
        let reference = view.image(&radiances);
        let seen = Seen::new(&shown(&reference, gain));
        let objects = own.iter().map(|_| OnceLock::new()).collect();
        Self { view, gain, radiances, seen, reference, objects }
    }

    /// An object's place, found when it is first asked for.
    fn seat(&self, object: usize) -> &Seat {
        self.objects[object].get_or_init(|| {
            let pixels = self.view.pixels_of(object);
            let crop = Crop::around(&pixels, &self.reference);
            let seen = Seen::new(&shown(&crop.of(&self.reference), self.gain));
            Seat { pixels, crop, seen, some: self.view.demands()[object].some(FIRST_PIXELS) }
        })
    }

    pub const fn view(&self) -> &View {
        self.view
    }

    pub const fn reference(&self) -> &Image {
        &self.reference
    }

    /// How many pixels an object's error is the mean of.
    pub fn pixels(&self, object: usize) -> usize {
        self.seat(object).pixels.len()
    }

    /// The error to expect of a model by some of the pixels, colour by colour; none where all are as quick.
    pub fn estimate(&self, object: usize, brdf: &dyn Brdf) -> Option<f64> {
        let Seat { pixels, some: (demand, places), .. } = self.seat(object);
        if pixels.len() < SMALL {
            return None;
        }
        let radiance = demand.radiance(brdf);
        let error = |((pixel, place), new): ((usize, &usize), &Rgb)| {
            let whole = self.reference.pixels()[pixel];
            let changed = changed(whole, self.radiances[object][*place], *new);
            flip_of_colors(displayed(whole * self.gain), displayed(changed * self.gain))
        };
        let errors = demand.pixels().zip(places).zip(&radiance).map(error);
        Some(errors.sum::<f64>() / radiance.len().max(1) as f64)
    }

    /// Mean FLIP on the object's pixels, all others being themselves.
    pub fn error(&self, object: usize, brdf: &dyn Brdf) -> f64 {
        let part = shown(&self.part(object, brdf), self.gain);
        self.on_pixels(object, &self.seat(object).seen.flip_map(&Seen::new(&part)))
    }

    /// Mean FLIP on the object's pixels between two models, all others being themselves.
    pub fn between(&self, object: usize, one: &dyn Brdf, other: &dyn Brdf) -> f64 {
        let [one, other] = [one, other].map(|brdf| Seen::new(&shown(&self.part(object, brdf), self.gain)));
        self.on_pixels(object, &one.flip_map(&other))
    }

    /// Whether FLIP of one object sees the pixels of another.
    pub fn touch(&self, object: usize, other: usize) -> bool {
        let width = self.reference.width();
        self.view.demands()[other].pixels().any(|pixel| self.seat(object).crop.place(pixel, width).is_some())
    }

    /// The part of the picture around an object, of this model.
    fn part(&self, object: usize, brdf: &dyn Brdf) -> Image {
        let Seat { crop, .. } = self.seat(object);
        let demand = &self.view.demands()[object];
        let mut part = crop.of(&self.reference);
        let radiance = demand.radiance(brdf);
        for ((pixel, own), new) in demand.pixels().zip(&self.radiances[object]).zip(&radiance) {
            if let Some(place) = crop.place(pixel, self.reference.width()) {
                let whole = &mut part.pixels_mut()[place];
                *whole = changed(*whole, *own, *new);
            }
        }
        part
    }

    /// The mean over an object's pixels of what was found in its part of the picture.
    fn on_pixels(&self, object: usize, map: &[f32]) -> f64 {
        let Seat { pixels, crop, .. } = self.seat(object);
        mean(pixels.iter().filter_map(|&pixel| crop.place(pixel, self.reference.width())).map(|place| map[place]))
    }

    /// The picture of these models, and every object's mean FLIP in it.
    pub fn together(&self, models: &[&dyn Brdf]) -> (Image, Vec<f64>) {
        let radiances: Vec<Vec<Rgb>> =
            self.view.demands().iter().zip(models).map(|(demand, brdf)| demand.radiance(*brdf)).collect();
        let image = self.view.image(&radiances);
        let map = self.seen.flip_map(&Seen::new(&shown(&image, self.gain)));
        let error = |object: usize| mean(self.seat(object).pixels.iter().map(|&pixel| map[pixel]));
        let errors = (0..models.len()).map(error).collect();
        (image, errors)
    }
}

impl Crop {
    /// Around some pixels, as far as FLIP looks.
    fn around(pixels: &[usize], image: &Image) -> Self {
        let span = |places: &mut dyn Iterator<Item = usize>, size: usize| {
            let (low, high) = places.fold((size, 0), |(low, high), place| (low.min(place), high.max(place + 1)));
            let low = low.saturating_sub(Seen::REACH);
            (low, (high + Seen::REACH).min(size).saturating_sub(low))
        };
        let (left, width) = span(&mut pixels.iter().map(|pixel| pixel % image.width()), image.width());
        let (top, height) = span(&mut pixels.iter().map(|pixel| pixel / image.width()), image.height());
        Self { left, top, width, height }
    }

    fn of(&self, image: &Image) -> Image {
        let row = |y: usize| {
            let start = (self.top + y) * image.width() + self.left;
            image.pixels()[start..start + self.width].iter().copied()
        };
        Image::new(self.width, self.height, (0..self.height).flat_map(row).collect())
    }

    /// The place of the picture's pixel in the part.
    fn place(&self, pixel: usize, width: usize) -> Option<usize> {
        let (x, y) = ((pixel % width).checked_sub(self.left)?, (pixel / width).checked_sub(self.top)?);
        (x < self.width && y < self.height).then(|| y * self.width + x)
    }
}

/// A pixel's radiance when an object's share of it changes; the same to the bit where it does not.
fn changed(whole: Rgb, own: Rgb, new: Rgb) -> Rgb {
    whole + new.zip(own, |new, own| new - own)
}

fn shown(image: &Image, gain: f32) -> Image {
    let mut shown = Image::default();
    image.displayed_into(gain, &mut shown);
    shown
}

fn displayed(linear: Rgb) -> Rgb {
    linear.map(|v| crate::image::clipped(v).powf(crate::image::DISPLAY_GAMMA.recip()))
}

fn mean(values: impl Iterator<Item = f32>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), v| (sum + f64::from(v), count + 1));
    sum / count.max(1) as f64
}
