//! Paths that were made for the eye: no colours that neither end has, an even pace, nothing impossible beyond the ends;
//! and edits that move what they say.

use std::sync::Arc;

use nbrdf::catalog::{Catalog, Reference};
use nbrdf_core::axis::{Axis, edit};
use nbrdf_core::library::builtin;
use nbrdf_core::metric::{Smoothness, albedo_max};
use nbrdf_core::quality::Qualities;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Image, Material, Path, Representation, Weights};

fn catalog() -> Catalog {
    Catalog::new(Arc::new(Reference::built_in()))
}

fn materials<const N: usize>(names: [&str; N]) -> [Material; N] {
    names.map(|name| builtin::shared().get(name).unwrap().material())
}

fn smoothness(path: &dyn Path) -> Smoothness {
    let render = |step: u8| Sphere::studio().render(path.at(&Weights::two(f32::from(step) / 16.0)).unwrap().as_ref());
    let pictures: Vec<Image> = (0..=16).map(render).collect();
    Smoothness::of(&pictures, Sphere::studio().covered())
}

/// The pairs on which an autoencoder that is not trained for it drifts most in hue: 0.02 and more.
const DRIFTING: [[&str; 2]; 3] = [
    ["specular-orange-phenolic", "blue-rubber"],
    ["green-plastic", "specular-maroon-phenolic"],
    ["specular-maroon-phenolic", "blue-metallic-paint2"],
];

#[test]
fn latent_paths_keep_to_the_colours_of_their_ends_and_shortest_ones_are_even() {
    let catalog = catalog();
    for names in DRIFTING {
        let ends = materials(names);
        let of = |method: &str| smoothness(catalog.interpolation(method).unwrap().between(&ends).unwrap().as_ref());
        let [straight, even, shortest] = ["latent", "latent_even", "latent_geodesic"].map(of);
        println!("{names:?}\n  straight {straight:?}\n  even     {even:?}\n  shortest {shortest:?}");
        assert!(straight.hue_excursion < 0.01 && shortest.hue_excursion < 0.005);
        assert!(even.step_ratio < 1.05 && shortest.step_ratio < 1.05);
        assert!(shortest.length_ratio < 1.05);
    }
}

#[test]
fn beyond_the_ends_latent_paths_make_no_light_however_far_one_goes() {
    let catalog = catalog();
    for names in [["chrome", "red-fabric"], ["white-paint", "gold-paint"], ["black-soft-plastic", "rgl/paper_white"]] {
        let ends = materials(names);
        for method in ["latent", "latent_even", "latent_geodesic"] {
            let path = catalog.interpolation(method).unwrap().between(&ends).unwrap();
            for t in [-100.0, -0.5, -0.1, 1.1, 1.5, 100.0] {
                let albedo = albedo_max(path.at(&Weights::two(t)).unwrap().as_ref());
                assert!(albedo <= 1.0, "{method} {names:?} at {t}: {albedo}");
            }
        }
    }
}

#[test]
fn a_spline_through_key_materials_knows_how_far_it_is_from_known_ones() {
    let (catalog, ends) = (catalog(), materials(["gold-paint", "blue-acrylic", "white-fabric"]));
    let path = catalog.interpolation("latent").unwrap().between(&ends).unwrap();
    let known = catalog.autoencoder();
    let distance =
        |t: f32| known.distance(&path.code(&Weights::along_spline(t, 3)).unwrap().unwrap()).unwrap().unwrap();
    // Training materials: their own codes are near, what lies between is further away.
    assert!(distance(0.0) < 0.5 && distance(0.5) < 0.5, "{} {}", distance(0.0), distance(0.5));
    assert!(distance(0.25) > distance(0.0));
}

#[test]
fn an_edit_moves_its_quality_and_leaves_lightness_and_colour() {
    let catalog = catalog();
    let known = catalog.autoencoder();
    let prior = known.prior().unwrap();
    for material in materials(["red-plastic", "alumina-oxide", "gold-paint"]) {
        let code = catalog.representation("znbrdf", false).unwrap().encode(&material).unwrap();
        let before = Qualities::of(known.decode(&code).unwrap().as_ref());
        for (axis, amount) in
            [(Axis::Roughness, 0.06), (Axis::Roughness, -0.06), (Axis::Gloss, 0.05), (Axis::Sheen, 0.05)]
        {
            let (_, after) = edit(known.as_ref(), &prior, &code.code, axis, amount).unwrap();
            let moved = axis.difference(&before, &after);
            assert!(moved / amount > 0.7, "{} {}: {moved} of {amount}", material.name, axis.name());
            let colour = [0, 1].map(|i| after.colour[i] - before.colour[i]);
            assert!(colour[0].hypot(colour[1]) < 0.006, "{} {}: {colour:?}", material.name, axis.name());
        }
        let (same, _) = edit(known.as_ref(), &prior, &code.code, Axis::Gloss, 0.0).unwrap();
        assert_eq!(same, code.code);
    }
}
