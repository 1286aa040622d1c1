//! Files that are open.

use std::path::Path;

use super::Session;

impl Session {
    /// A file is open, and gave the materials of these names.
    pub fn keep_file(&mut self, file: &Path, names: &[String]) {
        if !self.files.iter().any(|known| known == file) {
            self.files.push(file.to_owned());
        }
        self.origins.retain(|_, origin| origin != file);
        self.origins.extend(names.iter().map(|name| (name.clone(), file.to_owned())));
    }

    /// A file is not to be opened again.
    pub fn lose_file(&mut self, file: &Path) {
        self.files.retain(|known| known != file);
        self.origins.retain(|_, origin| origin != file);
    }
}
