//! SVG drawn as pixels.

use anyhow::{Context, Result, anyhow};
use resvg::{tiny_skia, usvg};

/// Pixels for each unit of the picture: readable on dense displays.
const SCALE: f32 = 2.0;

/// The PNG of a picture, in the typefaces of the app.
pub fn png(svg: &str) -> Result<Vec<u8>> {
    let mut options = usvg::Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    let family = fonts.faces().next().and_then(|face| face.families.first()).map(|(name, _)| name.clone());
    fonts.set_sans_serif_family(family.context("the built-in font has no name")?);
    let tree = usvg::Tree::from_str(svg, &options).context("the chart is no SVG")?;
    let size = tree.size().to_int_size().scale_by(SCALE).context("the chart has no size")?;
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).context("the chart has no pixels")?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| anyhow!("PNG: {error}"))
}
