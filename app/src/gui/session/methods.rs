//! Which ways between the materials are shown; written to files by their names in the catalog.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::catalog::{Catalog, INTERPOLATIONS};

/// Interpolations by catalog name, in catalog order.
#[derive(Clone, Debug, PartialEq)]
pub struct Methods(pub Vec<&'static str>);

impl Methods {
    /// Shows a method or hides it.
    pub fn toggle(&mut self, name: &str) {
        let is_on = |method: &&str| self.0.contains(method) != (*method == name);
        self.0 = INTERPOLATIONS.iter().map(|entry| entry.name).filter(is_on).collect();
    }
}

impl Default for Methods {
    fn default() -> Self {
        Self(vec!["latent", "raw_weights", "pca_tables"])
    }
}

impl Serialize for Methods {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Methods {
    /// Names of methods that are no more are left out.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let names = Vec::<String>::deserialize(from)?;
        let known = |name: &String| Catalog::interpolation_entry(name).map(|entry| entry.name).ok();
        Ok(Self(names.iter().filter_map(known).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_stay_in_catalog_order() {
        let mut methods = Methods::default();
        methods.toggle("linear_mix");
        methods.toggle("aligned_weights");
        methods.toggle("latent");
        assert_eq!(methods.0, ["raw_weights", "aligned_weights", "pca_tables", "linear_mix"]);
    }

    #[test]
    fn a_file_of_another_version_loses_only_methods_that_are_no_more() {
        let methods: Methods = serde_json::from_str(r#"["latent", "telepathy"]"#).unwrap();
        assert_eq!(methods.0, ["latent"]);
    }
}
