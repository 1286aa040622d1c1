//! The thread that works out figures: curves, slices, costs and warnings; coarse first, fine when nothing newer came.

mod price;
mod profile;
mod question;
mod slice;
mod told;
mod walk;

use std::sync::Arc;

use nbrdf_core::{Brdf, Code, Material, Path, Weights};

use super::paths::Prepared;
use super::studio::QUIET;
use super::{Answer, Card, Office, Walk, guarded};
pub use price::Price;
use price::Prices;
pub use profile::Profile;
pub use question::{Findings, Found, Question, Topic};
pub use told::Told;
use walk::Walks;
pub use walk::{Along, Place};

/// One material to look at.
struct Subject {
    card: Card,
    brdf: Arc<dyn Brdf>,
    /// Its code, where it has one.
    code: Option<Code>,
    /// The path it is a point of, and where on that.
    on: Option<(Arc<dyn Path>, Weights)>,
}

/// The thread's memory.
#[derive(Default)]
struct Clerk {
    walks: Walks,
    prices: Prices,
    arrivals: u64,
}

/// Answers the newest question until the mailbox closes.
pub(super) fn run(office: &Office) {
    let mut clerk = Clerk::default();
    while let Some(question) = office.questions.take() {
        let _busy = office.activity.begin();
        let arrivals = office.arrivals();
        if clerk.arrivals != arrivals {
            clerk = Clerk { arrivals, ..Clerk::default() };
        }
        if let Err(why) = guarded("The figure", || clerk.answer(office, &question)).flatten() {
            say(office, &question, 0, true, Found::Nothing(why));
        }
    }
}

fn say(office: &Office, question: &Question, waiting: usize, is_fine: bool, found: Found) {
    let findings = Findings { question: question.clone(), is_fine, waiting, found };
    office.say(Answer::Findings(Box::new(findings)));
}

impl Clerk {
    fn answer(&mut self, office: &Office, question: &Question) -> Result<(), String> {
        let ends: Vec<Material> = question.ends.iter().filter_map(|name| office.material(name)).collect();
        if ends.len() < question.ends.len() {
            let missing = question.ends.iter().find(|name| office.material(name).is_none());
            let why = format!("There is no material `{}`; choose one from the list.", missing.map_or("", |name| name));
            return Err(why);
        }
        let (paths, waiting) = ready(office, question);
        let say = |is_fine, found| say(office, question, waiting, is_fine, found);
        let has_news = || office.questions.has_news();
        let at = |walk: &Walk, weights: &Weights| subjects(office, question, (&ends, &paths), (walk, weights));
        match &question.topic {
            Topic::Along { is_beyond } => {
                for is_fine in [false, true] {
                    if is_fine && !office.questions.stays_quiet(QUIET) {
                        break;
                    }
                    let walks = self.walks.of(office, (question, *is_beyond, is_fine), &ends, &paths);
                    let Some(walks) = walks.map_err(|error| format!("{error:#}"))? else { break };
                    say(is_fine, Found::Walks(walks));
                }
            }
            Topic::Albedo { weights } => {
                let subjects = at(&question.walk, weights);
                for is_fine in [false, true] {
                    if is_fine && !office.questions.stays_quiet(QUIET) {
                        break;
                    }
                    let Some(profiles) = profile::of(&subjects, &has_news, |brdf| profile::albedo(brdf, is_fine))
                    else {
                        break;
                    };
                    say(is_fine, Found::Profiles(profiles));
                }
            }
            Topic::Lobe { weights, theta_i } => {
                let found = profile::of(&at(&question.walk, weights), &has_news, |brdf| profile::lobe(brdf, *theta_i));
                found.into_iter().for_each(|profiles| say(true, Found::Profiles(profiles)));
            }
            Topic::Half { weights, theta_d } => {
                let found = profile::of(&at(&question.walk, weights), &has_news, |brdf| profile::half(brdf, *theta_d));
                found.into_iter().for_each(|profiles| say(true, Found::Profiles(profiles)));
            }
            Topic::Slice { weights, exposure } => {
                let found = slice::of(&at(&question.walk, weights), *exposure, &has_news);
                found.into_iter().for_each(|slices| say(true, Found::Slices(slices)));
            }
            Topic::Cost => {
                let walk = Walk { t: Some(0.5), ..Walk::default() };
                let middle = at(&walk, &Weights::along_spline(0.5, ends.len()));
                let prices = self.prices.of(question, &middle);
                say(true, Found::Prices(prices));
            }
            Topic::Warnings { weights } => {
                let known = office.stock.catalog.autoencoder();
                let told = told::of(&at(&question.walk, weights), &known, &has_news);
                told.into_iter().for_each(|told| say(true, Found::Told(told)));
            }
        }
        Ok(())
    }
}

/// A method and its path.
type Walkable = (&'static str, Arc<dyn Path>);

/// The paths that can be walked, and how many are being prepared: the studio, which shows the same methods, asks for them.
fn ready(office: &Office, question: &Question) -> (Vec<Walkable>, usize) {
    let (mut paths, mut waiting) = (Vec::new(), 0);
    for &method in &question.methods {
        match office.paths.get(&question.key(method)) {
            Some(Prepared::Ready(path)) => paths.push((method, path)),
            // Its card says why.
            Some(Prepared::Failed(_)) => {}
            None => waiting += 1,
        }
    }
    (paths, waiting)
}

/// The ends, and the point of every path as spheres show it; a path that has none there is left out, as its card says.
fn subjects(
    office: &Office,
    question: &Question,
    (ends, paths): (&[Material], &[Walkable]),
    (walk, weights): (&Walk, &Weights),
) -> Vec<Subject> {
    let ends = ends.iter().enumerate().map(|(end, material)| Subject {
        card: Card::End(end),
        brdf: Arc::clone(&material.brdf),
        code: None,
        on: None,
    });
    let points = paths.iter().filter_map(|(method, path)| {
        let here = question.here(method, walk, weights);
        let (brdf, code) = office.shown(path.as_ref(), &here).ok()?;
        let on = Some((Arc::clone(path), here.weights(office)));
        Some(Subject { card: Card::Method(method), brdf, code, on })
    });
    ends.chain(points).collect()
}
