//! The materials on the map: pictures where there is room, dots elsewhere.

use egui::{Color32, FontId, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2};
use nbrdf_core::{Database, Split};

use super::colours;
use super::frame::Frame;
use crate::gui::session::{Tint, shown};
use crate::gui::{Gallery, Session, look, picture, put};
use crate::report::figure;
use crate::worker::Spot;

/// Sides of pictures \[points\].
const SIDES: [f32; 2] = [18.0, 72.0];
/// Radius of a dot.
const DOT: f32 = 4.0;
/// From here on names are shown.
const NAMED: f32 = 2.5;

/// The materials.
pub struct Marks<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
    pub frame: &'a Frame,
    pub spots: &'a [Spot],
    /// Figures of the first and the last colour.
    pub range: Option<[f64; 2]>,
}

/// A material in view.
struct Mark<'a> {
    spot: &'a Spot,
    at: Pos2,
    /// The end that it is, if it is one.
    end: Option<usize>,
    is_picture: bool,
}

impl<'a> Marks<'a> {
    pub fn show(mut self, ui: &Ui) {
        let side = (20.0 * self.session.map.zoom.sqrt()).clamp(SIDES[0], SIDES[1]);
        let marks = self.marks(side);
        // Pictures below, so that no dot is hidden.
        for mark in marks.iter().filter(|mark| mark.is_picture).chain(marks.iter().filter(|mark| !mark.is_picture)) {
            let reach = if mark.is_picture { 0.5 * side } else { DOT + 2.0 };
            let id = ui.scope_id().with(("mark", mark.spot.name.as_str()));
            let response = ui.interact(Rect::from_center_size(mark.at, Vec2::splat(2.0 * reach)), id, Sense::click());
            self.paint(ui, mark, &response, if mark.is_picture { 0.5 * side } else { DOT });
            self.choose(ui, mark, response);
        }
        self.names(ui, &marks, side);
    }

    /// Those in view; ends are never dots, others are where they would cover a picture.
    fn marks(&self, side: f32) -> Vec<Mark<'a>> {
        let view = self.frame.rect.expand(0.5 * side);
        let all = self.spots.iter().map(|spot| {
            let end = self.session.blend.ends.iter().position(|end| *end == spot.name);
            Mark { spot, at: self.frame.point(spot.at), end, is_picture: false }
        });
        let mut marks: Vec<Mark<'a>> = all.filter(|mark| view.contains(mark.at)).collect();
        marks.sort_by_key(|mark| mark.end.is_none());
        let points: Vec<Pos2> = marks.iter().map(|mark| mark.at).collect();
        for (mark, has_room) in marks.iter_mut().zip(with_room(&points, side)) {
            mark.is_picture = mark.end.is_some() || has_room;
        }
        marks
    }

    fn paint(&self, ui: &Ui, mark: &Mark<'_>, response: &Response, radius: f32) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        let tint = colours::colour(self.session.map.tint, self.range, mark.spot, ui);
        let quiet = visuals.weak_text_color();
        let is_held_out = Split::of(&mark.spot.name) == Split::HeldOut;
        let texture = self.gallery.thumbnail(&mark.spot.name).filter(|_| mark.is_picture);
        match texture {
            Some(texture) => {
                let rect = Rect::from_center_size(mark.at, Vec2::splat(2.0 * radius));
                picture::whole(painter, texture, rect, Color32::WHITE);
                if is_held_out {
                    painter.extend(colours::dashed(mark.at, radius, tint.unwrap_or(quiet)));
                } else if let Some(tint) = tint {
                    painter.circle_stroke(mark.at, radius, Stroke::new(2.5, tint));
                }
            }
            None => {
                let (fill, rim) = (tint.unwrap_or(quiet), Stroke::new(1.0, look::card_fill(visuals)));
                if is_held_out {
                    let rect = Rect::from_center_size(mark.at, Vec2::splat(1.8 * radius));
                    painter.rect(rect, 0.0, fill, rim, StrokeKind::Outside);
                } else {
                    painter.circle(mark.at, radius, fill, rim);
                }
            }
        }
        if response.hovered() || response.has_focus() {
            painter.circle_stroke(mark.at, radius + 2.5, Stroke::new(1.5, visuals.selection.stroke.color));
        }
        if let Some(end) = mark.end {
            look::badge(painter, mark.at + vec2(0.8, -0.8) * radius, end, true, visuals);
        }
    }

    /// As in the library: a click is for A, one with shift for B.
    fn choose(&mut self, ui: &Ui, mark: &Mark<'_>, response: Response) {
        let name = &mark.spot.name;
        response.widget_info(|| {
            WidgetInfo::selected(egui::Role::Button, true, mark.end.is_some(), format!("{name} on the map"))
        });
        if response.clicked() {
            let shift = ui.input(|input| input.modifiers.shift);
            self.session.blend.choose(usize::from(shift), name);
        }
        put::by_letter(ui, &response, &mut self.session.blend, name);
        let tint = self.session.map.tint;
        response.on_hover_ui(|ui| {
            ui.strong(name);
            facts(mark.spot, tint).into_iter().for_each(|fact| drop(ui.label(fact)));
        });
    }

    /// Names below pictures, where there is room.
    fn names(&self, ui: &Ui, marks: &[Mark<'_>], side: f32) {
        let mut taken: Vec<Rect> = Vec::new();
        let is_named = |mark: &&Mark<'_>| mark.is_picture && (mark.end.is_some() || self.session.map.zoom >= NAMED);
        for mark in marks.iter().filter(is_named) {
            let name = shown(&mark.spot.name);
            let colour = ui.visuals().text_color();
            let galley = ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(11.0), colour);
            let corner = mark.at + vec2(-0.5 * galley.size().x, 0.5 * side + 1.0);
            let rect = Rect::from_min_size(corner, galley.size());
            let is_free = |mark: &Mark<'_>| {
                let reach = if mark.is_picture { 0.5 * side - 1.0 } else { DOT };
                !rect.intersects(Rect::from_center_size(mark.at, Vec2::splat(2.0 * reach)))
            };
            if mark.end.is_some() || (taken.iter().all(|other| !other.intersects(rect)) && marks.iter().all(is_free)) {
                taken.push(rect);
                ui.painter().rect_filled(rect.expand(1.0), 2.0, look::card_fill(ui.visuals()).gamma_multiply(0.8));
                ui.painter().galley(corner, galley, colour);
            }
        }
    }
}

fn facts(spot: &Spot, tint: Tint) -> Vec<String> {
    let origin = match Database::of(&spot.name) {
        Database::Merl => "MERL",
        Database::Rgl => "RGL",
        Database::Other => "own",
    };
    let split = if Split::of(&spot.name) == Split::HeldOut { ", held out" } else { "" };
    let mut facts = vec![format!("{origin}{split}")];
    let known = |tint: &Tint| tint.value(spot).map(|value| format!("{}: {}", tint.title(), figure(value)));
    let others = [tint, Tint::Error, Tint::Distance];
    let first = |(place, tint): &(usize, &Tint)| !others[..*place].contains(tint);
    facts.extend(others.iter().enumerate().filter(first).filter_map(|(_, tint)| known(tint)));
    facts.push("Click for A, shift-click for B".to_owned());
    facts
}

/// Which points may have pictures of this side without covering one before them.
fn with_room(points: &[Pos2], side: f32) -> Vec<bool> {
    let mut pictures: Vec<Pos2> = Vec::new();
    let has_room = |point: &Pos2| {
        let is_free = pictures.iter().all(|other| other.distance(*point) >= side);
        if is_free {
            pictures.push(*point);
        }
        is_free
    };
    points.iter().map(has_room).collect()
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn no_two_pictures_overlap_and_lonely_ones_are_shown() {
        let points: Vec<Pos2> =
            (0..200u8).map(|i| pos2(f32::from(i) * 3.7 % 150.0, f32::from(i) * 7.9 % 90.0)).collect();
        let shown: Vec<Pos2> =
            points.iter().zip(with_room(&points, 20.0)).filter(|(_, shown)| *shown).map(|(point, _)| *point).collect();
        assert!(shown.len() > 10);
        assert!(shown.iter().enumerate().all(|(i, a)| shown[..i].iter().all(|b| a.distance(*b) >= 20.0)));
        assert_eq!(with_room(&[pos2(0.0, 0.0), pos2(20.0, 0.0)], 20.0), [true, true]);
    }
}
