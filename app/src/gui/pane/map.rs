//! The latent map: every material where its code lies in a plane, and the way between the chosen ones.

mod colours;
mod frame;
mod marks;
mod walk;

use egui::{
    Button, ComboBox, CursorIcon, DragValue, Label, Rect, Response, RichText, Sense, Spinner, Ui, WidgetInfo, vec2,
};

use crate::gui::session::Tint;
use crate::gui::{Gallery, Session, look, travel};
use crate::worker::{Explored, Projection, Track};

use frame::Frame;
use marks::Marks;

/// Smallest side of the map \[points\].
const SMALLEST: f32 = 80.0;
/// How far a key press moves it \[points\].
const STEP: f32 = 24.0;

/// The pane.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) {
    let spots = gallery.atlas.spots(session.map.projection);
    let track = gallery.atlas.track(session.map.projection);
    let range = colours::range(session.map.tint, spots);
    ui.horizontal_wrapped(|ui| {
        choices(ui, session);
        explorer(ui, session, track);
        if !spots.is_empty() {
            colours::legend(ui, session.map.tint, range);
        }
    });
    line(ui, session, gallery);
    let (rect, canvas) =
        ui.allocate_exact_size(ui.available_size().max(vec2(SMALLEST, SMALLEST)), Sense::click_and_drag());
    canvas.widget_info(|| WidgetInfo::labeled(egui::Role::Canvas, true, "Latent map"));
    ui.painter().rect(
        rect,
        look::ROUND,
        look::card_fill(ui.visuals()),
        look::card_stroke(ui.visuals()),
        egui::StrokeKind::Inside,
    );
    look::focus(ui.painter(), &canvas, ui.visuals());
    if spots.is_empty() {
        let text = gallery.atlas.doing.as_deref().unwrap_or("The map appears here as soon as materials are encoded");
        ui.put(
            Rect::from_center_size(rect.center(), vec2(rect.width() - 16.0, 40.0)),
            Label::new(RichText::new(text).weak()).wrap(),
        );
        return;
    }
    let frame = Frame::new(rect, spots, &session.map);
    let on_curve = track.and_then(|track| walk::nearest(&frame, track, canvas.hover_pos()?));
    ground(ui, &canvas, session, &frame, on_curve);
    keys(ui, &canvas, session, &frame);
    let ui = &mut ui.new_child(egui::UiBuilder::new().id_salt(session.map.projection.title()).max_rect(rect));
    ui.shrink_clip_rect(rect);
    if let Some(track) = track {
        walk::curves(ui, &frame, track);
    }
    Marks { session, gallery, frame: &frame, spots, range }.show(ui);
    walk::places(ui, &frame, session, track);
    if let Some(t) = on_curve {
        let about = format!("The way between the materials: click to go to t = {t:.2}");
        canvas.on_hover_cursor(CursorIcon::PointingHand).on_hover_text_at_pointer(about);
    }
}

/// Which map, in which colours, and back to all of it.
fn choices(ui: &mut Ui, session: &mut Session) {
    let map = &mut session.map;
    let mut chosen = map.projection;
    let combo = ComboBox::from_id_salt("projection").selected_text(chosen.title()).width(96.0).show_ui(ui, |ui| {
        for projection in Projection::ALL {
            ui.selectable_value(&mut chosen, projection, projection.title()).on_hover_text(projection.about());
        }
    });
    named(combo.response.on_hover_text(chosen.about()), "Map", chosen.title());
    map.choose(chosen);
    let combo = ComboBox::from_id_salt("tint").selected_text(map.tint.title()).width(104.0).show_ui(ui, |ui| {
        for tint in Tint::all() {
            ui.selectable_value(&mut map.tint, tint, tint.title()).on_hover_text(tint.about());
        }
    });
    named(combo.response.on_hover_text(map.tint.about()), "Colours of the map", map.tint.title());
    if ui.button("Whole map").on_hover_text("All materials in view; the wheel enlarges, dragging moves").clicked() {
        map.reset();
    }
}

fn named(combo: Response, name: &str, chosen: &str) {
    combo.widget_info(|| WidgetInfo::labeled(egui::Role::ComboBox, true, format!("{name}: {chosen}")));
}

/// Begins and ends exploring, and where it is.
fn explorer(ui: &mut Ui, session: &mut Session, track: Option<&Track>) {
    let projection = session.map.projection;
    let Some(explored) = &mut session.explored else {
        let here = track.and_then(|track| track.courses.first()).map(|course| course.here);
        let button = ui.add_enabled(here.is_some(), Button::new("Explore"));
        let button = button.on_hover_text("Show what is at a place of the map on a sphere of its own; or Alt + drag");
        if button.clicked() {
            session.explored = here.map(|place| Explored { projection, place });
        }
        return;
    };
    for (axis, prefix) in ["x ", "y "].into_iter().enumerate() {
        let field =
            DragValue::new(&mut explored.place[axis]).speed(0.01).range(-1e4..=1e4).max_decimals(3).prefix(prefix);
        ui.add(field)
            .on_hover_text(format!("The explored place, in units of the map ({})", explored.projection.title()));
    }
    if ui.button("End exploring").on_hover_text("No longer show this place (Esc)").clicked() {
        session.explored = None;
    }
}

/// What goes on, what is odd about the explored place, or what can be done.
fn line(ui: &mut Ui, session: &Session, gallery: &Gallery) {
    ui.horizontal(|ui| {
        let (distance, warning) = gallery.atlas.explored();
        let text = if let Some(doing) = &gallery.atlas.doing {
            ui.add(Spinner::new().size(12.0));
            RichText::new(doing).small().weak()
        } else if let Some(warning) = warning.filter(|_| session.explored.is_some()) {
            RichText::new(format!("Explored: {warning}")).small().color(ui.visuals().warn_fg_color)
        } else if let Some(distance) = distance.filter(|_| session.explored.is_some()) {
            RichText::new(format!("Explored: {distance:.1} from the codes of training; 1 is how far these are apart"))
                .small()
                .weak()
        } else {
            RichText::new("Click for A, shift-click for B; drag the dot, or Alt + drag, to explore").small().weak()
        };
        let about = match session.explored.map(|explored| explored.projection) {
            Some(Projection::Pca) => {
                "The code on the plane, and what the six nearest codes are off the plane in the mean"
            }
            Some(Projection::Charting) => "The weighted mean of the six nearest codes",
            None => "Arrow keys move between materials once one has the focus; A to F put that one at a slot",
        };
        ui.add(Label::new(text).truncate()).on_hover_text(about);
    });
}

/// The wheel, and what dragging and clicking beside all marks do.
fn ground(ui: &Ui, canvas: &Response, session: &mut Session, frame: &Frame, on_curve: Option<f32>) {
    if ui.rect_contains_pointer(frame.rect)
        && let Some(pointer) = ui.input(|input| input.pointer.hover_pos())
    {
        let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let factor = (0.004 * wheel).exp() * pinch;
        if factor != 1.0 {
            session.map.zoom_by(factor, frame.offset(pointer));
        }
    }
    if canvas.dragged()
        && let Some(pointer) = canvas.interact_pointer_pos()
    {
        if ui.input(|input| input.modifiers.alt) {
            explore(session, frame, pointer);
        } else {
            let moved = canvas.drag_delta() / frame.scale;
            let [x, y] = session.map.centre;
            session.map.centre = [x - moved.x, y + moved.y];
        }
    }
    if let Some(t) = on_curve.filter(|_| canvas.clicked()) {
        session.blend.go_to(t);
    }
}

/// What keys do while the map has the focus.
fn keys(ui: &Ui, canvas: &Response, session: &mut Session, frame: &Frame) {
    if let Some([x, y]) = travel::steps(ui, canvas) {
        let step = STEP / frame.scale;
        let [across, up] = session.map.centre;
        session.map.centre = [across + step * x, up + step * y];
    }
    if let Some(factor) = travel::zoom(ui, canvas) {
        session.map.zoom_by(factor, frame.offset(frame.rect.center()));
    }
    if travel::is_home(ui, canvas) {
        session.map.reset();
    }
}

/// Looks at what is under the pointer.
fn explore(session: &mut Session, frame: &Frame, pointer: egui::Pos2) {
    let pointer = frame.rect.clamp(pointer);
    session.explored = Some(Explored { projection: session.map.projection, place: frame.place(pointer) });
}
