//! Where the panes are: docked, resized and stacked as the user likes.

use egui::{Response, Ui, WidgetText};
use egui_tiles::{
    Behavior, Container, Linear, LinearDir, ResizeState, SimplificationOptions, TabState, Tile, TileId, Tiles, Tree,
    UiResponse,
};
use serde::{Deserialize, Serialize};

use super::look;
use super::pane::{Desk, Pane};

/// The panes in their places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Layout(Tree<Pane>);

/// Below this width \[points\] the inspector shares a place with the library.
const NARROW: f32 = 1100.0;

impl Layout {
    /// For a window so wide: library left, stage in the middle, path and figures below it, inspector right.
    pub fn of(width: f32) -> Self {
        let mut tiles = Tiles::default();
        let is_narrow = width < NARROW;
        let mut tabs = |panes: &[&[Pane]]| {
            let panes: Vec<TileId> = panes.concat().into_iter().map(|pane| tiles.insert_pane(pane)).collect();
            tiles.insert_tab_tile(panes)
        };
        let right: &[Pane] = &Pane::RIGHT;
        let library = tabs(&[&[Pane::Library], if is_narrow { right } else { &[] }]);
        let stage = tabs(&[&[Pane::Stage]]);
        let below = tabs(&[&Pane::BELOW]);
        let inspector = (!is_narrow).then(|| tabs(&[right]));
        let share = |points: f32| points / width.max(1.0);
        let middle = linear(&mut tiles, LinearDir::Vertical, &[(stage, 0.58), (below, 0.42)]);
        let (left, right) = (share((0.17 * width).clamp(220.0, 320.0)), share((0.18 * width).clamp(230.0, 340.0)));
        let mut columns = vec![(library, left), (middle, 1.0 - left - if is_narrow { 0.0 } else { right })];
        columns.extend(inspector.map(|tile| (tile, right)));
        let all = linear(&mut tiles, LinearDir::Horizontal, &columns);
        Self(Tree::new(egui::Id::unique("panes"), all, tiles))
    }
}

fn linear(tiles: &mut Tiles<Pane>, direction: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(direction, parts.iter().map(|(tile, _)| *tile).collect());
    parts.iter().for_each(|(tile, share)| linear.shares.set_share(*tile, *share));
    tiles.insert_container(Container::Linear(linear))
}

impl Layout {
    /// One frame of all panes.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        self.0.ui(desk, ui);
    }

    /// Brings a pane to the front of its stack.
    pub fn bring(&mut self, pane: Pane) {
        self.0.make_active(|_, tile| matches!(tile, Tile::Pane(own) if *own == pane));
    }

    /// Whether every pane is somewhere, once: a file of another version may lack some.
    pub fn is_whole(&self) -> bool {
        let shown: Vec<Pane> = self
            .0
            .tiles
            .tiles()
            .filter_map(|tile| match tile {
                Tile::Pane(pane) => Some(*pane),
                Tile::Container(_) => None,
            })
            .collect();
        shown.len() == Pane::ALL.len() && Pane::ALL.iter().all(|pane| shown.contains(pane))
    }
}

impl Behavior<Pane> for Desk<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, pane: &mut Pane) -> UiResponse {
        ui.push_id(*pane, |ui| self.show(ui, *pane));
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        pane.title().into()
    }

    fn simplification_options(&self) -> SimplificationOptions {
        // Every pane keeps its title, by which it is dragged.
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }

    fn min_size(&self) -> f32 {
        120.0
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        1.0
    }

    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        26.0
    }

    fn tab_bar_color(&self, _: &egui::Visuals) -> egui::Color32 {
        egui::Color32::TRANSPARENT
    }

    fn tab_bg_color(&self, visuals: &egui::Visuals, _: &Tiles<Pane>, _: TileId, state: &TabState) -> egui::Color32 {
        if state.active { look::card_fill(visuals) } else { egui::Color32::TRANSPARENT }
    }

    fn tab_outline_stroke(&self, _: &egui::Visuals, _: &Tiles<Pane>, _: TileId, _: &TabState) -> egui::Stroke {
        egui::Stroke::NONE
    }

    fn on_tab_button(&mut self, _: &mut Tiles<Pane>, _: TileId, button: Response) -> Response {
        let context = &button.ctx;
        look::focus(&context.layer_painter(button.layer_id), &button, &context.global_style().visuals);
        button
    }

    fn resize_stroke(&self, style: &egui::Style, state: ResizeState) -> egui::Stroke {
        match state {
            ResizeState::Idle => egui::Stroke::new(1.0, style.visuals.widgets.noninteractive.bg_stroke.color),
            ResizeState::Hovering => egui::Stroke::new(2.0, style.visuals.weak_text_color()),
            ResizeState::Dragging => egui::Stroke::new(2.0, style.visuals.selection.stroke.color),
        }
    }

    fn tab_text_color(&self, visuals: &egui::Visuals, _: &Tiles<Pane>, _: TileId, state: &TabState) -> egui::Color32 {
        if state.active { visuals.text_color() } else { visuals.weak_text_color() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layout_comes_back_from_its_file_and_one_that_lacks_a_pane_is_known() {
        for width in [900.0, 1600.0] {
            let layout = Layout::of(width);
            assert!(layout.is_whole());
            let text = serde_json::to_string(&layout).unwrap();
            let again: Layout = serde_json::from_str(&text).unwrap();
            assert_eq!(again, layout);
        }
        assert!(!Layout(Tree::new_tabs(egui::Id::unique("panes"), vec![Pane::Stage])).is_whole());
    }
}
