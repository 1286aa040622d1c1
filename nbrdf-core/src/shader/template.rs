//! Texts with places to fill in.

/// The text with every `@name@` replaced by what `value` gives for the name; where it gives nothing, the text stays.
pub(super) fn fill(text: &str, value: &dyn Fn(&str) -> Option<String>) -> String {
    let mut filled = String::with_capacity(2 * text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('@') {
        filled += before;
        let found = after.split_once('@').and_then(|(name, after)| Some((value(name)?, after)));
        match found {
            Some((found, after)) => {
                filled += &found;
                rest = after;
            }
            None => {
                filled.push('@');
                rest = after;
            }
        }
    }
    filled + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_replaced_and_what_is_filled_in_is_not_looked_at() {
        let value = |name: &str| (name == "a").then(|| "@a@".to_owned());
        assert_eq!(fill("@a@, @media @a@ x@b@", &value), "@a@, @media @a@ x@b@");
        assert_eq!(fill("1@a@2@a@", &|_| Some("-".to_owned())), "1-2-");
    }
}
