//! A page with a sphere of the material.

use super::{Language, Shader, numbers, template};
use crate::render::{Lamp, Light};

/// The page of a material.
pub(super) fn of(shader: &Shader) -> String {
    let [first, second] = shader.hidden;
    template::fill(include_str!("page.html"), &|key| {
        Some(match key {
            "name" => escaped(&shader.name),
            "function" => shader.function(),
            "source" => shader.source(Language::Glsl),
            "lights" => lights(),
            "lamps" => all().map(|(_, light)| light.lamps.len()).max()?.to_string(),
            "version" => env!("CARGO_PKG_VERSION").to_owned(),
            "shape" => format!("6-{first}-{second}-3"),
            "sha256" => shader.weights_sha256()[..16].to_owned(),
            _ => return None,
        })
    })
}

/// The standard lights and their names.
fn all() -> impl Iterator<Item = (&'static str, Light)> {
    Light::NAMES.into_iter().filter_map(|name| Some((name, Light::by_name(name)?)))
}

/// The same as a JavaScript object: for each lamp its direction and its irradiance.
fn lights() -> String {
    let lamp = |lamp: &Lamp| {
        let six = lamp.direction.to_array().into_iter().chain(lamp.irradiance.0);
        format!("    [{}]", six.map(numbers::literal).collect::<Vec<_>>().join(", "))
    };
    let light = |(name, light): (&str, Light)| {
        let lamps: Vec<String> = light.lamps.iter().map(lamp).collect();
        format!("  {name}: [\n{}\n  ]", lamps.join(",\n"))
    };
    format!("{{\n{}\n}}", all().map(light).collect::<Vec<_>>().join(",\n"))
}

/// As text of a page, also between quotes.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;

    #[test]
    fn no_name_leaves_its_place_in_the_page() {
        let network = &builtin::shared().get("chrome").unwrap().network;
        let page = of(&Shader::new("a\"</script><b>@sha256@", network));
        assert!(page.contains("<h1>a&quot;&lt;/script&gt;&lt;b&gt;@sha256@</h1>"), "{}", &page[..600]);
        assert!(!page.contains("a\"<") && !page.contains("<b>"));
        assert_eq!(page.matches("<script").count(), page.matches("</script>").count());
    }

    #[test]
    fn every_place_is_filled_and_every_lamp_is_there() {
        let page = of(&Shader::new("chrome", &builtin::shared().get("chrome").unwrap().network));
        assert!(!page.contains('@'), "{:?}", page.split_once('@'));
        assert_eq!(lights().matches('[').count(), 2 + 1 + 11);
        assert!(page.contains("direction[11]") && page.contains("6-21-21-3"));
    }
}
