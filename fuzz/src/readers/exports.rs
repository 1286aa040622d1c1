//! What is exported and read again: parameters of standard models, source code.

use std::sync::Arc;

use nbrdf_core::brdf::Azimuth;
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::parametric::{FileError, GltfPbr, OpenPbr, Principled, ShadingModel};
use nbrdf_core::{Brdf, shader};

use super::assert_reflects;

/// A glTF material, an OpenPBR surface in MaterialX, or a Principled BSDF.
pub fn shading_model(bytes: &[u8]) -> bool {
    is_one(GltfPbr::read(bytes)) | is_one(OpenPbr::read(bytes)) | is_one(Principled::read(bytes))
}

fn is_one<M: ShadingModel>(read: Result<M, FileError>) -> bool {
    let Ok(model) = read else { return false };
    assert!(model.values().iter().all(|value| value.is_finite()));
    assert_reflects(model.brdf().as_ref());
    true
}

/// A network as source code in any language.
pub fn source_code(bytes: &[u8]) -> bool {
    let Ok((network, azimuth)) = shader::read(&String::from_utf8_lossy(bytes)) else { return false };
    let brdf: Arc<dyn Brdf> = match azimuth {
        Azimuth::Dropped => Arc::new(network),
        Azimuth::Kept => Arc::new(AnisotropicNbrdf::of(network)),
    };
    assert_reflects(brdf.as_ref());
    true
}
