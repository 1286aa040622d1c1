//! The panes, and the bars above and below them.

use egui::{CentralPanel, Frame, Margin, Panel, Ui};

use super::Workbench;
use super::passing::Passing;
use crate::gui::Layout;
use crate::gui::header::Header;
use crate::gui::notices::Notices;
use crate::gui::pane::{Desk, Wanted};
use crate::gui::shelf::Errand;
use crate::gui::status::Status;

impl Workbench {
    /// One frame; what the panes ask for.
    pub(super) fn panels(&mut self, ui: &mut Ui) -> Wanted {
        // Nothing is filled: whoever draws begins with the colour of the panels, which costs least.
        let frame = |x: i8, y: i8| Frame::new().inner_margin(Margin::symmetric(x, y));
        let (is_settled, is_around, ways) = (self.is_settled(), self.session.look.is_around(), self.history.ways());
        let asked = Panel::top("header")
            .exact_size(44.0)
            .frame(frame(14, 0))
            .show(ui, |ui| Header { session: &mut self.session, ways }.show(ui));
        asked.inner.into_iter().for_each(|action| self.act(action, ui.ctx()));
        let gallery = &mut self.gallery;
        Panel::bottom("status")
            .exact_size(24.0)
            .frame(frame(14, 0))
            .show(ui, |ui| Status { gallery, is_settled, is_around }.show(ui));
        if !gallery.notices.is_empty() {
            Panel::top("notices").frame(frame(12, 6)).show(ui, |ui| Notices { gallery }.show(ui));
        }
        let Passing { is_searching, opener, errands, entered, is_entering, .. } = &mut self.passing;
        let mut entering = entered.filter(|_| std::mem::take(is_entering));
        let session = &mut self.session;
        let entering = &mut entering;
        let mut desk = Desk { session, gallery, is_searching, entering, opener, errands, wanted: Wanted::default() };
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            let layout = self.layout.get_or_insert_with(|| Layout::of(ui.available_width()));
            layout.show(ui, &mut desk);
        });
        let wanted = desk.wanted;
        self.run_errands();
        wanted
    }

    /// What the library asked for.
    fn run_errands(&mut self) {
        for errand in self.passing.errands.drain(..) {
            match errand {
                Errand::Choose => self.worker.choose(),
                Errand::Open(path) => self.worker.open(path),
                Errand::Cancel(job) => self.worker.cancel(job),
            }
        }
    }
}
