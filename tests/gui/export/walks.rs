//! Tables of figures along a path.

use nbrdf::gui::session::Way;

use super::*;

/// Lines of the table that is written of this session's walk.
fn curve(mut session: Session, folder: &Path, steps: u16) -> Vec<Vec<String>> {
    session.export.steps = steps;
    let mut harness = built_in(session);
    choose(&mut harness, What::Curve);
    let said = write(&mut harness);
    let text = std::fs::read_to_string(folder.join("out.csv")).unwrap_or_else(|error| panic!("{said}: {error}"));
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_walk_goes_around_a_polygon_and_beyond_the_ends_as_film_strips_do() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.choose(2, "chrome");
    session.blend.way = Way::Polygon;
    let lines = curve(session, folder.path(), 4);
    assert_eq!(manifest(folder.path())["tour"], "around");
    assert_eq!(lines.len(), 4);
    for (line, corner) in lines.iter().zip([0, 1, 2, 0]) {
        let weights: Vec<f32> = line[2..5].iter().map(|weight| weight.parse().unwrap()).collect();
        assert!((weights[corner] - 1.0).abs() < 1e-5, "{line:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.is_beyond = true;
    let lines = curve(session, folder.path(), 3);
    assert_eq!(lines.iter().map(|line| line[1].as_str()).collect::<Vec<_>>(), ["-0.5", "0.5", "1.5"]);
    assert_eq!(lines[0][2..4], ["1.5", "-0.5"]);
}
