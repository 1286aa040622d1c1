//! The thread that opens scenes and plans them: a small, grainy picture first, then the scene's own.

use std::time::Instant;

use nbrdf_core::plan::{Choice, Models, Options, Plan, PlanError, Planner, TOLERANCE, Watch};
use nbrdf_core::scene::{Gathering, Picture, Scene, View};

use super::order::{Desk, Order};
use super::{News, Planned, Row, Sight, Still, Wish, example};
use crate::measure::planned::{Opened, WHITE, difference, reason, saved};
use crate::worker::{Answer, Mailbox, Office, guarded};

/// Longer side of the first picture in pixels, and its rays through a pixel.
const DRAFT: (usize, usize) = (160, 4);
/// Rays are drawn as the command line draws them.
const SEED: u64 = 0;

/// A wish and its number.
type Numbered = (u64, Wish);

/// Plans what was asked for last until the mailbox closes.
pub fn run(office: &Office, letters: &Mailbox<Order>) {
    let desk = Desk { office, letters };
    let mut wanted = desk.next();
    while let Some((mut number, wish)) = wanted {
        let served =
            guarded("Planning the scene", || serve(desk, &mut number, wish).map_err(|error| format!("{error:#}")));
        wanted = served.and_then(|served| served).unwrap_or_else(|why| {
            desk.say(News::Failed(why.clone()));
            office.say(Answer::Notice(why));
            // The number of the newest letter that was taken; whatever came in since is one of its own.
            desk.say(News::Done(number));
            desk.next()
        });
    }
}

/// Plans one scene as long as nothing is asked of another; what is asked then. The number becomes that of the last letter
/// about this scene.
fn serve(desk: Desk, number: &mut u64, mut wish: Wish) -> anyhow::Result<Option<Numbered>> {
    desk.say(News::Reading);
    desk.say(News::Doing("reading the scene, timing the kinds of models".to_owned()));
    let busy = desk.office.activity.begin();
    let opened = example::open(&wish.source, &desk.office.stock.catalog)?;
    drop(busy);
    desk.say(News::Read(opened.scene.tolerance));
    let models = Models::new(&opened.materials, &opened.ladder);
    for is_draft in [true, false] {
        let scene = if is_draft { drafted(&opened.scene) } else { opened.scene.clone() };
        let view = loop {
            desk.say(News::Doing("looking".to_owned()));
            let how = Gathering { seed: SEED, done: &|| (), cancelled: &|| desk.letters.has_news() };
            let busy = desk.office.activity.begin();
            let view = opened.view(&scene, how);
            drop(busy);
            match view {
                Some(view) => break view,
                None => match desk.next_of(&wish) {
                    Ok(next) => (*number, wish) = next,
                    Err(other) => return Ok(other),
                },
            }
        };
        if is_draft && view.unseen(&opened.scene.objects).next().is_some() {
            // Too small for a draft.
            continue;
        }
        opened.refuse_unseen(&view)?;
        let planner = Planner::new(&view, &models, &opened.material)?;
        let table = Table { desk, opened: &opened, planner: &planner, is_draft };
        let mut is_seen = false;
        loop {
            let is_planned = table.plan(&wish, &mut is_seen)?;
            if is_planned && is_draft {
                break;
            }
            if is_planned {
                desk.say(News::Done(*number));
            }
            match desk.next_of(&wish) {
                Ok(next) => (*number, wish) = next,
                Err(other) => return Ok(other),
            }
        }
    }
    Ok(desk.next())
}

/// The same scene in a small, grainy picture.
fn drafted(scene: &Scene) -> Scene {
    let Picture { width, height, samples, exposure } = scene.picture;
    let scale = (DRAFT.0 as f64 / width.max(height) as f64).min(1.0);
    let side = |side: usize| ((side as f64 * scale).round() as usize).max(1);
    let picture = Picture { width: side(width), height: side(height), samples: samples.min(DRAFT.1), exposure };
    Scene { picture, ..scene.clone() }
}

/// A view of a scene, where it is planned.
struct Table<'a> {
    desk: Desk<'a>,
    opened: &'a Opened,
    planner: &'a Planner<'a>,
    is_draft: bool,
}

impl Table<'_> {
    /// Plans; false if something newer came.
    fn plan(&self, wish: &Wish, is_seen: &mut bool) -> anyhow::Result<bool> {
        let _busy = self.desk.office.activity.begin();
        let tolerance = wish.tolerance.or(self.opened.scene.tolerance).unwrap_or(TOLERANCE);
        let options = self.opened.options(tolerance, wish.by, usize::MAX);
        if !*is_seen {
            self.desk.say(News::Seen(Box::new(self.sight())));
            *is_seen = true;
        }
        let tried = |object: usize, name: &str| {
            let object = &self.opened.scene.objects[object].name;
            self.desk.say(News::Doing(format!("{object}: {name}")));
        };
        let start = Instant::now();
        let watch = Watch { tried: &tried, cancelled: &|| self.desk.letters.has_news() };
        match self.planner.plan(options, &watch) {
            Ok(plan) => {
                let planned = self.shown(&plan, options, start.elapsed().as_secs_f64());
                self.desk.say(News::Planned(Box::new(planned)));
                Ok(true)
            }
            Err(PlanError::Cancelled) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    fn sight(&self) -> Sight {
        let objects = self.opened.scene.objects.iter().map(|object| object.name.clone()).collect();
        let view = self.planner.view();
        Sight::new(view, objects, Still::of(self.planner.reference(), gain(view)))
    }

    fn shown(&self, plan: &Plan, options: Options, seconds: f64) -> Planned {
        let gain = gain(self.planner.view());
        let [full, planned] = [&plan.reference, &plan.planned].map(|image| image.map(|pixel| pixel * gain));
        let white = WHITE * options.tolerance;
        let row = |(object, choice): (usize, &Choice)| {
            let place = self.opened.material[object];
            Row {
                object: self.opened.scene.objects[object].name.clone(),
                material: self.opened.materials[place].name.clone(),
                is_file: self.opened.files[place].is_some(),
                model: self.opened.ladder[choice.rung].name.clone(),
                error: choice.error,
                ns: choice.ns,
                bytes: choice.bytes,
                reason: reason(self.opened, self.planner, options, object, choice),
            }
        };
        Planned {
            picture: Still::of(&planned, 1.0),
            difference: Still::of(&difference(&full, &planned, white), 1.0),
            white,
            rows: plan.choices.iter().enumerate().map(row).collect(),
            tolerance: options.tolerance,
            by: options.by,
            totals: plan.totals,
            beside: plan.beside,
            saved: saved(plan),
            seconds,
            is_draft: self.is_draft,
        }
    }
}

/// What the display multiplies radiance by.
fn gain(view: &View) -> f32 {
    (view.picture().exposure as f32).exp2()
}
