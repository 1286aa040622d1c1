//! What holds for every formula.

use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use crate::brdf::abc::Abc;
use crate::brdf::free_fresnel::{Facets, FreeFresnel};
use crate::brdf::lambert::Lambert;
use crate::brdf::sgd::{Sgd, Shadowing, ShiftedGamma};
use crate::brdf::ward::Ward;
use crate::library::builtin;
use crate::metric::{LogError, Metric};
use crate::sampling::{evaluate, rus32k};
use crate::{Directions, Rgb};

fn all() -> [Box<dyn Representation>; 6] {
    [
        Box::new(Analytic::<LambertAlone>::new()),
        Box::new(Analytic::<WardLobe>::new()),
        Box::new(Analytic::<BlinnPhongLobe>::new()),
        Box::new(Analytic::<AbcLobe>::new()),
        Box::new(Analytic::<GgxLobe>::new()),
        Box::new(Analytic::<SgdLobes>::new()),
    ]
}

fn error(representation: &dyn Representation, target: &Material) -> f64 {
    let decoded = representation.decode(&representation.encode(target).unwrap()).unwrap();
    LogError.distance(target.brdf.as_ref(), decoded.as_ref())
}

#[test]
fn a_material_of_the_formula_is_found_again() {
    let (diffuse, f0, f90) = (Rgb([0.3, 0.1, 0.02]), Rgb([0.04, 0.05, 0.06]), Rgb([0.5, 0.8, 1.0]));
    let shadowing = Shadowing { lambda: 3.0, reach: 1.2, k: 12.0, theta0: 0.3 };
    let sharp = ShiftedGamma { diffuse: 0.2, specular: 8.0, alpha: 0.01, p: 0.5, f0: 0.1, f1: 0.02, shadowing };
    let soft = ShiftedGamma { specular: 0.5, alpha: 0.2, ..sharp };
    let materials: [Arc<dyn Brdf>; 6] = [
        Arc::new(Lambert { albedo: diffuse }),
        Arc::new(Ward { diffuse, specular: f0, alpha: 0.08 }),
        Arc::new(FreeFresnel { diffuse, f0, f90, alpha: 0.2, facets: Facets::BlinnPhong }),
        Arc::new(Abc { diffuse, a: Rgb([30.0, 20.0, 10.0]), b: 3e3, c: 1.5, ior: 1.7 }),
        Arc::new(FreeFresnel { diffuse, f0, f90, alpha: 0.03, facets: Facets::Ggx }),
        Arc::new(Sgd { channels: [sharp, sharp, soft] }),
    ];
    for (representation, brdf) in all().iter().zip(materials) {
        let error = error(representation.as_ref(), &Material::new("known", brdf));
        assert!(error < 5e-4, "{}: {error}", representation.name());
    }
}

#[test]
fn a_lobe_over_the_base_never_fits_worse_than_the_base_alone() {
    for name in ["chrome", "blue-fabric", "gold-paint"] {
        let material = builtin::shared().get(name).unwrap().material();
        let errors = all().map(|representation| error(representation.as_ref(), &material));
        println!("{name}: lambert, ward, blinn_phong, abc, ggx, sgd {errors:.4?}");
        assert!(errors[1..].iter().all(|error| *error < errors[0]), "{name}: {errors:?}");
        assert!(errors[5] < errors[4], "{name}: thirty numbers fit no worse than ten: {errors:?}");
    }
}

#[test]
fn a_black_material_has_a_code_and_one_that_is_not_finite_has_none() {
    struct Constant(f32);
    impl Brdf for Constant {
        fn eval(&self, _: Directions) -> Rgb {
            Rgb::splat(self.0)
        }
    }
    for representation in all() {
        let material = |value| Material::new("constant", Arc::new(Constant(value)));
        assert!(error(representation.as_ref(), &material(0.0)) < 1e-3, "{}", representation.name());
        let refused = representation.encode(&material(f32::NAN));
        assert!(matches!(refused, Err(EncodeError::NotFinite { .. })), "{}", representation.name());
        assert!(representation.encode(&material(f32::MAX)).is_ok(), "{}", representation.name());
    }
}

#[test]
fn samples_of_a_formula_find_it_again_and_no_samples_find_nothing() {
    let sampled: Vec<Directions> = rus32k().iter().step_by(41).copied().collect();
    let ggx = FreeFresnel {
        diffuse: Rgb([0.3, 0.1, 0.02]),
        f0: Rgb::splat(0.05),
        f90: Rgb::splat(0.8),
        alpha: 0.3,
        facets: Facets::Ggx,
    };
    let list = SampleList { values: evaluate(&ggx, &sampled), at: sampled, below: 0 };
    let found = Analytic::<GgxLobe>::fit_list(&list).unwrap();
    let error = LogError.distance(&ggx, found.as_ref());
    assert!(error < 1e-3, "{error}");
    assert!(Analytic::<GgxLobe>::fit_list(&SampleList::default()).is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_finite_code_is_a_reflectance(numbers in prop::collection::vec(-60.0..60.0_f32, 30), scale in 0..4_i32) {
        let at: Vec<Directions> = rus32k().iter().step_by(211).copied().collect();
        let grazing = Directions::from_angles(1.5705, 0.0, 1.5705, std::f32::consts::PI);
        let at: Vec<Directions> = at.into_iter().chain([grazing]).collect();
        for representation in all() {
            let numbers = numbers[..representation.dim()].iter().map(|v| v * 10_f32.powi(scale * 9 - 9)).collect();
            let decoded = representation.decode(&representation.code(numbers)).unwrap();
            for f in evaluate(decoded.as_ref(), &at) {
                prop_assert!(f.is_finite() && f.min() >= 0.0, "{}: {f:?}", representation.name());
            }
        }
    }
}
