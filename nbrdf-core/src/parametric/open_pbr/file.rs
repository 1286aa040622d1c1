//! MaterialX files with one `open_pbr_surface`.

use roxmltree::{Document, Node};

use super::{COAT_IOR, OpenPbr};
use crate::Rgb;
use crate::parametric::written::{INDEX, SHARE, color, number, refused, sentence};
use crate::parametric::{FileError, FitErrors};

impl OpenPbr {
    /// A `.mtlx` file: a `surfacematerial` with an `open_pbr_surface`; the fit's figures are in its `doc`.
    pub fn write(&self, name: &str, errors: &FitErrors) -> Vec<u8> {
        let identifier = identifier(name);
        let doc = escaped(&format!("A fit of {name}: {}", sentence(errors)));
        let float = |name: &str, value: f32| input(name, "float", number(value).to_string());
        let color3 = |name: &str, value: Rgb| input(name, "color3", color(value).map(|v| v.to_string()).join(", "));
        let inputs = [
            color3("base_color", self.base_color),
            float("base_metalness", self.metalness),
            float("base_diffuse_roughness", self.diffuse_roughness),
            color3("specular_color", self.specular_color),
            float("specular_roughness", self.roughness),
            float("specular_ior", self.ior),
            float("coat_weight", self.coat),
            float("coat_roughness", self.coat_roughness),
            float("coat_ior", COAT_IOR),
            float("coat_darkening", 0.0),
        ];
        let text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <materialx version=\"1.39\" colorspace=\"lin_rec709\">\n  \
             <open_pbr_surface name=\"{identifier}_surface\" type=\"surfaceshader\" doc=\"{doc}\">\n{}  \
             </open_pbr_surface>\n  \
             <surfacematerial name=\"{identifier}\" type=\"material\">\n    \
             <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"{identifier}_surface\" />\n  \
             </surfacematerial>\n\
             </materialx>\n",
            inputs.concat()
        );
        text.into_bytes()
    }

    /// The first `open_pbr_surface` of a `.mtlx` file; what it leaves out is as the specification says, what this model
    /// has no term for is not looked at.
    ///
    /// # Errors
    /// [`FileError`]: no XML, no such surface, or inputs that are no numbers.
    pub fn read(bytes: &[u8]) -> Result<Self, FileError> {
        let text = std::str::from_utf8(bytes).map_err(|error| FileError::new("a .mtlx file", error))?;
        let document = Document::parse(text).map_err(|error| FileError::new("a .mtlx file", error))?;
        let surface = document.descendants().find(|node| node.has_tag_name("open_pbr_surface"));
        let surface = surface.ok_or_else(|| FileError::new("an open_pbr_surface", "none"))?;
        let within = |name: &str, without: f32, range: [f32; 2]| -> Result<f32, FileError> {
            Ok(numbers::<1>(surface, name, range)?.map_or(without, |[value]| value))
        };
        let float = |name: &str, without: f32| within(name, without, SHARE);
        let color3 = |name: &str, without: f32| -> Result<Rgb, FileError> {
            Ok(Rgb(numbers(surface, name, SHARE)?.unwrap_or([without; 3])))
        };
        Ok(Self {
            base_color: color3("base_color", 0.8)?,
            metalness: float("base_metalness", 0.0)?,
            roughness: float("specular_roughness", 0.3)?,
            diffuse_roughness: float("base_diffuse_roughness", 0.0)?,
            specular_color: color3("specular_color", 1.0)?,
            ior: within("specular_ior", 1.5, INDEX)?,
            coat: float("coat_weight", 0.0)?,
            coat_roughness: float("coat_roughness", 0.0)?,
        })
    }
}

fn input(name: &str, kind: &str, value: String) -> String {
    format!("    <input name=\"{name}\" type=\"{kind}\" value=\"{value}\" />\n")
}

/// Numbers of an input, each within a range, if the surface has it.
fn numbers<const N: usize>(surface: Node, name: &str, range: [f32; 2]) -> Result<Option<[f32; N]>, FileError> {
    let input = surface.children().find(|node| node.has_tag_name("input") && node.attribute("name") == Some(name));
    let Some(input) = input else { return Ok(None) };
    let value = input.attribute("value").unwrap_or_default();
    let number = |part: &str| part.trim().parse::<f32>().ok().filter(|v| (range[0]..=range[1]).contains(v));
    let found: Option<Vec<f32>> = value.split(',').map(number).collect();
    let found = found.and_then(|found| <[f32; N]>::try_from(found).ok());
    let what = if N == 1 { "a number" } else { "three numbers" };
    found.map(Some).ok_or_else(|| refused(what, name, range, format!("'{value}'")))
}

/// A name as MaterialX allows it: letters of English, digits, underscores.
fn identifier(name: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let name: String = name.chars().map(plain).collect();
    if name.starts_with(|first: char| first.is_ascii_alphabetic()) { name } else { format!("material_{name}") }
}

fn escaped(text: &str) -> String {
    let printed: String = text.chars().filter(|letter| !letter.is_control()).collect();
    printed.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
