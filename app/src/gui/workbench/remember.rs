//! What is kept of a frame.

use egui::Context;

use super::Workbench;

impl Workbench {
    /// For undo, and for the next start.
    pub(super) fn remember(&mut self, context: &Context) {
        // A turn of the wheel, a pinch and a key that is held are one step each, too.
        let is_moving = context.input(|input| {
            let is_turned = input.is_scrolling() || input.zoom_delta() != 1.0;
            input.pointer.any_down() || is_turned || !input.keys_down.is_empty()
        });
        self.passing.was_typing = context.text_edit_focused();
        let is_busy = is_moving || self.passing.was_typing;
        self.history.watch(&self.session, !is_busy);
        if let Some(store) = &mut self.store {
            let size = context.content_rect().size();
            let rest = store.keep(&self.session, self.layout.as_ref(), Some([size.x, size.y]));
            rest.into_iter().for_each(|rest| context.request_repaint_after(rest));
        }
    }
}
