//! The thread that measures all representations: what each costs against how close it comes.
//!
//! A quick look, as `nbrdf chart --quick` takes: a few held-out materials, and those that are on the screen. One model
//! after the other, so that each appears when it is known and the work can be stopped in between.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::Result;
use nbrdf_core::cost::{Given, Track};
use nbrdf_core::{Database, Material, Representation, Split};

use super::{Answer, Office, guarded};
use crate::catalog::{REPRESENTATIONS, RepresentationEntry};
use crate::measure::Target;
use crate::measure::point::{Band, METRICS, Point};
use crate::measure::times::Times;

/// Held-out materials.
const MATERIALS: usize = 4;
/// Repeats whose median counts.
const REPEATS: usize = 9;

/// Materials kept; beyond, all of them are measured anew, so this only bounds a long day's work.
const KEPT: usize = 64;
/// How long other threads are waited for before a model is timed: a fit may take minutes.
const PATIENCE: Duration = Duration::from_secs(1);

/// How far the chart has come.
#[derive(Clone, Debug, Default)]
pub struct ChartNews {
    /// The models measured by now.
    pub rivals: Vec<Rival>,
    /// Models there are.
    pub count: usize,
    /// The one that is being measured; none when it is over.
    pub doing: Option<&'static str>,
}

/// One model.
#[derive(Clone, Debug)]
pub struct Rival {
    /// Over the held-out materials.
    pub point: Point,
    /// Of each material on the screen: its name and its errors by metric.
    pub own: Vec<(String, BTreeMap<String, f64>)>,
    /// Whether other threads worked while it was timed, in spite of waiting for them.
    pub is_disturbed: bool,
}

/// One material in one representation.
#[derive(Clone)]
struct Measured {
    times: Times,
    bytes: usize,
    figures: BTreeMap<String, f64>,
    is_disturbed: bool,
}

/// The thread's memory.
#[derive(Default)]
struct Bench {
    targets: HashMap<String, Target>,
    /// By place in the catalog and name of the material: each is measured once.
    measured: HashMap<(usize, String), Measured>,
    arrivals: u64,
}

/// Makes a chart whenever one is asked for, until the mailbox closes.
pub(super) fn run(office: &Office) {
    let mut bench = Bench::default();
    while let Some(asked) = office.charts.take() {
        let mut news = ChartNews { count: REPRESENTATIONS.len(), ..ChartNews::default() };
        // Nothing is asked for by whoever wants it to stop.
        let Some(names) = asked else { continue };
        bench.make_room(office);
        for (place, entry) in REPRESENTATIONS.iter().enumerate() {
            if office.charts.has_news() {
                break;
            }
            news.doing = Some(entry.name);
            office.say(Answer::Chart(Box::new(news.clone())));
            match guarded(entry.name, || bench.rival(office, (place, entry), &names)) {
                Ok(Ok(rival)) => news.rivals.extend(rival),
                Ok(Err(error)) => office.say(Answer::Notice(format!("{}: {error:#}", entry.name))),
                Err(why) => office.say(Answer::Notice(why)),
            }
        }
        news.doing = None;
        office.say(Answer::Chart(Box::new(news)));
    }
}

impl Bench {
    /// Forgets everything once it is too much, or a name may mean another material.
    fn make_room(&mut self, office: &Office) {
        let arrivals = office.arrivals();
        if self.arrivals != arrivals || self.targets.len() > KEPT {
            *self = Self { arrivals, ..Self::default() };
        }
    }

    /// One model; none if it was stopped.
    fn rival(
        &mut self,
        office: &Office,
        (place, entry): (usize, &RepresentationEntry),
        names: &Arc<[String]>,
    ) -> Result<Option<Rival>> {
        let catalog = &office.stock.catalog;
        let representation = entry.build(catalog)?;
        let held_out = catalog.reference().of(Database::Merl, Split::HeldOut);
        let chosen = held_out.iter().step_by(held_out.len().div_ceil(MATERIALS).max(1));
        let mut measured = Vec::new();
        office.activity.rests(PATIENCE, || office.charts.has_news());
        for material in chosen {
            if office.charts.has_news() {
                return Ok(None);
            }
            measured.push(self.measure(office, (place, representation.as_ref()), material)?);
        }
        let mut own = Vec::new();
        for material in names.iter().filter_map(|name| office.material(name)) {
            if office.charts.has_news() {
                return Ok(None);
            }
            // A material that this model cannot hold has no mark.
            if let Ok(found) = self.measure(office, (place, representation.as_ref()), &material) {
                own.push((material.name, found.figures));
            }
        }
        let is_disturbed = measured.iter().any(|own| own.is_disturbed);
        Ok(point(entry, representation.as_ref(), &measured).map(|point| Rival { point, own, is_disturbed }))
    }

    fn measure(
        &mut self,
        office: &Office,
        (place, model): (usize, &dyn Representation),
        material: &Material,
    ) -> Result<Measured> {
        let key = (place, material.name.clone());
        if let Some(known) = self.measured.get(&key) {
            return Ok(known.clone());
        }
        let is_quiet = || office.activity.rests(Duration::ZERO, || true);
        let was_quiet = is_quiet();
        let start = Instant::now();
        let code = model.encode(material)?;
        let encode_s = start.elapsed().as_secs_f64();
        let decoded = model.decode(&code)?;
        let cost = Track::new(0).measure(&[(decoded.as_ref(), Given::Directions)], REPEATS)[0];
        let is_disturbed = !was_quiet || !is_quiet();
        let target = self.targets.entry(material.name.clone()).or_insert_with(|| Target::new(material.brdf.as_ref()));
        let mut figures = target.figures(decoded.as_ref());
        figures.retain(|key, _| METRICS.contains(&key.as_str()));
        let (times, bytes) = (Times::of(cost, encode_s), model.bytes_of(&code));
        let found = Measured { times, bytes, figures, is_disturbed };
        self.measured.insert(key, found.clone());
        Ok(found)
    }
}

/// Of several materials; none of none.
fn point(entry: &RepresentationEntry, model: &dyn Representation, measured: &[Measured]) -> Option<Point> {
    let times: Vec<Times> = measured.iter().map(|own| own.times).collect();
    let mut bytes: Vec<usize> = measured.iter().map(|own| own.bytes).collect();
    bytes.sort_unstable();
    let band = |key: &str| {
        let values: Vec<f64> = measured.iter().filter_map(|own| own.figures.get(key).copied()).collect();
        Some((key.to_owned(), Band::of(&values)?))
    };
    Some(Point {
        name: if entry.name == "znbrdf" { format!("znbrdf_{}", model.dim()) } else { entry.name.to_owned() },
        variant: entry.variant.name().to_owned(),
        file: None,
        family: entry.family,
        times: Times::median(&times)?,
        bytes: bytes.get(bytes.len() / 2).copied()?,
        shared_bytes: model.shared_bytes(),
        error: METRICS.iter().filter_map(|key| band(key)).collect(),
        by_run: Vec::new(),
    })
}
