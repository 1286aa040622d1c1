//! What can be done from the keyboard, by name: keys, command palette and help all read this list.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn command(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn command_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

const REDO: KeyboardShortcut = command_shift(Key::Z);

/// One line for each action: its name, what it does for people, its keys, of which the first is shown.
macro_rules! actions {
    ($($name:ident: $title:literal, [$($key:expr),*];)*) => {
        /// Something to do.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Action {
            $(#[doc = $title] $name,)*
        }

        impl Action {
            /// All of them, in the order of the help.
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// What it does, for people.
            pub const fn title(self) -> &'static str {
                match self {
                    $(Self::$name => $title,)*
                }
            }

            /// Its keys; the first is shown.
            pub const fn keys(self) -> &'static [KeyboardShortcut] {
                match self {
                    $(Self::$name => const { &[$($key),*] },)*
                }
            }
        }
    };
}

actions! {
    Palette: "Find a command or a material", [command(Key::P)];
    Help: "Show all keys", [plain(Key::F1), plain(Key::Questionmark)];
    Undo: "Undo", [command(Key::Z)];
    Redo: "Redo", [command(Key::Y), REDO];
    Open: "Open files", [command(Key::O)];
    NextPane: "Go to the next pane", [plain(Key::F6)];
    PaneBefore: "Go to the pane before", [shift(Key::F6)];
    Search: "Search the library", [command(Key::F)];
    Play: "Play or pause", [plain(Key::Space)];
    Swap: "Walk the other way round", [plain(Key::X)];
    Beyond: "Go beyond the ends, or no longer", [plain(Key::E)];
    Timing: "Even or straight timing", [plain(Key::T)];
    Reset: "Reset place, light and exposure", [plain(Key::R)];
    Brighter: "Half a stop brighter", [plain(Key::Plus), plain(Key::Equals)];
    Darker: "Half a stop darker", [plain(Key::Minus)];
    Light: "Next light", [plain(Key::L)];
    Strips: "Show or hide film strips", [plain(Key::F)];
    SideBySide: "Compare side by side", [plain(Key::Num1)];
    Swipe: "Compare by a divider", [plain(Key::Num2)];
    Difference: "Compare by their difference", [plain(Key::Num3)];
    Flicker: "Compare by flicker", [plain(Key::Num4)];
    Pick: "Pick a point, or no longer", [plain(Key::P)];
    Export: "Write pictures, materials and figures to files", [command(Key::E)];
    CopyCode: "Copy the code of this point", [command_shift(Key::C)];
    CopyCommand: "Copy the command that draws this", [command_shift(Key::X)];
    Theme: "Dark or light theme", [];
    Leave: "End exploring the latent map", [];
    Arrange: "Put all panes back in place", [];
    Quit: "Close the window", [command(Key::Q)];
}

impl Action {
    /// The first key as it is written on keyboards; empty where there is none.
    pub fn shown_key(self, context: &Context) -> String {
        // As on the key: a name would be looked for among those with names.
        let symbol = |text: String| text.replace("Plus", "+").replace("Minus", "−");
        self.keys().first().map_or_else(String::new, |key| symbol(context.format_shortcut(key)))
    }

    /// What was just asked for by keys. Plain letters are left to a text that is being typed, and the space bar to
    /// whatever has the focus.
    pub fn pressed(context: &Context) -> Vec<Self> {
        let is_typing = context.text_edit_focused();
        let is_focused = context.memory(|memory| memory.focused().is_some_and(|id| id != super::scrubber::id()));
        let is_free = |key: &KeyboardShortcut| match key.logical_key {
            _ if !key.modifiers.is_none() => true,
            Key::Space => !is_focused,
            Key::F1 | Key::F6 => true,
            letter => !is_typing && !super::put::takes(context, letter),
        };
        // Shortcuts with more modifiers first, so that none is taken for a shorter one.
        let mut keys: Vec<_> =
            Self::ALL.iter().flat_map(|action| action.keys().iter().map(move |key| (*action, key))).collect();
        keys.sort_by_key(|(_, key)| !key.modifiers.shift);
        let is_pressed = |(action, key): &(Self, &KeyboardShortcut)| {
            // In a text, undo is the text's.
            let is_texts = is_typing && matches!(action, Self::Undo | Self::Redo);
            is_free(key) && !is_texts && context.input_mut(|input| input.consume_shortcut(key))
        };
        keys.iter().filter(|entry| is_pressed(entry)).map(|(action, _)| *action).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_actions_share_a_key_or_a_title() {
        let keys: Vec<_> = Action::ALL.iter().flat_map(|action| action.keys()).collect();
        let titles: Vec<_> = Action::ALL.iter().map(|action| action.title()).collect();
        assert!(keys.iter().enumerate().all(|(place, key)| !keys[..place].contains(key)), "{keys:?}");
        assert!(titles.iter().enumerate().all(|(place, title)| !titles[..place].contains(title)), "{titles:?}");
    }
}
