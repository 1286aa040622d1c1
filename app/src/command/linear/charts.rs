//! The two pictures of `nbrdf linear`.

use nbrdf_core::rank::Frame;
use nbrdf_core::representation::values::Values;

use super::Ranks;
use crate::measure::linear::{Group, Kind};
use crate::report;
use crate::report::svg::{LineChart, Mark, Scale, Series};

/// Singular values below this power of ten of the first are rounding of the tables' numbers.
const LOWEST: i32 = -6;

/// Shares of drawn points that could not exist, over the number of components.
pub(super) fn unphysical(kinds: &[Kind]) -> LineChart {
    let series = |values: Values, name: &str, colour, mark, share: fn(&Group) -> f64| {
        let rows = kinds.iter().filter(|kind| kind.values == values).flat_map(|kind| &kind.rows);
        let point = |row: &crate::measure::linear::Row| {
            let value = share(&row.drawn);
            (row.components as f64, value, format!("{name}, {} components: {:.1} %", row.components, 100.0 * value))
        };
        Series { name: name.to_owned(), colour, mark, points: rows.map(point).collect() }
    };
    let last = |values: Values| kinds.iter().find(|kind| kind.values == values)?.rows.last();
    let figure =
        |values: Values, share: fn(&Group) -> f64| last(values).map_or(f64::NAN, |row| 100.0 * share(&row.drawn));
    let negative: fn(&Group) -> f64 = |group| group.negative;
    let violating: fn(&Group) -> f64 = |group| group.violating;
    LineChart {
        title: format!(
            "Plain PCA spans {:.0} % negative points; log PCA {:.0} % that make light from nothing",
            figure(Values::Plain, negative),
            figure(Values::Log, violating),
        ),
        subtitle: format!(
            "{} points from the Gaussian of training codes; negative: f cos < -0.001 in over 1 % of directions; violating: albedo > 1",
            last(Values::Plain).map_or(0, |row| row.drawn.count)
        ),
        x_label: "components (numbers in a code)".to_owned(),
        y_label: "share of drawn points".to_owned(),
        scale: Scale::Percent,
        series: vec![
            series(Values::Plain, "plain negative", 3, Mark::Cross, negative),
            series(Values::Plain, "plain violating", 3, Mark::Dot, violating),
            series(Values::Log, "log negative", 1, Mark::Cross, negative),
            series(Values::Log, "log violating", 1, Mark::Dot, violating),
            series(Values::LogRelative, "relative negative", 2, Mark::Cross, negative),
            series(Values::LogRelative, "relative violating", 2, Mark::Dot, violating),
        ],
    }
}

/// Singular values of both frames, over their index.
pub(super) fn ranks(ranks: &[Ranks], materials: usize) -> LineChart {
    let series = |frame: Frame, values: Values, name: &str, colour, mark| {
        let found = ranks.iter().filter(|row| (row.frame, row.values) == (frame, values));
        let point = |(index, &value): (usize, &f64)| {
            let place = (index + 1) as f64;
            (place, value, format!("{name}, number {place}: {}", report::figure(value)))
        };
        let points = found.flat_map(|row| row.singular_values.iter().enumerate().map(point)).collect();
        Series { name: name.to_owned(), colour, mark, points }
    };
    let effective = |frame: Frame, values: Values| {
        let found = ranks.iter().find(|row| (row.frame, row.values) == (frame, values));
        found.and_then(|row| row.effective_rank.as_ref()).map_or(f64::NAN, |spread| spread.mean)
    };
    let [half, standard] = Frame::ALL.map(|frame| [Values::Plain, Values::Log].map(|values| effective(frame, values)));
    LineChart {
        title: format!(
            "Half angles: plain tables have rank {:.1} instead of {:.1}; their logarithms {:.1}, not {:.1}",
            half[0], standard[0], half[1], standard[1],
        ),
        subtitle: format!(
            "Tables of 90 x 90 x 180 cells as matrices, geometric mean over {materials} materials; effective ranks"
        ),
        x_label: "index of the singular value".to_owned(),
        y_label: "singular value relative to the first".to_owned(),
        scale: Scale::Powers { lowest: LOWEST },
        series: vec![
            series(Frame::HalfDifference, Values::Log, "half angles, log", 1, Mark::Dot),
            series(Frame::Standard, Values::Log, "light and view, log", 3, Mark::Dot),
            series(Frame::HalfDifference, Values::Plain, "half angles, plain", 5, Mark::Ring),
            series(Frame::Standard, Values::Plain, "light and view, plain", 4, Mark::Ring),
        ],
    }
}
