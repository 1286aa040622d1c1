//! Walks between materials: detours, ends alike and far apart, beyond the ends, chains, many ends, and what nature allows.

mod pairs;
mod screen;
mod walks;

use anyhow::Result;
use nbrdf_core::stress::{Group, Hazard};
use nbrdf_core::{Database, Interpolation, Material};

use super::{Cell, Setup};
use crate::catalog::INTERPOLATIONS;

const DETOUR: &str = "way from end to middle to end, over the distance of the ends";

pub(super) const WORST_PAIR: Hazard = Hazard {
    name: "worst_pair",
    group: Group::Paths,
    title: "The worst of all pairs of MERL materials: screened by log values, the worst of them by ΔE_ITP of spheres",
    measure: DETOUR,
    holds: 1.25,
    fails: 2.0,
};
pub(super) const FAR_ENDS: Hazard =
    Hazard { name: "far_ends", title: "The hundredth part of all pairs whose ends are farthest apart", ..WORST_PAIR };
pub(super) const EQUAL_ENDS: Hazard = Hazard {
    name: "equal_ends",
    title: "The same material at both ends: nothing may change between",
    measure: "largest log_error against the method's own end",
    holds: 1e-4,
    fails: 5e-3,
    ..WORST_PAIR
};
pub(super) const EXTRAPOLATION: Hazard = Hazard {
    name: "extrapolation",
    title: "Half the way beyond either end",
    measure: "largest albedo, over that of the ends where it is above 1",
    holds: 1.001,
    fails: 1.05,
    ..WORST_PAIR
};
pub(super) const CHAIN: Hazard = Hazard {
    name: "chain",
    title: "A to B to C to A four times, every stop taken for a new material: does it come back?",
    measure: "log_error of the last A against the first",
    holds: 0.01,
    fails: 0.03,
    ..WORST_PAIR
};
pub(super) const MANY: Hazard = Hazard {
    name: "many",
    title: "Six materials in equal parts",
    measure: "mean distance from the ends, over that of the ends from each other",
    // Doing nothing, at one of the ends, is 5/6.
    holds: 0.84,
    fails: 1.0,
    ..WORST_PAIR
};
pub(super) const BETWEEN: [Hazard; 3] = [
    Hazard {
        name: "between_energy",
        title: "Half-way: no more light may leave than arrives",
        measure: "largest albedo, over that of the ends where it is above 1",
        holds: 1.001,
        fails: 1.05,
        ..WORST_PAIR
    },
    Hazard {
        name: "between_reciprocity",
        title: "Half-way: light and view exchanged must give the same",
        measure: "mean |f(i, o) − f(o, i)| / mean f",
        holds: 0.05,
        fails: 0.2,
        ..WORST_PAIR
    },
    Hazard {
        name: "between_negative",
        title: "Half-way: reflectance below zero, before it is clamped",
        measure: "share of directions",
        holds: 0.001,
        fails: 0.05,
        ..WORST_PAIR
    },
];

/// All of them.
pub(super) const HAZARDS: [Hazard; 9] = {
    let [energy, reciprocity, negative] = BETWEEN;
    [WORST_PAIR, FAR_ENDS, EQUAL_ENDS, EXTRAPOLATION, CHAIN, MANY, energy, reciprocity, negative]
};

/// Cells of all interpolations.
pub(super) fn cells(setup: &Setup, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
    let ends = merl(setup)?;
    let entries: Vec<_> = INTERPOLATIONS.iter().filter(|entry| setup.wants_method(entry.name)).collect();
    let mut cells = Vec::new();
    let screening = screen::Screening::new(setup, &ends);
    for entry in entries {
        done(entry.name)?;
        let method = entry.build(setup.catalog)?;
        let walker = Walker { setup, method: method.as_ref(), ends: &ends, done };
        if setup.wants(&WORST_PAIR) || setup.wants(&FAR_ENDS) {
            cells.extend(screening.cells(&walker)?);
        }
        cells.extend(walks::cells(&walker)?);
    }
    Ok(cells)
}

/// A method, and the materials it walks between.
struct Walker<'a> {
    setup: &'a Setup<'a>,
    method: &'a dyn Interpolation,
    ends: &'a [Material],
    done: &'a (dyn Fn(&str) -> Result<()> + Sync),
}

/// MERL materials by name, evenly picked.
pub(super) fn merl(setup: &Setup) -> Result<Vec<Material>> {
    let reference = setup.catalog.reference();
    let is_merl = |material: &&Material| Database::of(&material.name) == Database::Merl;
    let mut merl: Vec<&Material> = reference.materials.iter().filter(is_merl).collect();
    if merl.len() < 6 {
        return Err(reference.lacks("six MERL materials or more to walk between", merl.len()));
    }
    merl.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(merl.iter().step_by(merl.len().div_ceil(setup.extent.ends)).map(|&material| material.clone()).collect())
}
