use std::fs;

use super::*;
use crate::library::builtin;
use crate::metric::flip_map;
use crate::nbrdf::precision::Precision;
use crate::representation::Representation;
use crate::representation::analytic::{Analytic, LambertAlone, WardLobe};
use crate::sampler::lobe::Lobe;
use crate::scene::{Gathering, Scene, View};

const SCENE: &str = "
    [image]
    width = 72
    height = 48
    samples = 4
    [camera]
    from = [0, 0.4, 6]
    to = [0, 0, 0]
    field = 34
    [[light]]
    kind = 'environment'
    map = 'softboxes'
    seen = false
    [[light]]
    kind = 'point'
    at = [3, 5, 4]
    intensity = [30, 30, 30]
    [[object]]
    name = 'shiny'
    material = 'chrome'
    sphere = { centre = [-1.2, 0, 0], radius = 1 }
    [[object]]
    name = 'matte'
    material = 'pink-felt'
    sphere = { centre = [1.2, 0, 0], radius = 1 }
    [[object]]
    name = 'far and shiny'
    material = 'chrome'
    sphere = { centre = [0, 2.4, -9], radius = 0.4 }
";
const MATERIAL: [usize; 3] = [0, 1, 0];
const QUIET: Watch = Watch { tried: &|_, _| {}, cancelled: &|| false };

fn scene() -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, SCENE).unwrap();
    Scene::load(&path).unwrap()
}

fn view(scene: &Scene) -> View {
    let lobes = [Lobe { share: 0.8, width: 0.05 }, Lobe::COSINE, Lobe { share: 0.8, width: 0.05 }];
    View::gather(scene, &lobes, Gathering { seed: 0, done: &|| (), cancelled: &|| false }).unwrap()
}

fn materials() -> Vec<Material> {
    ["chrome", "pink-felt"].map(|name| builtin::shared().get(name).unwrap().material()).into()
}

/// A base, a lobe over it, the network in half precision, the network.
fn ladder() -> Vec<Rung> {
    fn formula<R: Representation + 'static>(representation: R, ns: f64) -> Rung {
        let (name, bytes) = (representation.name().to_owned(), representation.code_bytes());
        let make = move |material: &Material| {
            let code = representation.encode(material)?;
            Ok(Model { brdf: Arc::from(representation.decode(&code)?), bytes, kept: Kept::Code(code) })
        };
        Rung { name, ns, bytes, shared: None, coarser_than: None, is_itself: false, make: Box::new(make) }
    }
    let network = |name: &str, precision: Precision, is_itself| {
        let make = move |material: &Material| {
            let network = precision.round(material.network.as_ref().unwrap());
            let bytes = precision.bytes(network.hidden());
            let kept = if is_itself { Kept::Itself } else { Kept::Network(network.clone()) };
            Ok(Model { brdf: Arc::new(network), bytes, kept })
        };
        let bytes = precision.bytes([21, 21]);
        Rung {
            name: name.to_owned(),
            ns: 15.0,
            bytes,
            shared: None,
            coarser_than: None,
            is_itself,
            make: Box::new(make),
        }
    };
    vec![
        formula(Analytic::<LambertAlone>::new(), 0.6),
        formula(Analytic::<WardLobe>::new(), 2.4),
        network("half", Precision::Half, false),
        network("itself", Precision::Single, true),
    ]
}

fn options(tolerance: f64) -> Options {
    Options { tolerance, by: By::Time, exhaustive: false, most_bytes: usize::MAX, beside: Some(3) }
}

fn names<'a>(ladder: &'a [Rung], plan: &Plan) -> Vec<&'a str> {
    plan.choices.iter().map(|choice| ladder[choice.rung].name.as_str()).collect()
}

#[test]
fn matte_objects_take_fewer_numbers_than_shiny_ones() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let models = Models::new(&materials, &ladder);
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    let close = planner.plan(options(0.01), &QUIET).unwrap();
    assert_eq!(names(&ladder, &close), ["half"; 3], "as fast as the networks, and half of their bytes");
    let plan = planner.plan(options(0.2), &QUIET).unwrap();
    assert_eq!(names(&ladder, &plan)[..2], ["lambert_ward", "lambert"]);
    let everywhere = plan.beside.unwrap();
    assert_eq!(everywhere.bytes, 2 * 2700, "two materials, three objects");
    assert!(plan.totals.ns < everywhere.ns && plan.totals.bytes < everywhere.bytes);
}

#[test]
fn nothing_is_over_the_tolerance_and_more_of_it_never_costs_time() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let models = Models::new(&materials, &ladder);
    // One measurement of all for every tolerance: what is compared is the choice.
    let timed = Planner::new(&view, &models, &MATERIAL).unwrap();
    timed.plan(Options { exhaustive: true, ..options(1.0) }, &QUIET).unwrap();
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    planner.take_times(&timed);
    let mut before = f64::INFINITY;
    for tolerance in [1e-6, 0.001, 0.01, 0.04, 0.1, 0.3, 1.0] {
        let plan = planner.plan(options(tolerance), &QUIET).unwrap();
        let map = flip_map(&plan.reference.displayed(), &plan.planned.displayed());
        for (object, choice) in plan.choices.iter().enumerate() {
            let pixels = view.pixels_of(object);
            let mean = pixels.iter().map(|&pixel| f64::from(map[pixel])).sum::<f64>() / pixels.len() as f64;
            assert!((mean - choice.error).abs() < 1e-9 && mean <= tolerance, "{tolerance}: {choice:?}, {mean}");
        }
        // Within a tenth, bytes decide.
        assert!(plan.totals.ns <= TIE * before, "{tolerance}");
        before = plan.totals.ns;
        assert_eq!(plan.choices.iter().all(|choice| choice.unmet.is_some()), tolerance < 0.002, "{tolerance}");
    }
}

#[test]
fn the_walk_chooses_as_somebody_who_tries_everything() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let [some, all] = [Models::new(&materials, &ladder), Models::new(&materials, &ladder)];
    let everything = Planner::new(&view, &all, &MATERIAL).unwrap();
    let planner = Planner::new(&view, &some, &MATERIAL).unwrap();
    for (tolerance, by) in [(0.04, By::Time), (0.2, By::Time), (0.04, By::Bytes), (0.2, By::Bytes)] {
        let options = Options { by, ..options(tolerance) };
        let plan = planner.plan(options, &QUIET).unwrap();
        everything.take_times(&planner);
        let exhaustive = everything.plan(Options { exhaustive: true, ..options }, &QUIET).unwrap();
        assert_eq!(names(&ladder, &plan), names(&ladder, &exhaustive), "{tolerance} {by:?}");
    }
    assert!(some.count() <= all.count());
    assert_eq!(all.count(), 8, "two materials on four rungs");
}

#[test]
fn a_model_that_many_share_is_tried_only_where_it_can_pay() {
    let (view, materials) = (view(&scene()), materials());
    for (shared, expected) in [(100, "code"), (100_000, "half")] {
        let mut ladder = ladder();
        let Rung { make, .. } = ladder.remove(3);
        let code = Box::new(|material: &Material| {
            let network = material.network.clone().unwrap();
            Ok(Model { brdf: Arc::new(network.clone()), bytes: 128, kept: Kept::Network(network) })
        });
        let rung = |name: &str, bytes, shared, is_itself, make| Rung {
            name: name.into(),
            ns: 15.0,
            bytes,
            shared,
            coarser_than: None,
            is_itself,
            make,
        };
        ladder.push(rung("code", 128, Some(("decoder".to_owned(), shared)), false, code));
        ladder.push(rung("itself", 2700, None, true, make));
        let models = Models::new(&materials, &ladder);
        let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
        let plan = planner.plan(Options { by: By::Bytes, ..options(0.01) }, &QUIET).unwrap();
        assert_eq!(names(&ladder, &plan), [expected; 3], "{shared}");
        assert_eq!(plan.totals.bytes, if expected == "code" { 2 * 128 + 100 } else { 2 * 1350 });
    }
}

#[test]
fn the_error_of_one_object_is_that_of_the_whole_picture() {
    let (view, materials) = (view(&scene()), materials());
    let own: Vec<&dyn Brdf> = MATERIAL.iter().map(|&place| materials[place].brdf.as_ref()).collect();
    let judge = judge::Judge::new(&view, &own);
    for object in 0..3 {
        let other = crate::brdf::lambert::Lambert { albedo: crate::Rgb([0.5, 0.4, 0.1]) };
        let mut models = own.clone();
        models[object] = &other;
        let (alone, together) = (judge.error(object, &other), judge.together(&models).1[object]);
        assert!((alone - together).abs() < 1e-5 && alone > 0.05, "{alone} {together}");
        assert_eq!(judge.error(object, own[object]), 0.0);
        assert!((judge.between(object, own[object], &other) - alone).abs() < 1e-9);
    }
}

#[test]
fn a_material_that_a_kind_of_model_cannot_hold_is_served_by_others() {
    let (view, materials, mut ladder) = (view(&scene()), materials(), ladder());
    ladder[0].make = Box::new(|material| Err(EncodeError::NotFinite { material: material.name.clone() }));
    let models = Models::new(&materials, &ladder);
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    let with = |beside| planner.plan(Options { beside: Some(beside), ..options(1.0) }, &QUIET).unwrap();
    assert_eq!(names(&ladder, &with(3)), ["lambert_ward"; 3]);
    assert!(with(0).beside.is_none());
}

#[test]
fn light_beyond_all_numbers_is_still_planned() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let blinding =
        Material::new("blinding", Arc::new(crate::brdf::lambert::Lambert { albedo: crate::Rgb::splat(3e38) }));
    let materials = [blinding, materials[1].clone()];
    let mut ladder = ladder;
    ladder[3].make = Box::new(|material| Ok(Model { brdf: material.brdf.clone(), bytes: 12, kept: Kept::Itself }));
    ladder.remove(2);
    let models = Models::new(&materials, &ladder);
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    let plan = planner.plan(Options { beside: None, ..options(1e-6) }, &QUIET).unwrap();
    assert!(plan.choices.iter().all(|choice| choice.error <= 1e-6), "{:?}", plan.choices);
}

#[test]
fn models_that_are_too_large_are_left_out_but_for_the_materials_themselves() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let models = Models::new(&materials, &ladder);
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    let plan = planner.plan(Options { most_bytes: 1000, ..options(0.01) }, &QUIET).unwrap();
    assert_eq!(names(&ladder, &plan), ["itself"; 3]);
}

#[test]
fn who_cancels_gets_no_plan() {
    let (view, materials, ladder) = (view(&scene()), materials(), ladder());
    let models = Models::new(&materials, &ladder);
    let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
    let watch = Watch { cancelled: &|| true, ..QUIET };
    assert!(matches!(planner.plan(options(0.04), &watch), Err(PlanError::Cancelled)));
}

#[test]
fn a_receding_object_changes_its_model_seldom_and_unseen() {
    let (scene, materials, ladder) = (scene(), materials(), ladder());
    let models = Models::new(&materials, &ladder);
    let tolerance = 0.2;
    let factors: Vec<f64> = (0..6).map(|step| 1.5_f64.powi(step)).collect();
    let mut before = None;
    let mut rungs = Vec::new();
    for factor in factors.iter().chain(factors.iter().rev()) {
        let view = view(&scene.from_afar(1, *factor));
        let planner = Planner::new(&view, &models, &MATERIAL).unwrap();
        let now = planner.follow(1, before, options(tolerance), &QUIET).unwrap();
        assert!(now.error <= tolerance && now.change.is_none_or(|change| change <= tolerance), "{factor}: {now:?}");
        before = Some(now.rung);
        rungs.push(now.rung);
    }
    rungs.dedup();
    assert!(rungs.len() <= 5, "out and back: {rungs:?}");
}
