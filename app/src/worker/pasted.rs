//! Codes that came from no file: they are materials as those of files are, and the session keeps their text.

use serde::{Deserialize, Serialize};

use super::files::Desk;
use super::{Answer, guarded};
use crate::material::{decoded, parse_code};
use nbrdf_core::library::is_name;

/// A code as text, and what it is called in the list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PastedCode {
    /// Name of its material.
    pub name: String,
    /// The code as JSON, believed only after a look.
    pub text: String,
}

impl Desk {
    /// Lists the material of a code on the clipboard.
    pub(super) fn paste(&self, text: String) {
        match guarded("Reading the code", || self.list_code(&text, None)) {
            Ok(Ok(name)) => self.office.say(Answer::Pasted(PastedCode { name, text })),
            Ok(Err(why)) | Err(why) => self.office.say(Answer::Notice(why)),
        }
    }

    /// Lists the material of a code of the last session under the name it had. One that gives none stays with the session:
    /// another version, or another checkpoint, may read it.
    pub(super) fn paste_again(&self, code: PastedCode) {
        match guarded("Reading the code", || self.list_code(&code.text, Some(&code.name))) {
            Ok(Ok(_)) => {}
            Ok(Err(why)) | Err(why) => {
                let advice = "It is tried again at the next start";
                self.office
                    .say(Answer::Notice(format!("A pasted code of the last session gives nothing: {why}. {advice}")));
            }
        }
    }

    /// The name that the material of a code has in the list.
    fn list_code(&self, text: &str, name: Option<&str>) -> Result<String, String> {
        let mut code = parse_code("clipboard", text.as_bytes()).map_err(|error| format!("{error:#}"))?;
        if let Some(name) = name {
            let refused = || "clipboard: expected a printable name, found another: paste the code again".to_owned();
            code.material = Some(is_name(name).then(|| name.to_owned()).ok_or_else(refused)?);
        }
        let item = decoded(&self.office.stock.catalog, code, "clipboard").map_err(|error| format!("{error:#}"))?;
        let material = self.office.materials.add(item.material);
        Ok(self.list(vec![material]).concat())
    }
}
