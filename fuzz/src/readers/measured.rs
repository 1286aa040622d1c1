//! Measurements.

use std::cell::RefCell;

use nbrdf_core::Rgb;
use nbrdf_core::brdf::lambert::Lambert;
use nbrdf_core::merl::{FILE_BYTES, Merl};
use nbrdf_core::rgl::RglTable;
use nbrdf_core::sample_list::SampleList;

use super::assert_reflects;

/// RGL `.bsdf`.
pub fn rgl(bytes: &[u8]) -> bool {
    let Ok(table) = RglTable::parse(bytes) else { return false };
    assert_reflects(&table);
    true
}

/// A goniometer's text.
pub fn goniometer(bytes: &[u8]) -> bool {
    is_sound(SampleList::of_goniometer(&String::from_utf8_lossy(bytes)).ok())
}

/// Samples in `.csv`.
pub fn csv(bytes: &[u8]) -> bool {
    is_sound(SampleList::of_csv(&String::from_utf8_lossy(bytes)).ok())
}

fn is_sound(list: Option<SampleList>) -> bool {
    let Some(list) = list else { return false };
    assert!(!list.is_empty() && list.at.len() == list.values.len());
    assert!(list.at.iter().all(|at| at.is_above() && at.light.is_finite() && at.view.is_finite()));
    assert!(list.values.iter().all(|f| f.is_finite() && f.min() >= 0.0));
    let [folded, rest] = list.split(2, 0);
    assert_eq!(folded.len() + rest.len(), list.len());
    assert!(list.largest_gap() >= 0.0);
    true
}

/// Bytes of one change to a table: where, and what.
const CHANGE: usize = 4 + 8;

/// MERL `.binary`: the bytes as they are, which are never as long as a table, and as a header and changes to the 35 MB of a
/// valid one.
pub fn merl(bytes: &[u8]) -> bool {
    thread_local! {
        static VALID: RefCell<Vec<u8>> = RefCell::new(Merl::tabulate(&Lambert { albedo: Rgb::splat(0.5) }).to_bytes());
    }
    assert!(Merl::parse(bytes).is_err());
    let Some((header, changes)) = bytes.split_first_chunk::<12>() else { return false };
    VALID.with_borrow_mut(|table| {
        let own: Vec<(usize, [u8; 8])> = changes
            .chunks_exact(CHANGE)
            .map(|change| {
                let at = u32::from_le_bytes([change[0], change[1], change[2], change[3]]) as usize % (FILE_BYTES - 8);
                (at, std::array::from_fn(|i| change[4 + i]))
            })
            .collect();
        let before = *table.first_chunk::<12>().unwrap();
        table[..12].copy_from_slice(header);
        let kept: Vec<(usize, [u8; 8])> = own
            .iter()
            .map(|&(at, new)| {
                let old = std::array::from_fn(|i| table[at + i]);
                table[at..at + 8].copy_from_slice(&new);
                (at, old)
            })
            .collect();
        let read = Merl::parse(table);
        if let Ok(merl) = &read {
            assert!((0..1000).filter_map(|i| merl.cell(1457 * i)).all(|f| f.is_finite() && f.min() >= 0.0));
            assert_eq!(&merl.to_bytes(), table, "what is read is written again to the byte");
        }
        kept.iter().rev().for_each(|(at, old)| table[*at..at + 8].copy_from_slice(old));
        table[..12].copy_from_slice(&before);
        read.is_ok()
    })
}
