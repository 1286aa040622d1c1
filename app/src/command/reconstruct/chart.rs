//! Error over the number of measured directions, both logarithmic.

use super::Measured;
use crate::measure::reconstruction::combination::CombinationRow;
use crate::measure::reconstruction::directions::DirectionsRow;
use crate::report::figure;
use crate::report::svg::{LogChart, Mark, Series};

/// A number of measured directions and the mean error.
type Point = (usize, f64);

/// `log_error` of everything that was measured.
pub(super) fn chart(measured: &Measured, draws: u64) -> LogChart {
    let directions = |by: &str, damping: f64| -> Vec<Point> {
        let chosen = |row: &&DirectionsRow| row.chosen_by == by && row.damping == damping;
        measured.directions.iter().filter(chosen).map(|row| (row.count, row.log_error.mean)).collect()
    };
    let mix = |domain: &str, solve: &str| -> Vec<Point> {
        let chosen = |row: &&CombinationRow| row.domain == domain && row.solve == solve && !row.whole_table;
        measured.combination.iter().filter(chosen).map(|row| (row.samples, row.log_error.mean)).collect()
    };
    let damping = nbrdf_core::representation::optimal_sampling::DAMPING;
    let random = directions("random", damping);
    let chosen = directions("expected_error", damping);
    let pictures: Vec<Point> = measured.images.iter().map(|row| (row.count, row.errors.log_error)).collect();
    let last = |points: &[Point]| points.last().map_or(f64::NAN, |point| point.1);
    let series = |name: &str, colour, mark, points: &[Point]| {
        let tip = |count: usize, error: f64| format!("{name}: {count} measured, log_error {}", figure(error));
        let point = |&(count, error): &Point| ((count as f64).log10(), error, tip(count, error));
        Series { name: name.to_owned(), colour, mark, points: points.iter().map(point).collect() }
    };
    LogChart {
        title: format!(
            "{0} chosen directions come {1:.1} times as close as {0} random ones",
            chosen.last().map_or(0, |point| point.0),
            last(&random) / last(&chosen)
        ),
        subtitle: format!(
            "{} materials never learned from; random ones are means over {draws} draws; sums of measured materials from \
             100 on",
            measured.materials
        ),
        x_label: "directions measured; squares: pictures of a sphere".to_owned(),
        y_label: "log_error, mean over materials".to_owned(),
        x_ticks: (0..4u32).map(|decade| (f64::from(decade), 10u32.pow(decade).to_string())).collect(),
        series: vec![
            series("at random", 0, Mark::Ring, &random),
            series("least condition", 4, Mark::Dot, &directions("condition_number", damping)),
            series("least error", 3, Mark::Dot, &chosen),
            series("pictures", 2, Mark::Square, &pictures),
            series("log sum, plain", 1, Mark::Cross, &mix("logarithm", "plain")),
            series("log sum, ridge", 1, Mark::Dot, &mix("logarithm", "ridge")),
            series("sum of f, ridge", 0, Mark::Cross, &mix("reflectance", "ridge")),
        ],
    }
}
