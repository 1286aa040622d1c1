//! The thread that looks at one place of all spheres: which directions meet there, and what the materials make of them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use nbrdf_core::render::{Lamp, Place};
use nbrdf_core::{Brdf, Directions, Image, Rgb};

use super::paths::Prepared;
use super::{Answer, Card, Mailbox, Office, Request, guarded};

/// A place to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Half picture widths from the middle: +x right, +y up.
    pub at: [f32; 2],
    request: Request,
}

/// What there is at a place.
#[derive(Clone, Debug)]
pub struct Point {
    /// Half picture widths from the middle: +x right, +y up.
    pub at: [f32; 2],
    /// Lamps that the surface sees, brightest first; under a map, the mirrored view alone. Empty beside the sphere.
    pub lamps: Vec<Incidence>,
    /// What every card shows, or why it shows nothing.
    pub readings: Vec<(Card, Result<Reading, String>)>,
}

/// How light meets the surface.
#[derive(Clone, Copy, Debug)]
pub struct Incidence {
    /// Which lamp of the light.
    pub lamp: usize,
    /// Light and view in the shading frame.
    pub directions: Directions,
    /// E cos θ_i; none under a map.
    pub irradiance: Option<Rgb>,
}

/// What a material makes of it.
#[derive(Clone, Debug)]
pub struct Reading {
    /// f_r \[1/sr\] under each of the lamps.
    pub values: Vec<Rgb>,
    /// Linear, before exposure; none under a map while its picture is not there.
    pub radiance: Option<Rgb>,
    /// As displayed, 0 to 255.
    pub shown: Option<[u8; 3]>,
}

/// What is asked, and the pictures under a map, which nothing but their rendering can tell.
#[derive(Default)]
pub(super) struct Points {
    letters: Mailbox<Option<Probe>>,
    images: Mutex<HashMap<Card, Image>>,
}

impl Probe {
    /// At this place of the spheres of a request.
    pub fn new(at: [f32; 2], request: &Request) -> Self {
        // Sizes do not matter here.
        Self { at, request: Request { size: 0, strip: 0, closeup: None, ..request.clone() } }
    }
}

impl Points {
    pub fn put(&self, probe: Option<Probe>) {
        self.letters.put(probe);
    }

    /// Something that was not there before is there now.
    pub fn again(&self) {
        self.letters.again();
    }

    pub fn close(&self) {
        self.letters.close();
    }

    /// A newer picture under a map.
    pub fn see(&self, card: Card, image: Image) {
        self.images().insert(card, image);
        self.again();
    }

    /// No picture is that of what is now asked for.
    pub fn forget(&self) {
        self.images().clear();
    }

    fn images(&self) -> MutexGuard<'_, HashMap<Card, Image>> {
        self.images.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Of the pixel at a place.
    fn radiance(&self, card: Card, at: [f32; 2]) -> Option<Rgb> {
        let images = self.images();
        let image = images.get(&card)?;
        let pixel = |from_left: f32, count: usize| {
            ((0.5 * (1.0 + from_left) * count as f32) as usize).min(count.saturating_sub(1))
        };
        // It may be outside of what is shown.
        let is_seen = image.width() > 0 && at.iter().all(|along| along.abs() <= 1.0);
        is_seen.then(|| image.get(pixel(at[0], image.width()), pixel(-at[1], image.height())))
    }
}

/// Answers the newest question until the mailbox closes.
pub(super) fn run(office: &Office) {
    while let Some(probe) = office.points.letters.take() {
        let Some(probe) = probe else { continue };
        let _busy = office.activity.begin();
        match guarded("The point", || look(office, &probe)) {
            Ok(point) => office.say(Answer::Point(point)),
            Err(why) => office.say(Answer::Notice(why)),
        }
    }
}

fn look(office: &Office, Probe { at, request }: &Probe) -> Point {
    let model = office.model(request.scenery.shape);
    let lamps = Place::on(&model, *at).map_or_else(Vec::new, |place| incidences(&place, request));
    let ends = (0..request.ends.len()).map(Card::End);
    let methods = request.methods.iter().copied().map(Card::Method);
    let cards = ends.chain(methods).chain(request.explored.map(|_| Card::Explored));
    let read = |card| {
        let brdf = brdf(office, card, request)?;
        guarded("Evaluation", || read(office, card, brdf.as_ref(), (*at, &lamps), request))
    };
    Point { at: *at, readings: cards.map(|card| (card, read(card))).collect(), lamps }
}

fn incidences(place: &Place, request: &Request) -> Vec<Incidence> {
    let Some(light) = request.scenery.lighting.lamps() else {
        return vec![Incidence { lamp: 0, directions: place.mirrored(), irradiance: None }];
    };
    let of = |(lamp, own): (usize, &Lamp)| {
        let directions = place.under(own.direction);
        Incidence { lamp, directions, irradiance: Some(own.irradiance * directions.light.z) }
    };
    // A mesh may be in its own light.
    let open = light.lamps.iter().enumerate().filter(|(_, own)| place.is_open(own.direction));
    let mut lamps: Vec<_> = open.map(of).filter(|lamp| lamp.directions.is_above()).collect();
    let brightness = |lamp: &Incidence| lamp.irradiance.map_or(0.0, Rgb::luminance);
    lamps.sort_by(|a, b| brightness(b).total_cmp(&brightness(a)));
    lamps
}

/// The material that a card shows.
fn brdf(office: &Office, card: Card, request: &Request) -> Result<Arc<dyn Brdf>, String> {
    match card {
        Card::End(end) => {
            let found = request.ends.get(end).and_then(|name| office.material(name));
            Ok(found.ok_or("there is no such material")?.brdf)
        }
        Card::Method(method) => match office.paths.get(&request.key(method)) {
            Some(Prepared::Ready(path)) => {
                let point = guarded("The path", || office.shown(path.as_ref(), &request.here(method)))?;
                point.map(|(brdf, _)| brdf).map_err(|error| format!("{error:#}"))
            }
            Some(Prepared::Failed(why)) => Err(why),
            None => Err("preparing the path".to_owned()),
        },
        Card::Explored => {
            let explored = request.explored.ok_or("nothing is explored")?;
            Ok(Arc::from(office.explored(explored)?))
        }
    }
}

fn read(
    office: &Office,
    card: Card,
    brdf: &dyn Brdf,
    (at, lamps): ([f32; 2], &[Incidence]),
    request: &Request,
) -> Reading {
    let values: Vec<Rgb> = lamps.iter().map(|lamp| brdf.eval(lamp.directions)).collect();
    let lit = || {
        let terms = lamps.iter().zip(&values).filter_map(|(lamp, &value)| Some(value * lamp.irradiance?));
        terms.fold(Rgb::BLACK, |sum, term| sum + term)
    };
    let radiance = match request.scenery.lighting.lamps() {
        Some(_) => Some(lit()),
        None => {
            let seen = request.scenery.frame.seen_at(at.map(f64::from));
            office.points.radiance(card, seen.map(|along| along as f32))
        }
    };
    let shown = radiance.map(|radiance| {
        let mut bytes = Vec::new();
        Image::new(1, 1, vec![radiance]).toned_bytes_into(request.exposure.exp2(), request.tone, &mut bytes);
        std::array::from_fn(|channel| bytes[channel])
    });
    Reading { values, radiance, shown }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn under_a_map_the_radiance_is_that_of_the_pixel() {
        let points = Points::default();
        let card = Card::End(0);
        assert_eq!(points.radiance(card, [0.0, 0.0]), None);
        let image = Image::new(2, 2, [1.0, 2.0, 3.0, 4.0].map(Rgb::splat).to_vec());
        points.see(card, image);
        for (at, value) in [([-0.5, 0.5], 1.0), ([0.5, 0.5], 2.0), ([-0.5, -0.5], 3.0), ([1.0, -1.0], 4.0)] {
            assert_eq!(points.radiance(card, at), Some(Rgb::splat(value)));
        }
        points.forget();
        assert_eq!(points.radiance(card, [0.0, 0.0]), None);
    }
}
