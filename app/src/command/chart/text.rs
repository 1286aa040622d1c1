//! The figures of a report as a table.

use super::draw::themselves;
use super::saved::Saved;
use super::stability::Stability;
use crate::report;
use crate::report::table::Table;

/// The table, those on the front marked.
pub fn text(saved: &Saved, metric: &str) -> String {
    let head = ["", "model", metric, "10 %", "90 %", "ns", "x loop", "bytes", "shared MB", "encode s"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    let front = saved.front(metric);
    let mut order: Vec<usize> = (0..saved.points.len()).collect();
    order.sort_by(|&a, &b| saved.points[a].times.ns.total_cmp(&saved.points[b].times.ns));
    for i in order {
        let point = &saved.points[i];
        let band = point.error.get(metric);
        let figure = |value: Option<f64>| report::figure(value.unwrap_or(f64::NAN));
        table.push(vec![
            if front.contains(&i) { "*" } else { "" }.to_owned(),
            point.title(),
            figure(band.map(|band| band.mean)),
            figure(band.map(|band| band.p10)),
            figure(band.map(|band| band.p90)),
            report::figure(point.times.ns),
            report::figure(point.times.ratio_to_reference_loop),
            point.bytes.to_string(),
            format!("{:.1}", point.shared_bytes as f64 / 1e6),
            report::figure(point.times.encode_s),
        ]);
    }
    let mut text = format!(
        "{} held-out MERL materials, reference: {}; * nothing else is closer and no more than a tenth slower\n",
        saved.materials, saved.reference
    );
    if let Some(said) = themselves(saved, metric) {
        text += &format!("{said}: no error, on no chart\n");
    }
    if saved.runs > 1 {
        text += &format!("Times are medians. {}\n", Stability::of(saved, metric));
    }
    format!("{text}\n{table}")
}
