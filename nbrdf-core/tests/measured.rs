//! Measured files: MERL tables against numbers made by NumPy, RGL tables against the published networks, goniometer data.

use std::path::{Path, PathBuf};

use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::table::{CELLS, Lookup};
use nbrdf_core::measured::Measured;
use nbrdf_core::merl::{FILE_BYTES, Merl, MerlError};
use nbrdf_core::rgl::{RglError, RglTable};
use nbrdf_core::sample_list::{SampleList, SampleListError};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Directions, Library, Rgb, Vec3, data};
use serde_json::Value;

/// The file that `scripts/make_golden.py merl` reads its answers from: number k of the planes together is
/// ((7919 k) mod 10007) / 7, every 11th one −1.
fn formula() -> Vec<u8> {
    let count = 3 * CELLS.iter().product::<usize>() as u64;
    let number = |k: u64| if k.is_multiple_of(11) { -1.0 } else { (7919 * k % 10007) as f64 / 7.0 };
    let header = CELLS.into_iter().flat_map(|cells| (cells as i32).to_le_bytes());
    header.chain((0..count).flat_map(|k| number(k).to_le_bytes())).collect()
}

#[test]
fn nearest_cells_are_those_of_the_databases_own_reader_and_bytes_come_back() {
    let bytes = formula();
    let merl = Merl::parse(&bytes).unwrap();
    assert_eq!(merl.to_bytes(), bytes);
    let table = merl.table(Lookup::Nearest);
    let golden = golden("merl.json");
    let rows = golden["rows"].as_array().unwrap();
    assert!(rows.len() > 150);
    for row in rows {
        let at = Directions::new(vector(&row["light"]), vector(&row["view"]));
        let (found, wanted) = (table.eval(at), three(&row["f"]));
        for channel in 0..3 {
            let (found, wanted) = (f64::from(found[channel]), wanted[channel]);
            assert!((found - wanted).abs() < 1e-5 * (wanted + 1.0), "{at:?}: {found} {row}");
        }
    }
}

fn golden(name: &str) -> Value {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden").join(name);
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn three(row: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| row[i].as_f64().unwrap())
}

fn vector(row: &Value) -> Vec3 {
    let [x, y, z] = three(row).map(|v| v as f32);
    Vec3::new(x, y, z)
}

#[test]
fn what_is_tabulated_is_read_back() {
    let smooth = Ggx { diffuse: Rgb([0.3, 0.2, 0.1]), f0: Rgb([0.04, 0.5, 0.9]), alpha: 0.4 };
    let merl = Merl::tabulate(&smooth);
    let again = Merl::parse(&merl.to_bytes()).unwrap();
    assert_eq!(again, merl);
    let table = again.table(Lookup::Trilinear);
    assert_eq!(table.measured_share(), 1.0);
    for &at in rus32k().iter().filter(|at| at.light.z > 0.2 && at.view.z > 0.2).step_by(5) {
        let relative = smooth.eval(at).zip(table.eval(at), |a, b| (a - b).abs() / a).max();
        assert!(relative < 0.01, "{at:?}: {relative}");
    }
}

#[test]
fn what_is_no_merl_table_is_refused_with_the_reason() {
    let whole = formula();
    let with = |at: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        Merl::parse(&changed).unwrap_err().to_string()
    };
    let cells = |cells: [i32; 3]| with(0, &cells.map(i32::to_le_bytes).concat());
    // The right product, and sizes that no memory holds.
    assert!(cells([180, 90, 90]).contains("found 180 x 90 x 90"));
    assert!(cells([90, 90, 360]).contains("keep the first 180"));
    assert!(cells([i32::MAX; 3]).contains("90 x 90 x 180"));
    assert!(with(12 + 8 * 7, &1e300f64.to_le_bytes()).contains("byte 68"));
    let said = with(12 + 8 * 1000, &f64::NAN.to_le_bytes());
    assert!(said.contains("byte 8012") && said.contains("NaN"), "{said}");
    for length in [0, 11, 12, FILE_BYTES - 1] {
        assert!(matches!(Merl::parse(&whole[..length]), Err(MerlError::Length { found }) if found == length as u64));
    }
    let mut long = whole.clone();
    long.push(0);
    assert!(matches!(Merl::parse(&long), Err(MerlError::Length { .. })));
    let mut dark = whole[..12].to_vec();
    dark.extend((12..FILE_BYTES).step_by(8).flat_map(|_| (-1.0f64).to_le_bytes()));
    assert!(matches!(Merl::parse(&dark), Err(MerlError::Empty)));
}

const RGL: [&str; 4] = ["cc_ibiza_sunset", "cg_sunflower", "colodur_napoli_4f", "paper_white"];

#[test]
fn rgl_tables_are_read_as_mitsuba_reads_them() {
    let golden = golden("rgl.json");
    for name in RGL {
        let Some(file) = data::published_or_skip(&format!("rgl_measured/{name}_rgb.bsdf")) else { return };
        let table = RglTable::load(&file).unwrap();
        assert_eq!(golden["f"][name].as_array().unwrap().len(), 24);
        for (i, wanted) in golden["f"][name].as_array().unwrap().iter().enumerate() {
            let at = Directions::new(vector(&golden["light"][i]), vector(&golden["view"][i]));
            let (found, wanted) = (table.eval(at), three(wanted));
            for channel in 0..3 {
                let (found, wanted) = (f64::from(found[channel]), wanted[channel]);
                assert!((found - wanted).abs() < 2e-3 * wanted + 1e-4, "{name} at {at:?}: {found}, {wanted}");
            }
        }
    }
}

#[test]
fn a_table_that_changes_when_it_is_turned_is_read_as_mitsuba_reads_it() {
    let golden = golden("rgl.json");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/brushed.bsdf");
    let table = RglTable::load(&file).unwrap();
    assert!(!table.is_isotropic());
    assert!(matches!(Measured::load(&file).unwrap(), Measured::Turning(_)));
    for (i, wanted) in golden["f"]["brushed"].as_array().unwrap().iter().enumerate() {
        let at = Directions::new(vector(&golden["light"][i]), vector(&golden["view"][i]));
        let (found, wanted) = (table.eval(at), three(wanted));
        for channel in 0..3 {
            let (found, wanted) = (f64::from(found[channel]), wanted[channel]);
            assert!((found - wanted).abs() < 2e-3 * wanted + 1e-5, "{at:?}: {found}, {wanted}");
        }
    }
}

/// Where a material is darker than this, a fit of ln(1 + f c) sees nothing of it.
const SEEN: f32 = 0.01;

#[test]
fn rgl_tables_agree_with_the_published_networks() {
    let Some(networks) = data::published_or_skip("rgl_nbrdf_subset.zip") else { return };
    let networks = Library::load(&networks).unwrap();
    for name in RGL {
        let Some(file) = data::published_or_skip(&format!("rgl_measured/{name}_rgb.bsdf")) else { return };
        let Measured::Everywhere(table) = Measured::load(&file).unwrap() else { panic!("{name} is a table") };
        let network = &networks.get(&format!("rgl/{name}")).unwrap().network;
        let at: Vec<Directions> = rus32k().iter().filter(|at| at.light.z > 0.2 && at.view.z > 0.2).copied().collect();
        let pairs = evaluate(table.as_ref(), &at).into_iter().zip(evaluate(network, &at));
        let seen = pairs.flat_map(|(a, b)| (0..3).map(move |c| (a[c], b[c]))).filter(|(a, _)| *a > SEEN);
        let mut ratios: Vec<f32> = seen.map(|(a, b)| b / a).collect();
        ratios.sort_by(f32::total_cmp);
        let [low, median, high] = [0.1, 0.5, 0.9].map(|share| ratios[(share * ratios.len() as f32) as usize]);
        println!("{name}: network over table, median {median:.3}, from {low:.3} to {high:.3} (10 to 90 %)");
        assert!((median - 1.0).abs() < 0.02, "{name}: {median}");
    }
}

#[test]
fn what_is_no_rgl_material_is_refused_and_never_panics() {
    let Some(file) = data::published_or_skip("rgl_measured/paper_white_rgb.bsdf") else { return };
    let whole = std::fs::read(file).unwrap();
    assert!(RglTable::parse(&whole).is_ok_and(|table| table.is_isotropic()));
    for length in [0, 11, 14, 18, 40, 400, 5000, whole.len() / 2, whole.len() - 1] {
        assert!(matches!(RglTable::parse(&whole[..length]), Err(RglError::Tensors(_))), "{length}");
    }
    // Every byte of the headers, turned over.
    for byte in 0..420 {
        let mut damaged = whole.clone();
        damaged[byte] ^= 0xff;
        let _ = RglTable::parse(&damaged);
    }
}

#[test]
fn goniometer_data_are_read_as_colours() {
    for (name, strongest) in [("krylon_blue", 2), ("garnet_red", 0)] {
        let Some(file) = data::published_or_skip(&format!("cornell_measured/{name}.brdf")) else { return };
        let list = SampleList::load(&file).unwrap();
        assert!(list.len() > 1400 && list.below < 20, "{} {}", list.len(), list.below);
        let sum = list.values.iter().fold([0.0f32; 3], |sum, f| [0, 1, 2].map(|c| sum[c] + f[c]));
        assert!((0..3).all(|c| sum[c] <= sum[strongest]), "{name}: {sum:?}");
    }
}

#[test]
fn damaged_lists_are_refused_with_the_line() {
    let gonio = "# a\n2\n500 600\n0.1 0 0.2 1 0.3 0.4\n";
    assert_eq!(SampleList::of_goniometer(gonio).unwrap().len(), 1);
    let csv = "light_x,light_y,light_z,view_x,view_y,view_z,r,g,b\n0,0,1,0.6,0,0.8,0.1,0.2,0.3\n";
    assert_eq!(SampleList::of_csv(csv).unwrap().values, [Rgb([0.1, 0.2, 0.3])]);
    let gonio_of = |text: &str| SampleList::of_goniometer(text);
    let csv_of = |text: &str| SampleList::of_csv(text);
    let cases: [(Result<SampleList, SampleListError>, &str); 10] = [
        (gonio_of(""), "number of wavelengths"),
        (gonio_of("99999999999\n"), "line 1"),
        (gonio_of("2\n600 500\n"), "rise"),
        (gonio_of(&gonio.replace("0.1 0 ", "30 0 ")), "degrees"),
        (gonio_of(&gonio.replace("0.3", "nan")), "line 4"),
        (gonio_of(&gonio.replace(" 0.4", "")), "2 reflectances"),
        (csv_of("a,b\n"), "heading"),
        (csv_of(&csv.replace("0.6", "6")), "unit vectors"),
        (csv_of(&csv.replace("0.1", "-0.1")), "0 and more"),
        (csv_of(&csv.replace("0,0,1", "0,0,-1")), "found none"),
    ];
    for (found, says) in cases {
        let error = found.unwrap_err().to_string();
        assert!(error.contains(says), "{says}: {error}");
    }
}
