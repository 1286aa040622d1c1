//! Planned scenes: what command line and app share.

mod difference;
mod opened;
mod reason;

use nbrdf_core::plan::Plan;

pub use difference::{WHITE, difference};
pub use opened::Opened;
pub use reason::reason;

/// How many times less time and fewer bytes a plan takes than what it is compared with; none where it is not compared.
pub fn saved(plan: &Plan) -> Option<[f64; 2]> {
    let (full, own) = (plan.beside.as_ref()?, &plan.totals);
    Some([full.ns / own.ns, full.bytes as f64 / own.bytes.max(1) as f64])
}

/// A ratio for people, by its names above 1 and below: `2.1 × less time`.
pub fn times(ratio: f64, [less, more]: [&str; 2]) -> String {
    match ratio < 1.0 {
        true => format!("{:.1} × {more}", 1.0 / ratio),
        false => format!("{ratio:.1} × {less}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_below_one_is_told_the_other_way_round() {
        assert_eq!(times(2.1, ["less time", "more time"]), "2.1 × less time");
        assert_eq!(times(0.5, ["less time", "more time"]), "2.0 × more time");
    }
}
