//! Codes that were pasted: they have no file that could be read again.

use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

use crate::worker::PastedCode;

/// Most codes that are kept for the next start.
const MOST_PASTED: usize = 64;
/// Longest text of a code that is kept \[bytes\]; one of 32 numbers has some 600.
const LONGEST_PASTED: usize = 1 << 16;

/// Codes in the order they were pasted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Pasted(#[serde(deserialize_with = "lenient")] Vec<PastedCode>);

impl Pasted {
    /// All of them.
    pub fn codes(&self) -> &[PastedCode] {
        &self.0
    }

    /// Keeps a code for the next start.
    ///
    /// # Errors
    /// Why there is no room for it, for people.
    pub fn keep(&mut self, code: PastedCode) -> Result<(), String> {
        let why = if self.0.len() >= MOST_PASTED {
            format!("{MOST_PASTED} pasted codes are kept at most")
        } else if code.text.len() > LONGEST_PASTED {
            format!("its text has {} bytes, and {LONGEST_PASTED} are kept at most", code.text.len())
        } else {
            self.0.push(code);
            return Ok(());
        };
        Err(format!("{}: gone after a restart, {why}: save it as a file and open that", code.name))
    }

    /// Whether a material came from a code.
    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|known| known.name == name)
    }

    /// Keeps the codes no longer of which this says so.
    pub fn forget(&mut self, is_meant: impl Fn(&PastedCode) -> bool) {
        self.0.retain(|known| !is_meant(known));
    }

    /// Only what there is room for, and what is to be said of the others: a file may hold more.
    pub fn within_bounds(self) -> (Self, Vec<String>) {
        let mut kept = Self::default();
        let lost = self.0.into_iter().filter_map(|code| kept.keep(code).err()).collect();
        (kept, lost)
    }
}

/// What is no code stays as text, so that whoever reads it can say so; the session is worth more than one of them.
fn lenient<'a, D: Deserializer<'a>>(from: D) -> Result<Vec<PastedCode>, D::Error> {
    let damaged = |value: Value| PastedCode { name: "damaged code".to_owned(), text: value.to_string() };
    let code = |value: Value| serde_json::from_value(value.clone()).unwrap_or_else(|_| damaged(value));
    Ok(match Value::deserialize(from)? {
        Value::Array(values) => values.into_iter().map(code).collect(),
        Value::Null => Vec::new(),
        other => vec![damaged(other)],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(name: &str, length: usize) -> PastedCode {
        PastedCode { name: name.to_owned(), text: "x".repeat(length) }
    }

    #[test]
    fn number_and_size_are_bounded_and_what_is_left_out_is_said() {
        let all = (0..MOST_PASTED + 2).map(|at| code(&format!("code {at}"), 10));
        let pasted = Pasted(std::iter::once(code("long", LONGEST_PASTED + 1)).chain(all).collect());
        let (mut kept, lost) = pasted.within_bounds();
        assert_eq!(kept.codes().len(), MOST_PASTED);
        assert!(lost.len() == 3 && lost[0].contains("long") && lost[1].contains("64"), "{lost:?}");
        assert!(kept.has("code 0") && !kept.has("long") && !kept.has("code 64"));
        kept.forget(|code| code.name == "code 0");
        assert!(!kept.has("code 0"));
        assert_eq!(kept.keep(code("new", 10)), Ok(()));
    }

    #[test]
    fn what_is_no_code_harms_no_other_and_no_session() {
        let text = r#"[{"name": "a", "text": "{}"}, 7, {"name": 1}, null]"#;
        let found: Pasted = serde_json::from_str(text).unwrap();
        let texts: Vec<&str> = found.codes().iter().map(|code| code.text.as_str()).collect();
        assert_eq!(texts, ["{}", "7", r#"{"name":1}"#, "null"]);
        assert_eq!(serde_json::from_str::<Pasted>("7").unwrap().codes().len(), 1);
        let again: Pasted = serde_json::from_str(&serde_json::to_string(&found).unwrap()).unwrap();
        assert_eq!(again, found);
    }
}
