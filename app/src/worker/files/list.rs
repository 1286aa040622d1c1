//! What became materials goes into the list, and everybody is told.

use std::path::Path;

use nbrdf_core::Material;

use super::Desk;
use crate::measure::guard;
use crate::worker::{Answer, guarded};

impl Desk {
    /// Puts materials of a file into the list.
    pub fn add(&self, path: &Path, materials: Vec<Material>) {
        let names = self.list(self.office.put(path, materials));
        self.office.say(Answer::Kept(path.to_owned(), names));
    }

    /// Tells everybody that these materials are in the list now; their names.
    pub(in crate::worker) fn list(&self, materials: Vec<Material>) -> Vec<String> {
        let office = &self.office;
        let names: Vec<String> = materials.iter().map(|material| material.name.clone()).collect();
        office.say(Answer::Opened(office.materials.all().into_iter().map(|material| material.name).collect()));
        // Spheres may have waited for it since the start, or show what it was before, or what is gone.
        let is_news = |end: &String| names.contains(end) || office.material(end).is_none();
        if office.requests.newest().is_some_and(|(_, request)| request.ends.iter().any(is_news)) {
            office.requests.again();
            office.points.again();
            office.questions.again();
        }
        office.inquiries.again();
        office.map_requests.again();
        // The thread ends only with the process.
        let _ = self.thumbnails.send(materials.clone());
        self.warn(&materials);
        names
    }

    /// What is odd about materials that were opened.
    fn warn(&self, materials: &[Material]) {
        for Material { name, brdf, .. } in materials {
            let brdf = brdf.as_ref();
            let said = || guard::of_result(brdf).chain(guard::of_source(brdf)).collect();
            let warnings: Vec<_> = guarded(name, said).unwrap_or_default();
            warnings.into_iter().for_each(|warning| self.office.say(Answer::Notice(format!("{name}: {warning}"))));
        }
    }
}
