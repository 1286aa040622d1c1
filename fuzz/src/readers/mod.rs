//! Every reader as a function of bytes: it reads them, and where they are valid, uses what was read. Each says whether
//! they were. Fuzz targets call them, and so do the tests of the workspace.

mod code;
mod exports;
mod measured;
mod networks;
mod pictures;
mod scenes;
mod tensors;

pub use code::{chart_report, code, stress_report};
pub use exports::{shading_model, source_code};
pub use measured::{csv, goniometer, merl, rgl};
pub use networks::{archive, keras, library, network_safetensors, npy, npz};
pub use pictures::{exr, hdr};
pub use scenes::{gltf, obj, scene};
pub use tensors::{basis, checkpoint};

use nbrdf_core::{Brdf, Directions};

/// A reader by its name, which is also that of its fuzz target and of the folder of its seeds.
pub type Reader = (&'static str, fn(&[u8]) -> bool);

/// All of them.
pub const ALL: [Reader; 22] = [
    ("archive", archive),
    ("basis", basis),
    ("chart_report", chart_report),
    ("checkpoint", checkpoint),
    ("code", code),
    ("csv", csv),
    ("exr", exr),
    ("gltf", gltf),
    ("goniometer", goniometer),
    ("hdr", hdr),
    ("keras", keras),
    ("library", library),
    ("merl", merl),
    ("network_safetensors", network_safetensors),
    ("npy", npy),
    ("npz", npz),
    ("obj", obj),
    ("rgl", rgl),
    ("scene", scene),
    ("shading_model", shading_model),
    ("source_code", source_code),
    ("stress_report", stress_report),
];

/// Nothing that is read may reflect NaN, infinity, or less than nothing.
fn assert_reflects(brdf: &dyn Brdf) {
    let places = [(0.0, 0.0, 0.0, 0.0), (0.3, 1.0, 0.5, -2.0), (1.2, 3.0, 1.2, 0.1), (1.57, 0.0, 1.57, 3.1)];
    for (theta_i, phi_i, theta_o, phi_o) in places {
        let f = brdf.eval(Directions::from_angles(theta_i, phi_i, theta_o, phi_o));
        assert!(f.is_finite() && f.min() >= 0.0, "{f:?} at {:?}", (theta_i, phi_i, theta_o, phi_o));
    }
}

/// The first part of the bytes, as long as its first four bytes say, and the rest.
fn split(bytes: &[u8]) -> (&[u8], &[u8]) {
    let Some((length, rest)) = bytes.split_first_chunk() else { return (&[], &[]) };
    rest.split_at((u32::from_le_bytes(*length) as usize).min(rest.len()))
}
