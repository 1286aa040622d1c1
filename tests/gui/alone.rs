//! Each pane by itself, in a window no larger than it.

use egui_tiles::Tree;
use nbrdf::gui::Layout;
use nbrdf::gui::pane::Pane;

use super::*;

/// The window with one pane in it.
fn alone(pane: Pane) -> Harness<'static, Workbench> {
    let tree = Tree::new_tabs(egui::Id::unique("panes"), vec![pane]);
    let layout: Layout = serde_json::from_value(serde_json::to_value(tree).unwrap()).unwrap();
    let mut workbench = Workbench::new(Stock::built_in(), quick());
    workbench.layout = Some(layout);
    Harness::builder()
        .with_size([460.0, 420.0])
        .build_ui_state(|ui, workbench: &mut Workbench| workbench.ui(ui), workbench)
}

/// Something that only this pane has, and that is seen at once.
const fn mark(pane: Pane) -> &'static str {
    match pane {
        Pane::Library => "Open…",
        Pane::Stage => "Side by side",
        Pane::Path => "t, from A to B",
        Pane::Figures => "Copy CSV",
        Pane::Map => "Latent map",
        Pane::Scene => "Example: shelf",
        Pane::Inspector => "Exposure",
        Pane::Point => "Point pane",
    }
}

#[test]
fn every_pane_is_there_without_the_others_and_takes_keys() {
    for pane in Pane::ALL {
        let mut harness = alone(pane);
        settle(&mut harness);
        harness.run_steps(3);
        let window = egui::Rect::from_min_size(egui::Pos2::ZERO, harness.ctx.content_rect().size());
        let found = harness.query_all_by_label(mark(pane)).next().map(|node| node.rect());
        assert!(found.is_some_and(|rect| window.intersects(rect)), "{pane:?}: {found:?}");
        for other in Pane::ALL.into_iter().filter(|other| *other != pane) {
            assert!(harness.query_by_label(&format!("{} pane", other.title())).is_none(), "{other:?} beside {pane:?}");
        }
        for key in [Key::Tab, Key::ArrowRight, Key::Tab, Key::ArrowUp, Key::Tab, Key::Space, Key::Escape] {
            harness.key_press(key);
            harness.run_steps(2);
        }
        assert!(harness.query_all_by_label(&format!("{} pane", pane.title())).next().is_some(), "{pane:?}");
    }
}
