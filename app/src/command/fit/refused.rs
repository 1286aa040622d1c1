//! What a fit is refused for, before the work.

use anyhow::Result;
use nbrdf_core::extensions::listed;
use nbrdf_core::library::builtin;
use nbrdf_core::measured::{self, Measured};

use super::Fit;
use crate::failure::Failure;
use crate::input::{check_file, is_missing};
use crate::shell::quoted;

/// Azimuths of the half vector \[rad\] in a row that a list may leave out.
const LARGEST_GAP: f32 = 1.0;

impl Fit {
    /// Refuses a path at which there is nothing, and a name of the library, whose materials are networks already.
    pub(super) fn check_source(&self) -> Result<()> {
        let name = self.source.to_string_lossy();
        if is_missing(&self.source) && builtin::shared().get(&name).is_ok() {
            let name = quoted(&name);
            let found = format!(
                "{name}: expected a measurement, found a built-in material, which is a network: nothing to fit"
            );
            return Err(Failure::Usage(format!("{found}; `nbrdf export {name} --to npz -o OUT` writes it")).into());
        }
        check_file(&self.source, &format!("a measurement ({})", listed(&measured::EXTENSIONS)))
    }

    /// Refuses switches that this measurement has no use for.
    pub(super) fn check(&self, measured: &Measured) -> Result<()> {
        let refused = match measured {
            Measured::Somewhere(list) if self.leave_out.is_some_and(|n| list.len() < usize::from(n)) => {
                format!("--leave-out asks for more folds than the {} samples: choose fewer", list.len())
            }
            Measured::Somewhere(list) if self.anisotropic && list.largest_gap() > LARGEST_GAP => format!(
                "the samples leave {:.0} of 360 degrees of the half vector's azimuth out, where --anisotropic would have to guess: \
                 leave it out",
                list.largest_gap().to_degrees()
            ),
            Measured::Everywhere(_) | Measured::Turning(_) if self.leave_out.is_some() => {
                "--leave-out is for lists of samples: a table is fitted whole".to_owned()
            }
            _ => return Ok(()),
        };
        Err(Failure::Usage(refused).into())
    }
}
