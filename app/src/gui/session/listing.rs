//! Which materials the library lists.

use nbrdf_core::Database;
use serde::{Deserialize, Serialize};

/// What a material must be to be listed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Listing {
    /// What names must contain.
    pub search: String,
    /// Whose materials.
    pub database: Option<Database>,
}

impl Listing {
    /// Whether a material is listed: every word of the search is in its name.
    pub fn lists(&self, name: &str) -> bool {
        let plain = |text: &str| text.to_lowercase().replace(['_', '-', '/'], " ");
        let (name_plain, search) = (plain(name), plain(&self.search));
        search.split_whitespace().all(|word| name_plain.contains(word))
            && self.database.is_none_or(|database| Database::of(name) == database)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn search_takes_words_in_any_order_and_any_hyphen() {
        let listing = Listing { search: "fabric BLUE".to_owned(), ..Listing::default() };
        assert!(listing.lists("blue-fabric") && !listing.lists("blue-rubber"));
        let rgl = Listing { database: Some(Database::Rgl), ..Listing::default() };
        assert!(rgl.lists("rgl/paper_white") && !rgl.lists("chrome"));
    }
}
