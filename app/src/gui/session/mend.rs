//! A session from a file, put back into range: one that was edited by hand must not break the window.

use super::polygon::{corners, into_polygon};
use super::{Blend, LAMP, Look, MAX_EXPOSURE, MOST_ENDS, Session, TOLERANCES};
use crate::editor::MOST;
use crate::worker::Lighting;

impl Session {
    /// With everything in range that has one; what is in range stays as it is.
    #[must_use]
    pub fn mended(mut self) -> Self {
        self.blend.mend();
        self.blends.iter_mut().for_each(|kept| kept.blend.mend());
        self.look.mend();
        self.compare.divider = number(self.compare.divider, [0.0, 1.0], 0.5);
        self.pick.at = self.pick.at.map(|at| at.map(|along| number(along, [-1.0, 1.0], 0.0)));
        self.explored = self.explored.filter(|explored| explored.place.iter().all(|along| along.is_finite()));
        if !self.map.zoom.is_normal() || self.map.zoom < 0.0 || !self.map.centre.iter().all(|along| along.is_finite()) {
            self.map.reset();
        }
        let angles = [0.0, 90.0];
        self.figures.theta_i = number(self.figures.theta_i, angles, 45.0);
        self.figures.theta_d = number(self.figures.theta_d, angles, 0.0);
        let Self { files, origins, .. } = &mut self;
        origins.retain(|_, origin| files.contains(origin));
        let [low, high] = TOLERANCES;
        self.scene.tolerance = self.scene.tolerance.filter(|tolerance| (low..=high).contains(tolerance));
        self
    }
}

impl Blend {
    fn mend(&mut self) {
        self.ends.truncate(MOST_ENDS);
        let usual = Self::default();
        self.ends.extend(usual.ends.into_iter().skip(self.ends.len()));
        let [low, high] = self.range();
        self.t = number(self.t, [low, high], usual.t);
        self.edits = self.edits.map(|amount| number(amount, [-MOST, MOST], 0.0));
        let place = self.place.map(|along| number(along, [-1.0, 1.0], 0.0));
        self.place = into_polygon(place, &corners(self.ends.len().max(3)));
    }
}

impl Look {
    fn mend(&mut self) {
        self.exposure = number(self.exposure, [-MAX_EXPOSURE, MAX_EXPOSURE], 0.0);
        match &mut self.scenery.lighting {
            Lighting::Point(direction) => match direction.try_normalize() {
                Some(unit) => *direction = unit,
                None => self.scenery.lighting = LAMP,
            },
            Lighting::Around { turn, .. } => *turn = number(*turn, [-std::f32::consts::PI, std::f32::consts::PI], 0.0),
            Lighting::Studio => {}
        }
    }
}

/// Within a range; the usual one for what is no number.
fn number(found: f32, [low, high]: [f32; 2], usual: f32) -> f32 {
    if found.is_finite() { found.clamp(low, high) } else { usual }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Vec3;

    use super::*;
    use crate::gui::session::Way;

    #[test]
    fn what_is_in_range_stays_as_it_is() {
        let mut session = Session::default();
        session.blend.choose(2, "chrome");
        (session.blend.way, session.blend.place) = (Way::Polygon, [0.1, -0.2]);
        session.look.scenery.lighting = Lighting::Point(Vec3::new(0.0, 0.6, 0.8));
        assert_eq!(session.clone().mended(), session);
    }

    #[test]
    fn a_session_that_was_edited_by_hand_is_put_right() {
        let text = r#"{
            "blend": {"ends": ["chrome"], "t": 1e40, "place": [9.0, -1e40], "edits": [7, 0, 0, 0, 0, 0, -1e40]},
            "blends": [{"name": "none", "blend": {"ends": []}, "methods": []}],
            "look": {"exposure": -1e40, "scenery": {"lighting": {"Point": [0, 0, 0]}}},
            "compare": {"divider": 1e40},
            "map": {"zoom": 0},
            "figures": {"theta_i": 1e40},
            "scene": {"tolerance": -1}
        }"#;
        let session = serde_json::from_str::<Session>(text).unwrap().mended();
        assert_eq!(session.blend.ends, ["chrome", "blue-acrylic"]);
        assert_eq!((session.blend.t, session.blend.edits[0], session.blend.edits[6]), (0.5, 1.0, 0.0));
        assert_eq!(session.blends[0].blend.ends.len(), 2);
        assert_eq!((session.look.exposure, session.look.scenery.lighting), (0.0, LAMP));
        assert_eq!((session.compare.divider, session.map.zoom, session.figures.theta_i), (0.5, 1.0, 45.0));
        assert_eq!(session.scene.tolerance, None);
    }
}
