//! Tables of reflectances as files.

use std::sync::Arc;

use nbrdf_core::brdf::table::Lookup;
use nbrdf_core::merl::Merl;

use super::entry::first;
use super::{ExporterEntry, Needs};

/// A table as in the MERL database, which cannot say how a material changes when it is turned.
pub(super) const BINARY: ExporterEntry = ExporterEntry {
    name: "binary",
    extension: "binary",
    about: "a table of 90 × 90 × 180 cells as in the MERL database, 35 MB",
    needs: Needs::Reflectance,
    convention: "f_r [1/sr] times 1500 / (1, 1.15, 1.66) in red, green, blue, without the cosine; -1 below the horizon",
    tolerance: None,
    ends: &[".binary"],
    write: |subject, _| {
        let is_sayable = !subject.changes_when_turned();
        Ok(is_sayable.then(|| vec![Merl::tabulate(subject.material.brdf.as_ref()).to_bytes()]))
    },
    read: |files, _| {
        let table = Merl::parse(first(files))?;
        Ok(Arc::new(table.table(Lookup::Trilinear)))
    },
};
