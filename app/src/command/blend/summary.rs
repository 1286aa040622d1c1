//! The report of a blend.

use nbrdf_core::Material;
use serde_json::{Value, json};

use super::Blend;
use super::samples::Sample;
use super::walk::Walk;

impl Blend {
    /// The report as JSON.
    pub(super) fn json(&self, ends: &[Material], samples: &[Sample], walks: &[Walk]) -> Value {
        let method = |walk: &Walk| match &walk.result {
            Ok(walked) => {
                json!({
                    "name": walk.entry.name, "albedo_max": walked.albedo, "reciprocity": walked.reciprocity,
                    "distances": walked.distances, "warnings": walked.warnings,
                })
            }
            Err(error) => json!({"name": walk.entry.name, "failed": format!("{error:#}")}),
        };
        json!({
            "schema": 1,
            "materials": ends.iter().map(|end| &end.name).collect::<Vec<_>>(),
            "weights": samples.iter().map(|sample| sample.weights.as_slice()).collect::<Vec<_>>(),
            "light": self.light.light().name,
            "methods": walks.iter().map(method).collect::<Vec<_>>(),
            "output": self.output.display().to_string(),
            "code": self.code.as_ref().map(|path| path.display().to_string()),
        })
    }
}
