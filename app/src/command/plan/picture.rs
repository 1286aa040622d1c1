//! Full models, planned models and what is different, side by side.

use std::path::Path;

use nbrdf_core::Image;
use nbrdf_core::plan::Plan;
use nbrdf_core::scene::View;
use serde_json::Value;

use crate::measure::planned::{WHITE, difference, times};
use crate::strip::text::{Face, Text};
use crate::strip::{BRIGHT, MUTED, ground};

/// Space around pictures and between them \[pixels\].
const MARGIN: usize = 28;
const GAP: usize = 16;
/// Space above the pictures.
const HEAD: usize = 92;

/// Three pictures with their labels.
pub fn triptych(scene: &Path, view: &View, plan: &Plan, summary: &Value) -> Image {
    let gain = (view.picture().exposure as f32).exp2();
    let [full, planned] = [&plan.reference, &plan.planned].map(|image| image.map(|pixel| pixel * gain));
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN);
    let white = WHITE * number("/tolerance");
    let heat = difference(&full, &planned, white);
    let name = scene.file_stem().unwrap_or_default().to_string_lossy();
    let heading = format!(
        "{name}: {} and {} within FLIP {}",
        times(number("/times_faster"), ["less time", "more time"]),
        times(number("/times_smaller"), ["fewer bytes", "more bytes"]),
        number("/tolerance")
    );
    let cost = |which: &str| {
        let bytes = 1e-3 * number(&format!("/{which}/bytes"));
        let bytes = if bytes < 1000.0 { format!("{bytes:.1} kB") } else { format!("{:.0} MB", 1e-3 * bytes) };
        format!("{:.1} ms, {bytes}", 1e-6 * number(&format!("/{which}/ns")))
    };
    let labels = [
        format!("The materials themselves (pruned NBRDF everywhere: {})", cost("nbrdf_everywhere")),
        format!("Planned: {}", cost("planned")),
        format!("Difference: FLIP, white is {white:.2}"),
    ];
    let pictures = [full, planned, heat];
    let (size, row) = layout(&pictures[0], &heading, &labels);
    let mut page = Image::new(size.0, size.1, vec![ground(); size.0 * size.1]);
    Text::new(Face::Sans, 26.0).draw(&mut page, &heading, MARGIN as f32, 46.0, BRIGHT);
    for (place, (picture, label)) in pictures.iter().zip(&labels).enumerate() {
        let left = MARGIN + place * row;
        LABEL.draw(&mut page, label, left as f32, 78.0, MUTED);
        page.paste(picture, left, HEAD);
    }
    page
}

const LABEL: Text = Text::new(Face::Sans, 15.5);

/// Size of the page, and from one picture to the next: small pictures stand as far apart as their labels need.
fn layout(picture: &Image, heading: &str, labels: &[String; 3]) -> ((usize, usize), usize) {
    let widest = labels.iter().map(|label| LABEL.width(label)).fold(0.0, f32::max).ceil() as usize;
    let row = picture.width().max(widest) + GAP;
    let wide = Text::new(Face::Sans, 26.0).width(heading).ceil() as usize;
    let width = (3 * row - GAP).max(wide) + 2 * MARGIN;
    ((width, HEAD + picture.height() + MARGIN), row)
}
