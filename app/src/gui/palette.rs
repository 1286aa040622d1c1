//! The command palette: every action and every material, found by a few letters.

use egui::{Align2, Area, Context, Frame, Id, Key, Modifiers, Order, RichText, ScrollArea, TextEdit, Ui, vec2};

use super::action::Action;
use super::pane::Pane;
use super::session::{Session, letter};

/// Rows shown at most; more are found by more letters.
const MOST: usize = 200;
const WIDTH: f32 = 460.0;

/// What a row does.
#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    /// An action.
    Do(Action),
    /// A pane comes to the front.
    Go(Pane),
    /// A kept blend is shown again.
    Load(usize),
    /// A material is put at an end.
    Put(usize, String),
}

/// An open palette.
#[derive(Default)]
pub struct Palette {
    text: String,
    chosen: usize,
    /// Whether it was there when the pointer was last pressed: the click that opens it is beside it.
    was_shown: bool,
}

impl Palette {
    /// One frame; whether it stays open, and what was chosen.
    pub fn show(&mut self, context: &Context, session: &Session, names: &[String]) -> (bool, Option<Choice>) {
        let rows = rows(&self.text, context, session, names);
        let (up, down, enter, escape) = context.input_mut(|input| {
            let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
            (pressed(Key::ArrowUp), pressed(Key::ArrowDown), pressed(Key::Enter), pressed(Key::Escape))
        });
        let last = rows.len().saturating_sub(1);
        self.chosen = (self.chosen + usize::from(down)).saturating_sub(usize::from(up)).min(last);
        let mut taken = enter.then(|| rows.get(self.chosen).map(|row| row.0.clone())).flatten();
        let area =
            Area::new(Id::unique("palette")).order(Order::Foreground).anchor(Align2::CENTER_TOP, vec2(0.0, 64.0));
        let shown = area.show(context, |ui| {
            Frame::popup(ui.style()).inner_margin(10).show(ui, |ui| {
                ui.set_width(WIDTH.min(context.content_rect().width() - 60.0));
                self.field(ui);
                if let Some(choice) = self.list(ui, &rows, up || down) {
                    taken = Some(choice);
                }
            });
        });
        let was_shown = std::mem::replace(&mut self.was_shown, true);
        let is_left = was_shown
            && context.input(|input| input.pointer.any_click())
            && !context.pointer_interact_pos().is_some_and(|at| shown.response.rect.contains(at));
        (taken.is_none() && !escape && !enter && !is_left, taken)
    }

    fn field(&mut self, ui: &mut Ui) {
        let hint = "A command, a pane or a material";
        let field = TextEdit::singleline(&mut self.text).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field.margin(vec2(8.0, 6.0)).lock_focus(true));
        field.request_focus();
        if field.changed() {
            self.chosen = 0;
        }
    }

    fn list(&self, ui: &mut Ui, rows: &[(Choice, String, String)], is_moved: bool) -> Option<Choice> {
        let mut taken = None;
        if rows.is_empty() {
            ui.add_space(8.0);
            ui.label(RichText::new("Nothing has such a name.").weak());
        }
        ScrollArea::vertical().max_height(340.0).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for (place, (choice, title, keys)) in rows.iter().enumerate() {
                let row = ui.add_sized(
                    vec2(ui.available_width(), 26.0),
                    egui::Button::selectable(place == self.chosen, title.as_str())
                        .shortcut_text(RichText::new(keys).weak())
                        .truncate(),
                );
                if place == self.chosen && is_moved {
                    row.scroll_to_me(None);
                }
                if row.clicked() {
                    taken = Some(choice.clone());
                }
            }
        });
        taken
    }
}

/// What matches: every word is somewhere in the title.
fn rows(text: &str, context: &Context, session: &Session, names: &[String]) -> Vec<(Choice, String, String)> {
    let plain = |text: &str| text.to_lowercase().replace(['_', '-', '/'], " ");
    let words = plain(text);
    let actions = Action::ALL
        .iter()
        .filter(|action| **action != Action::Palette)
        .map(|&action| (Choice::Do(action), action.title().to_owned(), action.shown_key(context)));
    let panes = Pane::ALL.iter().map(|&pane| (Choice::Go(pane), format!("Show {}", pane.title()), String::new()));
    let kept = session.blends.iter().enumerate();
    let kept = kept.map(|(place, kept)| (Choice::Load(place), format!("Load blend {}", kept.name), String::new()));
    let ends = session.blend.ends.len();
    // Materials only once something is looked for: 134 names are no overview.
    let materials = names.iter().filter(|_| !words.trim().is_empty()).flat_map(|name| {
        (0..ends).map(move |end| (Choice::Put(end, name.clone()), format!("{name} as {}", letter(end)), String::new()))
    });
    let matches = |row: &(Choice, String, String)| {
        let title = plain(&row.1);
        words.split_whitespace().all(|word| title.contains(word))
    };
    actions.chain(panes).chain(kept).chain(materials).filter(matches).take(MOST).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_letters_find_an_action_a_pane_and_a_material() {
        let (context, mut session) = (Context::default(), Session::default());
        session.keep_blend("bronze age");
        let names = ["blue-fabric".to_owned(), "chrome".to_owned()];
        let found =
            |text: &str| rows(text, &context, &session, &names).into_iter().map(|row| row.0).collect::<Vec<_>>();
        assert_eq!(found("redo"), [Choice::Do(Action::Redo)]);
        assert_eq!(found("show lib"), [Choice::Go(Pane::Library)]);
        assert_eq!(found("load bronze"), [Choice::Load(0)]);
        assert_eq!(found("fabric b")[1], Choice::Put(1, "blue-fabric".to_owned()));
        assert!(found("").iter().all(|choice| !matches!(choice, Choice::Put(..))));
    }
}
