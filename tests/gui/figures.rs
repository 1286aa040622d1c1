//! The figures pane.

use std::sync::Arc;

use egui::OutputCommand;
use nbrdf::gui::pane::Pane;
use nbrdf::gui::session::{Figure, FigureChoice, Quantity};
use nbrdf::worker::{Found, Place, Profile, Topic};
use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::metric::{albedo_max, delta_e_itp, directional_albedo, negative_share, psnr};
use nbrdf_core::path::mix::Mix;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Brdf, Directions, Interpolation as _, Material, Rgb, Weights};

use super::*;

/// Two formulas, quick to evaluate and beyond reproach.
fn formulas() -> Vec<Material> {
    let material = |name: &str, diffuse, alpha| {
        let brdf: Arc<dyn Brdf> = Arc::new(Ggx { diffuse: Rgb(diffuse), f0: Rgb::splat(0.04), alpha });
        Material { name: name.to_owned(), brdf, network: None }
    };
    vec![material("blue", [0.1, 0.2, 0.3], 0.4), material("red", [0.3, 0.2, 0.1], 0.2)]
}

/// The pane in front, with this figure of two formulas.
fn shown(figure: Figure, method: &'static str) -> Harness<'static, Workbench> {
    let mut session = Session { methods: Methods(vec![method]), strips: false, ..Session::default() };
    session.blend.ends = vec!["blue".to_owned(), "red".to_owned()];
    session.figures = FigureChoice { figure, ..FigureChoice::default() };
    let stock = Stock { materials: formulas(), ..Stock::built_in() };
    let mut harness = open(stock, session, [1000.0, 700.0]);
    harness.state_mut().bring(Pane::Figures);
    harness.run_steps(2);
    harness
}

/// The newest answer to what is shown.
fn found(bench: &Workbench) -> Option<&Found> {
    let Session { figures, blend, look, .. } = &bench.session;
    let topic = figures.figure.topic(figures, blend, look.exposure);
    let findings = bench.gallery.curves.of(&topic)?;
    (findings.question.topic == topic && findings.is_fine && findings.waiting == 0).then_some(&findings.found)
}

fn wait(harness: &mut Harness<'_, Workbench>) {
    until(harness, "the figure is fine", |bench| found(bench).is_some());
}

fn places(bench: &Workbench) -> &[Place] {
    match found(bench) {
        Some(Found::Walks(walks)) => &walks[0].places,
        other => panic!("{other:?}"),
    }
}

fn profiles(bench: &Workbench) -> &[Profile] {
    match found(bench) {
        Some(Found::Profiles(profiles)) => profiles,
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_figure_is_there_by_its_label() {
    let mut harness = shown(Figure::Along, "log_mix");
    let labels = [
        "Figure: PSNR to the mix [dB] over t; curves: 1",
        "Figure: lobe of f_r, luminance [1/sr] at θ_i = 45°; curves: 3",
        "Figure: f_r, luminance [1/sr] over θ_half [°]; curves: 3",
        "Slice of Log mix",
        "Figure: directional albedo, luminance over θ_o [°]; curves: 3",
        "× loop",
        "Nothing to warn of",
    ];
    for ((figure, name, _), label) in Figure::ALL.into_iter().zip(labels) {
        harness.get_by_role_and_label(Role::Button, name).click();
        harness.run_steps(2);
        assert_eq!(harness.state().session.figures.figure, figure);
        wait(&mut harness);
        assert!(harness.query_by_label(label).is_some(), "{label}");
    }
}

#[test]
fn a_click_in_the_plot_goes_to_t() {
    let mut harness = shown(Figure::Along, "log_mix");
    harness.state_mut().session.blend.go_to(0.1);
    wait(&mut harness);
    harness.get_by_label_contains("Figure: PSNR").click();
    harness.run_steps(3);
    let t = harness.state().session.blend.t;
    assert!((t - 0.5).abs() < 0.06, "{t}");
}

#[test]
fn the_curves_are_what_the_metrics_say() {
    let mut harness = shown(Figure::Along, "log_mix");
    wait(&mut harness);
    let ends = formulas();
    let path = Mix::Log.between(&ends).unwrap();
    let mix = Mix::Linear.between(&ends).unwrap();
    let (point, mixed) = (path.at(&Weights::two(0.25)).unwrap(), mix.at(&Weights::two(0.25)).unwrap());
    let sphere = Sphere::studio();
    let (own, wanted) = (sphere.render(point.as_ref()), sphere.render(mixed.as_ref()));
    let before = sphere.render(path.at(&Weights::two(0.25 - 1.0 / 32.0)).unwrap().as_ref());
    let found = places(harness.state());
    assert_eq!((found.len(), found[0].t, found[32].t), (33, 0.0, 1.0));
    let place = found[8];
    assert_eq!(place.psnr, psnr(&wanted.displayed(), &own.displayed(), sphere.covered()));
    assert_eq!(place.to_mix, delta_e_itp(&wanted, &own, sphere.covered()));
    assert_eq!((place.albedo, place.negative), (albedo_max(point.as_ref()), negative_share(point.as_ref())));
    let [middle, step] = place.step.unwrap();
    assert_eq!(middle, 7.5 / 32.0);
    assert!((step - delta_e_itp(&before, &own, sphere.covered())).abs() < 1e-9);
    harness.state_mut().session.blend.is_beyond = true;
    harness.run_steps(2);
    wait(&mut harness);
    let beyond = places(harness.state());
    assert_eq!((beyond.len(), beyond[0].t, beyond[64].t), (65, -0.5, 1.5));
}

#[test]
fn profiles_are_what_the_materials_say() {
    let mut harness = shown(Figure::Lobe, "linear_mix");
    harness.state_mut().session.blend.go_to(0.25);
    harness.state_mut().session.figures.theta_i = 30.0;
    harness.run_steps(2);
    wait(&mut harness);
    let point = Mix::Linear.between(&formulas()).unwrap().at(&Weights::two(0.25)).unwrap();
    let own = |bench: &Workbench| {
        let found = profiles(bench).iter().find(|profile| profile.card == Card::Method("linear_mix"));
        found.unwrap().points.clone()
    };
    let (angle, f) = own(harness.state())[178 + 100];
    let at = Directions::from_angles(30f32.to_radians(), std::f32::consts::PI, 50f32.to_radians(), 0.0);
    let wanted = point.eval(at);
    assert!(
        angle == 50.0 && f.zip(wanted, |a, b| (a - b).abs()).max() < 1e-5 * wanted.max(),
        "{angle} {f:?} {wanted:?}"
    );
    harness.state_mut().session.figures.figure = Figure::Albedo;
    harness.run_steps(2);
    wait(&mut harness);
    let (angle, albedo) = own(harness.state())[40];
    assert_eq!((angle, albedo), (40.0, directional_albedo(point.as_ref(), 40f32.to_radians())));
}

#[test]
fn going_beyond_the_ends_is_a_warning_and_coming_back_ends_it() {
    let mut harness = shown(Figure::Warnings, "linear_mix");
    wait(&mut harness);
    assert!(harness.query_by_label("Nothing to warn of").is_some());
    let blend = &mut harness.state_mut().session.blend;
    blend.is_beyond = true;
    blend.go_to(1.4);
    harness.run_steps(2);
    wait(&mut harness);
    assert!(harness.query_by_label_contains("beyond the materials by 0.40").is_some());
    harness.state_mut().session.blend.go_to(0.5);
    harness.run_steps(2);
    wait(&mut harness);
    assert!(harness.query_by_label("Nothing to warn of").is_some());
}

#[test]
fn what_is_shown_is_copied_as_csv() {
    let mut harness = shown(Figure::Along, "log_mix");
    harness.state_mut().session.figures.quantity = Quantity::Albedo;
    wait(&mut harness);
    let wanted = places(harness.state())[32].albedo;
    harness.get_by_label("Copy CSV").click();
    let mut copied = None;
    for _ in 0..4 {
        harness.step();
        copied = copied.or(harness.output().platform_output.commands.iter().find_map(|command| match command {
            OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        }));
    }
    let copied = copied.unwrap();
    let lines: Vec<&str> = copied.lines().collect();
    assert_eq!((lines.len(), lines[0]), (34, "curve,t,Albedo [largest directional]"));
    assert_eq!(lines[33], format!("Log mix,1,{wanted}"));
}

#[test]
fn the_chart_of_all_models_can_be_stopped() {
    let mut harness = shown(Figure::Cost, "linear_mix");
    wait(&mut harness);
    let Some(Found::Prices(prices)) = found(harness.state()) else { panic!("no prices") };
    assert!(prices.len() == 3 && prices.iter().all(|price| price.cost.ns > 0.0), "{prices:?}");
    harness.get_by_label("Measure all").click();
    let doing = |bench: &Workbench| bench.gallery.curves.chart.as_ref().map(|chart| chart.doing.is_some());
    until(&mut harness, "the chart has begun", |bench| doing(bench) == Some(true));
    harness.get_by_label("Cancel").click();
    until(&mut harness, "the chart has stopped", |bench| doing(bench) == Some(false));
    assert!(harness.query_by_label("Measure all").is_some());
    assert!(harness.state().gallery.notices.is_empty(), "{:?}", harness.state().gallery.notices);
}

#[test]
fn an_end_that_is_unknown_is_said_in_the_pane() {
    let mut harness = shown(Figure::Albedo, "linear_mix");
    harness.state_mut().session.blend.choose(0, "blu");
    harness.run_steps(2);
    let topic = Topic::Albedo { weights: Weights::two(0.5) };
    until(&mut harness, "it is said", |bench| {
        bench
            .gallery
            .curves
            .of(&topic)
            .is_some_and(|found| matches!(&found.found, Found::Nothing(why) if why.contains("`blu`")))
    });
    harness.run_steps(1);
    assert!(harness.query_all_by_label_contains("There is no material `blu`").count() > 0);
}
