//! Extensions of files, for messages.

/// As a message lists them: `.a, .b or .c`.
pub fn listed(extensions: &[&str]) -> String {
    let dotted: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
    match dotted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, first)) => format!("{} or {last}", first.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_of_a_list_is_set_apart() {
        assert_eq!(listed(&["a"]), ".a");
        assert_eq!(listed(&["a", "b", "c"]), ".a, .b or .c");
        assert_eq!(listed(&[]), "");
    }
}
