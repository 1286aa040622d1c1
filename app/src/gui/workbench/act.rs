//! What actions do.

use egui::{Context, ThemePreference, ViewportCommand};

use super::Workbench;
use crate::gui::action::Action;
use crate::gui::exports::Exports;
use crate::gui::palette::Palette;
use crate::gui::pane::Pane;
use crate::gui::session::{MAX_EXPOSURE, Mode};
use crate::gui::{Layout, Session, reproduce};
use crate::worker::Timing;

impl Workbench {
    /// Does something that was asked for by key, by button or by name.
    pub fn act(&mut self, action: Action, context: &Context) {
        let Session { blend, look, compare, pick, .. } = &mut self.session;
        match action {
            Action::Palette => self.passing.palette = Some(Palette::default()),
            Action::Help => self.passing.is_helping = !self.passing.is_helping,
            Action::Undo => self.history.undo(&mut self.session),
            Action::Redo => self.history.redo(&mut self.session),
            Action::Open => {
                self.bring(Pane::Library);
                self.passing.opener.begin();
                self.worker.choose();
            }
            Action::NextPane => self.enter_next(1),
            Action::PaneBefore => self.enter_next(Pane::ALL.len() - 1),
            Action::Search => {
                self.bring(Pane::Library);
                self.passing.is_searching = true;
            }
            Action::Play => blend.toggle_play(),
            Action::Swap => blend.swap(),
            Action::Beyond => {
                blend.is_beyond = !blend.is_beyond;
                blend.go_to(blend.t);
            }
            Action::Timing if blend.timing == Timing::Even => blend.timing = Timing::Straight,
            Action::Timing => blend.timing = Timing::Even,
            Action::Reset => self.session.reset(),
            Action::Brighter => look.exposure = (look.exposure + 0.5).min(MAX_EXPOSURE),
            Action::Darker => look.exposure = (look.exposure - 0.5).max(-MAX_EXPOSURE),
            Action::Light => look.next_light(&self.gallery.maps),
            Action::Strips => self.session.strips = !self.session.strips,
            Action::SideBySide => compare.mode = Mode::SideBySide,
            Action::Swipe => compare.mode = Mode::Swipe,
            Action::Difference => compare.mode = Mode::Difference,
            Action::Flicker => compare.mode = Mode::Flicker,
            Action::Pick => {
                pick.is_picking = !pick.is_picking;
                if pick.is_picking {
                    self.bring(Pane::Point);
                }
            }
            Action::Export => self.passing.exports = Some(Exports::default()),
            Action::CopyCode => self.worker.code(self.session.shown()),
            Action::CopyCommand => {
                context.copy_text(reproduce::command(&self.session));
                self.gallery.notify("The command that draws this is on the clipboard.".to_owned());
            }
            Action::Theme => {
                let is_dark = context.theme() == egui::Theme::Dark;
                self.session.theme = if is_dark { ThemePreference::Light } else { ThemePreference::Dark };
            }
            Action::Arrange => self.layout = Some(Layout::of(context.content_rect().width())),
            Action::Quit => context.send_viewport_cmd(ViewportCommand::Close),
            Action::Leave => self.session.explored = None,
        }
    }
}
