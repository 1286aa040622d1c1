//! The models that a scene's materials can take, as rungs of a ladder.
//!
//! Formulas, factors, networks, tables, and codes that decode to networks. Linear bases and charts are left out: they
//! evaluate a dozen times as slowly as networks that are closer, and share tens of megabytes.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::{Context, Result};
use nbrdf_core::cost::{Given, Track};
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::PUBLISHED_HIDDEN;
use nbrdf_core::nbrdf::fit::random_hidden;
use nbrdf_core::nbrdf::precision::Precision;
use nbrdf_core::plan::{Kept, Make, Model, Rung};
use nbrdf_core::representation::{DecodeError, EncodeError};
use nbrdf_core::{Brdf, Material, Nbrdf};

use super::{Catalog, Family, REPRESENTATIONS, RepresentationEntry, Shared, Variant};

/// The rung of the materials as they are.
const ITSELF: &str = "itself";
/// The rung that others are compared with: a network of the published widths for everything.
pub const NBRDF: &str = "nbrdf";
/// Bits of stored weights, and how the names of rungs tell them.
const PRECISIONS: [(Precision, &str); 3] =
    [(Precision::Single, ""), (Precision::Half, "_half"), (Precision::Byte, "_byte")];
/// Runs whose median is the time to expect.
const REPEATS: usize = 8;
/// A built-in network of about as many live units as most, for the time to expect of its kind.
const TYPICAL: &str = "gold-paint";

/// All rungs: those of the catalog, codes of further checkpoints (each with its file), and the materials themselves, which
/// take `own_bytes` where they are no networks.
pub fn ladder(
    catalog: &Catalog,
    others: &[(PathBuf, Catalog)],
    own_bytes: impl Fn(&Material) -> usize + Send + Sync + 'static,
) -> Result<Vec<Rung>> {
    let mut rungs = Vec::new();
    for entry in REPRESENTATIONS.iter().filter(|entry| is_rung(entry)) {
        let representation = entry.build(catalog)?;
        match entry.family {
            Family::Code => rungs.push(code(entry, representation, "")?),
            // The other precisions follow from the same fit.
            Family::Network if representation.precision() != Precision::Single => {}
            Family::Network => rungs.extend(networks(entry, representation)?),
            _ => rungs.push(decoded(entry, representation)?),
        }
    }
    for (path, other) in others {
        for entry in REPRESENTATIONS.iter().filter(|entry| entry.family == Family::Code && is_rung(entry)) {
            let representation = entry.build(other)?;
            let own = code(entry, Arc::clone(&representation), "")?;
            // Of one length there may be several: the file tells them apart, or the mark of what was learned.
            let is_new = |timed: &Timed| rungs.iter().all(|known: &Timed| known.rung.name != timed.rung.name);
            let of = |mark: &str| code(entry, Arc::clone(&representation), mark);
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let named = if is_new(&own) { own } else { of(&format!("_{stem}"))? };
            let named = if is_new(&named) { named } else { of(&format!("_{}", representation.checkpoint()))? };
            // The same checkpoint twice.
            if is_new(&named) {
                rungs.push(named);
            }
        }
    }
    let own = |material: &Material| {
        let none = || EncodeError::NeedsNetwork { model: ITSELF, material: material.name.clone() };
        material.network.clone().ok_or_else(none)
    };
    // In as many bits as they have they are the materials themselves.
    rungs.extend(rounded(ITSELF, PUBLISHED_HIDDEN, &PRECISIONS[1..], Arc::new(own)));
    time(&mut rungs);
    let itself = move |material: &Material| {
        Ok(match &material.network {
            Some(network) => pruned(network, Precision::Single, |_| Kept::Itself),
            None => Model { bytes: own_bytes(material), brdf: Arc::clone(&material.brdf), kept: Kept::Itself },
        })
    };
    let mut rungs: Vec<Rung> = rungs.into_iter().map(|timed| timed.rung).collect();
    // What the materials themselves cost is measured and not expected.
    let (name, make) = (ITSELF.to_owned(), Box::new(itself));
    rungs.push(Rung { name, ns: f64::INFINITY, bytes: 0, shared: None, coarser_than: None, is_itself: true, make });
    for place in 0..rungs.len() {
        let finer = PRECISIONS[1..].iter().find_map(|(_, suffix)| rungs[place].name.strip_suffix(suffix));
        rungs[place].coarser_than = finer.and_then(|finer| rungs.iter().position(|rung| rung.name == finer));
    }
    Ok(rungs)
}

/// A rung, and a model of its kind to time.
struct Timed {
    rung: Rung,
    sample: Arc<dyn Brdf>,
}

impl Timed {
    fn new(name: String, bytes: usize, shared: Option<(String, usize)>, make: Make, sample: Arc<dyn Brdf>) -> Self {
        Self {
            rung: Rung { name, ns: f64::INFINITY, bytes, shared, coarser_than: None, is_itself: false, make },
            sample,
        }
    }
}

fn is_rung(entry: &RepresentationEntry) -> bool {
    match entry.family {
        Family::Formula | Family::Factored => true,
        // Over the angles of light and view a table has no file of its own, and is no closer.
        Family::Table => entry.name != "table_standard",
        // All networks are pruned here.
        Family::Network => entry.name != "nbrdf_pruned",
        Family::Code => entry.name == "znbrdf" && entry.variant == Variant::Refined,
        Family::Linear | Family::Chart => false,
    }
}

/// Of formulas, factors and tables.
fn decoded(entry: &RepresentationEntry, representation: Shared) -> Result<Timed> {
    // What the numbers are does not matter to how long they take.
    let sample = representation.decode(&representation.code(vec![0.0; representation.dim()]))?;
    let bytes = representation.code_bytes();
    let is_table = entry.family == Family::Table;
    let make = move |material: &Material| {
        let code = representation.encode(material)?;
        let brdf = Arc::from(representation.decode(&code)?);
        Ok(Model { brdf, bytes, kept: if is_table { Kept::Table } else { Kept::Code(code) } })
    };
    Ok(Timed::new(entry.name.to_owned(), bytes, None, Box::new(make), Arc::from(sample)))
}

/// Of codes that decode to networks.
fn code(entry: &RepresentationEntry, representation: Shared, mark: &str) -> Result<Timed> {
    let name = format!("{}_{}{mark}", entry.name, representation.dim());
    let bytes = representation.code_bytes();
    let shared = Some((name.clone(), representation.shared_bytes()));
    let make = move |material: &Material| {
        let code = representation.encode(material)?;
        let brdf: Arc<dyn Brdf> = match representation.network(&code)? {
            Some(network) => Arc::new(network.pruned()),
            None => Arc::from(representation.decode(&code)?),
        };
        Ok(Model { brdf, bytes, kept: Kept::Code(code) })
    };
    Ok(Timed::new(name, bytes, shared, Box::new(make), Arc::new(typical(PUBLISHED_HIDDEN))))
}

/// Of networks: their weights in single and half precision and in bytes, from one fit.
fn networks(entry: &RepresentationEntry, representation: Shared) -> Result<Vec<Timed>> {
    let zero = representation.code(vec![0.0; representation.dim()]);
    let network = representation.network(&zero)?.with_context(|| format!("{}: no networks", entry.name))?;
    let hidden = network.hidden();
    let fits = Fits { representation, made: Mutex::new(Vec::new()) };
    Ok(rounded(entry.name, hidden, &PRECISIONS, Arc::new(move |material: &Material| fits.get(material))))
}

/// The network of a material.
type Source = Arc<dyn Fn(&Material) -> Result<Nbrdf, EncodeError> + Send + Sync>;

/// Networks from one source, stored in so many bits.
fn rounded(name: &str, hidden: [usize; 2], precisions: &[(Precision, &str)], source: Source) -> Vec<Timed> {
    let sample: Arc<dyn Brdf> = Arc::new(typical(hidden));
    let one = |&(precision, suffix): &(Precision, &str)| {
        let source = Arc::clone(&source);
        let make = move |material: &Material| {
            let network = precision.round(&source(material)?);
            Ok(pruned(&network, precision, Kept::Network))
        };
        let (name, bytes) = (format!("{name}{suffix}"), precision.bytes(hidden));
        Timed::new(name, bytes, None, Box::new(make), Arc::clone(&sample))
    };
    precisions.iter().map(one).collect()
}

/// Networks of one kind, each fitted once; materials are told apart by what they share.
struct Fits {
    representation: Shared,
    made: Mutex<Vec<(Arc<dyn Brdf>, Nbrdf)>>,
}

impl Fits {
    fn get(&self, material: &Material) -> Result<Nbrdf, EncodeError> {
        let made = || self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, network)) = made().iter().find(|(brdf, _)| Arc::ptr_eq(brdf, &material.brdf)) {
            return Ok(network.clone());
        }
        // Not under the lock: fits work in parallel.
        let code = self.representation.encode(material)?;
        let failed = || DecodeError::Failed(format!("{}: no network", self.representation.name()));
        let network = self.representation.network(&code)?.ok_or_else(failed)?;
        made().push((Arc::clone(&material.brdf), network.clone()));
        Ok(network)
    }
}

/// A network without the units that never fire.
fn pruned(network: &Nbrdf, precision: Precision, kept: impl Fn(Nbrdf) -> Kept) -> Model {
    let pruned = network.pruned();
    let compact = pruned.compact();
    Model { bytes: precision.bytes(compact.hidden()), brdf: Arc::new(pruned), kept: kept(compact) }
}

/// A network as they usually are of these widths, pruned.
fn typical(hidden: [usize; 2]) -> Nbrdf {
    let known = builtin::shared().get(TYPICAL).ok().and_then(|entry| entry.network.shrunk(hidden));
    known.unwrap_or_else(|| random_hidden(0, 0, hidden)).pruned()
}

/// Times to expect, all kinds side by side.
fn time(rungs: &mut [Timed]) {
    let samples: Vec<(&dyn Brdf, Given)> =
        rungs.iter().map(|timed| (timed.sample.as_ref(), Given::Directions)).collect();
    let costs = Track::new(0).measure(&samples, REPEATS);
    rungs.iter_mut().zip(costs).for_each(|(timed, cost)| timed.rung.ns = cost.ns);
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use nbrdf_core::sampling::{evaluate, rus32k};
    use nbrdf_core::{Directions, Rgb};

    use super::*;
    use crate::catalog::Reference;

    fn values(brdf: &dyn Brdf) -> Vec<Rgb> {
        let at: Vec<Directions> = rus32k().iter().step_by(97).copied().collect();
        evaluate(brdf, &at)
    }

    #[test]
    fn every_rung_makes_what_is_kept_of_it_in_no_more_bytes_than_expected() {
        let catalog = Catalog::new(Arc::new(Reference::built_in()));
        let rungs = ladder(&catalog, &[], |_| 0).unwrap();
        let names: BTreeSet<&str> = rungs.iter().map(|rung| rung.name.as_str()).collect();
        assert_eq!(names.len(), rungs.len(), "no name twice");
        assert!(
            [NBRDF, "nbrdf_half", "nbrdf_10_byte", "znbrdf_32", "lambert", "table", ITSELF]
                .iter()
                .all(|n| names.contains(n))
        );
        let material = builtin::shared().get("gold-paint").unwrap().material();
        for rung in rungs {
            let model = (rung.make)(&material).unwrap();
            let own = values(model.brdf.as_ref());
            match &model.kept {
                Kept::Code(code) => {
                    let decoded = catalog.representation(&code.model, false).unwrap().decode(code).unwrap();
                    assert_eq!(own, values(decoded.as_ref()), "{}", rung.name);
                }
                Kept::Network(network) => assert_eq!(own, values(network), "{}: pruned, the same bits", rung.name),
                Kept::Itself => assert_eq!(own, values(material.brdf.as_ref()), "{}", rung.name),
                Kept::Table => {}
            }
            assert!(model.bytes <= rung.bytes || rung.is_itself, "{}: {} of {}", rung.name, model.bytes, rung.bytes);
            assert!(rung.ns > 0.0, "{}", rung.name);
        }
    }
}
