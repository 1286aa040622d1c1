//! What is taught, and what is examined then.

use std::sync::Arc;

use nbrdf_core::Material;
use nbrdf_core::stress::damage::RED_FOR_ALL;
use nbrdf_core::stress::numbers::Scaled;

/// Less than all, or something wrong.
pub(super) struct Syllabus {
    /// Whether the material of this place and name is taught.
    is_taught: fn(usize, &str) -> bool,
    /// Whether it is taught with wrong scales.
    is_wrong: fn(usize) -> bool,
    /// Whether a held-out material of this name is examined.
    is_examined: fn(&str) -> bool,
}

/// One for each hazard of learning that has one, in the same order.
pub(super) const SYLLABI: [Syllabus; 5] = [
    Syllabus { is_taught: |place, _| place.is_multiple_of(2), ..Syllabus::ALL },
    Syllabus { is_taught: |place, _| place.is_multiple_of(4), ..Syllabus::ALL },
    Syllabus { is_taught: |_, name| !is_metal(name), is_examined: is_metal, ..Syllabus::ALL },
    Syllabus { is_taught: |_, name| !is_fabric(name), is_examined: is_fabric, ..Syllabus::ALL },
    Syllabus { is_wrong: |place| place % 10 == 5, ..Syllabus::ALL },
];

impl Syllabus {
    pub(super) const ALL: Self = Self { is_taught: |_, _| true, is_wrong: |_| false, is_examined: |_| true };

    /// What is taught of all training materials.
    pub fn materials(&self, all: &[Material]) -> Vec<Material> {
        let taught = all.iter().enumerate().filter(|(place, material)| (self.is_taught)(*place, &material.name));
        taught
            .map(|(place, material)| if (self.is_wrong)(place) { wrong(material) } else { material.clone() })
            .collect()
    }

    pub fn is_examined(&self, name: &str) -> bool {
        (self.is_examined)(name)
    }
}

/// As read by who takes the scale of red for all channels.
fn wrong(material: &Material) -> Material {
    let (inner, scale) = (Arc::clone(&material.brdf), RED_FOR_ALL);
    Material::new(&material.name, Arc::new(Scaled { inner, scale }))
}

/// Metals as such, by their MERL names; metallic paints are paints.
fn is_metal(name: &str) -> bool {
    const METALS: [&str; 12] = [
        "alum-bronze",
        "aluminium",
        "black-oxidized-steel",
        "brass",
        "chrome",
        "chrome-steel",
        "grease-covered-steel",
        "hematite",
        "nickel",
        "ss440",
        "steel",
        "tungsten-carbide",
    ];
    METALS.contains(&name)
}

fn is_fabric(name: &str) -> bool {
    name.contains("fabric") || name.contains("felt")
}

#[cfg(test)]
mod tests {
    use nbrdf_core::database::MERL;
    use nbrdf_core::library::builtin;
    use nbrdf_core::{Database, Split};

    use super::*;

    #[test]
    fn who_learns_no_metals_is_examined_in_metals() {
        let all: Vec<Material> = builtin::shared().materials();
        let merl = |material: &&Material| Database::of(&material.name) == Database::Merl;
        let all: Vec<Material> = all.iter().filter(merl).cloned().collect();
        let [half, quarter, metals, fabrics, wrong] = &SYLLABI;
        assert_eq!([half, quarter, wrong].map(|syllabus| syllabus.materials(&all).len()), [50, 25, 100]);
        for class in [metals, fabrics] {
            let taught = class.materials(&all);
            assert!(taught.len() < 95 && taught.iter().all(|material| !class.is_examined(&material.name)));
            assert!(MERL.iter().any(|name| class.is_examined(name) && Split::of(name) == Split::HeldOut));
        }
        assert_eq!(wrong.materials(&all).iter().filter(|material| material.network.is_none()).count(), 10);
    }
}
