//! Which materials may be learned from, chosen on, and reported on (PROTOCOL, "Splits").
//!
//! Membership follows from the place of a name in its database's sorted list of standard names, so that it is the
//! same in a library that holds only some of them.

use serde::{Deserialize, Serialize};

use crate::database::Database;

/// What a material is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Split {
    /// Learned from.
    Train,
    /// A training material set aside while choices are made (MERL, index mod 5 = 4).
    Validation,
    /// Never seen by anything learned; figures are reported on these (MERL, index mod 5 = 2; RGL, index mod 4 = 1).
    HeldOut,
}

impl Split {
    /// The split of a material's name. Names outside the standard sets are for training.
    ///
    /// ```
    /// use nbrdf_core::split::Split;
    /// assert_eq!(Split::of("aluminium"), Split::HeldOut);
    /// assert_eq!(Split::of("my-paint"), Split::Train);
    /// ```
    pub fn of(name: &str) -> Self {
        let database = Database::of(name);
        let Ok(index) = database.names().binary_search(&name) else {
            return Self::Train;
        };
        match (database, index % 5, index % 4) {
            (Database::Merl, 2, _) | (Database::Rgl, _, 1) => Self::HeldOut,
            (Database::Merl, 4, _) => Self::Validation,
            _ => Self::Train,
        }
    }

    /// Whether a learner may see the material once choices are made: [`Train`](Self::Train) and
    /// [`Validation`](Self::Validation).
    pub const fn is_training(self) -> bool {
        !matches!(self, Self::HeldOut)
    }

    /// Whether a learner may see the material now: while choices are made (`validating`) [`Train`](Self::Train) alone,
    /// afterwards all that [is for training](Self::is_training).
    pub const fn is_learned_from(self, validating: bool) -> bool {
        if validating { matches!(self, Self::Train) } else { self.is_training() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::database::{MERL, RGL};

    fn count(names: &[&str], split: Split) -> usize {
        names.iter().filter(|name| Split::of(name) == split).count()
    }

    #[test]
    fn twenty_of_merl_and_nine_of_rgl_are_held_out() {
        assert_eq!(count(&MERL, Split::HeldOut), 20);
        assert_eq!(count(&MERL, Split::Validation), 20);
        assert_eq!(count(&RGL, Split::HeldOut), 9);
        assert_eq!(count(&RGL, Split::Validation), 0);
    }

    #[test]
    fn splits_of_known_names_do_not_move() {
        for (name, split) in [
            ("alum-bronze", Split::Train),
            ("aluminium", Split::HeldOut),
            ("beige-fabric", Split::Validation),
            ("chrome", Split::HeldOut),
            ("chrome-steel", Split::Train),
            ("yellow-plastic", Split::Validation),
            ("rgl/acrylic_felt_green", Split::Train),
            ("rgl/acrylic_felt_pink", Split::HeldOut),
            ("rgl/paper_white", Split::HeldOut),
        ] {
            assert_eq!(Split::of(name), split, "{name}");
        }
    }
}
