//! Fits that run or wait.

use egui::{Label, Layout, ProgressBar, RichText, Ui};

use super::Errand;
use crate::worker::Job;

/// One line and a bar for each; nothing where there is none.
pub fn show(ui: &mut Ui, jobs: &[Job], errands: &mut Vec<Errand>) {
    for job in jobs {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
                let about = format!("Stop fitting {}; nothing of it is kept", job.name);
                if ui.small_button("Cancel").on_hover_text(about).clicked() {
                    errands.push(Errand::Cancel(job.number));
                }
                ui.with_layout(Layout::left_to_right(egui::Align::Center), |ui| {
                    ui.add(Label::new(RichText::new(format!("Fitting {}", job.name)).small()).truncate());
                });
            });
        });
        let bar = ProgressBar::new(job.share).desired_height(14.0).text(RichText::new(text(job)).small());
        ui.add(bar).on_hover_text("A network is fitted to the measurement; it appears in the list when it is done");
    }
}

fn text(job: &Job) -> String {
    match job.left {
        Some(left) if left >= 90.0 => format!("{:.0} %, {:.0} min left", 100.0 * job.share, left / 60.0),
        Some(left) => format!("{:.0} %, {left:.0} s left", 100.0 * job.share),
        None => "waiting".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_fits_are_told_in_minutes() {
        let job = |share, left| Job { number: 0, name: "felt".to_owned(), share, left };
        assert_eq!(text(&job(0.25, Some(12.4))), "25 %, 12 s left");
        assert_eq!(text(&job(0.1, Some(300.0))), "10 %, 5 min left");
        assert_eq!(text(&job(0.0, None)), "waiting");
    }
}
