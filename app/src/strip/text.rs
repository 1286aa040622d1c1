//! Labels in the app's own typefaces.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use nbrdf_core::Rgb;
use nbrdf_core::image::{DISPLAY_GAMMA, Image};

/// A typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// For people.
    Sans,
    /// For what is typed.
    Mono,
}

impl Face {
    /// # Panics
    /// If the bytes compiled in are no font: a mistake of the build, caught by a test.
    fn font(self) -> &'static FontRef<'static> {
        static FONTS: OnceLock<[FontRef; 2]> = OnceLock::new();
        let fonts = FONTS.get_or_init(|| {
            [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR]
                .map(|bytes| FontRef::try_from_slice(bytes).unwrap_or_else(|error| panic!("built-in font: {error}")))
        });
        &fonts[self as usize]
    }
}

/// A linear grey that is displayed as `shown`, 0..1.
pub fn ink(shown: f32) -> Rgb {
    Rgb::splat(shown.powf(DISPLAY_GAMMA))
}

/// A typeface at a size.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    face: Face,
    size: f32,
}

impl Text {
    /// `size` from ascender to descender \[pixels\].
    pub const fn new(face: Face, size: f32) -> Self {
        Self { face, size }
    }

    /// Pixels from the start of the first letter to the end of the last.
    pub fn width(self, text: &str) -> f32 {
        self.place(text, 0.0, 0.0).1
    }

    /// Draws from `left` on a baseline, in a displayed grey.
    pub fn draw(self, picture: &mut Image, text: &str, left: f32, baseline: f32, shown: f32) {
        let ink = ink(shown);
        for glyph in self.place(text, left, baseline).0 {
            let Some(outline) = self.face.font().outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, coverage| {
                let (x, y) = (corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y));
                blend(picture, x, y, ink, coverage.clamp(0.0, 1.0));
            });
        }
    }

    fn place(self, text: &str, left: f32, baseline: f32) -> (Vec<Glyph>, f32) {
        let font = self.face.font().as_scaled(PxScale::from(self.size));
        let mut x = left;
        let mut before = None;
        let glyphs = text.chars().map(|letter| {
            let id = font.glyph_id(letter);
            x += before.map_or(0.0, |before| font.kern(before, id));
            before = Some(id);
            let glyph = id.with_scale_and_position(font.scale(), point(x, baseline));
            x += font.h_advance(id);
            glyph
        });
        let glyphs = glyphs.collect();
        (glyphs, x - left)
    }
}

fn blend(picture: &mut Image, x: i64, y: i64, ink: Rgb, coverage: f32) {
    let (width, height) = (picture.width(), picture.height());
    let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { return };
    if x < width && y < height {
        let pixel = &mut picture.pixels_mut()[y * width + x];
        *pixel = pixel.zip(ink, |under, over| under + (over - under) * coverage);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_typefaces_have_the_letters_of_labels() {
        for face in [Face::Sans, Face::Mono] {
            for letter in "abcXYZ0123456789.,-_/()=:+".chars() {
                assert_ne!(face.font().glyph_id(letter).0, 0, "{face:?} lacks {letter}");
            }
        }
    }

    #[test]
    fn text_lands_where_it_is_measured() {
        let mut picture = Image::black(200, 40);
        let text = Text::new(Face::Sans, 20.0);
        text.draw(&mut picture, "chrome", 10.0, 28.0, 1.0);
        let right = 10.0 + text.width("chrome");
        let inked: Vec<usize> = (0..8000).filter(|&i| picture.pixels()[i].max() > 0.1).map(|i| i % 200).collect();
        assert!(!inked.is_empty() && inked.iter().all(|&x| x >= 9 && x as f32 <= right + 1.0));
    }

    #[test]
    fn text_beyond_the_edge_is_cut_off() {
        let mut picture = Image::black(10, 10);
        Text::new(Face::Mono, 20.0).draw(&mut picture, "wide", -5.0, 8.0, 1.0);
    }
}
