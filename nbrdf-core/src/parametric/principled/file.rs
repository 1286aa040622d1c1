//! Principled values as JSON, and as a Python program that makes the node.

use serde_json::{Value, json};

use super::{COAT_IOR, Principled};
use crate::Rgb;
use crate::parametric::written::{self, INDEX, SHARE, color, number, read_color, read_number, sentence};
use crate::parametric::{FileError, FitErrors};

impl Principled {
    /// A `.json` file: `inputs` by the names of the node's sockets, colours with alpha, beside the fit's figures.
    pub fn write(&self, name: &str, errors: &FitErrors) -> Vec<u8> {
        let file = json!({
            "model": "Principled BSDF",
            "blender": "4.0 or newer",
            "distribution": "MULTI_GGX",
            "source": name,
            "errors": written::errors(errors),
            "inputs": self.inputs(),
        });
        format!("{file:#}\n").into_bytes()
    }

    /// A Python program for Blender that makes a material of this name and is a module with a function that does.
    pub fn write_python(&self, name: &str, errors: &FitErrors) -> Vec<u8> {
        // JSON of strings and numbers is Python.
        let (name, inputs) = (json!(name), self.inputs());
        let lines: Vec<String> = inputs
            .as_object()
            .into_iter()
            .flatten()
            .map(|(socket, value)| format!("    {}: {value},\n", json!(socket)))
            .collect();
        let text = format!(
            "# Makes a material of Blender's Principled BSDF (4.0 or newer): run it in the text editor.\n\
             # A fit: {}\n\
             import bpy\n\n\
             NAME = {name}\n\
             INPUTS = {{\n{}}}\n\n\n\
             def make(name=NAME, inputs=INPUTS):\n    \
             \"\"\"A new material whose surface is one Principled BSDF with these inputs.\"\"\"\n    \
             material = bpy.data.materials.new(name)\n    \
             material.use_nodes = True\n    \
             nodes, links = material.node_tree.nodes, material.node_tree.links\n    \
             nodes.clear()\n    \
             node = nodes.new(\"ShaderNodeBsdfPrincipled\")\n    \
             node.distribution = \"MULTI_GGX\"\n    \
             for socket, value in inputs.items():\n        \
             node.inputs[socket].default_value = value\n    \
             output = nodes.new(\"ShaderNodeOutputMaterial\")\n    \
             output.location = (300, 0)\n    \
             links.new(node.outputs[\"BSDF\"], output.inputs[\"Surface\"])\n    \
             return material\n\n\n\
             if __name__ == \"__main__\":\n    \
             make()\n",
            sentence(errors),
            lines.concat(),
        );
        text.into_bytes()
    }

    /// The values of a `.json` file.
    ///
    /// # Errors
    /// [`FileError`]: no JSON, no `inputs`, or inputs that are no numbers.
    pub fn read(bytes: &[u8]) -> Result<Self, FileError> {
        let file: Value = serde_json::from_slice(bytes).map_err(|error| FileError::new("a .json file", error))?;
        let inputs = &file["inputs"];
        if !inputs.is_object() {
            return Err(FileError::new("'inputs' of a Principled BSDF", "none"));
        }
        Ok(Self {
            base_color: read_color(inputs, "Base Color", Rgb::splat(0.8), SHARE)?,
            metallic: read_number(inputs, "Metallic", 0.0, SHARE)?,
            roughness: read_number(inputs, "Roughness", 0.5, SHARE)?,
            ior: read_number(inputs, "IOR", 1.5, INDEX)?,
            specular_tint: read_color(inputs, "Specular Tint", Rgb::splat(1.0), SHARE)?,
            coat: read_number(inputs, "Coat Weight", 0.0, SHARE)?,
            coat_roughness: read_number(inputs, "Coat Roughness", 0.03, SHARE)?,
        })
    }

    fn inputs(&self) -> Value {
        let with_alpha = |value: Rgb| {
            let [r, g, b] = color(value);
            [r, g, b, 1.0]
        };
        json!({
            "Base Color": with_alpha(self.base_color),
            "Metallic": number(self.metallic),
            "Roughness": number(self.roughness),
            "IOR": number(self.ior),
            "Specular IOR Level": 0.5,
            "Specular Tint": with_alpha(self.specular_tint),
            "Coat Weight": number(self.coat),
            "Coat Roughness": number(self.coat_roughness),
            "Coat IOR": number(COAT_IOR),
        })
    }
}
