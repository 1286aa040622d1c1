use super::*;
use crate::brdf::ggx::Ggx;
use crate::library::builtin;
use crate::metric::{Metric, RelativeLog, negative_share};
use crate::sampling::{evaluate, rus32k};
use crate::{Rgb, Split};

/// Every so many of the training materials of the built-in library.
fn training(step: usize) -> Vec<Material> {
    let materials = builtin::shared().materials().into_iter();
    let materials = materials.filter(|m| !m.name.contains('/') && Split::of(&m.name).is_training());
    materials.step_by(step).collect()
}

fn lobes(count: usize) -> Vec<Material> {
    let lobe = |i: usize| {
        let t = i as f32 / (count - 1) as f32;
        let ggx = Ggx { diffuse: Rgb([0.3 * t, 0.2, 0.1]), f0: Rgb([0.9, 0.9 - 0.5 * t, 0.3]), alpha: 0.05 + 0.4 * t };
        Material::new(format!("lobe-{i}"), std::sync::Arc::new(ggx))
    };
    (0..count).map(lobe).collect()
}

#[test]
fn more_components_reproduce_the_training_materials_better() {
    let training = training(1);
    let error = |components: usize| {
        let pca = PcaTables::learn(&training, PcaOptions { components, ..PcaOptions::LOG_45 }).unwrap();
        let one = |material: &Material| {
            let decoded = pca.decode(&pca.encode(material).unwrap()).unwrap();
            RelativeLog.distance(material.brdf.as_ref(), decoded.as_ref())
        };
        training.iter().step_by(9).map(one).sum::<f64>()
    };
    let [few, more] = [32, 45].map(error);
    assert!(more < 0.9 * few, "{few} {more}");
}

#[test]
fn a_code_of_zeros_is_the_median_of_the_training_materials() {
    let training = training(11);
    let pca = PcaTables::learn(&training, PcaOptions { components: 4, ..PcaOptions::RELATIVE_45 }).unwrap();
    let median = pca.decode(&pca.code(vec![0.0; 4])).unwrap();
    let cells: Vec<_> = Grid::Coarse.directions().iter().step_by(1009).filter(|at| at.is_above()).copied().collect();
    let all: Vec<Vec<Rgb>> = training.iter().map(|material| evaluate(material.brdf.as_ref(), &cells)).collect();
    for ((i, at), found) in cells.iter().enumerate().zip(evaluate(median.as_ref(), &cells)) {
        let mut reds: Vec<f32> = all.iter().map(|values| values[i][0]).collect();
        reds.sort_by(f32::total_cmp);
        let expected = 0.5 * (reds[(reds.len() - 1) / 2] + reds[reds.len() / 2]);
        // Read at the middle of a cell, up to rounding of the place: highlights are steep.
        let weight = (at.light.z * at.view.z).max(1e-3);
        assert!(
            (found[0] - expected).abs() * weight < 0.02 * (expected * weight + 1e-3),
            "{at:?}: {} {expected}",
            found[0]
        );
    }
}

#[test]
fn plain_values_become_negative_and_logarithms_hardly() {
    let training = lobes(8);
    let far = |options: PcaOptions| {
        let pca = PcaTables::learn(&training, PcaOptions { components: 3, ..options }).unwrap();
        let codes = [&training[0], &training[7]].map(|material| pca.encode(material).unwrap().code);
        // As far beyond one end as the other end is away.
        let numbers = codes[0].iter().zip(&codes[1]).map(|(a, b)| 2.0 * a - b).collect();
        let decoded = pca.decode(&pca.code(numbers)).unwrap();
        let signed = crate::sampling::evaluate_signed(decoded.as_ref(), rus32k());
        let floor = |at: &crate::Directions| match options.values {
            Values::LogRelative => (at.light.z * at.view.z).max(1e-3),
            _ => at.light.z,
        };
        let lowest = signed.iter().zip(rus32k()).map(|(f, at)| f.min() * floor(at)).fold(f32::INFINITY, f32::min);
        (negative_share(decoded.as_ref()), lowest)
    };
    let (share, lowest) = far(PcaOptions::PLAIN_45);
    assert!(share > 0.1 && lowest < -0.05, "{share} {lowest}");
    for options in [PcaOptions::LOG_45, PcaOptions::RELATIVE_45] {
        let (_, lowest) = far(options);
        assert!(lowest >= -1.1e-3, "{} {lowest}", options.name);
    }
}

#[test]
fn the_grid_of_merl_comes_in_pieces_and_reads_highlights_better() {
    let training = lobes(5);
    let error = |grid: Grid| {
        let options = PcaOptions { name: "pca", components: 4, values: Values::Log, grid };
        let pca = PcaTables::learn(&training, options).unwrap();
        assert_eq!(pca.shared_bytes(), 5 * 4 * grid.numbers());
        let decoded = pca.decode(&pca.encode(&training[0]).unwrap()).unwrap();
        RelativeLog.distance(training[0].brdf.as_ref(), decoded.as_ref())
    };
    let [coarse, merl] = [Grid::Coarse, Grid::Merl].map(error);
    assert!(merl < 0.5 * coarse, "{coarse} {merl}");
}

#[test]
fn codes_of_one_kind_are_not_those_of_another() {
    let training = lobes(4);
    let learned = |options: PcaOptions| {
        PcaTables::learn(&training, PcaOptions { name: "pca", components: 2, ..options }).unwrap()
    };
    let [log, plain] = [PcaOptions::LOG_45, PcaOptions::PLAIN_45].map(learned);
    let code = plain.encode(&training[0]).unwrap();
    assert!(matches!(log.decode(&code).err(), Some(DecodeError::Checkpoint { .. })));
}
