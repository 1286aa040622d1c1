//! Names of materials as names in programs.

/// `prefix`, `_` and the name in lower case, with one `_` for every run of characters that are no ASCII letters or digits:
/// no name of it begins with a digit, is a keyword, or has two `_` in a row, which GLSL keeps to itself.
pub(super) fn of(prefix: &str, name: &str) -> String {
    let mut found = prefix.to_owned();
    for word in name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()) {
        found.push('_');
        found.push_str(&word.to_ascii_lowercase());
    }
    found
}

/// The name within a comment of any language: letters, digits and a few signs, none of which ends a comment, a line, or the
/// part of a page that the comment stands in.
pub(super) fn in_comment(name: &str) -> String {
    let is_harmless = |c: char| c.is_ascii_alphanumeric() || " -_.,()+%/".contains(c);
    name.chars().map(|c| if is_harmless(c) { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_becomes_an_identifier() {
        for (name, expected) in [
            ("chrome", "f_r_chrome"),
            ("alum-bronze", "f_r_alum_bronze"),
            ("rgl/paper_white", "f_r_rgl_paper_white"),
            ("2-layer--Gold ", "f_r_2_layer_gold"),
            ("__main__", "f_r_main"),
            ("grün", "f_r_gr_n"),
            ("漆", "f_r"),
            ("", "f_r"),
        ] {
            assert_eq!(of("f_r", name), expected);
        }
    }

    #[test]
    fn no_name_leaves_its_comment() {
        assert_eq!(in_comment("rgl/paper_white"), "rgl/paper_white");
        assert_eq!(in_comment("a\nint x; */ </script>\\"), "a_int x_ _/ _/script__");
    }
}
