//! Every material on every rung of the ladder, made when first asked for.

use std::sync::{Arc, Mutex, PoisonError};

use super::{Model, Rung};
use crate::Material;
use crate::representation::EncodeError;

/// Models of some materials; views of one scene share them.
pub struct Models<'a> {
    pub(super) materials: &'a [Material],
    pub(super) ladder: &'a [Rung],
    made: Vec<Vec<Mutex<Option<Arc<Model>>>>>,
}

impl<'a> Models<'a> {
    /// None is made yet.
    pub fn new(materials: &'a [Material], ladder: &'a [Rung]) -> Self {
        let row = |_: &Material| ladder.iter().map(|_| Mutex::new(None)).collect();
        Self { materials, ladder, made: materials.iter().map(row).collect() }
    }

    /// The materials.
    pub const fn materials(&self) -> &'a [Material] {
        self.materials
    }

    /// The kinds of models.
    pub const fn ladder(&self) -> &'a [Rung] {
        self.ladder
    }

    /// The model of a material on a rung.
    ///
    /// # Errors
    /// [`EncodeError`] where there is none.
    pub fn get(&self, material: usize, rung: usize) -> Result<Arc<Model>, EncodeError> {
        if let Some(model) = self.found(material, rung) {
            return Ok(model);
        }
        // Not under the lock: fits work in parallel, and a thread that waits for them may come here again.
        let model = Arc::new((self.ladder[rung].make)(&self.materials[material])?);
        *self.made[material][rung].lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&model));
        Ok(model)
    }

    fn found(&self, material: usize, rung: usize) -> Option<Arc<Model>> {
        self.made[material][rung].lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// How many were made.
    pub fn count(&self) -> usize {
        let row = |(material, rungs): (usize, &Vec<_>)| {
            (0..rungs.len()).filter(|&rung| self.found(material, rung).is_some()).count()
        };
        self.made.iter().enumerate().map(row).sum()
    }
}
