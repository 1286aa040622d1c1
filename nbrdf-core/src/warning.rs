//! What the library has to say about a result that it gives all the same.
//!
//! Errors are for what cannot be done; a warning goes with a result that is less than it seems. The command line tells them
//! (and takes them for errors with `--strict`), the app shows them, reports carry their kinds.

use serde::Serialize;

/// A reason to look twice.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Warning {
    /// A point of a walk that is beyond its ends.
    #[error("lies beyond the materials by {beyond:.2} of their distance: nothing was learned there")]
    Extrapolated {
        /// Sum of the negative weights.
        beyond: f32,
    },
    /// A point beyond the ends that was asked for, and would have been too bright.
    #[error(
        "energy clamped: {asked:.2} beyond the materials more light would leave than arrives, so the walk stops at {kept:.2}"
    )]
    EnergyClamped {
        /// Sum of the negative weights asked for.
        asked: f32,
        /// That of the point given.
        kept: f32,
    },
    /// More light leaves than arrives.
    #[error("albedo_max is {albedo_max:.3}: more light leaves than arrives")]
    EnergyGained {
        /// Largest directional albedo.
        albedo_max: f64,
    },
    /// Light and view exchanged give another reflectance.
    #[error("reciprocity is off by {reciprocity:.2}: light and view exchanged give another reflectance")]
    NotReciprocal {
        /// See [`reciprocity`](crate::metric::reciprocity).
        reciprocity: f64,
    },
    /// Mirror pairs, whose half vector is at the normal and has no azimuth.
    #[error("at mirror directions rounding decides between reflectances that are {ratio:.1} times apart")]
    Undecided {
        /// Largest over smallest of f + 0.001.
        ratio: f64,
    },
    /// Below zero before it is clamped.
    #[error("reflectance is below zero at {:.0} % of the directions and clamped there", 100.0 * share)]
    Negative {
        /// See [`negative_share`](crate::metric::negative_share).
        share: f64,
    },
    /// Measurements that do not tell the numbers that are asked of them.
    #[error("ill-conditioned: κ = {kappa:.0} from {samples} samples: measure more directions, or fit fewer numbers")]
    IllConditioned {
        /// Condition number.
        kappa: f64,
        /// Measured directions.
        samples: usize,
    },
    /// A code that is unlike those of the training materials.
    #[error("the code is {distance:.0} times as far from those of training as these are from each other")]
    FarFromTraining {
        /// 1 is how far training materials are from each other.
        distance: f64,
    },
    /// A code that does not carry its material.
    #[error(
        "{numbers} numbers do not carry this material: expected log_error {expected:.3}, and materials like those of training stay below {usual}"
    )]
    NotCarried {
        /// Numbers of the code.
        numbers: usize,
        /// Expected `log_error`.
        expected: f64,
        /// What codes of training materials stay below.
        usual: f64,
    },
    /// Values that no material of this kind has.
    #[error("out of range: {what} is {found:.3}, expected {low} {}", upper(*high))]
    OutOfRange {
        /// What was looked at.
        what: &'static str,
        /// Its value.
        found: f64,
        /// Smallest usual value.
        low: f64,
        /// Largest usual value.
        high: f64,
    },
}

impl Warning {
    /// Name of its kind in reports.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Extrapolated { .. } => "extrapolated",
            Self::EnergyClamped { .. } => "energy_clamped",
            Self::EnergyGained { .. } => "energy_gained",
            Self::NotReciprocal { .. } => "not_reciprocal",
            Self::Undecided { .. } => "undecided",
            Self::Negative { .. } => "negative",
            Self::IllConditioned { .. } => "ill_conditioned",
            Self::FarFromTraining { .. } => "far_from_training",
            Self::NotCarried { .. } => "not_carried",
            Self::OutOfRange { .. } => "out_of_range",
        }
    }
}

fn upper(high: f64) -> String {
    if high.is_finite() { format!("to {high}") } else { "or more".to_owned() }
}
