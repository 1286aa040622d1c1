//! Maps that could not be learned: they are not tried again until what they are learned from is another.

use std::collections::HashMap;

use super::Projection;

/// Why there is no map, and from which edition of the codes there was none.
#[derive(Default)]
pub(super) struct Failures(HashMap<Projection, (u64, String)>);

impl Failures {
    /// What learning a map says, unless it failed with this edition before.
    pub fn unless_known<T>(
        &mut self,
        projection: Projection,
        edition: u64,
        learn: impl FnOnce() -> Result<T, String>,
    ) -> Result<T, String> {
        if let Some((_, why)) = self.0.get(&projection).filter(|(known, _)| *known == edition) {
            return Err(why.clone());
        }
        learn().inspect_err(|why| drop(self.0.insert(projection, (edition, why.clone()))))
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn what_failed_is_tried_again_only_with_other_codes() {
        let (mut failures, tries) = (Failures::default(), Cell::new(0));
        let mut learn = |projection, edition, found: Result<(), &str>| {
            failures.unless_known(projection, edition, || {
                tries.set(tries.get() + 1);
                found.map_err(str::to_owned)
            })
        };
        for _ in 0..3 {
            assert_eq!(learn(Projection::Pca, 1, Err("no codes")), Err("no codes".to_owned()));
        }
        assert_eq!(tries.get(), 1);
        assert_eq!(learn(Projection::Charting, 1, Ok(())), Ok(()), "another map");
        assert_eq!(learn(Projection::Pca, 2, Ok(())), Ok(()));
        assert_eq!(tries.get(), 3);
    }
}
