//! All spheres side by side, as large as fits.

use egui::{Rect, ScrollArea, Sense, Ui, Vec2, vec2};

use super::card::{self, CardPanel};
use super::{Gallery, Session};

const GAP: f32 = 8.0;
const SMALLEST: f32 = 96.0;

/// The spheres.
pub struct Cards<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
}

/// How the cards are laid out \[points\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Cards in a row.
    pub columns: usize,
    /// Side of a sphere.
    pub side: f32,
    /// Height of everything.
    pub height: f32,
}

impl Cards<'_> {
    /// The side of a sphere that is asked for \[points\].
    pub fn show(self, ui: &mut Ui) -> f32 {
        let Self { session, gallery } = self;
        let cards = session.cards();
        let (available, pixel) = (ui.available_size(), 1.0 / ui.pixels_per_point());
        let mut grid = Grid::fit(available, cards.len());
        // Whole pixels, so that pictures are shown as they were rendered.
        grid.side = (grid.side / pixel).floor() * pixel;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            let spare = ((available.y - grid.height) / 2.0).max(0.0);
            let (area, _) = ui.allocate_exact_size(vec2(available.x, grid.height.max(available.y)), Sense::hover());
            let size = card::size(grid.side);
            let wide = grid.columns as f32 * (size.x + GAP) - GAP;
            let corner = area.min + vec2(((available.x - wide) / 2.0).max(0.0).round(), spare.round());
            for (place, &card) in cards.iter().enumerate() {
                let (column, row) = ((place % grid.columns) as f32, (place / grid.columns) as f32);
                let at = corner + vec2(column * (size.x + GAP), row * (size.y + GAP));
                let (view, distance) = (gallery.view(card), gallery.atlas.explored());
                CardPanel { session: &mut *session, view, distance, card, side: grid.side }
                    .show(ui, Rect::from_min_size(at, size));
            }
        });
        grid.side
    }
}

impl Grid {
    /// The largest spheres that fit; one row is worth a fifth of their size.
    pub fn fit(available: Vec2, cards: usize) -> Self {
        let text = card::size(0.0);
        let side = |columns: usize| {
            let (columns, rows) = (columns as f32, cards.div_ceil(columns) as f32);
            let wide = (available.x + GAP) / columns - GAP - text.x;
            let high = (available.y + GAP) / rows - GAP - text.y;
            wide.min(high)
        };
        let worth = |columns: usize| side(columns) * if columns == cards { 1.2 } else { 1.0 };
        let columns = (1..=cards).max_by(|&m, &n| worth(m).total_cmp(&worth(n))).unwrap_or(1);
        let (columns, side) = if side(columns) >= SMALLEST {
            (columns, side(columns))
        } else {
            let columns = ((available.x + GAP) / (SMALLEST + text.x + GAP)).floor() as usize;
            let columns = columns.clamp(1, cards.max(1));
            (columns, ((available.x + GAP) / columns as f32 - GAP - text.x).clamp(SMALLEST, 160.0))
        };
        let high = cards.div_ceil(columns) as f32 * (side + text.y + GAP);
        Self { columns, side, height: high - GAP }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_cards_stand_in_one_row_and_fill_the_width() {
        let grid = Grid::fit(vec2(1300.0, 700.0), 5);
        assert_eq!(grid.columns, 5);
        assert!(grid.side > 210.0 && grid.height <= 700.0, "{grid:?}");
    }

    #[test]
    fn a_narrow_middle_wraps_and_nothing_is_smaller_than_it_may_be() {
        let grid = Grid::fit(vec2(300.0, 200.0), 5);
        assert_eq!(grid.columns, 2);
        assert!(grid.side >= SMALLEST && grid.height > 200.0, "it scrolls: {grid:?}");
    }

    #[test]
    fn nothing_overlaps_at_any_size() {
        for (width, height) in (100..2000).step_by(37).flat_map(|w| (100..1200).step_by(41).map(move |h| (w, h))) {
            for cards in 2..=13 {
                let available = vec2(width as f32, height as f32);
                let grid = Grid::fit(available, cards);
                let rows = cards.div_ceil(grid.columns) as f32;
                assert!(rows * card::size(grid.side).y <= grid.height + 0.01, "{grid:?}");
                assert!(grid.side >= SMALLEST);
            }
        }
    }
}
