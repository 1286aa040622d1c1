//! What lies over the panes: palette, files to be written, keys, and what is dragged.

use egui::Context;

use super::Workbench;
use crate::gui::exports::Wish;
use crate::gui::palette::Choice;
use crate::gui::{drag, help};

impl Workbench {
    /// One frame, and what was chosen there.
    pub(super) fn overlays(&mut self, context: &Context) {
        if let Some(palette) = &mut self.passing.palette {
            let (stays, choice) = palette.show(context, &self.session, &self.gallery.names);
            if !stays {
                self.passing.palette = None;
            }
            match choice {
                Some(Choice::Do(action)) => self.act(action, context),
                Some(Choice::Go(pane)) => self.enter(pane),
                Some(Choice::Load(place)) => self.session.load_blend(place),
                Some(Choice::Put(end, name)) => self.session.blend.choose(end, &name),
                None => {}
            }
        }
        if let Some(exports) = &mut self.passing.exports {
            let (stays, wish) = exports.show(context, &mut self.session, &self.gallery);
            if !stays {
                self.passing.exports = None;
            }
            match wish {
                Some(Wish::Look(files)) => self.worker.look_for(files),
                Some(Wish::Write(job)) => {
                    self.gallery.files.progress = Some(0.0);
                    self.worker.write(*job);
                }
                Some(Wish::Stop) => self.worker.stop_writing(),
                None => {}
            }
        }
        if self.passing.is_helping {
            self.passing.is_helping = help::show(context);
        }
        drag::show(context, &self.gallery);
    }
}
