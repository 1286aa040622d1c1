//! The latent map as the worker drew it last, and what it is asked for.

use std::collections::HashMap;
use std::sync::Arc;

use super::Session;
use crate::worker::{MapAnswer, MapRequest, Projection, Spot, Track};

/// All maps.
#[derive(Default)]
pub struct Atlas {
    /// What the worker does, if it takes a while.
    pub doing: Option<String>,
    spots: HashMap<Projection, Vec<Spot>>,
    track: Option<Track>,
}

impl Atlas {
    /// Takes an answer in.
    pub fn take(&mut self, answer: MapAnswer) {
        match answer {
            MapAnswer::Doing(what) => self.doing = what,
            MapAnswer::Spots(projection, spots) => drop(self.spots.insert(projection, spots)),
            MapAnswer::Track(track) => self.track = Some(track),
        }
    }

    /// The materials on a map; none until it is drawn.
    pub fn spots(&self, projection: Projection) -> &[Spot] {
        self.spots.get(&projection).map_or(&[], Vec::as_slice)
    }

    /// The paths on a map.
    pub fn track(&self, projection: Projection) -> Option<&Track> {
        self.track.as_ref().filter(|track| track.projection == projection)
    }

    /// Distance of what is explored from the codes of training, and what is to be said of it.
    pub fn explored(&self) -> (Option<f64>, Option<&str>) {
        self.track.as_ref().map_or((None, None), |track| (track.distance, track.warning.as_deref()))
    }
}

/// What is to be on the map now; `ends` are those of the session.
pub fn request(session: &Session, ends: Arc<[String]>) -> MapRequest {
    let Session { blend, methods, map, explored, .. } = session;
    MapRequest {
        projection: map.projection,
        ends,
        weights: blend.weights(),
        range: (!blend.is_polygon()).then(|| blend.range()),
        timing: blend.timing,
        walk: blend.walk(),
        methods: methods.0.clone(),
        explored: *explored,
    }
}
