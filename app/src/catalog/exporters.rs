//! The forms that a material is written in: one file for each family of them, one line here, and `nbrdf export`, `nbrdf
//! decode` and the app's window know it.

mod code;
mod entry;
mod mitsuba;
mod network;
mod parametric;
mod shader;
mod subject;
mod table;

pub use code::json;
pub use entry::{ExporterEntry, Needs};
pub use subject::Subject;

/// Every form, in the order of lists.
pub const EXPORTERS: &[ExporterEntry] = &[
    network::NPZ,
    network::SAFETENSORS,
    network::NPY,
    network::KERAS,
    table::BINARY,
    mitsuba::BSDF,
    code::CODE,
    shader::GLSL,
    shader::HLSL,
    shader::WGSL,
    shader::C,
    shader::RUST,
    shader::PAGE,
    parametric::GLTF,
    parametric::MTLX,
    parametric::PRINCIPLED,
];

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use nbrdf_core::library::builtin;
    use nbrdf_core::metric::log_error;
    use nbrdf_core::path::mix::{Mix, Mixed};
    use nbrdf_core::sampling::{evaluate, rus32k};
    use nbrdf_core::{Brdf, Directions, Library, Material, Rgb};

    use super::*;
    use crate::catalog::{Catalog, Reference};

    const FITS: [&str; 3] = ["gltf", "mtlx", "principled"];

    #[test]
    fn every_form_stands_for_what_was_written() {
        let catalog = Catalog::new(Arc::new(Reference::built_in()));
        let network = builtin::shared().get("gold-metallic-paint").unwrap().material();
        let representation = catalog.representation("znbrdf", false).unwrap();
        let code = representation.encode(&network).unwrap();
        let decoded = Material::new("gold-metallic-paint", Arc::from(representation.decode(&code).unwrap()));
        for entry in EXPORTERS {
            let material = if entry.needs == Needs::Code { &decoded } else { &network };
            let subject = Subject { material, code: Some(&code) };
            let files = entry.files(Path::new("a"), &subject).unwrap();
            assert_eq!(files.len(), entry.ends.len(), "{}", entry.name);
            let bytes: Vec<&[u8]> = files.iter().map(|(_, bytes)| bytes.as_slice()).collect();
            let read = entry.read_back(&bytes, &catalog).unwrap();
            let at = rus32k();
            let error = log_error(at, &evaluate(material.brdf.as_ref(), at), &evaluate(read.as_ref(), at));
            // Weights are written to the bit, tables are not, and fits are what a few parameters can say.
            let most = match entry.needs {
                Needs::Reflectance if FITS.contains(&entry.name) => 0.05,
                Needs::Reflectance => 0.004,
                _ => 0.0,
            };
            assert!(error <= most, "{}: {error}", entry.name);
        }
    }

    #[test]
    fn every_form_of_a_network_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let material = builtin::shared().get("chrome").unwrap().material();
        let subject = Subject { material: &material, code: None };
        for entry in EXPORTERS.iter().filter(|entry| entry.needs == Needs::Network) {
            let files = entry.files(&folder.path().join("v1.chrome"), &subject).unwrap();
            files.iter().for_each(|(path, bytes)| std::fs::write(path, bytes).unwrap());
            let read = Library::load(&files[0].0).map(Library::into_entries);
            // Of a set of six, and of source code, no library is made.
            if ["npz", "safetensors", "keras"].contains(&entry.name) {
                assert_eq!(read.unwrap()[0].network.weights(), subject.network().unwrap().weights());
            }
        }
    }

    #[test]
    fn what_lacks_a_code_is_told_so() {
        let material = builtin::shared().get("chrome").unwrap().material();
        let subject = Subject { material: &material, code: None };
        let error = ExporterEntry::named("code").unwrap().files(Path::new("a"), &subject).unwrap_err();
        assert!(error.to_string().contains("chrome has no code"), "{error}");
    }

    /// Brighter on one side of the brush than on the other.
    struct Brushed;

    impl Brdf for Brushed {
        fn eval(&self, at: Directions) -> Rgb {
            Rgb::splat(0.2 + 0.1 * (at.light + at.view).normalize().x)
        }
    }

    #[test]
    fn a_table_is_refused_where_something_that_turns_is_mixed_in() {
        for material in builtin::shared().materials() {
            let subject = Subject { material: &material, code: None };
            assert!(!subject.changes_when_turned(), "{}", material.name);
        }
        let plain = builtin::shared().get("white-fabric").unwrap().material().brdf;
        let parts: Vec<(f32, Arc<dyn Brdf>)> = vec![(0.75, plain), (0.25, Arc::new(Brushed))];
        let material = Material::new("mixed", Arc::new(Mixed::new(Mix::Linear, parts)));
        let subject = Subject { material: &material, code: None };
        let error = ExporterEntry::named("binary").unwrap().files(Path::new("a"), &subject).unwrap_err();
        assert!(error.to_string().contains("mixed changes when it is turned"), "{error}");
    }

    #[test]
    fn no_two_forms_share_a_name_or_an_extension() {
        for (place, entry) in EXPORTERS.iter().enumerate() {
            let others = &EXPORTERS[..place];
            assert!(others.iter().all(|other| other.name != entry.name && other.extension != entry.extension));
            // Written beside each other under one stem, none replaces a file of another; but for Keras, whose readers look for
            // `.json`, and whose description is written over nothing but its own.
            let is_shared = |end: &&str| others.iter().any(|other| other.name != "keras" && other.ends.contains(end));
            assert!(!entry.ends.iter().any(is_shared), "{}", entry.name);
        }
    }
}
