//! What can go wrong, and what is still right.

use serde::{Deserialize, Serialize};

/// Kinds of hazards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    /// Where a material is looked at.
    Directions,
    /// Codes and weights that are out of the ordinary.
    Numbers,
    /// Measurements that are not what they should be.
    Data,
    /// What materials and nature allow.
    Physics,
    /// What is learned from.
    Learning,
    /// Walks between materials.
    Paths,
}

impl Group {
    /// All, in the order of reports.
    pub const ALL: [Self; 6] =
        [Self::Directions, Self::Numbers, Self::Data, Self::Physics, Self::Learning, Self::Paths];

    /// Name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Directions => "directions",
            Self::Numbers => "numbers",
            Self::Data => "data",
            Self::Physics => "physics",
            Self::Learning => "learning",
            Self::Paths => "paths",
        }
    }
}

/// Something that methods are exposed to. The value that tells how they bear it is not negative, and larger is worse.
#[derive(Debug)]
pub struct Hazard {
    /// Name on the command line and in reports.
    pub name: &'static str,
    /// Its kind.
    pub group: Group,
    /// What happens, for people.
    pub title: &'static str,
    /// What the value is, with its unit.
    pub measure: &'static str,
    /// Largest value at which a method holds.
    pub holds: f64,
    /// Largest value at which it degrades; beyond, it fails.
    pub fails: f64,
}

/// How a method bears a hazard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// As if nothing had happened.
    Holds,
    /// Says that it cannot: an error instead of a wrong answer.
    Refuses,
    /// Worse, but of use.
    Degrades,
    /// Of no use.
    Fails,
}

impl Verdict {
    /// All, the best first.
    pub const ALL: [Self; 4] = [Self::Holds, Self::Refuses, Self::Degrades, Self::Fails];

    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Refuses => "refuses",
            Self::Degrades => "degrades",
            Self::Fails => "fails",
        }
    }
}

impl Hazard {
    /// Of a value; what is no number fails.
    pub fn verdict(&self, value: f64) -> Verdict {
        match value {
            value if value <= self.holds => Verdict::Holds,
            value if value <= self.fails => Verdict::Degrades,
            _ => Verdict::Fails,
        }
    }
}

/// Relative errors of which a renderer's user sees nothing or little: within a fifth.
pub(crate) const WITHIN_A_FIFTH: f64 = 0.182;
/// Off by a factor of two.
pub(crate) const BY_HALF: f64 = 0.693;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_larger_the_worse_and_no_number_fails() {
        let hazard = Hazard { name: "h", group: Group::Data, title: "", measure: "", holds: 0.0, fails: 1.0 };
        let verdicts = [0.0, 1e-9, 1.0, 1.1, f64::INFINITY, f64::NAN].map(|value| hazard.verdict(value));
        use Verdict::{Degrades, Fails, Holds};
        assert_eq!(verdicts, [Holds, Degrades, Degrades, Fails, Fails, Fails]);
    }
}
