//! Fits of standard shading models as files: for tools that accept nothing else, always with a picture of what is lost.

mod picture;

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::Brdf;
use nbrdf_core::parametric::{Fitted, GltfPbr, OpenPbr, Principled, ShadingModel, fit};

use super::{ExporterEntry, Needs, Subject};

/// A glTF material.
pub(super) const GLTF: ExporterEntry = ExporterEntry {
    name: "gltf",
    extension: "gltf",
    about: "a fit: a sphere of a glTF material, and a picture of the difference",
    needs: Needs::Reflectance,
    convention: "parameters of glTF 2.0, appendix B, and KHR extensions; colours are linear BT.709",
    tolerance: None,
    ends: &[".gltf", ".gltf.difference.png"],
    write: |subject, _| {
        let Some(fitted) = fitted::<GltfPbr>(subject) else { return Ok(None) };
        Ok(Some(vec![fitted.model.write(&subject.material.name, &fitted.errors), picture(subject, &fitted)?]))
    },
    read: |files, _| read(files, 0, |bytes| Ok(GltfPbr::read(bytes)?)),
};

/// An OpenPBR surface.
pub(super) const MTLX: ExporterEntry = ExporterEntry {
    name: "mtlx",
    extension: "mtlx",
    about: "a fit: an OpenPBR surface in MaterialX, and a picture of the difference",
    needs: Needs::Reflectance,
    convention: "inputs of OpenPBR 1.1; colours are linear BT.709",
    tolerance: None,
    ends: &[".mtlx", ".mtlx.difference.png"],
    write: |subject, _| {
        let Some(fitted) = fitted::<OpenPbr>(subject) else { return Ok(None) };
        Ok(Some(vec![fitted.model.write(&subject.material.name, &fitted.errors), picture(subject, &fitted)?]))
    },
    read: |files, _| read(files, 0, |bytes| Ok(OpenPbr::read(bytes)?)),
};

/// Values of Blender's Principled BSDF.
pub(super) const PRINCIPLED: ExporterEntry = ExporterEntry {
    name: "principled",
    extension: "py",
    about: "a fit: Blender's Principled BSDF as a program and as values, and a picture of the difference",
    needs: Needs::Reflectance,
    convention: "inputs of Blender's Principled BSDF; colours are linear BT.709",
    tolerance: None,
    ends: &[".py", ".principled.json", ".principled.difference.png"],
    write: |subject, _| {
        let Some(fitted) = fitted::<Principled>(subject) else { return Ok(None) };
        let (Fitted { model, errors, .. }, name) = (&fitted, &subject.material.name);
        Ok(Some(vec![model.write_python(name, errors), model.write(name, errors), picture(subject, &fitted)?]))
    },
    read: |files, _| read(files, 1, |bytes| Ok(Principled::read(bytes)?)),
};

/// None of a material that changes when it is turned, or is not finite: these models know one direction to be like another.
fn fitted<M: ShadingModel>(subject: &Subject<'_>) -> Option<Fitted<M>> {
    if subject.changes_when_turned() { None } else { fit(subject.material.brdf.as_ref()) }
}

fn picture<M: ShadingModel>(subject: &Subject<'_>, fitted: &Fitted<M>) -> Result<Vec<u8>> {
    Ok(picture::difference(subject.material, fitted.model.brdf().as_ref(), M::NAME).png_bytes()?)
}

/// The reflectance of the values in this one of the files.
fn read<M: ShadingModel>(files: &[&[u8]], which: usize, of: fn(&[u8]) -> Result<M>) -> Result<Arc<dyn Brdf>> {
    Ok(of(files.get(which).copied().unwrap_or_default())?.brdf().into())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use nbrdf_core::library::builtin;
    use nbrdf_core::metric::{LogError, Metric};
    use nbrdf_core::parametric::FitErrors;
    use nbrdf_core::scene::Mesh;

    use super::*;

    #[test]
    fn every_fit_is_read_back_as_it_was_fitted_and_says_its_error() {
        let material = builtin::shared().get("gold-paint").unwrap().material();
        let subject = Subject { material: &material, code: None };
        type Reader = fn(&[Vec<u8>]) -> Arc<dyn Brdf>;
        let readers: [(ExporterEntry, Reader); 3] = [
            (GLTF, |files| GltfPbr::read(&files[0]).unwrap().brdf().into()),
            (MTLX, |files| OpenPbr::read(&files[0]).unwrap().brdf().into()),
            (PRINCIPLED, |files| Principled::read(&files[1]).unwrap().brdf().into()),
        ];
        for (entry, reader) in readers {
            let files = entry.files(Path::new("a/gold"), &subject).unwrap();
            assert_eq!(files.len(), entry.ends.len());
            let (path, picture) = files.last().unwrap();
            assert!(path.to_str().unwrap().ends_with("difference.png") && picture.starts_with(b"\x89PNG"));
            let bytes: Vec<Vec<u8>> = files.into_iter().map(|(_, bytes)| bytes).collect();
            let errors = FitErrors::of(material.brdf.as_ref(), reader(&bytes).as_ref());
            let text = String::from_utf8(bytes[0].clone()).unwrap();
            let said = [format!("{:.4}", errors.log_error), format!("{:.6}", errors.log_error)];
            assert!(said.iter().any(|said| text.contains(said.trim_end_matches('0'))), "{}: {errors:?}", entry.name);
            assert!(errors.log_error < 0.05 && errors.studio_psnr > 25.0, "{}: {errors:?}", entry.name);
        }
    }

    #[test]
    fn a_gltf_fit_holds_a_sphere_that_is_read_as_a_mesh() {
        let material = builtin::shared().get("blue-acrylic").unwrap().material();
        let files = GLTF.files(Path::new("blue"), &Subject { material: &material, code: None }).unwrap();
        let mesh = Mesh::of_gltf(&files[0].1).unwrap();
        assert!((mesh.radius() - 1.0).abs() < 1e-5 && mesh.centre().length() < 1e-5);
        assert_eq!(mesh.len(), 2 * 64 * 31);
        let read = GltfPbr::read(&files[0].1).unwrap();
        assert!(LogError.distance(material.brdf.as_ref(), read.brdf().as_ref()) < 0.05);
    }
}
