use super::*;

/// Distance of two numbers in units of the last place of the exact one.
fn ulps(own: f32, exact: f64) -> f64 {
    let rounded = exact as f32;
    let spacing = f64::from(f32::from_bits(rounded.abs().to_bits() + 1)) - f64::from(rounded.abs());
    (f64::from(own) - exact).abs() / spacing
}

struct Exponential<'a>(&'a mut [Lanes]);

impl WithSimd for Exponential<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for lanes in self.0 {
            for y in lanes.vectors_mut::<S>() {
                *y = exp_minus_one(simd, *y);
            }
        }
    }
}

#[test]
fn exp_minus_one_is_within_two_ulp_and_finite_everywhere() {
    let mut ys: Vec<f32> = (0..200_000).map(|i| -20.0 + i as f32 * 5e-4).collect();
    ys.extend((0..400).flat_map(|i| [1.0, -1.0].map(|sign| sign * 0.9f32.powi(i))));
    ys.resize(ys.len().next_multiple_of(LANES), 0.0);
    for set in InstructionSet::available() {
        let mut lanes: Vec<Lanes> = ys.as_chunks().0.iter().map(|ys| Lanes(*ys)).collect();
        set.run(Exponential(&mut lanes));
        let own = lanes.iter().flat_map(|lanes| lanes.0);
        let errors = ys.iter().zip(own).map(|(&y, own)| (ulps(own, f64::from(y).exp_m1()), y));
        let worst = errors.fold((0.0, 0.0), |worst, error| if error.0 > worst.0 { error } else { worst });
        // Without fused multiply-adds two more roundings add up.
        let allowed = if set.is_vector() { 2.0 } else { 4.0 };
        assert!(worst.0 <= allowed, "{}: {} ulp at y = {}", set.name(), worst.0, worst.1);
        let mut extreme = [Lanes::ZERO];
        extreme[0].0[..6].copy_from_slice(&[1e30, f32::INFINITY, -1e30, f32::NEG_INFINITY, f32::NAN, f32::MAX]);
        set.run(Exponential(&mut extreme));
        assert!(extreme[0].0.iter().all(|v| v.is_finite()), "{}: {:?}", set.name(), extreme[0].0);
    }
}

#[test]
fn logarithms_are_accurate_and_finite_everywhere() {
    let x: Vec<f32> = (0..100_003).map(|i| (-80.0 + i as f32 * 1.6e-3).exp()).chain([0.999, 1.0, 1.001]).collect();
    let mut own = x.clone();
    logarithms(&mut own);
    for (x, own) in x.iter().zip(own) {
        let exact = f64::from(*x).ln();
        assert!((f64::from(own) - exact).abs() <= 1.5e-7 * exact.abs().max(1.0), "ln {x}: {own} {exact}");
    }
    let mut extreme = [0.0, -1.0, f32::MIN_POSITIVE, 1e-45, f32::MAX];
    logarithms(&mut extreme);
    assert!(extreme.iter().all(|v| v.is_finite()), "{extreme:?}");
}

#[test]
fn powers_are_accurate_and_nothing_stays_nothing() {
    let x: Vec<f32> = (0..10_007).map(|i| 1e-6 * 1.0024f32.powi(i)).filter(|x| *x < 1e6).collect();
    let mut own = x.clone();
    powers(&mut own, 1.0 / 2.2);
    for (x, own) in x.iter().zip(own) {
        let exact = f64::from(*x).powf(f64::from(1.0f32 / 2.2));
        assert!((f64::from(own) / exact - 1.0).abs() < 2e-6, "{x}: {own} {exact}");
    }
    let mut none = [0.0, -3.0, f32::NAN, 1.0];
    powers(&mut none, 1.0 / 2.2);
    assert_eq!(none[..3], [0.0; 3]);
    assert!((none[3] - 1.0).abs() < 1e-6);
}

struct Angles<'a>(&'a [[Lanes; 2]], &'a mut [Lanes]);

impl WithSimd for Angles<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for ([y, x], out) in self.0.iter().zip(self.1) {
            for i in 0..LANES / S::F32_LANES {
                out.vectors_mut::<S>()[i] = angle(simd, y.vectors::<S>()[i], x.vectors::<S>()[i]);
            }
        }
    }
}

#[test]
fn angles_are_those_of_atan2() {
    let points: Vec<[Lanes; 2]> = (0..200)
        .map(|block| {
            let at = |lane: usize| (block * LANES + lane) as f32 / (200.0 * LANES as f32) * std::f32::consts::PI;
            [0, 1].map(|axis| {
                Lanes(std::array::from_fn(|lane| {
                    let (sin, cos) = at(lane).sin_cos();
                    (0.1 + lane as f32) * if axis == 0 { sin.abs() } else { cos }
                }))
            })
        })
        .collect();
    let mut own = vec![Lanes::ZERO; points.len()];
    InstructionSet::fastest().run(Angles(&points, &mut own));
    for ([y, x], own) in points.iter().zip(&own) {
        for lane in 0..LANES {
            let exact = y.0[lane].atan2(x.0[lane]);
            assert!((own.0[lane] - exact).abs() < 5e-7, "({}, {}): {} {exact}", x.0[lane], y.0[lane], own.0[lane]);
        }
    }
}
