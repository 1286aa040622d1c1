//! The thread of the latent map: the codes of all materials, where they lie in a plane, and the paths between them.
//!
//! Codes are made once; a map is learned from those of the training materials when it is first looked at, and materials
//! that are opened later find their places on it. The paths are placed anew with every request.

mod chart;
mod course;
mod encode;
mod encoded;
mod explored;
mod failures;
mod sheet;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use nbrdf_core::{Brdf, Weights};
use rayon::prelude::*;

pub use chart::Projection;
pub use course::{Course, Track};
pub use encoded::Spot;
pub use explored::Explored;
pub(super) use sheet::Sheets;

use chart::Chart;
use course::Courses;
use encoded::Encoded;
use failures::Failures;
use sheet::Sheet;

use super::{Answer, Office, Timing, Walk, guarded};

/// What is to be on the map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapRequest {
    /// Which map.
    pub projection: Projection,
    /// Names of the ends.
    pub ends: Arc<[String]>,
    /// Where between them.
    pub weights: Weights,
    /// Lowest and highest t of the paths; none where they are not walked along t.
    pub range: Option<[f32; 2]>,
    /// How t runs.
    pub timing: Timing,
    /// Its time and edits: marks are where the materials are that spheres show.
    pub walk: Walk,
    /// Catalog names of the interpolations; those that walk through other codes have no place here.
    pub methods: Vec<&'static str>,
    /// A place that is looked at.
    pub explored: Option<Explored>,
}

/// What the thread has to say.
#[derive(Debug)]
pub enum MapAnswer {
    /// What it does, if it takes a while.
    Doing(Option<String>),
    /// All materials with a place on this map.
    Spots(Projection, Vec<Spot>),
    /// The paths, and what is known of the explored place.
    Track(Track),
}

/// The thread's memory.
struct Cartographer<'a> {
    office: &'a Office,
    encoded: Vec<Encoded>,
    /// The materials that were encoded, or failed, by name.
    tried: HashMap<String, Arc<dyn Brdf>>,
    /// Counts changes of the codes.
    edition: u64,
    failures: Failures,
    arrivals: u64,
    charts: HashMap<Projection, Chart>,
    /// Places of the encoded materials, as far as they are known; none of those that cannot be placed.
    places: HashMap<Projection, Vec<Option<[f32; 2]>>>,
    courses: Courses,
    told: HashSet<String>,
}

/// Draws what was asked for last until the mailbox closes.
pub(super) fn run(office: &Office) {
    let mut cartographer = Cartographer {
        office,
        encoded: Vec::new(),
        tried: HashMap::new(),
        edition: 0,
        failures: Failures::default(),
        arrivals: 0,
        charts: HashMap::new(),
        places: HashMap::new(),
        courses: Courses::default(),
        told: HashSet::new(),
    };
    while let Some(request) = office.map_requests.take() {
        let _busy = office.activity.begin();
        let drawn = guarded("The latent map", || cartographer.draw(&request));
        if let Ok(Err(why)) | Err(why) = drawn {
            cartographer.tell(why);
        }
        cartographer.say(MapAnswer::Doing(None));
    }
}

impl Cartographer<'_> {
    fn draw(&mut self, request: &MapRequest) -> Result<(), String> {
        if !self.encode() {
            return Ok(());
        }
        let projections = request.explored.map(|explored| explored.projection).into_iter().chain([request.projection]);
        for projection in projections {
            // Without the one map the other is there all the same.
            if let Err(why) = guarded(projection.title(), || self.place(projection)).flatten() {
                if self.office.sheets.fail(projection, why.clone()) {
                    self.ring();
                }
                self.tell(why);
            }
        }
        let Some(chart) = self.charts.get(&request.projection) else { return Ok(()) };
        let track = self.courses.track(self.office, chart, request)?;
        self.say(MapAnswer::Track(track));
        Ok(())
    }

    /// Learns a map, if it is new, and finds places for the materials that have none yet.
    fn place(&mut self, projection: Projection) -> Result<(), String> {
        if !self.charts.contains_key(&projection) {
            let (office, encoded) = (self.office, &self.encoded);
            let learn = || {
                let title = projection.title();
                office.say(Answer::Map(MapAnswer::Doing(Some(format!("{title}: learning the map")))));
                let learned = guarded(title, || Chart::learn(projection, &office.stock.catalog, encoded))?;
                learned.map_err(|error| format!("{title}: {error:#}"))
            };
            // Charting learns from the catalog, which stays as it is.
            let edition = if projection == Projection::Pca { self.edition } else { 0 };
            let chart = self.failures.unless_known(projection, edition, learn)?;
            self.charts.insert(projection, chart);
        }
        let Some(chart) = self.charts.get(&projection) else { return Ok(()) };
        let before = self.places.get(&projection).map_or(0, Vec::len);
        if before == self.encoded.len() && self.places.contains_key(&projection) {
            return Ok(());
        }
        self.say(MapAnswer::Doing(Some(format!("{}: placing materials", projection.title()))));
        let new = &self.encoded[before..];
        let of = |own: &Encoded| {
            let place = guarded("Placing", || chart.place(&own.code, || Ok(own.material.clone())));
            let place = place.and_then(|place| place.map_err(|error| format!("{error:#}")));
            place.map_err(|why| format!("{} is not on the map: {why}", own.material.name))
        };
        let found: Vec<_> = new.par_iter().map(of).collect();
        found.iter().filter_map(|place| place.as_ref().err()).for_each(|why| self.say_notice(why.clone()));
        let places = self.places.entry(projection).or_default();
        places.extend(found.into_iter().map(Result::ok));
        let placed = || self.encoded.iter().zip(places.iter()).filter_map(|(own, place)| Some((own, (*place)?)));
        let spots = placed().map(|(own, at)| own.spot(at)).collect();
        let sheet = Sheet::new(chart.pca(), placed().map(|(own, at)| (at, own.code.clone())));
        self.office.sheets.put(projection, sheet);
        self.say(MapAnswer::Spots(projection, spots));
        self.ring();
        Ok(())
    }

    /// An explored place may have waited for the map.
    fn ring(&self) {
        self.office.points.again();
        if self.office.requests.newest().is_some_and(|(_, request)| request.explored.is_some()) {
            self.office.requests.again();
        }
    }

    fn say(&self, answer: MapAnswer) {
        self.office.say(Answer::Map(answer));
    }

    fn say_notice(&self, why: String) {
        self.office.say(Answer::Notice(why));
    }

    /// A notice, once.
    fn tell(&mut self, why: String) {
        if self.told.insert(why.clone()) {
            self.say_notice(why);
        }
    }
}
