//! Where on a walk files, pictures and lines of a table are: on the way that film strips of the window show.

use anyhow::Result;
use nbrdf_core::Weights;

use super::Exporter;
use super::job::Job;
use crate::command::blend::samples::{Sample, samples};
use crate::worker::{Request, Tour};

/// One place of a walk.
pub(super) struct Place {
    /// t; around a polygon the share of the way.
    pub at: f32,
    /// Weights of the ends there, as long as no clock has others.
    pub plain: Weights,
    /// What stands above its column.
    pub heading: String,
}

impl Job {
    /// Where the places of so many steps are: t, or the share of the way around.
    pub(super) fn course(&self, steps: u16) -> Vec<f32> {
        let (tour, ends) = (self.shown.walk.tour, self.shown.ends.len());
        let [first, last] = [0, tour.frames(ends) - 1].map(|frame| tour.place(frame, ends));
        let share = |step: u16| f32::from(step) / f32::from(steps.max(2) - 1);
        (0..steps).map(|step| first + (last - first) * share(step)).collect()
    }

    /// The places of so many steps.
    pub(super) fn places(&self, steps: u16) -> Result<Vec<Place>> {
        let (tour, ends) = (self.shown.walk.tour, self.shown.ends.len());
        let course = self.course(steps);
        let given = |at: &f32| match tour {
            Tour::Beyond if ends == 2 => at.to_string(),
            _ => {
                let weights = tour.weights(*at, ends);
                weights.as_slice().iter().map(f32::to_string).collect::<Vec<_>>().join(",")
            }
        };
        // From end to end the command line goes the same way, to the last bit.
        let found = match tour {
            Tour::Along => samples(ends, &[], Some(steps))?,
            Tour::Beyond | Tour::Around => samples(ends, &course.iter().map(given).collect::<Vec<_>>(), None)?,
        };
        let place = |(at, sample): (f32, Sample)| Place { at, heading: sample.heading(), plain: sample.weights };
        Ok(course.into_iter().zip(found).map(place).collect())
    }
}

impl Exporter {
    /// The weights that a method's path, which is prepared, has at a place: those of its clock where it has one.
    pub(super) fn weights(&self, method: &'static str, shown: &Request, place: &Place) -> Weights {
        let t = (shown.walk.tour != Tour::Around).then_some(place.at);
        self.office.paths.weights(&shown.key(method), t, &place.plain)
    }
}
