//! Networks as source code, run by compilers and by a graphics driver, against the library's own evaluation.

#[path = "shader/c.rs"]
mod c;
#[path = "shader/driver.rs"]
mod driver;
#[path = "shader/gpu.rs"]
mod gpu;
#[path = "shader/hlsl.rs"]
mod hlsl;
#[path = "shader/program.rs"]
mod program;
#[path = "shader/rust.rs"]
mod rust;

use std::f32::consts::{FRAC_PI_2, PI};

use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::nbrdf::fit::{random_hidden, random_network};
use nbrdf_core::sampling::turned_rus32k;
use nbrdf_core::shader::Shader;
use nbrdf_core::{Brdf, Directions, Rgb, Vec3};

/// Every so many pairs of the metrics' directions are asked.
const EVERY: usize = 5;
/// Largest relative difference from the library. Glossy networks multiply the rounding of their inputs by a hundred and more.
const TOLERANCE: f32 = 1e-4;
/// Reflectance below which differences count as if it were this \[1/sr\], a hundredth of a white Lambertian: exp(y) − 1 is as
/// exact as the sum y, whose terms are of the order of 1 and may leave next to nothing.
const FLOOR: f32 = 3e-3;

/// Metals, paints, plastics, fabrics; networks of other widths; one that changes when it is turned.
fn materials() -> Vec<(Shader, Box<dyn Brdf>)> {
    let built_in = ["chrome", "gold-metallic-paint", "red-plastic", "white-fabric", "black-obsidian", "blue-acrylic"];
    let network = |name: &str| builtin::independent().get(name).unwrap().network.clone();
    let mut networks: Vec<_> = built_in.iter().map(|&name| (name, network(name))).collect();
    networks.extend([("3-5", random_hidden(1, 0, [3, 5])), ("30 8", random_hidden(2, 0, [30, 8]))]);
    let isotropic = networks.into_iter().map(|(name, network)| {
        let shader = Shader::new(name, &network);
        (shader, Box::new(network) as Box<dyn Brdf>)
    });
    let turning = AnisotropicNbrdf::of(random_network(3, 0));
    isotropic.chain([(Shader::turning("brushed", &turning), Box::new(turning) as Box<dyn Brdf>)]).collect()
}

/// Those of the metrics, turned to all sides; grazing ones; those where coordinates have no azimuth or no half vector; and
/// some below the horizon.
fn directions() -> Vec<Directions> {
    let mut all: Vec<Directions> = turned_rus32k().into_iter().step_by(EVERY).collect();
    assert!(all.len() > 2000, "{}", all.len());
    let polar = [0.0, 1e-4, 0.7, 1.5, 1.56, 1.569];
    let azimuth = [0.0, 1e-3, 1.0, PI / 2.0, 3.0, PI];
    for theta_i in polar {
        for theta_o in polar {
            all.extend(azimuth.map(|phi| Directions::from_angles(theta_i, 0.4, theta_o, 0.4 + phi)));
        }
    }
    let low = FRAC_PI_2 - 1e-4;
    all.extend([Directions::from_angles(low, 0.3, low, 0.3 + PI), Directions::new(Vec3::Z, Vec3::Z)]);
    let below = Vec3::new(0.6, 0.0, -0.8);
    all.extend([below, Vec3::X].map(|light| Directions::new(light, Vec3::Z)));
    all.extend([below, Vec3::Y].map(|view| Directions::new(Vec3::Z, view)));
    all
}

/// Six numbers of each pair.
fn numbers(at: &[Directions]) -> Vec<f32> {
    at.iter().flat_map(|at| [at.light.to_array(), at.view.to_array()].concat()).collect()
}

/// Numbers as this machine keeps them.
fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_ne_bytes()).collect()
}

/// The other way round.
fn values(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks_exact(4).map(|four| f32::from_ne_bytes(four.try_into().unwrap())).collect()
}

/// Three numbers of each pair against the library's.
fn compare(who: &str, shader: &Shader, brdf: &dyn Brdf, found: &[f32]) {
    let at = directions();
    assert_eq!(found.len(), 3 * at.len());
    let (mut worst, mut place) = (0.0, String::new());
    for (&at, found) in at.iter().zip(found.chunks_exact(3)) {
        let Rgb(expected) = brdf.eval(at);
        for (found, expected) in found.iter().zip(expected) {
            let error = (found - expected).abs() / expected.max(FLOOR);
            if error > worst || error.is_nan() {
                (worst, place) = (error, format!("{found} instead of {expected} at {at:?}"));
            }
        }
        assert!(at.is_above() || found == [0.0; 3], "{who}, {}: {found:?} at {at:?}", shader.name());
    }
    println!("{who}, {}: at most {worst:.1e}, {place}", shader.name());
    assert!(worst <= TOLERANCE, "{who}, {}: {worst}, {place}", shader.name());
}
