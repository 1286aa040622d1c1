//! Small windows: what must be seen is within them, and what belongs together stands together.

use egui::Rect;
use nbrdf::gui::pane::Pane;
use nbrdf::gui::session::{Blend, Figure, FigureChoice, Way};

use super::*;

const SMALL: [f32; 2] = [900.0, 600.0];

fn rects(harness: &Harness<'_, Workbench>, label: &str) -> Vec<Rect> {
    harness.query_all_by_label(label).map(|node| node.rect()).collect()
}

#[test]
fn the_list_of_keys_begins_within_a_small_window() {
    let mut harness = open(Stock::built_in(), quick(), SMALL);
    harness.key_press(Key::F1);
    harness.run_steps(4);
    let first = harness.get_by_label("Find a command or a material").rect();
    let window = Rect::from_min_size(egui::Pos2::ZERO, SMALL.into());
    assert!(window.contains_rect(first), "{first:?}");
    let title = rects(&harness, "Keys");
    assert!(title.iter().all(|title| window.contains_rect(*title)), "{title:?}");
}

#[test]
fn frames_of_a_film_strip_stand_below_their_place_on_the_scrubber() {
    for (size, is_beyond) in [(SMALL, false), ([1600.0, 900.0], false), ([1920.0, 1080.0], false), (SMALL, true)] {
        let session = Session { strips: true, blend: Blend { is_beyond, ..Blend::default() }, ..quick() };
        let mut harness = open(Stock::built_in(), session, size);
        harness.run_steps(3);
        let rail = harness.get_by_label("t, from A to B").rect();
        let [first, middle, last] = ["Raw weights at 0.000", "Raw weights at 0.500", "Raw weights at 1.000"]
            .map(|label| harness.get_by_label_contains(label).rect().center().x);
        assert!((middle - rail.center().x).abs() < 1.0, "{middle} {rail:?}");
        let frames = harness.query_all_by_label_contains("Raw weights at ");
        assert!(frames.map(|frame| frame.rect().right()).all(|right| right <= rail.right()), "within the strip");
        assert!((first + last - 2.0 * middle).abs() < 1.0 && rail.left() < first && last < rail.right());
    }
}

#[test]
fn two_ways_and_two_timings_are_never_on_two_lines() {
    let names = ["gold-paint", "blue-acrylic", "green-plastic", "chrome", "brass", "pink-felt"];
    for ends in 3..=names.len() {
        for width in [900.0, 1000.0, 1280.0, 1600.0] {
            let ends = names[..ends].iter().map(|&name| name.to_owned()).collect();
            let blend = Blend { ends, way: Way::Keys, ..Blend::default() };
            let mut harness = open(Stock::built_in(), Session { blend, ..quick() }, [width, 700.0]);
            harness.run_steps(2);
            for pair in [["Keys", "Polygon"], ["Straight", "Even"]] {
                let [one, other] = pair.map(|label| harness.get_by_label(label).rect());
                assert_eq!(one.top(), other.top(), "{pair:?} at {width}");
            }
        }
    }
}

#[test]
fn the_names_of_curves_stand_beside_the_figure() {
    for figure in [Figure::Along, Figure::Lobe] {
        let figures = FigureChoice { figure, ..FigureChoice::default() };
        let mut harness = open(Stock::built_in(), Session { figures, ..quick() }, SMALL);
        harness.state_mut().bring(Pane::Figures);
        let patience = Instant::now() + Duration::from_secs(120);
        while harness.query_by_label_contains("Figure: ").is_none() {
            assert!(Instant::now() < patience, "no figure");
            std::thread::sleep(Duration::from_millis(10));
            harness.step();
        }
        harness.run_steps(2);
        let plot = harness.get_by_label_contains("Figure: ").rect();
        let beside = |name: &Rect| name.left() >= plot.right() && name.right() <= SMALL[0];
        let names = rects(&harness, "Raw weights");
        assert!(names.iter().any(|name| beside(name) && name.top() >= plot.top()), "{plot:?} {names:?}");
    }
}
