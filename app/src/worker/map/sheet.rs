//! A finished map, read backwards: from a place to a code.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

use nbrdf_core::representation::pca::Pca;

use super::Projection;

/// Codes that count for a place.
const NEAREST: usize = 6;

/// Codes and their places.
///
/// A place of the plane of principal components is the code there plus what its [`NEAREST`] codes miss in the mean by
/// being moved into the plane; without a plane it is the mean of these codes. Both are weighted, so that a material's
/// own place gives its own code, and codes change smoothly from there on.
pub struct Sheet {
    plane: Option<Pca>,
    /// Places, and codes as far as they are off the plane.
    places: Vec<([f32; 2], Vec<f32>)>,
}

impl Sheet {
    /// Of these places and codes.
    pub fn new(plane: Option<Pca>, codes: impl Iterator<Item = ([f32; 2], Vec<f32>)>) -> Self {
        let off = |(at, mut code): ([f32; 2], Vec<f32>)| {
            if let Some(plane) = &plane {
                code.iter_mut().zip(plane.reconstruct(&at)).for_each(|(own, on)| *own -= on);
            }
            (at, code)
        };
        Self { places: codes.map(off).collect(), plane }
    }

    /// The code at a place; none where there are no materials.
    pub fn code(&self, place: [f32; 2]) -> Option<Vec<f32>> {
        let length = self.places.first()?.1.len();
        let mut code = self.plane.as_ref().map_or_else(|| vec![0.0; length], |plane| plane.reconstruct(&place));
        for (index, weight) in self.nearest(place) {
            code.iter_mut().zip(&self.places[index].1).for_each(|(sum, own)| *sum += weight as f32 * own);
        }
        Some(code)
    }

    /// The nearest codes and their weights, which sum to 1 (R. Franke, G. Nielson, *Smooth interpolation of large sets
    /// of scattered data*, 1980): a code that is no longer among the nearest had weight 0 before.
    fn nearest(&self, place: [f32; 2]) -> Vec<(usize, f64)> {
        let away = |at: [f32; 2]| f64::from(at[0] - place[0]).hypot(f64::from(at[1] - place[1]));
        let mut all: Vec<(usize, f64)> = self.places.iter().enumerate().map(|(i, (at, _))| (i, away(*at))).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        // Where there are only a few, all of them count.
        let rim = match all.get(NEAREST) {
            Some((_, away)) => *away,
            None => all.last().map_or(1.0, |(_, away)| 2.0 * away),
        };
        all.truncate(NEAREST);
        let Some(&(first, nearest)) = all.first() else { return all };
        if nearest < 1e-9 || rim - nearest < 1e-9 {
            return vec![(first, 1.0)];
        }
        all.iter_mut().for_each(|(_, away)| *away = ((rim - *away).max(0.0) / (rim * *away)).powi(2));
        let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
        all.iter_mut().for_each(|(_, weight)| *weight /= sum);
        all
    }
}

/// The newest sheet of each map.
#[derive(Default)]
pub struct Sheets(RwLock<HashMap<Projection, Drawn>>);

/// A finished map, or why there is none.
pub type Drawn = Result<Arc<Sheet>, String>;

impl Sheets {
    /// The sheet of a map, once it is drawn or failed.
    pub fn get(&self, projection: Projection) -> Option<Drawn> {
        self.0.read().unwrap_or_else(PoisonError::into_inner).get(&projection).cloned()
    }

    /// In place of an earlier one.
    pub fn put(&self, projection: Projection, sheet: Sheet) {
        self.0.write().unwrap_or_else(PoisonError::into_inner).insert(projection, Ok(Arc::new(sheet)));
    }

    /// There is no such map, unless an earlier one is there; whether that is news.
    pub fn fail(&self, projection: Projection, why: String) -> bool {
        let mut sheets = self.0.write().unwrap_or_else(PoisonError::into_inner);
        let is_news = sheets.get(&projection).is_none_or(|known| known.as_ref().is_err_and(|before| *before != why));
        if is_news {
            sheets.insert(projection, Err(why));
        }
        is_news
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Codes of five numbers on a plane, and their places.
    fn flat() -> (Pca, Vec<Vec<f32>>) {
        let code = |i: usize| {
            let (a, b) = ((i as f32).sin() * 3.0, (i as f32 * 1.7).cos());
            vec![a + 1.0, b, a - b, 0.5 * a + 2.0, -b]
        };
        let codes: Vec<Vec<f32>> = (0..12).map(code).collect();
        (Pca::learn(codes.clone(), 2).unwrap(), codes)
    }

    fn placed(plane: &Pca, codes: &[Vec<f32>]) -> Vec<([f32; 2], Vec<f32>)> {
        codes.iter().map(|code| (*plane.project(code).first_chunk().unwrap(), code.clone())).collect()
    }

    fn is_near(a: &[f32], b: &[f32]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3)
    }

    #[test]
    fn codes_on_the_plane_come_back_from_their_places() {
        let (plane, codes) = flat();
        let between: Vec<f32> = codes[0].iter().zip(&codes[1]).map(|(a, b)| 0.3 * a + 0.7 * b).collect();
        let place = *plane.project(&between).first_chunk().unwrap();
        let known = placed(&plane, &codes);
        let sheet = Sheet::new(Some(plane), known.into_iter());
        assert!(is_near(&sheet.code(place).unwrap(), &between), "{:?} {between:?}", sheet.code(place));
    }

    #[test]
    fn a_materials_own_place_gives_its_own_code_with_and_without_a_plane() {
        let (plane, mut codes) = flat();
        codes.iter_mut().enumerate().for_each(|(i, code)| code[1] += 0.2 * (i % 3) as f32);
        let known = placed(&plane, &codes);
        for plane in [Some(plane), None] {
            let sheet = Sheet::new(plane, known.iter().cloned());
            for (at, code) in &known {
                assert!(is_near(&sheet.code(*at).unwrap(), code), "{at:?} {code:?}");
            }
        }
    }

    #[test]
    fn a_map_that_failed_is_told_until_there_is_one() {
        let sheets = Sheets::default();
        let why = || "no materials".to_owned();
        assert!(sheets.get(Projection::Pca).is_none());
        assert!(sheets.fail(Projection::Pca, why()) && !sheets.fail(Projection::Pca, why()));
        assert!(sheets.get(Projection::Pca).unwrap().is_err() && sheets.get(Projection::Charting).is_none());
        sheets.put(Projection::Pca, Sheet::new(None, std::iter::empty()));
        assert!(!sheets.fail(Projection::Pca, why()) && sheets.get(Projection::Pca).unwrap().is_ok());
    }

    #[test]
    fn codes_change_smoothly_when_others_become_the_nearest() {
        let at = |i: usize| [i as f32, (i * i % 7) as f32];
        let sheet = Sheet::new(None, (0..20).map(|i| (at(i), vec![(i as f32 * 2.3).sin()])));
        let value = |step: usize| sheet.code([step as f32 * 0.002, 3.3]).unwrap()[0];
        let largest = (1..8000).map(|step| (value(step) - value(step - 1)).abs()).fold(0.0, f32::max);
        assert!(largest < 0.05, "{largest}");
        assert!(Sheet::new(None, std::iter::empty()).code([0.0; 2]).is_none());
    }
}
