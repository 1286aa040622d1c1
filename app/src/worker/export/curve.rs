//! Figures all along the paths, as a table.

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use nbrdf_core::metric::{albedo_max, reciprocity};
use nbrdf_core::path::mix::Mix;
use nbrdf_core::render::{Light, METRIC_SIZE, Sphere};
use nbrdf_core::{Brdf, Interpolation as _};

use super::Exporter;
use super::job::Job;
use crate::worker::figures::Seen;

impl Exporter {
    /// One line for each place of each method's path, on a whole sphere and through the clip curve, as all figures.
    pub(super) fn curve(&self, job: &Job, steps: u16) -> Result<Vec<(PathBuf, Vec<u8>)>> {
        let shown = &job.shown;
        // Light from all around is too grainy for figures.
        let light = super::painter::lamps(shown.scenery.lighting).unwrap_or_else(Light::studio);
        let sphere = Sphere::new(METRIC_SIZE, &light);
        let gain = shown.exposure.exp2();
        let look = |brdf: &dyn Brdf| {
            let mut seen = Seen::default();
            seen.look(&sphere.render(brdf), gain, sphere.covered());
            seen
        };
        let ends = self.ends(shown)?;
        let seen_ends: Vec<Seen> = ends.iter().map(|end| look(end.brdf.as_ref())).collect();
        let mix = Mix::Linear.between(&ends)?;
        let places = job.places(steps)?;
        let mut text = head(ends.len());
        for (row, &method) in shown.methods.iter().enumerate() {
            let path = self.path(method, shown)?;
            for (step, place) in places.iter().enumerate() {
                self.advance(row * places.len() + step, shown.methods.len() * places.len())?;
                let weights = self.weights(method, shown, place);
                let brdf = path.at(&weights)?;
                // As in the window, the mix is walked by no clock.
                let mixed = look(mix.at(&place.plain)?.as_ref());
                let figures = look(brdf.as_ref()).compare(&mixed, &seen_ends, None, sphere.covered());
                write!(text, "{method},{}", place.at)?;
                weights.as_slice().iter().try_for_each(|weight| write!(text, ",{weight}"))?;
                let (nearest, to_nearest) = figures.nearest;
                writeln!(
                    text,
                    ",{},{},{},{to_nearest},{},{},{}",
                    figures.psnr,
                    figures.to_mix,
                    letter(nearest),
                    figures.hue,
                    albedo_max(brdf.as_ref()),
                    reciprocity(brdf.as_ref()),
                )?;
            }
        }
        Ok(vec![(job.file("csv"), text.into_bytes())])
    }
}

/// Names of the columns, with units where there are any.
fn head(ends: usize) -> String {
    let weights: String = (0..ends).map(|end| format!(",weight_{}", letter(end))).collect();
    format!(
        "method,t{weights},psnr_to_mix_db,delta_e_itp_to_mix,nearest_end,delta_e_itp_to_nearest,hue_detour_uv,\
         albedo_max,reciprocity\n"
    )
}

/// The letter of an end, as in the window.
fn letter(end: usize) -> char {
    char::from(b'A' + (end % 26) as u8)
}
