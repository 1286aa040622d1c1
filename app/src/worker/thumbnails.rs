//! The thread that makes small pictures of materials: from the cache where they are there, else rendered.

use std::cell::LazyCell;
use std::sync::mpsc;

use nbrdf_core::Material;
use nbrdf_core::render::{Light, Sphere};

use super::cache::{self, Kind};
use super::picture::{AS_IT_IS, Picture};
use super::{Answer, Office, guarded};

/// Side of a thumbnail in pixels: 44 points on a dense display.
const SIZE: usize = 88;

/// Makes pictures of all materials that come, in their order.
pub(super) fn run(office: &Office, materials: &mpsc::Receiver<Vec<Material>>) {
    let sphere = LazyCell::new(|| Sphere::new(SIZE, &Light::studio()));
    for material in materials.iter().flatten().take_while(|_| !office.activity.is_over()) {
        let _busy = office.activity.begin();
        match guarded(&material.name, || thumbnail(office, || &*sphere, &material)) {
            Ok(picture) => office.say(Answer::Thumbnail(material.name, picture)),
            Err(why) => office.say(Answer::Notice(why)),
        }
    }
}

fn thumbnail<'a>(office: &Office, sphere: impl Fn() -> &'a Sphere, material: &Material) -> Picture {
    let key = cache::key(&[&SIZE.to_le_bytes(), cache::mark(material).as_bytes()]);
    let cache = &office.stock.cache;
    let whole = |rgba: &Vec<u8>| rgba.len() == 4 * SIZE * SIZE;
    if let Some(rgba) = cache.get(Kind::Thumbnail, &key).filter(whole) {
        return Picture { size: SIZE, rgba };
    }
    let sphere = sphere();
    let image = sphere.render(material.brdf.as_ref());
    // As in reports, whatever the spheres are shown like.
    let picture = Picture::of(&image, AS_IT_IS, &sphere.surfaces().opacity(), &office.plates);
    cache.put(Kind::Thumbnail, &key, &picture.rgba);
    picture
}
