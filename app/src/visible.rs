//! Text for a terminal.

/// Shows control characters instead of sending them: names and contents of files may hold any, and a terminal obeys them.
pub fn visible(text: &str) -> String {
    let is_shown = |c: char| !c.is_control() || matches!(c, '\n' | '\t');
    text.chars().map(|c| if is_shown(c) { c.to_string() } else { c.escape_default().to_string() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_seen_and_lines_stay() {
        assert_eq!(visible("a\u{1b}]0;b\u{7}\tθ\nc\r"), "a\\u{1b}]0;b\\u{7}\tθ\nc\\r");
    }
}
