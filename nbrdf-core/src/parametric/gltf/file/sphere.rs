//! A sphere of radius 1 as a glTF file that lacks its material.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::direction::spherical;

/// Steps from pole to pole and around.
const RINGS: u16 = 32;
const AROUND: u16 = 64;
/// WebGL's numbers of what a buffer holds, and of the kinds of its elements.
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

/// One scene, one node, one mesh of the material 0.
pub(super) fn file() -> Value {
    let places: Vec<[f32; 3]> = (0..=RINGS).flat_map(|ring| (0..=AROUND).map(move |step| place(ring, step))).collect();
    let indices: Vec<u16> = (0..RINGS).flat_map(|ring| (0..AROUND).flat_map(move |step| faces(ring, step))).collect();
    let mut bytes: Vec<u8> = bytemuck::cast_slice::<_, f32>(&places).iter().flat_map(|v| v.to_le_bytes()).collect();
    let of_places = bytes.len();
    bytes.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    json!({
        "asset": { "version": "2.0", "generator": concat!("nbrdf ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        // Of a sphere of radius 1, places are normals.
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "NORMAL": 0 }, "indices": 1, "material": 0 }] }],
        "accessors": [
            {
                "bufferView": 0, "componentType": FLOAT, "count": places.len(), "type": "VEC3",
                "min": bound(&places, f32::min), "max": bound(&places, f32::max),
            },
            { "bufferView": 1, "componentType": UNSIGNED_SHORT, "count": indices.len(), "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": of_places, "target": ARRAY_BUFFER },
            {
                "buffer": 0, "byteOffset": of_places, "byteLength": bytes.len() - of_places,
                "target": ELEMENT_ARRAY_BUFFER,
            },
        ],
        "buffers": [{ "byteLength": bytes.len(), "uri": uri }],
    })
}

/// y is up, as in glTF.
fn place(ring: u16, step: u16) -> [f32; 3] {
    let [x, z, y] = spherical(
        std::f32::consts::PI * f32::from(ring) / f32::from(RINGS),
        -std::f32::consts::TAU * f32::from(step % AROUND) / f32::from(AROUND),
    )
    .to_array();
    [x, y, z]
}

/// Two triangles; one at a pole, where the other has no area.
fn faces(ring: u16, step: u16) -> Vec<u16> {
    let corner = |ring: u16, step: u16| ring * (AROUND + 1) + step;
    let [a, b] = [corner(ring, step), corner(ring, step + 1)];
    let [c, d] = [corner(ring + 1, step), corner(ring + 1, step + 1)];
    let (upper, lower) = ([a, c, b], [b, c, d]);
    match ring {
        0 => lower.to_vec(),
        ring if ring + 1 == RINGS => upper.to_vec(),
        _ => [upper, lower].concat(),
    }
}

fn bound(places: &[[f32; 3]], choose: fn(f32, f32) -> f32) -> [f32; 3] {
    [0, 1, 2].map(|axis| places.iter().map(|place| place[axis]).fold(places[0][axis], choose))
}
