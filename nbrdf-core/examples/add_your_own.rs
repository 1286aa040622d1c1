//! A representation of your own: reflectance as a curve over the half angle, 16 numbers for each channel. It is judged beside a
//! formula: `cargo run --release -p nbrdf-core --example add_your_own -- FOLDER`.

use std::f32::consts::FRAC_PI_2;
use std::path::Path;

use nbrdf_core::library::builtin;
use nbrdf_core::metric::{LogError, Metric, image_errors};
use nbrdf_core::render::Sphere;
use nbrdf_core::representation::analytic::{Analytic, GgxLobe};
use nbrdf_core::representation::{DecodeError, EncodeError};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Code, Directions, Image, Material, Representation, Rgb};

/// What a code stands for: f_r at half angles that crowd towards the highlight.
struct Curve(Vec<Rgb>);

const PLACES: usize = 16;

/// Where on the curve a pair of directions is, 0 at the highlight.
fn place(at: Directions) -> f32 {
    ((at.rusinkiewicz().theta_half / FRAC_PI_2).sqrt() * (PLACES - 1) as f32).clamp(0.0, (PLACES - 1) as f32)
}

impl Brdf for Curve {
    fn eval(&self, at: Directions) -> Rgb {
        let (below, share) = (place(at) as usize, place(at).fract());
        let above = (below + 1).min(PLACES - 1);
        let between = self.0[below].zip(self.0[above], |a, b| a + share * (b - a));
        if at.is_above() { between } else { Rgb::BLACK }
    }
}

struct HalfAngle;

impl Representation for HalfAngle {
    fn name(&self) -> &'static str {
        "half_angle"
    }

    fn dim(&self) -> usize {
        3 * PLACES
    }

    /// Nothing is learned from other materials: a version stands for the hash.
    fn checkpoint(&self) -> &str {
        "half-angle-1"
    }

    fn shared_bytes(&self) -> usize {
        0
    }

    /// The mean logarithm at each place: of plain values a few mirror directions would outweigh all others.
    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let mut sums = [(Rgb::BLACK, 0.0); PLACES];
        for (&at, value) in rus32k().iter().zip(evaluate(target.brdf.as_ref(), rus32k())) {
            if !value.is_finite() {
                return Err(EncodeError::NotFinite { material: target.name.clone() });
            }
            let (sum, count) = &mut sums[place(at).round() as usize];
            *sum += value.map(f32::ln_1p);
            *count += 1.0;
        }
        Ok(self.code(sums.iter().flat_map(|(sum, count)| sum.map(|v| v / f32::max(*count, 1.0)).0).collect()))
    }

    /// `checked` refuses codes of another model, checkpoint or length; the clamp keeps any code finite and not negative.
    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let numbers = code.checked(self.name(), self.checkpoint(), self.dim())?;
        let value = |v: f32| v.clamp(0.0, 80.0).exp_m1();
        Ok(Box::new(Curve(numbers.chunks_exact(3).map(|rgb| Rgb([rgb[0], rgb[1], rgb[2]]).map(value)).collect())))
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    show(std::env::args().nth(1).ok_or("expected the folder to write to")?.as_ref())
}

/// Figures of both on a few materials, and a picture: the materials, the curves, the formula.
fn show(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let ways: [(&str, &dyn Representation); 2] =
        [("half_angle", &HalfAngle), ("lambert_ggx", &Analytic::<GgxLobe>::new())];
    let sphere = Sphere::studio();
    let mut columns = Vec::new();
    for name in ["pink-felt", "gold-paint", "blue-acrylic", "rgl/satin_purple"] {
        let material = builtin::shared().get(name)?.material();
        let mut column = vec![sphere.render(material.brdf.as_ref())];
        for (way, representation) in ways {
            let decoded = representation.decode(&representation.encode(&material)?)?;
            let picture = sphere.render(decoded.as_ref());
            let log_error = LogError.distance(material.brdf.as_ref(), decoded.as_ref());
            let psnr = image_errors(&column[0], &picture, sphere.covered()).psnr;
            println!(
                "{name:16} {way:11} {} numbers: log_error {log_error:.4}, PSNR {psnr:.1} dB",
                representation.dim()
            );
            column.push(picture);
        }
        columns.push(column);
    }
    let (rows, size) = (1 + ways.len(), sphere.size());
    let row = |y: usize| columns.iter().flat_map(move |column| &column[y / size].pixels()[y % size * size..][..size]);
    let pixels = (0..rows * size).flat_map(row).copied().collect();
    Ok(Image::new(columns.len() * size, rows * size, pixels).write_png(&folder.join("add_your_own.png"))?)
}

#[test]
fn it_keeps_what_a_representation_promises() {
    let material = builtin::shared().get("chrome").unwrap().material();
    let code = HalfAngle.encode(&material).unwrap();
    assert_eq!(code, HalfAngle.encode(&material).unwrap());
    assert!(code.code.len() == HalfAngle.dim() && code.code.iter().all(|v| v.is_finite()));
    for value in evaluate(HalfAngle.decode(&code).unwrap().as_ref(), rus32k()) {
        assert!(value.is_finite() && value.min() >= 0.0, "{value:?}");
    }
    let others =
        [Code { model: "other".into(), ..code.clone() }, HalfAngle.code(vec![0.0]), HalfAngle.code(vec![f32::NAN; 48])];
    assert!(others.iter().all(|code| HalfAngle.decode(code).is_err()));
}

#[test]
fn its_picture_is_written() {
    let folder = tempfile::tempdir().unwrap();
    show(folder.path()).unwrap();
    assert!(folder.path().join("add_your_own.png").exists());
}
