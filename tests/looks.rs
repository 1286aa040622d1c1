//! What the window looks like, drawn in software and laid beside kept pictures (`tests/snapshots`). After a change that is meant:
//! `UPDATE_SNAPSHOTS=1 cargo test --release --workspace --test looks`, and look at them.

use std::env;
use std::panic::catch_unwind;
use std::time::{Duration, Instant};

use egui::{Theme, ThemePreference};
use egui_kittest::wgpu::WgpuTestRenderer;
use egui_kittest::{Harness, SnapshotOptions};
use nbrdf::gui::pane::Pane;
use nbrdf::gui::session::{Compare, Methods, Mode};
use nbrdf::gui::{Layout, Session, Workbench};
use nbrdf::worker::Stock;

/// The smallest window that everything is laid out for \[points\].
const SIZE: [f32; 2] = [900.0, 600.0];
/// Pixels that may differ: rims of circles, as another version of the rasterizer draws them.
const RIMS: usize = 60;

fn session() -> Session {
    Session { methods: Methods(vec!["latent", "raw_weights"]), ..Session::default() }
}

/// What draws; none where there is no Vulkan, which must be there where `NBRDF_REQUIRE_VULKAN` says so.
fn renderer() -> Option<WgpuTestRenderer> {
    let made = catch_unwind(WgpuTestRenderer::new).ok();
    let is_required = env::var_os("NBRDF_REQUIRE_VULKAN").is_some_and(|value| value == "1");
    assert!(
        made.is_some() || !is_required,
        "no Vulkan: install a driver (Debian: apt-get install mesa-vulkan-drivers)"
    );
    if made.is_none() {
        eprintln!(
            "SKIPPED: pictures of the window, since there is no Vulkan (Debian: apt-get install mesa-vulkan-drivers)"
        );
    }
    made
}

/// The window once everything is shown, beside the picture of this name.
fn look(name: &str, theme: Theme, session: Session, pane: Option<Pane>) {
    let Some(renderer) = renderer() else { return };
    let session = Session { theme: ThemePreference::from(theme), ..session };
    let mut workbench = Workbench::new(Stock::built_in(), session);
    if let Some(pane) = pane {
        workbench.layout.get_or_insert_with(|| Layout::of(SIZE[0])).bring(pane);
    }
    let draw = |ui: &mut egui::Ui, workbench: &mut Workbench| {
        // As the window does before each frame.
        ui.painter().rect_filled(ui.max_rect().expand(64.0), 0.0, ui.visuals().panel_fill);
        workbench.ui(ui);
    };
    let mut harness = Harness::builder().with_size(SIZE).renderer(renderer).build_ui_state(draw, workbench);
    let patience = Instant::now() + Duration::from_secs(120);
    loop {
        harness.step();
        let workbench = harness.state();
        if workbench.is_settled() && workbench.gallery.is_complete() {
            break;
        }
        assert!(Instant::now() < patience, "still waiting for everything to be shown");
        std::thread::sleep(Duration::from_millis(20));
    }
    harness.run_steps(2);
    let options = SnapshotOptions::new().output_path("../tests/snapshots").max_failed_pixels(RIMS);
    harness.snapshot_options(name, &options);
}

#[test]
fn the_window_looks_as_it_did_in_the_dark_theme() {
    look("path-dark", Theme::Dark, session(), None);
}

#[test]
fn the_window_looks_as_it_did_in_the_light_theme() {
    look("path-light", Theme::Light, session(), None);
}

#[test]
fn a_difference_looks_as_it_did() {
    let compare = Compare { mode: Mode::Difference, ..Compare::default() };
    look("difference", Theme::Dark, Session { compare, ..session() }, None);
}

#[test]
fn figures_along_the_path_look_as_they_did() {
    look("figures", Theme::Light, session(), Some(Pane::Figures));
}
