//! The picture of a report.

use super::saved::Saved;
use crate::catalog::Family;
use crate::measure::front::{EXACT, TIE};
use crate::measure::point::{Point, title_of};
use crate::report;
use crate::report::svg::scatter::{Kind, Panel, Scatter, Shape, Spot};

/// Radii of the marks of the smallest and the largest material.
const SIZES: [f64; 2] = [3.2, 9.0];

/// Letters of a title that fit a line.
const LONGEST_TITLE: usize = 112;

/// The chart.
pub fn scatter(saved: &Saved, metric: &str, is_dark: bool) -> Scatter {
    let front = saved.front(metric);
    let names: Vec<String> = front.iter().map(|&i| saved.points[i].title()).collect();
    let others = saved.points.len() - saved.references(metric).len();
    let found = format!("{} of {others} models are worth their time", names.len());
    let title = match names.as_slice() {
        [first, .., last] if found.chars().count() + listed(&names).chars().count() > LONGEST_TITLE - 2 => {
            format!("{found}, from {first} to {last}")
        }
        _ => format!("{found}: {}", listed(&names)),
    };
    let quick = if saved.quick { ", a quick look" } else { "" };
    let runs = if saved.runs > 1 { format!(", {} runs", saved.runs) } else { String::new() };
    let subtitle = format!(
        "{} held-out MERL materials{quick}{runs}, reference: {}; {}mark size: bytes, bars: eight of ten materials",
        saved.materials,
        saved.reference,
        themselves(saved, metric).map(|said| said + "; ").unwrap_or_default()
    );
    let error = format!("{}, mean", title_of(metric));
    let all = || saved.points.iter().map(size);
    let sizes = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
    let panel = |title: &str, x_label: &str, tie: f64, cost: &dyn Fn(&Point) -> f64| Panel {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: error.clone(),
        spots: saved.points.iter().map(|point| spot(point, metric, cost(point), sizes)).collect(),
        front: saved.front_of(metric, tie, cost),
        is_straight: false,
    };
    let kind = |(place, family): (usize, Family)| Kind {
        name: family.title().to_owned(),
        colour: [3, 4, 1, 7, 2, 6, 0][place],
        shape: [Shape::Up, Shape::Down, Shape::Circle, Shape::Hexagon, Shape::Square, Shape::Diamond, Shape::Plus]
            [place],
    };
    Scatter {
        title: shortened(title),
        subtitle,
        kinds: Family::ALL.into_iter().enumerate().map(kind).collect(),
        panels: vec![
            panel("Evaluation", "ns per evaluation, one thread", TIE, &|point| point.times.ns),
            panel("Storage", "bytes per material, what is shared not counted", EXACT, &|point| point.bytes as f64),
            panel(
                "Encoding (nbrdf, _pruned, _half, _byte: looked up)",
                "seconds per material, median",
                TIE,
                &|point| point.times.encode_s,
            ),
        ],
        is_dark,
    }
}

/// How large a material is, for the eye.
fn size(point: &Point) -> f64 {
    (point.bytes.max(1) as f64).ln()
}

fn spot(point: &Point, metric: &str, cost: f64, [low, high]: [f64; 2]) -> Spot {
    let share = (size(point) - low) / (high - low).max(1e-9);
    let band = point.error.get(metric);
    let [mean, p10, p90] = band.map_or([f64::NAN; 3], |band| [band.mean, band.p10, band.p90]);
    let kind = Family::ALL.iter().position(|family| *family == point.family).unwrap_or_default();
    let about = format!(
        "{}: {} {}, {:.1} ns ({:.1} x reference_loop), {} bytes, {} shared, {} s to encode",
        point.title(),
        title_of(metric),
        report::figure(mean),
        point.times.ns,
        point.times.ratio_to_reference_loop,
        point.bytes,
        point.shared_bytes,
        report::figure(point.times.encode_s)
    );
    Spot {
        x: cost,
        y: mean,
        band: [p10, p90],
        size: SIZES[0] + share * (SIZES[1] - SIZES[0]),
        kind,
        label: point.title(),
        about,
    }
}

/// Which models are what others are measured against, if any.
pub fn themselves(saved: &Saved, metric: &str) -> Option<String> {
    match saved.references(metric).as_slice() {
        [] => None,
        [one] => Some(format!("{one} is the reference itself")),
        many => Some(format!("{} are the reference itself", listed(many))),
    }
}

fn listed(names: &[String]) -> String {
    match names {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// As much as fits a line.
fn shortened(title: String) -> String {
    match title.char_indices().nth(LONGEST_TITLE) {
        Some((at, _)) => format!("{}…", &title[..at]),
        None => title,
    }
}
