//! The spheres: all side by side, or two of them in one large picture.

mod difference;
mod flicker;
mod large;
mod swipe;

use egui::{Button, ComboBox, CornerRadius, RichText, ScrollArea, Ui};

use super::action::Action;
use super::cards::Cards;
use super::session::Mode;
use super::{Gallery, Session};
use large::Large;

/// The spheres.
pub struct Stage<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
}

impl Stage<'_> {
    /// The side of a sphere that is asked for \[points\].
    pub fn show(self, ui: &mut Ui) -> f32 {
        let Self { session, gallery } = self;
        let mut is_held = false;
        ui.horizontal_wrapped(|ui| {
            modes(ui, session);
            let mode = session.compare.mode;
            if mode == Mode::SideBySide {
                return;
            }
            ui.add_space(6.0);
            let names = if mode == Mode::Swipe { ["Left", "Right"] } else { ["First", "Second"] };
            names.into_iter().enumerate().for_each(|(place, name)| choose(ui, session, place, name));
            match mode {
                Mode::Difference => difference::scale(ui, session),
                Mode::Flicker => is_held = flicker::buttons(ui, session),
                Mode::SideBySide | Mode::Swipe => {}
            }
        });
        let mode = session.compare.mode;
        if mode == Mode::SideBySide {
            return Cards { session, gallery }.show(ui);
        }
        let room = ui.available_size();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let cards = session.compared();
            let large = Large { session, gallery, cards, room };
            match mode {
                Mode::SideBySide | Mode::Swipe => swipe::show(ui, large),
                Mode::Difference => difference::show(ui, large),
                Mode::Flicker => flicker::show(ui, large, is_held),
            }
        });
        large::side(ui, room, mode)
    }
}

/// One button for each way to compare, joined.
fn modes(ui: &mut Ui, session: &mut Session) {
    let apart = std::mem::replace(&mut ui.spacing_mut().item_spacing.x, 1.0);
    for (mode, action) in Mode::ALL.into_iter().zip(ACTIONS) {
        let round = |is_outer: bool| if is_outer { 6 } else { 0 };
        let (left, right) = (round(mode == Mode::SideBySide), round(mode == Mode::Flicker));
        let corners = CornerRadius { nw: left, sw: left, ne: right, se: right };
        let button = Button::new(mode.title()).selected(session.compare.mode == mode).corner_radius(corners);
        let about = format!("{} ({})", mode.about(), action.shown_key(ui.ctx()));
        if ui.add(button).on_hover_text(about).clicked() {
            session.compare.mode = mode;
        }
    }
    ui.spacing_mut().item_spacing.x = apart;
}

/// In the order of the modes.
const ACTIONS: [Action; 4] = [Action::SideBySide, Action::Swipe, Action::Difference, Action::Flicker];

/// One of the two cards.
fn choose(ui: &mut Ui, session: &mut Session, place: usize, name: &str) {
    let label = ui.label(RichText::new(name).weak());
    let now = session.compared();
    let combo = ComboBox::from_id_salt(("compared", place)).selected_text(session.title(now[place])).width(110.0);
    let shown = combo.truncate().show_ui(ui, |ui| {
        for card in session.cards() {
            if ui.selectable_label(card == now[place], session.title(card)).clicked() {
                session.compare.pair.0 = now;
                session.compare.pair.0[place] = card;
            }
        }
    });
    shown.response.labelled_by(label.id).on_hover_text("Any end, and any method that is shown");
}
