//! Pictures of a high dynamic range, as environments.

use nbrdf_core::Image;
use nbrdf_core::render::Environment;

/// OpenEXR.
pub fn exr(bytes: &[u8]) -> bool {
    is_sound(bytes)
}

/// Radiance.
pub fn hdr(bytes: &[u8]) -> bool {
    is_sound(bytes)
}

/// Lights are drawn from what is a map.
fn is_sound(bytes: &[u8]) -> bool {
    let Ok(image) = Image::parse(bytes) else { return false };
    assert_eq!(image.pixels().len(), image.width() * image.height());
    if let Ok(map) = Environment::new(image) {
        for u in [[0.0, 0.0], [0.3, 0.7], [0.999_999, 0.999_999]] {
            let light = map.sample(u);
            assert!(light.pdf.is_finite() && light.pdf >= 0.0 && light.radiance.is_finite(), "{light:?}");
        }
    }
    true
}
