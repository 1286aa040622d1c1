//! What the worker is asked for: what the panes have room for, if it is news.

use std::sync::Arc;

use super::Workbench;
use crate::gui::pane::Wanted;
use crate::gui::{Session, atlas};
use crate::worker::{Probe, Request};

/// Largest picture of a sphere in pixels; beyond, it is enlarged.
const MOST_PIXELS: usize = 640;
/// Where two alone are looked at.
const MOST_PIXELS_OF_TWO: usize = 768;
/// Of a frame of a film strip: the largest on a dense display.
const MOST_PIXELS_OF_FRAME: usize = 220;

impl Workbench {
    /// Asks for what is now to be seen, if that is news.
    pub(super) fn ask(&mut self, wanted: &Wanted, pixels_per_point: f32) {
        if let Some(inquiry) = wanted.inquiry.filter(|_| wanted.inquiry != self.inquired) {
            self.worker.inquire(inquiry);
            self.inquired = wanted.inquiry;
        }
        if !self.gallery.is_reopened {
            // Materials that the session is about may not be there yet.
            return;
        }
        let pixels = |points: f32| (points * pixels_per_point).round() as usize;
        let Session { blend, pick, .. } = &self.session;
        let closeup = self.session.closeup();
        let most = if closeup.is_some() { MOST_PIXELS_OF_TWO } else { MOST_PIXELS };
        // The same list as before costs nothing to compare and to share.
        let ends = match &self.asked {
            Some((_, before)) if *before.ends == *blend.ends => Arc::clone(&before.ends),
            _ => blend.ends.as_slice().into(),
        };
        let request = Request {
            walk: blend.walk(),
            size: pixels(wanted.side).clamp(16, most),
            strip: pixels(wanted.frame).min(MOST_PIXELS_OF_FRAME),
            closeup,
            ..self.session.shown_between(ends)
        };
        let probe = pick.at.filter(|_| wanted.is_point).map(|at| Probe::new(at, &request));
        if probe != self.probed {
            self.worker.probe(probe.clone());
            self.probed = probe;
        }
        if wanted.is_map || request.explored.is_some() {
            let map = atlas::request(&self.session, Arc::clone(&request.ends));
            if self.asked_map.as_ref() != Some(&map) {
                self.worker.map(map.clone());
                self.asked_map = Some(map);
            }
        }
        if self.asked.as_ref().is_none_or(|(_, before)| *before != request) {
            let number = self.worker.show(request.clone());
            self.asked = Some((number, request));
        }
        if wanted.is_measured != self.is_measured {
            self.worker.measure(wanted.is_measured);
            self.is_measured = wanted.is_measured;
        }
        let number = self.worker.plan(wanted.scene, self.session.scene.wish());
        number.into_iter().for_each(|number| self.gallery.scene.ask(number));
    }

    /// Asks for the figure that is seen, if that is news, and for the chart of all representations.
    pub(super) fn question(&mut self, wanted: &Wanted) {
        if let Some(is_charting) = wanted.is_charting {
            self.worker.chart(is_charting.then(|| self.session.blend.ends.as_slice().into()));
        }
        let Some(topic) = wanted.figure.clone() else { return };
        if !self.questioned.as_ref().is_some_and(|asked| self.session.still_asks(asked, &topic)) {
            let question = self.session.question(topic);
            self.worker.ask(question.clone());
            self.questioned = Some(question);
        }
    }
}
