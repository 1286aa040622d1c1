//! What the command cannot say becomes a remark.

use nbrdf_core::axis::Axis;
use nbrdf_core::image::Tone;
use nbrdf_core::render::Frame;

use super::draw::At;
use super::line::Line;
use crate::gui::Session;
use crate::worker::export::PictureForm;
use crate::worker::{Shape, Timing, Tour};

/// Of the way between the ends.
pub fn walked(session: &Session, at: At) -> Vec<String> {
    let blend = &session.blend;
    let mut remarks = Vec::new();
    match (blend.timing, blend.ends.len()) {
        (Timing::Even, 2) => remarks.push("even timing: see latent_even".to_owned()),
        (Timing::Even, _) if !blend.is_polygon() => {
            remarks.push("even timing between more than two materials: the command keeps straight timing".to_owned());
        }
        (Timing::Even | Timing::Straight, _) => {}
    }
    match (at, blend.tour()) {
        (At::Steps(_), Tour::Around) => {
            remarks.push("steps around the polygon: the command goes along a smooth curve".to_owned());
        }
        (At::Steps(_), Tour::Beyond) => {
            remarks.push("steps from -0.5 to 1.5: the command goes from 0 to 1".to_owned());
        }
        // What lies along a path is not edited.
        (At::Steps(_), Tour::Along) => {}
        (At::Here, _) => {
            let edits = Axis::ALL.iter().zip(blend.edits).filter(|(_, amount)| *amount != 0.0);
            let edits: Vec<String> = edits.map(|(axis, amount)| format!("{} by {amount}", axis.name())).collect();
            if !edits.is_empty() {
                remarks.push(format!("edited: see nbrdf edit, {}", edits.join(" ")));
            }
        }
    }
    remarks
}

impl Line {
    /// Of how it is looked at: it draws whole spheres through the clip curve.
    pub fn seen(&mut self, session: &Session, at: At, form: PictureForm) {
        let look = &session.look;
        match look.scenery.shape {
            Shape::Sphere => {}
            Shape::Plane => self.remarks.push("on a plane: the command draws spheres".to_owned()),
            Shape::Mesh(_) => self.remarks.push("on a mesh: the command draws spheres".to_owned()),
        }
        let Frame { zoom, centre: [x, y] } = look.scenery.frame;
        // Film strips show the whole shape.
        if look.scenery.frame != Frame::WHOLE && matches!(at, At::Here) {
            self.remarks.push(format!("zoomed {zoom:.2} times at {x:.3} {y:.3}: the command draws the whole"));
        }
        if look.tone != Tone::Clip && form == PictureForm::Png {
            self.remarks.push(format!("tone curve {}: the command clips", look.tone.title()));
        }
    }
}
