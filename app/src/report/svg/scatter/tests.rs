use super::*;

fn scatter(places: &[(f64, f64)]) -> Scatter {
    let spot = |(i, &(x, y)): (usize, &(f64, f64))| Spot {
        x,
        y,
        band: [0.5 * y, 2.0 * y],
        size: 4.0,
        kind: 0,
        label: format!("p{i} < q"),
        about: "a & b".to_owned(),
    };
    let panel = || Panel {
        title: "title".to_owned(),
        x_label: "ns".to_owned(),
        y_label: "error".to_owned(),
        spots: places.iter().enumerate().map(spot).collect(),
        front: (0..places.len()).collect(),
        is_straight: false,
    };
    let kinds = vec![Kind { name: "kind".to_owned(), colour: 1, shape: Shape::Circle }];
    let panels = vec![panel(), panel(), panel()];
    Scatter { title: "t".to_owned(), subtitle: "s".to_owned(), kinds, panels, is_dark: false }
}

/// Centres of the marks after the legend's.
fn centres(svg: &str) -> Vec<[f64; 2]> {
    let number = |line: &str, key: &str| line.split(key).nth(1)?.split('"').next()?.parse().ok();
    let marks = svg.lines().filter(|line| line.starts_with("<circle"));
    marks.filter_map(|line| Some([number(line, "cx=\"")?, number(line, "cy=\"")?])).skip(1).collect()
}

#[test]
fn ten_times_as_much_is_as_far_everywhere_and_less_error_stands_lower() {
    let at = centres(&scatter(&[(1.0, 0.1), (10.0, 0.01), (100.0, 0.001)]).svg());
    assert_eq!(at.len(), 9, "three panels");
    assert!(((at[1][0] - at[0][0]) - (at[2][0] - at[1][0])).abs() < 0.2);
    assert!(at[0][1] < at[1][1] && at[1][1] < at[2][1]);
    assert!((at[3][1] - at[0][1]) > FIRST * 0.5, "the second panel is below the first");
}

#[test]
fn labels_do_not_cover_marks_or_each_other_and_are_left_out_where_there_is_no_room() {
    let crowded: Vec<(f64, f64)> = (0..60).map(|i| (1.0 + 0.001 * f64::from(i), 0.1)).chain([(100.0, 0.01)]).collect();
    let svg = scatter(&crowded).svg();
    let named = svg.matches("class=\"name\"").count();
    assert!((3..120).contains(&named), "{named}");
    assert!(svg.contains("p0 &lt; q") && svg.contains("a &amp; b"));
}

#[test]
fn nothing_to_show_is_still_a_picture() {
    for places in [&[][..], &[(f64::NAN, 1.0)], &[(0.0, 0.0)], &[(3.0, 0.2)]] {
        let svg = scatter(places).svg();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && !svg.contains("NaN"), "{places:?}");
    }
}
