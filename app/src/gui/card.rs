//! One sphere with its name and its figures.

use egui::{
    Align, Color32, CursorIcon, Layout, Pos2, Rect, Response, RichText, Sense, Spinner, Stroke, StrokeKind, Ui,
    UiBuilder, Vec2, WidgetInfo, vec2,
};

use super::gallery::{State, View};
use super::session::{letter, shown};
use super::{Session, drag, framing, look, pick, picture, travel};
use crate::catalog::Catalog;
use crate::worker::{Card, Figures};

const MARGIN: f32 = 10.0;
const TITLE: f32 = 24.0;
const LINE: f32 = 18.0;
/// How far a key press moves light or point, in radii of a sphere.
const STEP: f32 = 0.05;
/// What can be done with a sphere.
pub const HOW: &str = "Drag to move the light. Wheel or pinch: zoom. Shift or another button: drag the picture. Double \
                       click: all of it. Alt or Ctrl: pick a point (P). Arrow keys move the light, or the point \
                       while one is picked; Page up and down zoom, Home shows all";

/// One card.
pub struct CardPanel<'a> {
    pub session: &'a mut Session,
    pub view: Option<&'a View>,
    /// Of the explored code from those of training, and what is to be said of it.
    pub distance: (Option<f64>, Option<&'a str>),
    pub card: Card,
    pub side: f32,
}

/// Size of a card whose sphere is `side` wide.
pub fn size(side: f32) -> Vec2 {
    vec2(side + 2.0 * MARGIN, side + TITLE + 4.0 * LINE + 2.0 * MARGIN + 8.0)
}

impl CardPanel<'_> {
    pub fn show(mut self, ui: &mut Ui, rect: Rect) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        painter.rect(rect, look::ROUND, look::card_fill(visuals), look::card_stroke(visuals), StrokeKind::Inside);
        let builder = UiBuilder::new().id_salt(("card", self.card)).max_rect(rect.shrink(MARGIN));
        let ui = &mut ui.new_child(builder.layout(Layout::top_down(Align::Min)));
        ui.shrink_clip_rect(rect);
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        self.title(ui);
        self.sphere(ui);
        ui.add_space(8.0);
        figures(ui, self.card, self.view.and_then(|view| view.figures), self.distance);
        if let Card::End(end) = self.card {
            let target = ui.interact(rect, ui.scope_id().with("drop"), Sense::hover());
            if let Some(name) = drag::accept(ui, &target) {
                self.session.blend.choose(end, &name);
            }
        }
    }

    fn title(&mut self, ui: &mut Ui) {
        let (name, about) = match self.card {
            Card::End(end) => (self.session.blend.ends.get(end).map_or("", String::as_str), "The material as it is"),
            Card::Explored => ("Explored", "What the code at this place of the latent map decodes to"),
            Card::Method(name) => {
                Catalog::interpolation_entry(name).map_or((name, ""), |entry| (entry.title, entry.about))
            }
        };
        let line = Layout::left_to_right(Align::Min);
        let mut is_over = false;
        ui.allocate_ui_with_layout(vec2(ui.available_width(), TITLE), line, |ui| {
            ui.set_min_height(TITLE);
            if let Card::End(end) = self.card {
                let (rect, _) = ui.allocate_exact_size(vec2(24.0, 18.0), Sense::hover());
                look::badge(ui.painter(), rect.left_center() + vec2(9.0, 0.0), end, true, ui.visuals());
            }
            if matches!(self.card, Card::Method(_)) && self.session.blend.is_outside() {
                let mark = RichText::new("beyond").small().color(ui.visuals().warn_fg_color);
                ui.label(mark).on_hover_text("Beyond the ends: a guess, no mixture of what is known");
                ui.add_space(6.0);
            }
            let name = shown(name);
            if self.card == Card::Explored {
                let end = ui.small_button("End").on_hover_text("No longer show this place of the map (Esc)");
                is_over = end.clicked();
                ui.add_space(6.0);
            }
            ui.add(egui::Label::new(RichText::new(name).strong().size(14.0)).truncate()).on_hover_text(about);
        });
        if is_over {
            self.session.explored = None;
        }
    }

    fn sphere(&mut self, ui: &mut Ui) {
        let (rect, sphere) = ui.allocate_exact_size(Vec2::splat(self.side), Sense::click_and_drag());
        let name = match self.card {
            Card::End(end) => letter(end).to_string(),
            Card::Method(name) => name.to_owned(),
            Card::Explored => "explored".to_owned(),
        };
        sphere.widget_info(|| {
            WidgetInfo::labeled(egui::Role::Image, true, format!("Sphere {name}: {}", told(self.view)))
        });
        light(self.session, ui, rect, &sphere);
        if picture(ui, rect, self.view) {
            mark(self.session, ui, rect, &sphere);
        }
        look::focus(ui.painter(), &sphere, ui.visuals());
        sphere.on_hover_cursor(CursorIcon::Crosshair).on_hover_text(HOW);
    }
}

/// Whether a picture is there, in a word.
pub fn told(view: Option<&View>) -> &'static str {
    match view.map_or(&State::Pending, |view| &view.state) {
        State::Pending => "pending",
        State::Shown => "shown",
        State::Failed(_) => "failed",
    }
}

/// The picture of a view, or why there is none; whether it is the one asked for.
pub fn picture(ui: &mut Ui, rect: Rect, view: Option<&View>) -> bool {
    let state = view.map_or(&State::Pending, |view| &view.state);
    let texture = view.and_then(|view| view.texture.as_ref());
    if let Some(texture) = texture.filter(|_| !matches!(state, State::Failed(_))) {
        let tint = if *state == State::Shown { Color32::WHITE } else { Color32::from_white_alpha(50) };
        picture::whole(ui.painter(), texture, rect, tint);
    } else {
        picture::ball(ui.painter(), None, rect, ui.visuals());
    }
    match state {
        State::Pending => wait(ui, rect, "preparing"),
        State::Failed(why) => refuse(ui, rect, why),
        State::Shown => {}
    }
    *state == State::Shown
}

/// Dragging moves the lamp so that its reflection stays under the pointer; or the picked point, or what is shown.
pub fn light(session: &mut Session, ui: &Ui, rect: Rect, sphere: &Response) {
    let is_picking = pick::is_asked(ui, session);
    if let Some(steps) = travel::steps(ui, sphere) {
        nudge(session, steps);
    }
    if framing::change(ui, &mut session.look.scenery.frame, sphere) {
        return;
    }
    if (sphere.dragged() || (is_picking && sphere.clicked()))
        && let Some(pointer) = sphere.interact_pointer_pos()
    {
        let radius = rect.width() / 2.0;
        let from_middle = (pointer - rect.center()) / radius;
        if is_picking {
            let [x, y] = [from_middle.x, -from_middle.y].map(f64::from);
            session.pick.put(session.look.scenery.frame.place([x, y]));
        } else if !session.look.turn_by(sphere.drag_delta().x / radius) {
            session.look.point_at(from_middle.x, -from_middle.y);
        }
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }
}

/// What arrow keys move: the point while it is picked, else the lamp or the map that surrounds the spheres.
fn nudge(session: &mut Session, steps: [f32; 2]) {
    let [across, up] = steps.map(|steps| STEP * steps);
    let Session { look, pick, .. } = session;
    if pick.is_picking {
        let [x, y] = pick.at.unwrap_or_default();
        pick.put([x + across, y + up].map(f64::from));
    } else if !look.turn_by(across) {
        let [x, y] = look.highlight().unwrap_or_default();
        look.point_at(x + across, y + up);
    }
}

/// Where the lamp is mirrored, while that is of use, and the picked point.
pub fn mark(session: &Session, ui: &Ui, rect: Rect, sphere: &Response) {
    if let Some([x, y]) = session.look.highlight().filter(|_| sphere.hovered() || sphere.dragged()) {
        let at: Pos2 = rect.center() + vec2(x, -y) * (rect.width() / 2.0);
        ui.painter().circle_stroke(at, 8.0, Stroke::new(3.0, Color32::from_black_alpha(120)));
        ui.painter().circle_stroke(at, 8.0, Stroke::new(1.5, Color32::WHITE));
    }
    pick::mark(ui, rect, session);
}

/// Over the sphere, without moving what comes below it.
fn over(ui: &mut Ui, rect: Rect) -> Ui {
    ui.new_child(UiBuilder::new().max_rect(rect))
}

fn wait(ui: &mut Ui, rect: Rect, what: &str) {
    let ui = &mut over(ui, rect);
    let middle = Rect::from_center_size(rect.center() - vec2(0.0, 8.0), Vec2::splat(22.0));
    ui.put(middle, Spinner::new().size(22.0));
    let below = Rect::from_center_size(rect.center() + vec2(0.0, 16.0), vec2(rect.width() - 8.0, 18.0));
    ui.put(below, egui::Label::new(RichText::new(what).small().weak()).truncate());
}

fn refuse(ui: &mut Ui, rect: Rect, why: &str) {
    let ui = &mut over(ui, rect);
    let middle = Rect::from_center_size(rect.center(), vec2(0.75 * rect.width(), 18.0));
    let text = RichText::new("not available").small().color(ui.visuals().warn_fg_color);
    ui.put(middle, egui::Label::new(text).truncate()).on_hover_text(why);
}

fn figures(ui: &mut Ui, card: Card, figures: Option<Figures>, (distance, warning): (Option<f64>, Option<&str>)) {
    let shown = |value: Option<f64>, digits: usize| value.map_or("–".to_owned(), |v| format!("{v:.digits$}"));
    let psnr = match figures {
        Some(Figures { psnr, .. }) if psnr >= 100.0 => "exact".to_owned(),
        Some(Figures { psnr, .. }) => format!("{psnr:.1} dB"),
        None => "–".to_owned(),
    };
    let seen = "on a sphere: under this light, at this exposure, with the clip curve";
    line(
        ui,
        "PSNR",
        &psnr,
        &format!("Against the exact linear mix of the ends, in decibels, {seen}. Higher is closer."),
    );
    line(
        ui,
        "ΔE to mix",
        &shown(figures.map(|f| f.to_mix), 1),
        &format!("Mean ΔE_ITP to the exact linear mix of the ends, {seen}. One unit is just noticeable."),
    );
    let nearest = figures.map(|f| f.nearest);
    let label = nearest.map_or("ΔE to end".to_owned(), |(end, _)| format!("ΔE to {}", letter(end)));
    let about = "Mean ΔE_ITP to the nearest end; of an end, to the nearest other one.";
    line(ui, &label, &shown(nearest.map(|(_, distance)| distance), 1), about);
    if card == Card::Explored {
        let about = warning.unwrap_or("it is like them");
        let about = format!("Of the code from those of training; 1 is how far these are from each other: {about}.");
        let mark = if warning.is_some() { "far, " } else { "" };
        line(ui, "Distance", &format!("{mark}{}", shown(distance, 1)), &about);
        return;
    }
    let hue = figures.map(|f| f.hue).filter(|_| matches!(card, Card::Method(_)));
    line(
        ui,
        "Hue detour",
        &shown(hue, 3),
        "How far the mean colour leaves all mixtures of the ends' colours, in u'v'.",
    );
}

fn line(ui: &mut Ui, label: &str, value: &str, about: &str) {
    let line = Layout::left_to_right(Align::Center);
    let shown = ui.allocate_ui_with_layout(vec2(ui.available_width(), LINE), line, |ui| {
        ui.set_min_height(LINE);
        ui.label(RichText::new(label).size(12.0).weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(RichText::new(value).size(12.5)));
    });
    shown.response.on_hover_text(about);
}
