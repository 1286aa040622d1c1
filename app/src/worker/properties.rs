//! The thread that measures what lists are sorted by, of every material, once somebody asks.

use std::collections::HashMap;
use std::sync::Arc;

use nbrdf_core::metric::log_error_estimate;
use nbrdf_core::quality::Qualities;
use nbrdf_core::{Brdf, Material, Representation};

use super::cache::{self, Kind};
use super::{Answer, Office, guarded};

/// Its codes are judged.
const JUDGED: &str = "znbrdf";

/// What is asked of every material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Inquiry {
    /// Lightness, gloss and roughness.
    Qualities,
    /// The error to expect of a code.
    Error,
}

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Property {
    /// Lightness (L* / 100), gloss, and roughness \[√rad\], as in [`Qualities`].
    Qualities([f64; 3]),
    /// Expected `log_error` of the material's ZNBRDF code.
    Error(f64),
}

/// Answers the newest inquiry until the mailbox closes.
pub(super) fn run(office: &Office) {
    let mut known: HashMap<(Inquiry, String), Arc<dyn Brdf>> = HashMap::new();
    while let Some(inquiry) = office.inquiries.take() {
        let _busy = office.activity.begin();
        for material in office.materials.all() {
            if office.inquiries.has_news() {
                break;
            }
            let before = known.insert((inquiry, material.name.clone()), Arc::clone(&material.brdf));
            // A file that was read again may hold another one of this name.
            if before.is_some_and(|before| Arc::ptr_eq(&before, &material.brdf)) {
                continue;
            }
            let found = guarded(&material.name, || property(office, inquiry, &material));
            match found.flatten() {
                Ok(property) => office.say(Answer::Property(material.name, property)),
                Err(why) => office.say(Answer::Notice(why)),
            }
        }
    }
}

fn property(office: &Office, inquiry: Inquiry, material: &Material) -> Result<Property, String> {
    let mark = cache::mark(material);
    match inquiry {
        Inquiry::Qualities => {
            let measure = || {
                let found = Qualities::of(material.brdf.as_ref());
                Ok([found.lightness, found.gloss, found.roughness])
            };
            kept(office, Kind::Qualities, &mark, measure).map(Property::Qualities)
        }
        Inquiry::Error => {
            let representation = office.stock.catalog.representation(JUDGED, false);
            let representation = representation.map_err(|error| format!("{error:#}"))?;
            let key = cache::key(&[mark.as_bytes(), representation.checkpoint().as_bytes()]);
            let measure = || error(representation.as_ref(), material).map(|error| [error]);
            kept(office, Kind::Error, &key, measure).map(|[error]| Property::Error(error))
        }
    }
}

fn error(representation: &dyn Representation, material: &Material) -> Result<f64, String> {
    let told = |error: &dyn std::fmt::Display| format!("{}: {error}", material.name);
    let code = representation.encode(material).map_err(|error| told(&error))?;
    let decoded = representation.decode(&code).map_err(|error| told(&error))?;
    Ok(log_error_estimate(material.brdf.as_ref(), decoded.as_ref()))
}

/// Numbers from the cache, or measured and kept there.
fn kept<const N: usize>(
    office: &Office,
    kind: Kind,
    key: &str,
    measure: impl FnOnce() -> Result<[f64; N], String>,
) -> Result<[f64; N], String> {
    let cache = &office.stock.cache;
    if let Some(numbers) = cache.get(kind, key).as_deref().and_then(from_bytes) {
        return Ok(numbers);
    }
    let numbers = measure()?;
    cache.put(kind, key, numbers.map(f64::to_le_bytes).as_flattened());
    Ok(numbers)
}

fn from_bytes<const N: usize>(bytes: &[u8]) -> Option<[f64; N]> {
    let (numbers, rest) = bytes.as_chunks::<8>();
    let numbers: [[u8; 8]; N] = numbers.try_into().ok()?;
    rest.is_empty().then(|| numbers.map(f64::from_le_bytes))
}
