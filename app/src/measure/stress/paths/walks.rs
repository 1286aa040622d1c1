//! Single walks: equal ends, beyond the ends, chains, many ends, and half-way against what nature allows.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric, albedo_max, negative_share, reciprocity};
use nbrdf_core::path::PathError;
use nbrdf_core::stress::Hazard;
use nbrdf_core::{Brdf, Material, Nbrdf, Warning, Weights};
use rayon::prelude::*;

use super::super::Cell;
use super::super::picture::View;
use super::super::tally::{Look, Tally};
use super::pairs::{pairs, sixes, triples};
use super::{BETWEEN, CHAIN, EQUAL_ENDS, EXTRAPOLATION, MANY, Walker};
use crate::measure::guard;

/// Rounds of a chain.
const ROUNDS: usize = 4;
/// How far beyond the ends.
const BEYOND: [f32; 2] = [-0.5, 1.5];

/// A walk: its value, what it looks like, and what is said of it.
type Walked = (f64, Vec<Arc<dyn Brdf>>, Vec<Warning>);

/// All cells of a method but those of the screening.
pub(super) fn cells(walker: &Walker) -> Result<Vec<Cell>> {
    let pairs = pairs(walker.ends, walker.setup.extent.pairs);
    let few: Vec<Vec<Material>> = pairs.iter().take(walker.setup.extent.few * 4).cloned().collect();
    let equal: Vec<Vec<Material>> = few.iter().map(|pair| vec![pair[0].clone(), pair[0].clone()]).collect();
    let [energy, reciprocity, negative] = &BETWEEN;
    let mut cells = walker.cells(&[&EQUAL_ENDS], &equal, &|walker, ends| Ok(vec![walker.equal(ends)?]))?;
    cells.extend(
        walker.cells(&[&CHAIN], &triples(walker.ends, few.len()), &|walker, ends| Ok(vec![walker.chain(ends)?]))?,
    );
    cells.extend(walker.cells(&[&MANY], &sixes(walker.ends, few.len()), &|walker, ends| Ok(vec![walker.many(ends)?]))?);
    let physical = [&EXTRAPOLATION, energy, reciprocity, negative];
    cells.extend(walker.cells(&physical, &pairs, &|walker, ends| walker.physical(ends))?);
    Ok(cells)
}

/// Albedo that is no more than that of the ends.
fn allowed(ends: &[Material]) -> f64 {
    ends.iter().map(|end| albedo_max(end.brdf.as_ref())).fold(1.0, f64::max)
}

/// Walks once, for several hazards.
type Walk<'a> = &'a (dyn Fn(&Walker, &[Material]) -> Result<Vec<Walked>, PathError> + Sync);

impl Walker<'_> {
    fn cells(&self, hazards: &[&Hazard], all: &[Vec<Material>], walk: Walk) -> Result<Vec<Cell>> {
        if !hazards.iter().any(|hazard| self.setup.wants(hazard)) {
            return Ok(Vec::new());
        }
        let mut tallies: Vec<Tally> = hazards.iter().map(|hazard| Tally::new(hazard)).collect();
        for some in all.chunks(16) {
            (self.done)(&format!("{}, {}", self.method.name(), hazards[0].name))?;
            let walked: Vec<_> = some.par_iter().map(|ends| walk(self, ends)).collect();
            for (ends, walked) in some.iter().zip(walked) {
                let names: Vec<&str> = ends.iter().map(|end| end.name.as_str()).collect();
                let name = names.join(" > ");
                match walked {
                    Ok(walked) => {
                        for (tally, (value, panels, warnings)) in tallies.iter_mut().zip(walked) {
                            tally.add(&name, value, || {
                                let panels = panels.into_iter().map(|brdf| (String::new(), brdf)).collect();
                                (Look { panels, view: View::Walk }, warnings)
                            });
                        }
                    }
                    Err(error) => tallies.iter_mut().for_each(|tally| tally.refuse(&name, &error.to_string())),
                }
            }
        }
        let wanted = tallies.into_iter().zip(hazards).filter(|(_, hazard)| self.setup.wants(hazard));
        Ok(wanted.filter_map(|(tally, _)| tally.cell(self.method.name(), None)).collect())
    }

    fn equal(&self, ends: &[Material]) -> Result<Walked, PathError> {
        let path = self.method.between(ends)?;
        let start: Arc<dyn Brdf> = Arc::from(path.at(&Weights::two(0.0))?);
        let mut worst = (0.0, Arc::clone(&start));
        for t in [0.25, 0.5, 0.75, 1.0] {
            let point = path.at(&Weights::two(t))?;
            let error = LogError.distance(start.as_ref(), point.as_ref());
            if error > worst.0 || error.is_nan() {
                worst = (error, Arc::from(point));
            }
        }
        Ok((worst.0, vec![start, worst.1], path.warnings(&Weights::two(0.5))?))
    }

    /// Beyond the ends and half-way, against what nature allows.
    fn physical(&self, ends: &[Material]) -> Result<Vec<Walked>, PathError> {
        let path = self.method.between(ends)?;
        let limit = allowed(ends);
        let point = |t: f32| -> Result<(Arc<dyn Brdf>, Vec<Warning>), PathError> {
            let weights = Weights::two(t);
            let point: Arc<dyn Brdf> = Arc::from(path.at(&weights)?);
            let said = path.warnings(&weights)?.into_iter().chain(guard::of_reflectance(point.as_ref()));
            Ok((Arc::clone(&point), said.collect()))
        };
        let look =
            |point: &Arc<dyn Brdf>| vec![Arc::clone(&ends[0].brdf), Arc::clone(point), Arc::clone(&ends[1].brdf)];
        let brightness = |point: &Arc<dyn Brdf>| albedo_max(point.as_ref()) / limit;
        let beyond = BEYOND.into_iter().map(|t| {
            let (point, said) = point(t)?;
            Ok((brightness(&point), look(&point), said))
        });
        let beyond = beyond.collect::<Result<Vec<Walked>, PathError>>()?;
        // What is no number is worst.
        let badness = |walked: &Walked| if walked.0.is_nan() { f64::INFINITY } else { walked.0 };
        let worst = beyond.into_iter().max_by(|a, b| badness(a).total_cmp(&badness(b)));
        let (middle, said) = point(0.5)?;
        let figures = [brightness(&middle), reciprocity(middle.as_ref()), negative_share(middle.as_ref())];
        let between = figures.map(|figure| (figure, look(&middle), said.clone()));
        Ok(worst.into_iter().chain(between).collect())
    }

    /// From stop to stop, and every stop is a new material of a new name.
    fn chain(&self, ends: &[Material]) -> Result<Walked, PathError> {
        let mut stops = ends.to_vec();
        let mut here = 0;
        let mut said = Vec::new();
        for step in 1..=ROUNDS * ends.len() {
            let next = step % ends.len();
            let path = self.method.between(&[stops[here].clone(), stops[next].clone()])?;
            let there = path.at(&Weights::two(1.0))?;
            let name = format!("{}, stop {step}", ends[next].name);
            stops[next] = stop(name, there);
            here = next;
            said = path.warnings(&Weights::two(1.0))?;
        }
        let (first, last) = (&ends[0].brdf, &stops[0].brdf);
        let error = LogError.distance(first.as_ref(), last.as_ref());
        said.extend(guard::of_reflectance(last.as_ref()));
        Ok((error, vec![Arc::clone(first), Arc::clone(last)], said))
    }

    fn many(&self, ends: &[Material]) -> Result<Walked, PathError> {
        let path = self.method.between(ends)?;
        let weights = Weights::normalized(vec![1.0; ends.len()])?;
        let middle: Arc<dyn Brdf> = Arc::from(path.at(&weights)?);
        let distance = |a: &dyn Brdf, b: &dyn Brdf| LogError.distance(a, b);
        let outwards = ends.iter().map(|end| distance(end.brdf.as_ref(), middle.as_ref())).sum::<f64>();
        let mut apart = (0.0, 0.0);
        for (i, a) in ends.iter().enumerate() {
            for b in &ends[i + 1..] {
                apart = (apart.0 + distance(a.brdf.as_ref(), b.brdf.as_ref()), apart.1 + 1.0);
            }
        }
        let own = ends.iter().map(|end| Arc::clone(&end.brdf));
        let said = path.warnings(&weights)?.into_iter().chain(guard::of_reflectance(middle.as_ref())).collect();
        Ok((outwards / ends.len() as f64 / (apart.0 / apart.1), own.chain([middle]).collect(), said))
    }
}

/// A stop as a material: a network where it is one, and else what it is.
fn stop(name: String, brdf: Box<dyn Brdf>) -> Material {
    let any: &dyn std::any::Any = brdf.as_ref();
    match any.downcast_ref::<Nbrdf>() {
        Some(network) => Material::from_network(name, network.clone()),
        None => Material::new(name, Arc::from(brdf)),
    }
}
