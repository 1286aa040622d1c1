//! Codes of all materials that are there, each made once.

use std::collections::HashMap;
use std::sync::Arc;

use nbrdf_core::{Brdf, Material};
use rayon::prelude::*;

use super::course::Courses;
use super::encoded::Encoded;
use super::{Cartographer, MapAnswer};
use crate::worker::guarded;

/// Materials encoded between two looks at the mailbox.
const BATCH: usize = 8;

impl Cartographer<'_> {
    /// Forgets materials that are gone, or are others under the same name.
    fn forget(&mut self) {
        let arrivals = self.office.arrivals();
        if std::mem::replace(&mut self.arrivals, arrivals) == arrivals {
            return;
        }
        self.courses = Courses::default();
        let there: HashMap<String, Arc<dyn Brdf>> =
            self.office.materials.all().into_iter().map(|own| (own.name, own.brdf)).collect();
        let is_same = |name: &String, brdf: &Arc<dyn Brdf>| there.get(name).is_some_and(|own| Arc::ptr_eq(own, brdf));
        self.tried.retain(|name, brdf| is_same(name, brdf));
        let before = self.encoded.len();
        self.encoded.retain(|own| is_same(&own.material.name, &own.material.brdf));
        if self.encoded.len() < before {
            // All others are placed again; the maps stay as they were learned.
            self.places.clear();
            self.edition += 1;
        }
    }

    /// Encodes materials that are new; false where something else was asked for meanwhile.
    pub(super) fn encode(&mut self) -> bool {
        self.forget();
        let mut missing = self.office.materials.all();
        let all = missing.len();
        missing.retain(|own| !self.tried.contains_key(&own.name));
        for batch in missing.chunks(BATCH) {
            self.say(MapAnswer::Doing(Some(format!("Encoding materials: {} of {all}", self.tried.len()))));
            let catalog = &self.office.stock.catalog;
            let of = |own: &Material| match guarded("Encoding", || Encoded::of(own, catalog)) {
                Ok(Ok(encoded)) => Ok(encoded),
                Ok(Err(error)) => Err(format!("{} is not on the map: {error:#}", own.name)),
                Err(panic) => Err(format!("{} is not on the map: {panic}", own.name)),
            };
            let found: Vec<_> = batch.par_iter().map(of).collect();
            self.tried.extend(batch.iter().map(|own| (own.name.clone(), Arc::clone(&own.brdf))));
            self.edition += 1;
            for encoded in found {
                match encoded {
                    Ok(encoded) => self.encoded.push(encoded),
                    Err(why) => self.tell(why),
                }
            }
            // After a batch, so that something is done however fast requests come.
            if self.office.map_requests.has_news() {
                return false;
            }
        }
        true
    }
}
