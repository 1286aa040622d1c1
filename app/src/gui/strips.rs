//! Whole paths as film strips: the material at some points of each, and where t is among them.

use egui::{Align2, FontId, Rangef, Rect, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::{Gallery, Session, look, picture};
use crate::catalog::Catalog;
use crate::worker::{Card, Tour};

/// Smallest side of a frame.
pub const SMALLEST: f32 = 36.0;
const LARGEST: f32 = 110.0;
const LABEL: f32 = 104.0;
/// Between the last frame and the rim.
const RIGHT: f32 = 12.0;
const GAP: f32 = 6.0;
const TOP: f32 = 8.0;
const BOTTOM: f32 = 8.0;

/// The film strips of all methods.
pub struct Strips<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
    pub frame: f32,
    /// Where the first and the last frame have their middles, if there is a scrubber to be in line with.
    pub rail: Option<Rangef>,
}

/// Height of so many strips \[points\].
pub fn height(strips: usize, frame: f32) -> f32 {
    8.0 + strips as f32 * (frame + GAP) - GAP + TOP + BOTTOM
}

/// Side of a frame for strips of so many frames that must fit here, in line with a rail that ends so far from the right rim
/// if there is one \[points\].
pub fn fit(available: Vec2, strips: usize, frames: usize, rail: Option<(Rangef, f32)>) -> f32 {
    let high = (available.y - height(strips, 0.0)) / strips as f32;
    let wide = match rail {
        Some((rail, rim)) => {
            let apart = rail.span() / frames.saturating_sub(1).max(1) as f32 - GAP / 2.0;
            apart.min(2.0 * (rim - GAP / 2.0))
        }
        None => (available.x - LABEL - 2.0 * RIGHT) / frames as f32,
    };
    high.min(wide).clamp(SMALLEST, LARGEST)
}

impl Strips<'_> {
    pub fn show(self, ui: &mut Ui) {
        let Self { session, gallery, frame, .. } = self;
        let count = session.methods.0.len();
        let tall = height(count, frame) - 8.0;
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), tall), Sense::hover());
        let painter = ui.painter().clone();
        let visuals = ui.visuals().clone();
        painter.rect(
            area,
            look::ROUND,
            look::card_fill(&visuals),
            look::card_stroke(&visuals),
            egui::StrokeKind::Inside,
        );
        let free = Rangef::new(area.left() + LABEL + frame / 2.0, area.right() - RIGHT - frame / 2.0);
        let Rangef { min: first, max: last } = self.rail.unwrap_or(free);
        let (tour, ends) = (session.blend.tour(), session.blend.ends.len());
        let x = |place: f32| first + tour.share(place) * (last - first);
        // Behind the spheres, so that it hides none.
        if let Some(place) = session.blend.on_tour() {
            let is_outside = session.blend.is_outside();
            let colour = if is_outside { visuals.warn_fg_color } else { visuals.selection.stroke.color };
            let bar = Rect::from_center_size(pos2(x(place), area.center().y), vec2(frame + 4.0, area.height() - 2.0));
            painter.rect_filled(bar, look::ROUND, visuals.selection.bg_fill.gamma_multiply(0.5));
            painter.vline(x(place), bar.y_range(), Stroke::new(1.5, colour));
        }
        let mut chosen = None;
        for (row, &method) in session.methods.0.iter().enumerate() {
            let y = area.top() + TOP + frame / 2.0 + row as f32 * (frame + GAP);
            let title = Catalog::interpolation_entry(method).map_or(method, |entry| entry.title);
            let at = pos2(area.left() + 12.0, y);
            painter.text(at, Align2::LEFT_CENTER, title, FontId::proportional(12.5), visuals.weak_text_color());
            for step in 0..tour.frames(ends) {
                let t = tour.place(step, ends);
                let is_outside = tour == Tour::Beyond && !(0.0..=1.0).contains(&t);
                let rect = Rect::from_center_size(pos2(x(t), y), Vec2::splat(frame));
                let point = ui.interact(rect, ui.scope_id().with(("strip", method, step)), Sense::click());
                let beyond = if is_outside { ", beyond the ends" } else { "" };
                let label = format!("{title} at {t:.3}{beyond}");
                point.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &label));
                picture::ball(&painter, gallery.frame(Card::Method(method), step), rect, &visuals);
                if is_outside {
                    let stroke = Stroke::new(2.0, visuals.warn_fg_color.gamma_multiply(0.7));
                    let line = [rect.left_bottom() + vec2(4.0, 2.0), rect.right_bottom() + vec2(-4.0, 2.0)];
                    painter.extend(Shape::dashed_line(&line, stroke, 5.0, 4.0));
                }
                if point.has_focus() {
                    look::ring(&painter, rect, egui::StrokeKind::Outside, &visuals);
                }
                if point.on_hover_text(label).clicked() {
                    chosen = Some(t);
                }
            }
        }
        if let Some(t) = chosen {
            session.blend.tour_to(t);
        }
    }
}
