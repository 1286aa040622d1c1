//! What a method shows at a place, for those who have no picture of it: at its own time, and edited.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::axis::Axis;
use nbrdf_core::{Brdf, Code, Path, Representation as _, Weights};

use super::edits::Want;
use super::paths::Key;
use super::{Card, Office, Request, Walk};
use crate::editor::Editor;

/// A material, and its code where it has one.
pub(super) type Shown = (Arc<dyn Brdf>, Option<Code>);

/// A place of a method's path.
pub(super) struct Here<'a> {
    /// Of which path.
    pub key: Key,
    /// How it is walked.
    pub walk: &'a Walk,
    /// Where, unless the path is walked at times of its own.
    pub weights: &'a Weights,
}

impl Request {
    /// What a method's path between the ends is prepared from.
    pub(super) fn key(&self, method: &'static str) -> Key {
        Key::new(&self.ends, method, self.timing)
    }

    /// Where a method is.
    pub(super) fn here(&self, method: &'static str) -> Here<'_> {
        Here { key: self.key(method), walk: &self.walk, weights: &self.weights }
    }
}

impl Here<'_> {
    /// The weights of the ends, at the path's own time.
    pub fn weights(&self, office: &Office) -> Weights {
        office.paths.weights(&self.key, self.walk.t, self.weights)
    }
}

/// What is to be edited, and by what.
type Edit<'a> = (Want, &'a Editor);

impl Office {
    /// The material, and its code where it has one. An edit that is not known yet takes a moment.
    ///
    /// # Errors
    /// If there is no such point, or its edited code is no material.
    pub(super) fn here(&self, path: &dyn Path, method: &'static str, request: &Request) -> Result<Shown> {
        self.exact(path, &request.here(method))
    }

    /// The same at any place.
    ///
    /// # Errors
    /// As [`here`](Self::here).
    pub(super) fn exact(&self, path: &dyn Path, here: &Here) -> Result<Shown> {
        let (code, want) = self.wanted(path, here)?;
        let Some((want, editor)) = want else { return self.plain(path, here, code) };
        // An edit that failed left the code as it was; it is tried again, so that the reason is told.
        let known = self.found.exact(&want).filter(|numbers| **numbers != *want.code.code);
        let model = editor.model();
        let edited = match known {
            Some(numbers) => model.code(numbers.to_vec()),
            None => {
                let amounts = Axis::ALL.into_iter().zip(want.edits.map(f64::from));
                model.code(editor.edit(&want.code, amounts)?.code)
            }
        };
        Ok((Arc::from(model.decode(&edited)?), Some(edited)))
    }

    /// The same as spheres show it: until an edit is made, with the change of the last one. Who asks is asked again by
    /// [`ring`](Self::ring) once it is.
    ///
    /// # Errors
    /// If there is no such point, or its edited code is no material.
    pub(super) fn shown(&self, path: &dyn Path, here: &Here) -> Result<Shown> {
        let (code, want) = self.wanted(path, here)?;
        let Some((want, editor)) = want else { return self.plain(path, here, code) };
        let (numbers, is_exact) = want.known(&self.found);
        let model = editor.model();
        let edited = model.code(numbers.to_vec());
        match model.decode(&edited) {
            Ok(brdf) => Ok((Arc::from(brdf), Some(edited))),
            Err(why) if is_exact => Err(why.into()),
            // The true edit is waited for.
            Err(_) => self.plain(path, here, code),
        }
    }

    /// Whether edits apply to a path, as they do where it walks through codes of the editor's model.
    pub(super) fn is_edited(&self, path: &dyn Path, here: &Here) -> bool {
        here.walk.is_edit() && matches!(self.wanted(path, here), Ok((_, Some(_))))
    }

    /// The code of a place, and what is to be edited there, with what.
    fn wanted(&self, path: &dyn Path, here: &Here) -> Result<(Option<Code>, Option<Edit<'_>>)> {
        let code = path.code(&here.weights(self))?;
        let edited = || {
            let code = code.as_ref().filter(|_| here.walk.is_edit())?;
            let editor = self.editor().filter(|editor| editor.knows(code))?;
            Some((Want { card: Card::Method(here.key.method), code: code.clone(), edits: here.walk.edits }, editor))
        };
        let edited = edited();
        Ok((code, edited))
    }

    fn plain(&self, path: &dyn Path, here: &Here, code: Option<Code>) -> Result<Shown> {
        Ok((Arc::from(path.at(&here.weights(self))?), code))
    }
}
