//! Colours and measures, dark and light.

use egui::{
    Align2, Color32, Context, CornerRadius, FontFamily, FontId, Painter, Pos2, Rect, Response, Stroke, StrokeKind,
    TextStyle, Theme, Visuals,
};

use super::session::letter;
use crate::catalog::INTERPOLATIONS;

/// Radius of cards and rows.
pub const ROUND: u8 = 8;

/// The colour of an end.
pub fn accent(end: usize, visuals: &Visuals) -> Color32 {
    let [dark, light] = ACCENTS[end % ACCENTS.len()];
    let [r, g, b] = if visuals.dark_mode { dark } else { light };
    Color32::from_rgb(r, g, b)
}

/// Of each end, on dark and on light: told apart by most colour-blind people, too (after M. Okabe, K. Ito 2008).
const ACCENTS: [[[u8; 3]; 2]; 6] = [
    [[240, 170, 80], [190, 105, 10]],
    [[105, 170, 250], [30, 100, 205]],
    [[80, 200, 160], [0, 130, 95]],
    [[230, 140, 190], [175, 70, 130]],
    [[235, 225, 100], [140, 125, 0]],
    [[240, 125, 95], [195, 75, 30]],
];

/// The colour of a method, by its name in the catalog.
pub fn method_colour(name: &str, visuals: &Visuals) -> Color32 {
    series(method_place(name), visuals)
}

/// Whether a method's lines are dashed: there are more methods than colours that most people tell apart.
pub fn is_dashed(name: &str) -> bool {
    method_place(name) >= SERIES.len()
}

fn method_place(name: &str) -> usize {
    INTERPOLATIONS.iter().position(|entry| entry.name == name).unwrap_or_default()
}

/// The colour of one of several series; after eight they come again.
pub fn series(place: usize, visuals: &Visuals) -> Color32 {
    let [dark, light] = SERIES[place % SERIES.len()];
    let [r, g, b] = if visuals.dark_mode { dark } else { light };
    Color32::from_rgb(r, g, b)
}

/// On dark and on light: told apart by most colour-blind people, too (after P. Tol 2021, scheme "bright").
const SERIES: [[[u8; 3]; 2]; 8] = [
    [[100, 155, 235], [45, 95, 175]],
    [[240, 120, 135], [205, 50, 75]],
    [[85, 195, 110], [30, 125, 50]],
    [[225, 205, 85], [145, 125, 0]],
    [[105, 210, 240], [0, 135, 170]],
    [[205, 110, 175], [140, 40, 105]],
    [[190, 190, 190], [105, 105, 105]],
    [[240, 155, 85], [190, 95, 0]],
];

/// Text on an accent.
pub fn on_accent(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_gray(20) } else { Color32::WHITE }
}

/// Behind a sphere.
pub fn card_fill(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(35, 36, 40) } else { Color32::WHITE }
}

/// Around a card.
pub fn card_stroke(visuals: &Visuals) -> Stroke {
    let colour = if visuals.dark_mode { Color32::from_rgb(50, 51, 56) } else { Color32::from_gray(216) };
    Stroke::new(1.0, colour)
}

/// A ring around what has the keyboard's focus and does not show it otherwise.
pub fn focus(painter: &Painter, of: &Response, visuals: &Visuals) {
    if of.has_focus() {
        ring(painter, of.rect, StrokeKind::Inside, visuals);
    }
}

/// The ring itself.
pub fn ring(painter: &Painter, rect: Rect, kind: StrokeKind, visuals: &Visuals) {
    painter.rect_stroke(rect, ROUND, Stroke::new(1.5, visuals.selection.stroke.color), kind);
}

/// A disc with the end's letter.
pub fn badge(painter: &Painter, centre: Pos2, end: usize, is_chosen: bool, visuals: &Visuals) {
    let (radius, colour) = (9.0, accent(end, visuals));
    let text = if is_chosen {
        painter.circle_filled(centre, radius, colour);
        on_accent(visuals)
    } else {
        let quiet = visuals.weak_text_color();
        painter.circle_stroke(centre, radius - 0.5, Stroke::new(1.0, quiet.gamma_multiply(0.6)));
        quiet
    };
    painter.text(centre, Align2::CENTER_CENTER, letter(end), FontId::proportional(12.0), text);
}

/// Both themes, and the sizes of text.
pub fn install(context: &Context) {
    context.set_visuals_of(Theme::Dark, dark());
    context.set_visuals_of(Theme::Light, light());
    context.all_styles_mut(|style| {
        let proportional = |size| FontId::new(size, FontFamily::Proportional);
        style.text_styles.insert(TextStyle::Body, proportional(13.5));
        style.text_styles.insert(TextStyle::Button, proportional(13.5));
        style.text_styles.insert(TextStyle::Small, proportional(11.5));
        style.text_styles.insert(TextStyle::Heading, proportional(17.0));
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.spacing.button_padding = egui::vec2(9.0, 4.0);
        style.spacing.interact_size.y = 26.0;
    });
}

fn dark() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = Color32::from_rgb(24, 25, 28);
    visuals.window_fill = Color32::from_rgb(34, 35, 39);
    visuals.extreme_bg_color = Color32::from_rgb(16, 17, 19);
    visuals.faint_bg_color = Color32::from_rgb(32, 33, 37);
    visuals.override_text_color = Some(Color32::from_gray(225));
    visuals.weak_text_color = Some(Color32::from_gray(155));
    visuals.widgets.noninteractive.bg_stroke.color = Color32::from_rgb(46, 47, 52);
    finish(visuals)
}

fn light() -> Visuals {
    let mut visuals = Visuals::light();
    visuals.panel_fill = Color32::from_rgb(243, 243, 245);
    // Not white, so that white fields for text are seen on it.
    visuals.window_fill = Color32::from_rgb(247, 247, 249);
    visuals.extreme_bg_color = Color32::WHITE;
    visuals.faint_bg_color = Color32::from_rgb(234, 235, 238);
    visuals.override_text_color = Some(Color32::from_gray(30));
    visuals.weak_text_color = Some(Color32::from_gray(95));
    visuals.widgets.noninteractive.bg_stroke.color = Color32::from_gray(214);
    finish(visuals)
}

fn finish(mut visuals: Visuals) -> Visuals {
    let widgets = &mut visuals.widgets;
    for widget in [&mut widgets.noninteractive, &mut widgets.inactive, &mut widgets.hovered, &mut widgets.active] {
        widget.corner_radius = CornerRadius::same(6);
    }
    visuals.widgets.open.corner_radius = CornerRadius::same(6);
    visuals.selection.bg_fill = accent(1, &visuals).gamma_multiply(0.35);
    visuals.selection.stroke.color = accent(1, &visuals);
    visuals
}
