//! glTF files: a sphere of the material, so that a viewer shows it at once.

mod sphere;

use serde_json::{Map, Value, json};

use super::GltfPbr;
use crate::Rgb;
use crate::parametric::written::{self, FACTOR, INDEX, SHARE, color, number, read_color, read_number};
use crate::parametric::{FileError, FitErrors};

const IOR: &str = "KHR_materials_ior";
const SPECULAR: &str = "KHR_materials_specular";
const CLEARCOAT: &str = "KHR_materials_clearcoat";
const SHEEN: &str = "KHR_materials_sheen";

impl GltfPbr {
    /// A `.gltf` file with a sphere of the material, everything in it; the fit's figures are the material's `extras`.
    pub fn write(&self, name: &str, errors: &FitErrors) -> Vec<u8> {
        let mut material = self.material();
        let used: Vec<String> =
            material["extensions"].as_object().map(|own| own.keys().cloned().collect()).unwrap_or_default();
        material["name"] = json!(name);
        material["extras"] = json!({ "source": name, "errors": written::errors(errors) });
        let mut file = sphere::file();
        file["materials"] = json!([material]);
        if !used.is_empty() {
            file["extensionsUsed"] = json!(used);
        }
        (file.to_string() + "\n").into_bytes()
    }

    /// The first material of a `.gltf` file; what it leaves out is as the specification says.
    ///
    /// # Errors
    /// [`FileError`]: no JSON, no material, or factors that are no numbers.
    pub fn read(bytes: &[u8]) -> Result<Self, FileError> {
        let file: Value = serde_json::from_slice(bytes).map_err(|error| FileError::new("a .gltf file", error))?;
        let material = &file["materials"][0];
        if !material.is_object() {
            return Err(FileError::new("a material", "none"));
        }
        let (core, extensions) = (&material["pbrMetallicRoughness"], &material["extensions"]);
        let white = Rgb::splat(1.0);
        Ok(Self {
            base_color: read_color(core, "baseColorFactor", white, SHARE)?,
            metallic: read_number(core, "metallicFactor", 1.0, SHARE)?,
            roughness: read_number(core, "roughnessFactor", 1.0, SHARE)?,
            ior: read_number(&extensions[IOR], "ior", 1.5, INDEX)?,
            specular: read_number(&extensions[SPECULAR], "specularFactor", 1.0, SHARE)?,
            specular_color: read_color(&extensions[SPECULAR], "specularColorFactor", white, FACTOR)?,
            clearcoat: read_number(&extensions[CLEARCOAT], "clearcoatFactor", 0.0, SHARE)?,
            clearcoat_roughness: read_number(&extensions[CLEARCOAT], "clearcoatRoughnessFactor", 0.0, SHARE)?,
            sheen_color: read_color(&extensions[SHEEN], "sheenColorFactor", Rgb::BLACK, SHARE)?,
            sheen_roughness: read_number(&extensions[SHEEN], "sheenRoughnessFactor", 0.0, SHARE)?,
        })
    }

    /// The material, with those extensions that change something.
    fn material(&self) -> Value {
        let [r, g, b] = color(self.base_color);
        let mut extensions = Map::new();
        if self.ior != 1.5 {
            extensions.insert(IOR.to_owned(), json!({ "ior": number(self.ior) }));
        }
        if self.specular != 1.0 || self.specular_color != Rgb::splat(1.0) {
            let own = json!({
                "specularFactor": number(self.specular),
                "specularColorFactor": color(self.specular_color),
            });
            extensions.insert(SPECULAR.to_owned(), own);
        }
        if self.clearcoat != 0.0 {
            let own = json!({
                "clearcoatFactor": number(self.clearcoat),
                "clearcoatRoughnessFactor": number(self.clearcoat_roughness),
            });
            extensions.insert(CLEARCOAT.to_owned(), own);
        }
        if self.sheen_color != Rgb::BLACK {
            let own = json!({
                "sheenColorFactor": color(self.sheen_color),
                "sheenRoughnessFactor": number(self.sheen_roughness),
            });
            extensions.insert(SHEEN.to_owned(), own);
        }
        let core = json!({
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": number(self.metallic),
            "roughnessFactor": number(self.roughness),
        });
        let mut material = json!({ "pbrMetallicRoughness": core });
        if !extensions.is_empty() {
            material["extensions"] = Value::Object(extensions);
        }
        material
    }
}
