use std::fs;

use glam::DVec3;

use super::*;
use crate::brdf::{ggx::Ggx, lambert::Lambert};
use crate::render::{Light, Sphere};
use crate::sampler::lobe::Lobe;
use crate::{Brdf, Image, Rgb};

const HEAD: &str =
    "[image]\nwidth = 32\nheight = 24\nsamples = 4\n[camera]\nfrom = [0, 0, 5]\nto = [0, 0, 0]\nfield = 40\n";
const LAMP: &str = "[[light]]\nkind = \"point\"\nat = [0, 0, 5]\nintensity = [50, 50, 50]\n";
const BALL: &str = "[[object]]\nmaterial = \"chrome\"\nsphere = { centre = [0, 0, 0], radius = 1 }\n";

/// A scene of these files, the first of which is read.
fn scene(files: &[(&str, &str)]) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    Scene::load(&folder.path().join(files[0].0))
}

fn view(scene: &Scene) -> View {
    let lobes = vec![Lobe::COSINE; scene.objects.len()];
    View::gather(scene, &lobes, Gathering { seed: 0, done: &|| (), cancelled: &|| false }).unwrap()
}

fn image(scene: &Scene, brdfs: &[&dyn Brdf]) -> Image {
    let view = view(scene);
    let radiances: Vec<_> = view.demands().iter().zip(brdfs).map(|(demand, brdf)| demand.radiance(*brdf)).collect();
    view.image(&radiances)
}

fn white() -> Lambert {
    Lambert { albedo: Rgb::splat(1.0) }
}

#[test]
fn a_scene_is_read_with_what_it_includes_and_has_the_last_word() {
    let light = format!("tolerance = 0.1\n[image]\nwidth = 9\nheight = 9\n{LAMP}");
    let main = format!("include = [\"light.toml\"]\ntolerance = 0.02\n{HEAD}{BALL}");
    let scene = scene(&[("main.toml", &main), ("light.toml", &light)]).unwrap();
    assert_eq!((scene.picture.width, scene.lamps.len(), scene.objects.len()), (32, 1, 1));
    assert_eq!((scene.tolerance, scene.objects[0].name.as_str()), (Some(0.02), "chrome"));
}

#[test]
fn what_is_no_scene_is_told_with_place_and_remedy() {
    let with = |text: &str| format!("{HEAD}{LAMP}{BALL}{text}");
    let cases = [
        (format!("{HEAD}{LAMP}"), "[[object]]: expected 1 to 1000 of them, found 0"),
        (format!("{HEAD}{BALL}"), "[[light]]: expected 1 to 1000 of them, found 0"),
        (format!("{LAMP}{BALL}"), "[image]: expected it in this file or an included one, found none"),
        (with(BALL), "a name of its own for every one, found 'chrome' twice"),
        (with("tolerance = 3\n").replace("sphere = ", "spere = "), "unknown field `spere`"),
        (with("").replace("width = 32", "width = 0"), "image.width: expected 1 to 4096, found 0"),
        (with("").replace("width = 32", "width = 99999999999"), "image.width: expected 1 to 4096"),
        (
            with("").replace("= 32\nheight = 24\nsamples = 4", "= 4096\nheight = 4096\nsamples = 4096"),
            "found 137438953472",
        ),
        (with("").replace("field = 40", "field = nan"), "camera.field: expected 0.01 to 170, found NaN"),
        (with("").replace("from = [0, 0, 5]", "from = [0, 5, 0]"), "a view that is not along `up`"),
        (with("").replace("radius = 1", "radius = 0"), "object 1 ('chrome'), sphere.radius: expected"),
        (
            with("").replace("radius = 1 }", "radius = 1 }\nplane = { point = [0,0,0], normal = [0,1,0] }"),
            "one of sphere, plane",
        ),
        (with("").replace("[50, 50, 50]", "[50, -50, 50]"), "light 1, intensity: expected 0 to 1e9, found -50"),
        (format!("include = [\"none.toml\"]\n{}", with("")), "none.toml: expected a file, found no such file"),
        (format!("include = [\"a.toml\"]\n{}", with("")), "includes lead around in a circle (a.toml → a.toml)"),
        (format!("tolerance = 0\n{}", with("")), "tolerance: expected above 0, 1 at most, found 0"),
        ("\u{0}".to_owned(), "expected a scene in TOML"),
    ];
    for (text, expected) in cases {
        let error = scene(&[("a.toml", &text)]).unwrap_err().to_string();
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

#[test]
fn a_mesh_that_leads_nowhere_is_told() {
    let main = format!("{HEAD}{LAMP}[[object]]\nmaterial = \"chrome\"\nmesh = {{ file = \"m.obj\" }}\n");
    let cases = [
        ("", "1 to 1048576 faces in a scene, found 0"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "triangles with an area, found none"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "an OBJ file, found face vertex index out of bounds"),
        ("v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n", "corners within 1e9"),
        ("v 0 0 x\nf 1 1 1\n", "an OBJ file, found position parse error"),
    ];
    for (text, expected) in cases {
        let error = scene(&[("main.toml", &main), ("m.obj", text)]).unwrap_err().to_string();
        assert!(error.contains("m.obj: ") && error.contains(expected), "{expected}: {error}");
    }
    assert!(
        scene(&[("main.toml", &main)]).unwrap_err().to_string().contains("m.obj: expected a file, found no such file")
    );
}

#[test]
fn a_distant_lamp_shades_a_sphere_as_the_standard_sphere_is_shaded() {
    // From far away perspective and the lamp's nearness vanish: what is left is the sphere of the metrics.
    let text = "[image]\nwidth = 64\nheight = 64\nsamples = 64\n[camera]\nfrom = [0, 0, 1000]\nto = [0, 0, 0]\nfield = 0.115749\n\
                [[light]]\nkind = \"point\"\nat = [70710.678, 0, 70710.678]\nintensity = [3.14159265e10, 3.14159265e10, 3.14159265e10]\n\
                [[object]]\nmaterial = \"chrome\"\nsphere = { centre = [0, 0, 0], radius = 1 }\n";
    let text = text.replace("3.14159265e10", "9.99e8");
    let scene = scene(&[("a.toml", &text)]).unwrap();
    let seen = image(&scene, &[&white()]);
    let scale = std::f32::consts::PI * 1e10 / 9.99e8;
    let expected = Sphere::new(64, &Light::point()).render(&white());
    for (x, y) in [(32, 32), (45, 20), (50, 40), (40, 32)] {
        let (own, known) = (seen.get(x, y)[0] * scale, expected.get(x, y)[0]);
        assert!((own / known - 1.0).abs() < 0.02, "({x}, {y}): {own} {known}");
    }
}

#[test]
fn an_area_light_of_small_size_is_a_point_light() {
    let with = |light: &str| {
        let plane =
            "[[object]]\nmaterial = \"chrome\"\nrectangle = { centre = [0, 0, 0], u = [2, 0, 0], v = [0, 2, 0] }\n";
        image(&scene(&[("a.toml", &format!("{HEAD}{light}{plane}"))]).unwrap(), &[&white()])
    };
    // Radiant intensity of a facing area of 0.02 x 0.02 and radiance 100000 is 40.
    let point = with("[[light]]\nkind = \"point\"\nat = [0, 0, 3]\nintensity = [40, 40, 40]\n");
    let area = with(
        "[[light]]\nkind = \"area\"\ncentre = [0, 0, 3]\nu = [0.01, 0, 0]\nv = [0, -0.01, 0]\nradiance = [1e5, 1e5, 1e5]\n",
    );
    // It is seen from behind, and is not there; lights of size shine on one side, with the cosine to their normal.
    let (own, other) = (area.get(16, 12)[0], point.get(16, 12)[0]);
    assert!((own / other - 1.0).abs() < 0.05, "{own} {other}");
}

#[test]
fn an_even_environment_shows_a_white_surface_as_itself() {
    let folder = tempfile::tempdir().unwrap();
    Image::new(8, 4, vec![Rgb::splat(0.7); 32]).write_exr(&folder.path().join("even.exr")).unwrap();
    let text =
        format!("{HEAD}[[light]]\nkind = \"environment\"\nmap = \"even.exr\"\n{BALL}").replace("= 4\n", "= 256\n");
    fs::write(folder.path().join("a.toml"), text).unwrap();
    let seen = image(&Scene::load(&folder.path().join("a.toml")).unwrap(), &[&white()]);
    for (x, y) in [(16, 12), (12, 10), (0, 0)] {
        assert!((seen.get(x, y)[1] - 0.7).abs() < 0.02, "({x}, {y}): {:?}", seen.get(x, y));
    }
}

#[test]
fn what_stands_before_the_lamp_throws_a_shadow() {
    let floor = "[[object]]\nname = \"floor\"\nmaterial = \"a\"\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\n";
    let lamp = "[[light]]\nkind = \"point\"\nat = [0, 9, 0]\nintensity = [90, 90, 90]\n";
    let head = HEAD.replace("from = [0, 0, 5]", "from = [0, 4, 5]");
    let scene = scene(&[("a.toml", &format!("{head}{lamp}{floor}{BALL}"))]).unwrap();
    let seen = image(&scene, &[&white(), &white()]);
    let black = view(&scene).pixels_of(0).into_iter().filter(|&pixel| seen.pixels()[pixel] == Rgb::BLACK).count();
    // The umbra is a disk of radius 1.12 below the ball, most of it hidden by the ball.
    assert!((4..60).contains(&black), "{black}");
    let below = Ray { origin: DVec3::new(0.0, -0.9, 1.0), direction: DVec3::Y };
    assert!(scene.is_clear(&below, 9.0) && !scene.is_clear(&Ray { origin: DVec3::new(0.0, -0.9, 0.9), ..below }, 9.0));
}

#[test]
fn a_mesh_of_a_box_is_hit_where_the_box_is() {
    let corners: Vec<String> = (0..8).map(|i| format!("v {} {} {}", i & 1, (i >> 1) & 1, (i >> 2) & 1)).collect();
    let faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"].map(|face| format!("f {face}"));
    let obj = format!("{}\n{}\n", corners.join("\n"), faces.join("\n"));
    let main = format!(
        "{HEAD}{LAMP}[[object]]\nmaterial = \"a\"\nmesh = {{ file = \"m.obj\", scale = 2, at = [-1, -1, -1] }}\n"
    );
    let scene = scene(&[("main.toml", &main), ("m.obj", &obj)]).unwrap();
    let towards = |x: f64, y: f64| Ray { origin: DVec3::new(x, y, 5.0), direction: DVec3::NEG_Z };
    let hit = |x, y| scene.hit(&towards(x, y)).map(|(_, hit)| hit.distance);
    assert_eq!(hit(0.3, -0.4), Some(4.0));
    assert_eq!(hit(0.99, 0.99), Some(4.0));
    assert_eq!(hit(1.01, 0.0), None);
    let Shape::Mesh(mesh) = &scene.objects[0].shape else { panic!("a mesh") };
    assert_eq!((mesh.len(), mesh.centre()), (12, DVec3::ZERO));
}

#[test]
fn corners_have_the_normals_of_the_file_where_all_have_one_and_else_the_mean_of_the_faces_around() {
    let main = format!("{HEAD}{LAMP}[[object]]\nmaterial = \"a\"\nmesh = {{ file = \"m.obj\" }}\n");
    let corners = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn 0 0.6 0.8\nvn 1 0 0\nvt 0 0\n";
    let normal = |faces: &str| {
        let scene = scene(&[("main.toml", &main), ("m.obj", &format!("{corners}g one\n{faces}"))]).unwrap();
        let ray = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::NEG_Z };
        scene.hit(&ray).unwrap().1.normal
    };
    let given = DVec3::new(0.0, 0.6, 0.8);
    assert!(normal("f 1//1 2//1 3//1\n").distance(given) < 1e-6);
    assert!(normal("f\t1/1/1 2/1/1 3/1/1\r\n").distance(given) < 1e-6);
    assert!(normal("f 1 2 3\n").distance(DVec3::Z) < 1e-9);
    assert!(normal("f 1//2 2//2 3//2\nv 9 9 9\nv 8 9 9\nv 9 8 9\ng two\nf 4 5 6\n").distance(DVec3::Z) < 1e-9);
}

#[test]
fn a_file_that_two_others_include_counts_once_and_its_mistakes_are_its_own() {
    let both = format!("include = [\"a.toml\", \"b.toml\"]\n{HEAD}{BALL}");
    let read = |light: &str| {
        let include = "include = [\"light.toml\"]\n";
        scene(&[("main.toml", &both), ("a.toml", include), ("b.toml", include), ("light.toml", light)])
    };
    assert_eq!(read(LAMP).unwrap().lamps.len(), 1);
    let error = read(&LAMP.replace("50, 50", "-5, 50")).unwrap_err().to_string();
    assert!(error.contains("light.toml: light 1, intensity"), "{error}");
}

#[test]
fn an_area_light_shines_on_one_side_and_is_seen_there() {
    let with = |v: &str| {
        let light =
            format!("[[light]]\nkind = \"area\"\ncentre = [0, 0, 2]\nu = [1, 0, 0]\nv = {v}\nradiance = [2, 2, 2]\n");
        let wall = "[[object]]\nmaterial = \"a\"\nplane = { point = [0, 0, 0], normal = [0, 0, 1] }\n";
        image(&scene(&[("a.toml", &format!("{HEAD}{light}{wall}"))]).unwrap(), &[&white()])
    };
    let (towards_camera, towards_wall) = (with("[0, 1, 0]"), with("[0, -1, 0]"));
    assert_eq!(towards_camera.get(16, 12), Rgb::splat(2.0));
    assert_eq!(towards_camera.get(1, 1), Rgb::BLACK, "the wall is behind it");
    assert!(towards_wall.get(16, 12)[0] > 0.2 && towards_wall.get(16, 12)[0] < 2.0, "seen through its back");
}

#[test]
fn how_lights_are_drawn_changes_the_noise_and_not_the_mean() {
    let glossy = Ggx { diffuse: Rgb::splat(0.2), f0: Rgb::splat(0.5), alpha: 0.15 };
    let lights = "[[light]]\nkind = \"environment\"\nmap = \"softboxes\"\nseen = false\n\
                  [[light]]\nkind = \"area\"\ncentre = [-3, 3, 4]\nu = [1, 0, 1]\nv = [-0.5, 0.6, 0.5]\nradiance = [9, 9, 9]\n";
    let text = format!("{HEAD}{lights}{BALL}").replace("samples = 4", "samples = 256");
    let scene = scene(&[("a.toml", &text)]).unwrap();
    let with = |lobe: Lobe| {
        let how = Gathering { seed: 3, done: &|| (), cancelled: &|| false };
        let view = View::gather(&scene, &[lobe], how).unwrap();
        let radiance = view.demands()[0].radiance(&glossy);
        radiance.iter().map(|value| f64::from(value[1])).sum::<f64>() / radiance.len() as f64
    };
    let means = [Lobe::COSINE, Lobe { share: 0.5, width: 0.15 }, Lobe { share: 0.9, width: 0.4 }].map(with);
    for mean in means {
        assert!((mean / means[0] - 1.0).abs() < 0.02, "{means:?}");
    }
}

#[test]
fn pixels_and_pairs_are_the_same_for_any_number_of_threads() {
    let scene = scene(&[("a.toml", &format!("{HEAD}{LAMP}{BALL}"))]).unwrap();
    let with = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| image(&scene, &[&white()]))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn an_object_far_off_is_seen_in_the_same_place_and_smaller() {
    let scene = scene(&[("a.toml", &format!("{HEAD}{LAMP}{BALL}"))]).unwrap();
    let (near, far) = (view(&scene).pixels_of(0), view(&scene.from_afar(0, 3.0)).pixels_of(0));
    assert!(far.len() * 6 < near.len() && !far.is_empty() && far.iter().all(|pixel| near.contains(pixel)));
}

#[test]
fn what_no_ray_meets_is_named() {
    let hidden = "[[object]]\nname = \"hidden\"\nmaterial = \"a\"\nsphere = { centre = [0, 0, -3], radius = 0.1 }\n";
    let scene = scene(&[("a.toml", &format!("{HEAD}{LAMP}{BALL}{hidden}"))]).unwrap();
    let view = view(&scene);
    let names: Vec<&str> = view.unseen(&scene.objects).map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["hidden"]);
}
