//! One large picture, and what is written under it.

use egui::{CursorIcon, Label, Layout, Rect, Response, RichText, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use crate::gui::card::{self, HOW};
use crate::gui::session::Mode;
use crate::gui::{Gallery, Session, look};
use crate::worker::Card;

/// Under the picture \[points\]: a line of text, and of a difference its scale; each with the space before it.
const CAPTION: f32 = 30.0;
const SCALE: f32 = 38.0;
const LINE: f32 = 22.0;
const SMALLEST: f32 = 96.0;
/// Two captions in a line take so much.
const LEGIBLE: f32 = 260.0;

/// What a large picture is made of.
pub struct Large<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
    /// The two that are compared.
    pub cards: [Card; 2],
    /// Where there is room for it \[points\].
    pub room: Vec2,
}

/// The side of the picture \[points\]: whole pixels, so that it is shown as it was rendered.
pub fn side(ui: &Ui, room: Vec2, mode: Mode) -> f32 {
    let pixel = 1.0 / ui.pixels_per_point();
    let below = CAPTION + if mode == Mode::Difference { SCALE } else { 0.0 };
    (room.x.min(room.y - below).max(SMALLEST) / pixel).floor() * pixel
}

impl Large<'_> {
    /// Takes the room for a picture in the middle; what is done to it moves the light.
    pub fn allocate(&mut self, ui: &mut Ui) -> (Rect, Response) {
        let (side, pixel) = (side(ui, self.room, self.session.compare.mode), ui.pixels_per_point());
        let (row, _) = ui.allocate_exact_size(vec2(self.room.x.max(side), side), Sense::hover());
        let left = ((row.center().x - side / 2.0) * pixel).round() / pixel;
        let rect = Rect::from_min_size(pos2(left, (row.top() * pixel).round() / pixel), Vec2::splat(side));
        let picture = ui.interact(rect, ui.scope_id().with("large"), Sense::click_and_drag());
        card::light(self.session, ui, rect, &picture);
        (rect, picture)
    }

    /// Says what the picture is, to those who do not see it and to those who hover.
    pub fn describe(&self, ui: &Ui, picture: Response, what: &str) {
        look::focus(ui.painter(), &picture, ui.visuals());
        picture.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, what));
        picture.on_hover_cursor(CursorIcon::Crosshair).on_hover_text(HOW);
    }

    /// The name of one of the two, for a label.
    pub fn name(&self, place: usize) -> String {
        self.session.title(self.cards[place])
    }
}

/// A line under the picture: one text on the left, one on the right.
pub fn caption(ui: &mut Ui, rect: Rect, texts: [&str; 2]) {
    let rect = under(ui, rect);
    let line = Rect::from_min_size(rect.left_bottom(), vec2(rect.width(), LINE));
    ui.allocate_rect(line, Sense::hover());
    let [left, right] = [line.with_max_x(line.center().x - 4.0), line.with_min_x(line.center().x + 4.0)];
    let layouts = [Layout::left_to_right(egui::Align::Center), Layout::right_to_left(egui::Align::Center)];
    for ((half, layout), text) in [left, right].into_iter().zip(layouts).zip(texts) {
        let half = ui.new_child(egui::UiBuilder::new().max_rect(half).layout(layout));
        write(half, text);
    }
}

/// What is written under a picture may be wider than a small one.
pub fn under(ui: &Ui, picture: Rect) -> Rect {
    let width = picture.width().max(LEGIBLE.min(ui.max_rect().width()));
    Rect::from_center_size(picture.center(), vec2(width, picture.height()))
}

fn write(mut ui: Ui, text: &str) {
    ui.add(Label::new(RichText::new(text).strong()).truncate());
}
