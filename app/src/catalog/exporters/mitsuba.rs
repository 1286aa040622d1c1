//! Tables for Mitsuba's plugin `measured`, with a scene to begin with.

use std::fmt::Write as _;
use std::sync::Arc;

use nbrdf_core::render::Light;
use nbrdf_core::rgl::{RglTable, tabulated_within};

use super::entry::first;
use super::{ExporterEntry, Needs};

/// Share of the light of a sphere that may be in another place.
const TOLERANCE: f64 = 0.01;

/// A table as in the RGL database, as fine as its error asks for, and a scene.
pub(super) const BSDF: ExporterEntry = ExporterEntry {
    name: "bsdf",
    extension: "bsdf",
    about: "a table for Mitsuba 3's plugin `measured` as in the RGL database, within 1 %, 0.9 to 57 MB, and a scene .xml",
    needs: Needs::Reflectance,
    convention: "f_r [1/sr] times the cosine of the light, linear RGB, at warped half vectors; jacobian 0",
    tolerance: Some(TOLERANCE),
    ends: &[".bsdf", ".xml"],
    write: |subject, stem| {
        if subject.changes_when_turned() {
            return Ok(None);
        }
        let material = subject.material;
        let table = tabulated_within(material.brdf.as_ref(), TOLERANCE, &material.name);
        Ok(Some(vec![table.file, scene(stem).into_bytes()]))
    },
    read: |files, _| Ok(Arc::new(RglTable::parse(first(files))?)),
};

/// The sphere of `nbrdf render` under the lamps of `studio`.
fn scene(stem: &str) -> String {
    let mut lamps = String::new();
    for lamp in Light::studio().lamps {
        let ([x, y, z], [r, g, b]) = ((-lamp.direction).to_array(), lamp.irradiance.0);
        let _ = write!(
            lamps,
            "    <emitter type=\"directional\">\n        <vector name=\"direction\" x=\"{x}\" y=\"{y}\" z=\"{z}\"/>\n        \
             <rgb name=\"irradiance\" value=\"{r}, {g}, {b}\"/>\n    </emitter>\n"
        );
    }
    format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<!-- mitsuba -m scalar_rgb {name}.xml
     The sphere of `nbrdf render` under the lamps of its light `studio`. Mitsuba draws one of the lamps for each sample: where
     highlights are sharp, give it more (-Dsamples=1024). For light from all around, put
     <emitter type="envmap"><string name="filename" value="map.exr"/></emitter> in their place. -->
<scene version="3.0.0">
    <default name="size" value="512"/>
    <default name="samples" value="64"/>
    <integrator type="path">
        <integer name="max_depth" value="2"/>
    </integrator>
    <sensor type="orthographic">
        <transform name="to_world">
            <lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/>
        </transform>
        <sampler type="independent">
            <integer name="sample_count" value="$samples"/>
        </sampler>
        <film type="hdrfilm">
            <integer name="width" value="$size"/>
            <integer name="height" value="$size"/>
            <rfilter type="box"/>
        </film>
    </sensor>
    <shape type="sphere">
        <float name="radius" value="0.99"/>
        <bsdf type="measured">
            <string name="filename" value="{name}.bsdf"/>
        </bsdf>
    </shape>
{lamps}</scene>
"#,
        name = escaped(stem),
    )
}

/// As it stands in an attribute; in a comment two hyphens would end it.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(escape).collect::<String>().replace("--", "-&#45;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_has_the_lamps_of_the_studio_and_names_that_xml_can_hold() {
        let text = scene("a<b>--\"c\"");
        assert_eq!(text.matches("<emitter type=\"directional\">").count(), Light::studio().lamps.len());
        assert!(text.contains("value=\"a&lt;b&gt;-&#45;&quot;c&quot;.bsdf\""), "{text}");
        assert!(!text.contains("a<b>") && !text.contains("--\""));
    }
}
