//! A heat map of how two spheres differ, with its scale.

use egui::{Align2, Color32, ComboBox, FontId, Mesh, Rect, RichText, Sense, Ui, WidgetInfo, lerp, pos2, vec2};
use nbrdf_core::image::DISPLAY_GAMMA;

use super::large::{self, Large};
use crate::gui::gallery::{Heat, State};
use crate::gui::{Session, card, picture};
use crate::report::heat::heat;
use crate::worker::Scale;

/// Scales that can be chosen \[ΔE_ITP\].
const TOPS: [u16; 6] = [2, 5, 10, 20, 50, 100];
/// The bar's height, and of its numbers.
const BAR: f32 = 12.0;
const NUMBERS: f32 = 18.0;
const PIECES: u16 = 64;

/// Chooses where the colours end.
pub fn scale(ui: &mut Ui, session: &mut Session) {
    let label = ui.label(RichText::new("Scale").weak());
    let name = |scale: Scale| match scale {
        Scale::Whole => "all".to_owned(),
        Scale::UpTo(top) => format!("0 to {top}"),
    };
    let now = session.compare.scale;
    let combo = ComboBox::from_id_salt("scale").selected_text(name(now)).width(72.0).show_ui(ui, |ui| {
        for scale in std::iter::once(Scale::Whole).chain(TOPS.map(Scale::UpTo)) {
            ui.selectable_value(&mut session.compare.scale, scale, name(scale));
        }
    });
    let about = "ΔE_ITP at which the colours end; a fixed scale lets differences be compared, all fits the largest";
    combo.response.labelled_by(label.id).on_hover_text(about);
}

/// One frame.
pub fn show(ui: &mut Ui, mut large: Large<'_>) {
    let (rect, picture) = large.allocate(ui);
    let views = large.cards.map(|card| large.gallery.view(card));
    let is_there = views.iter().all(|view| view.is_some_and(|view| view.state == State::Shown));
    let found = large.gallery.heat.as_ref().filter(|heat| is_there && heat.cards == large.cards);
    let [first, second] = [0, 1].map(|place| large.name(place));
    let Some(found) = found else {
        // Whatever keeps one of the two from being shown keeps the difference, too.
        let missing = views.into_iter().find(|view| view.is_none_or(|view| view.state != State::Shown)).flatten();
        card::picture(ui, rect, missing.filter(|view| view.state != State::Shown));
        large.describe(ui, picture, &format!("Difference of {first} and {second}: {}", card::told(missing)));
        return large::caption(ui, rect, [&first, &second]);
    };
    picture::whole(ui.painter(), &found.texture, rect, Color32::WHITE);
    card::mark(large.session, ui, rect, &picture);
    let Heat { mean, largest, top, .. } = *found;
    large.describe(ui, picture, &format!("Difference of {first} and {second}: mean {mean:.2}, largest {largest:.1}"));
    let (left, right) = (format!("mean {mean:.2}"), format!("largest {largest:.1} ΔE_ITP"));
    large::caption(ui, rect, [&left, &right]);
    bar(ui, rect, top);
}

/// The colours, with numbers under them.
fn bar(ui: &mut Ui, picture: Rect, top: u16) {
    let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), BAR + NUMBERS), Sense::hover());
    let picture = large::under(ui, picture);
    let rect = Rect::from_min_size(pos2(picture.left(), row.top()), vec2(picture.width(), BAR));
    let mut mesh = Mesh::default();
    for piece in 0..=PIECES {
        let share = f32::from(piece) / f32::from(PIECES);
        let x = lerp(rect.x_range(), share);
        [rect.top(), rect.bottom()].into_iter().for_each(|y| mesh.colored_vertex(pos2(x, y), colour(share)));
        if piece > 0 {
            let first = 2 * u32::from(piece) - 2;
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    ui.painter().add(mesh);
    let quiet = ui.visuals().weak_text_color();
    let marks = [(0.0, Align2::LEFT_TOP), (0.5, Align2::CENTER_TOP), (1.0, Align2::RIGHT_TOP)];
    for (share, align) in marks {
        let unit = if share < 1.0 { "" } else { " ΔE_ITP" };
        let text = format!("{}{unit}", share * f32::from(top));
        let at = pos2(lerp(rect.x_range(), share), rect.bottom() + 2.0);
        ui.painter().text(at, align, text, FontId::proportional(11.0), quiet);
    }
    let bar = ui.interact(rect, ui.scope_id().with("bar"), Sense::hover());
    bar.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, format!("Scale from 0 to {top} ΔE_ITP")));
    bar.on_hover_text("ΔE_ITP of the displayed pictures, pixel by pixel; one unit is just noticeable");
}

/// As the map shows a share of its scale.
fn colour(share: f32) -> Color32 {
    let shown = heat(f64::from(share)).map(|linear| 255.0 * linear.max(0.0).powf(1.0 / DISPLAY_GAMMA));
    let [r, g, b] = shown.0.map(|value| value.round() as u8);
    Color32::from_rgb(r, g, b)
}
