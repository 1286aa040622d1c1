//! How long frames take: while a person works, or while t moves by itself.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use egui::{Context, ViewportCommand};
use nbrdf_core::atomic;
use serde_json::{Value, json};

use super::failures::Failures;
use crate::gui::{Workbench, scrubber};

/// Seconds from end to end and back while driving.
const ROUND: f32 = 5.0;

/// Times frames, and writes a report when the window closes.
pub struct Stopwatch {
    file: PathBuf,
    /// How long t is to move by itself, if it is.
    drive: Option<Duration>,
    start: Instant,
    /// Seconds from the program's start to the first frame on the screen.
    first: Option<f64>,
    /// When the last frame began.
    last: Option<Instant>,
    /// Since when frames count: once everything was shown.
    settled: Option<Instant>,
    /// Seconds between the beginnings of frames.
    intervals: Vec<f64>,
    /// Seconds of work for a frame, without waiting for the display.
    work: Vec<f64>,
    pictures: u64,
    /// Where the scrubber is, for those who move it by pointer: left, top, right, bottom \[points\].
    scrubber: Option<[f32; 4]>,
}

impl Stopwatch {
    /// Writes to this file; `drive` moves t back and forth for so long, and then closes the window.
    pub fn new(file: PathBuf, drive: Option<u16>, start: Instant) -> Self {
        let drive = drive.map(|seconds| Duration::from_secs(seconds.into()));
        let (intervals, work) = (Vec::new(), Vec::new());
        Self {
            file,
            drive,
            start,
            first: None,
            last: None,
            settled: None,
            intervals,
            work,
            pictures: 0,
            scrubber: None,
        }
    }

    /// At the beginning of each frame; `work` is that of the last frame \[s\].
    pub fn watch(&mut self, context: &Context, workbench: &mut Workbench, work: Option<f32>) {
        let now = Instant::now();
        // The second frame begins when the first is on the screen.
        if self.last.is_some() && self.first.is_none() {
            self.first = Some((now - self.start).as_secs_f64());
        }
        if self.settled.is_none() && workbench.is_settled() && workbench.gallery.is_complete() {
            self.settled = Some(now);
            self.pictures = workbench.gallery.pictures();
        } else if self.settled.is_some() {
            self.intervals.extend(self.last.map(|last| (now - last).as_secs_f64()));
            self.work.extend(work.map(f64::from));
        }
        self.last = Some(now);
        if let Some(scrubber) = context.read_response(scrubber::id()) {
            let (low, high) = (scrubber.rect.min, scrubber.rect.max);
            self.scrubber = Some([low.x, low.y, high.x, high.y]);
        }
        if let (Some(drive), Some(settled)) = (self.drive, self.settled) {
            let seconds = now - settled;
            let turn = std::f32::consts::TAU * seconds.as_secs_f32() / ROUND;
            workbench.session.blend.go_to(0.5 - 0.5 * turn.cos());
            if seconds > drive {
                context.send_viewport_cmd(ViewportCommand::Close);
            }
        }
        if self.drive.is_some() {
            context.request_repaint();
        }
    }

    /// Writes the report.
    pub fn finish(&self, workbench: &Workbench, failures: &Failures) {
        let seconds = self.settled.map_or(0.0, |settled| settled.elapsed().as_secs_f64());
        let pictures = workbench.gallery.pictures() - self.pictures;
        let shown = workbench.session.cards().len().saturating_sub(workbench.session.blend.ends.len()).max(1);
        let report = json!({
            "schema": 1,
            "first_frame_s": self.first,
            "seconds": seconds,
            "frames": self.intervals.len(),
            "interval_ms": spread(&self.intervals),
            "work_ms": spread(&self.work),
            "scrubber": self.scrubber,
            "spheres": shown,
            "largest_side_px": workbench.gallery.largest_side(),
            "pictures_per_sphere_and_second": pictures as f64 / shown as f64 / seconds.max(1e-9),
        });
        let text = format!("{report:#}\n");
        if let Err(error) = atomic::write(&self.file, text.as_bytes()) {
            failures.add(format!("{}: cannot be written: {error}", self.file.display()));
        }
    }
}

/// Median, 99th percentile and largest \[ms\]; null of nothing.
fn spread(seconds: &[f64]) -> Value {
    let mut sorted = seconds.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted.get(((sorted.len() - 1) as f64 * share).round() as usize).map(|s| 1e3 * s);
    if sorted.is_empty() { Value::Null } else { json!({"median": at(0.5), "p99": at(0.99), "max": at(1.0)}) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_has_its_middle_and_its_tail() {
        let seconds: Vec<f64> = (0..=100).rev().map(|ms| f64::from(ms) / 1e3).collect();
        assert_eq!(spread(&seconds), json!({"median": 50.0, "p99": 99.0, "max": 100.0}));
        assert_eq!(spread(&[]), Value::Null);
    }
}
