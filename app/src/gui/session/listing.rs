//! Which materials the library lists, and in which order.

use std::collections::BTreeSet;

use nbrdf_core::Database;
use nbrdf_core::class::Class;
use serde::{Deserialize, Serialize};

use super::Sort;

/// What a material must be to be listed, and how it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Listing {
    /// What names must contain.
    pub search: String,
    /// Whose materials.
    pub database: Option<Database>,
    /// Of which kind.
    pub class: Option<Class>,
    /// Whether only favourites are listed.
    pub is_favourites: bool,
    /// Names of the favourites.
    pub favourites: BTreeSet<String>,
    /// In which order.
    pub sort: Sort,
    /// Whether the order is turned round.
    pub is_descending: bool,
    /// Whether there are pictures alone.
    pub is_grid: bool,
}

impl Listing {
    /// Whether a material is listed: every word of the search is in its name.
    pub fn lists(&self, name: &str) -> bool {
        let plain = |text: &str| text.to_lowercase().replace(['_', '-', '/'], " ");
        let (name_plain, search) = (plain(name), plain(&self.search));
        search.split_whitespace().all(|word| name_plain.contains(word))
            && self.database.is_none_or(|database| Database::of(name) == database)
            && self.class.is_none_or(|class| Class::of(name) == class)
            && (!self.is_favourites || self.favourites.contains(name))
    }

    /// Whether something other than the search leaves materials out.
    pub const fn is_filtered(&self) -> bool {
        self.database.is_some() || self.class.is_some() || self.is_favourites
    }

    /// Lists all that the search finds.
    pub fn clear_filters(&mut self) {
        (self.database, self.class, self.is_favourites) = (None, None, false);
    }

    /// Makes a material a favourite, or no longer.
    pub fn toggle_favourite(&mut self, name: &str) {
        if !self.favourites.remove(name) {
            self.favourites.insert(name.to_owned());
        }
    }

    /// The materials that are listed, in order; `value` of those that have none comes last.
    pub fn order<'a>(&self, names: &'a [String], value: impl Fn(&str) -> Option<f64>) -> Vec<&'a str> {
        let mut listed: Vec<&str> = names.iter().map(String::as_str).filter(|name| self.lists(name)).collect();
        match self.sort {
            Sort::Database => {}
            Sort::Name => listed.sort_by_cached_key(|name| shown(name).to_lowercase()),
            _ => {
                let value = |name: &str| value(name).filter(|value| value.is_finite());
                let (mut known, unknown): (Vec<_>, Vec<_>) =
                    listed.into_iter().map(|name| (name, value(name))).partition(|(_, value)| value.is_some());
                known.sort_by(|(_, a), (_, b)| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
                if self.is_descending {
                    known.reverse();
                }
                return known.into_iter().chain(unknown).map(|(name, _)| name).collect();
            }
        }
        if self.is_descending {
            listed.reverse();
        }
        listed
    }
}

/// A name without the mark of its database.
pub fn shown(name: &str) -> &str {
    name.strip_prefix("rgl/").unwrap_or(name)
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

    #[test]
    fn all_filters_must_agree() {
        let mut listing = Listing { class: Some(Class::Fabric), database: Some(Database::Merl), ..Listing::default() };
        assert!(listing.lists("pink-felt") && !listing.lists("rgl/satin_gold") && !listing.lists("chrome"));
        listing.is_favourites = true;
        assert!(!listing.lists("pink-felt"));
        listing.toggle_favourite("pink-felt");
        assert!(listing.lists("pink-felt") && listing.is_filtered());
        listing.toggle_favourite("pink-felt");
        assert!(!listing.lists("pink-felt"));
        listing.clear_filters();
        assert!(listing.lists("chrome") && !listing.is_filtered());
    }

    #[test]
    fn what_has_no_value_comes_last_in_either_order() {
        let names = ["b", "a", "rgl/c", "d"].map(str::to_owned);
        let value = |name: &str| match name {
            "a" => Some(2.0),
            "b" => Some(1.0),
            "d" => Some(f64::NAN),
            _ => None,
        };
        let mut listing = Listing { sort: Sort::Gloss, ..Listing::default() };
        assert_eq!(listing.order(&names, value), ["b", "a", "rgl/c", "d"]);
        listing.is_descending = true;
        assert_eq!(listing.order(&names, value), ["a", "b", "rgl/c", "d"]);
        listing.sort = Sort::Name;
        assert_eq!(listing.order(&names, value), ["d", "rgl/c", "b", "a"]);
        listing.sort = Sort::Database;
        assert_eq!(listing.order(&names, value), ["d", "rgl/c", "a", "b"]);
    }
}
