//! Which figure is shown, and of what.

mod channel;
mod quantity;
mod radius;

use serde::{Deserialize, Serialize};

pub use channel::Channel;
pub use quantity::Quantity;
pub use radius::Radius;

use super::{Blend, Session};
use crate::worker::{Question, Topic, Tour, Walk};

/// Which figure is shown, and of what.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FigureChoice {
    /// The figure.
    pub figure: Figure,
    /// What is shown over t.
    pub quantity: Quantity,
    /// Polar angle of the light of the lobe \[degrees\].
    pub theta_i: f32,
    /// What the radius of the lobe says.
    pub radius: Radius,
    /// Angle between light and half vector of the curve over θ_half \[degrees\].
    pub theta_d: f32,
    /// Of which channel.
    pub channel: Channel,
    /// The error of the chart of all representations, by its key in reports.
    pub metric: String,
}

impl Default for FigureChoice {
    fn default() -> Self {
        Self {
            figure: Figure::Along,
            quantity: Quantity::Psnr,
            theta_i: 45.0,
            radius: Radius::CubeRoot,
            theta_d: 0.0,
            channel: Channel::Luminance,
            metric: "studio_delta_e_itp".to_owned(),
        }
    }
}

/// A figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Figure {
    /// Curves over t.
    Along,
    /// The lobe in the plane of incidence.
    Lobe,
    /// f_r over θ_half.
    Half,
    /// Image slices.
    Slice,
    /// Albedo over the view.
    Albedo,
    /// What evaluation costs.
    Cost,
    /// What is to be said.
    Warnings,
}

impl Figure {
    /// All, in the order of their tabs: name, and what it shows.
    pub const ALL: [(Self, &'static str, &'static str); 7] = [
        (Self::Along, "Along t", "How good the paths are, from end to end"),
        (Self::Lobe, "Lobe", "Reflectance in the plane of incidence, as a polar plot"),
        (Self::Half, "θ_half", "Reflectance over the half vector's angle from the normal"),
        (Self::Slice, "Slices", "Reflectance over half and difference angles, as pictures"),
        (Self::Albedo, "Albedo", "The share of light that is reflected, over the view"),
        (Self::Cost, "Cost", "What evaluation costs, and what it buys"),
        (Self::Warnings, "Warnings", "What is to be said of the ends and of the points between"),
    ];

    /// What the worker is to find out.
    pub fn topic(self, choice: &FigureChoice, blend: &Blend, exposure: f32) -> Topic {
        let weights = || blend.weights();
        match self {
            Self::Along => Topic::Along { is_beyond: blend.is_beyond },
            Self::Lobe => Topic::Lobe { weights: weights(), theta_i: choice.theta_i },
            Self::Half => Topic::Half { weights: weights(), theta_d: choice.theta_d },
            Self::Slice => Topic::Slice { weights: weights(), exposure },
            Self::Albedo => Topic::Albedo { weights: weights() },
            Self::Cost => Topic::Cost,
            Self::Warnings => Topic::Warnings { weights: weights() },
        }
    }
}

impl Session {
    /// How paths are walked for a figure: whole paths are the same wherever one is on them, and are not edited.
    fn walked_for(&self, topic: &Topic) -> Walk {
        topic.weights().map_or_else(Walk::default, |_| Walk { tour: Tour::default(), ..self.blend.walk() })
    }

    /// What the worker is asked for a figure.
    pub fn question(&self, topic: Topic) -> Question {
        let Self { blend, methods, .. } = self;
        let walk = self.walked_for(&topic);
        Question { ends: blend.ends.as_slice().into(), methods: methods.0.clone(), timing: blend.timing, walk, topic }
    }

    /// Whether a question is the one that would be asked now.
    pub fn still_asks(&self, asked: &Question, topic: &Topic) -> bool {
        let Self { blend, methods, .. } = self;
        let walk = self.walked_for(topic);
        (&asked.topic, asked.timing, asked.walk, &asked.methods) == (topic, blend.timing, walk, &methods.0)
            && *asked.ends == *blend.ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::session::Methods;
    use crate::worker::Timing;

    #[test]
    fn only_what_is_of_one_point_depends_on_t() {
        let (choice, mut blend) = (FigureChoice::default(), Blend::default());
        let topics = |blend: &Blend| Figure::ALL.map(|(figure, ..)| figure.topic(&choice, blend, 0.0));
        let before = topics(&blend);
        blend.go_to(0.25);
        let after = topics(&blend);
        let changed: Vec<bool> = before.iter().zip(&after).map(|(before, after)| before != after).collect();
        assert_eq!(changed, [false, true, true, true, true, false, true]);
    }

    #[test]
    fn what_was_asked_of_another_path_is_not_what_is_asked_now() {
        let mut session = Session::default();
        let topics = |session: &Session| {
            [Figure::Lobe, Figure::Cost].map(|figure| figure.topic(&session.figures, &session.blend, 0.0))
        };
        let asked = topics(&session).map(|topic| session.question(topic));
        let still = |session: &Session| {
            let topics = topics(session);
            [0, 1].map(|at| session.still_asks(&asked[at], &topics[at]))
        };
        assert_eq!(still(&session), [true; 2]);
        session.blend.edits[0] = 0.25;
        assert_eq!(still(&session), [false, true], "only the figure of a point is edited");
        session.blend.edits[0] = 0.0;
        session.methods.0.pop();
        assert_eq!(still(&session), [false; 2]);
        session.methods = Methods::default();
        session.blend.timing = Timing::Even;
        assert_eq!(still(&session), [false; 2]);
    }
}
