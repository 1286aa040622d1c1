//! Meshes in glTF 2.0 files (`.gltf` and `.glb`): positions, normals where there are some, indices, places of nodes.
//!
//! Every primitive of every node of the scene becomes part of one mesh. Colours, skins and morph targets are left out.

mod buffers;

use std::path::Path;

use glam::{DMat3, DMat4, DVec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Semantic};

use self::buffers::{Beside, Buffers};
use super::mesh::{Mesh, Triangle};
use super::obj::{LARGEST, MAX_BYTES, MAX_TRIANGLES, area, around, whole};
use super::{SceneError, SceneProblem};
use crate::bounded;

/// Nodes that are visited at most: they may be shared, and lead around in a circle.
const MAX_NODES: usize = 1 << 16;
/// Primitives that are visited at most, over all nodes: these may share a mesh, and it may be without triangles.
const MAX_PRIMITIVES: usize = 1 << 18;
/// Places, normals and indices that are read at most, over all nodes.
const MAX_CORNERS: usize = 9 * MAX_TRIANGLES;

/// Reads a file and the buffers beside it.
pub(super) fn load(path: &Path) -> Result<Mesh, SceneError> {
    let of = |problem: SceneProblem| problem.of(path);
    let bytes = bounded::read(path, MAX_BYTES).map_err(|error| of(error.into()))?;
    let bytes = bytes.ok_or_else(|| of(SceneProblem::mesh(format!("at most {MAX_BYTES} bytes"), "more")))?;
    parse(&bytes, Beside::Folder(path.parent().unwrap_or_else(|| Path::new("")))).map_err(of)
}

impl Mesh {
    /// Everything in a glTF file, as text or binary, whose buffers are in it.
    ///
    /// # Errors
    /// [`SceneProblem::Mesh`]: no glTF, no triangles, too many, buffers elsewhere, or accessors that lead beyond them.
    pub fn of_gltf(bytes: &[u8]) -> Result<Self, SceneProblem> {
        parse(bytes, Beside::Nothing)
    }
}

fn parse(bytes: &[u8], beside: Beside) -> Result<Mesh, SceneProblem> {
    let length = bytes.get(8..12).and_then(|length| Some(u32::from_le_bytes(length.try_into().ok()?)));
    if bytes.starts_with(b"glTF") && length.is_none_or(|length| length < 12) {
        return Err(SceneProblem::mesh("a binary glTF file with its length", format!("{length:?}")));
    }
    let Gltf { document, blob } =
        Gltf::from_slice(bytes).map_err(|error| SceneProblem::mesh("a glTF 2.0 file", error))?;
    let buffers = Buffers::read(&document, blob, beside)?;
    let mut reading = Reading { buffers, primitives: 0, corners: 0, triangles: Vec::new() };
    for (node, to_world) in placed(&document)? {
        for primitive in node.mesh().into_iter().flat_map(|mesh| mesh.primitives()) {
            reading.add(&primitive, to_world)?;
        }
    }
    whole(reading.triangles)
}

/// All nodes of the scene, and where they are.
fn placed(document: &Document) -> Result<Vec<(Node<'_>, DMat4)>, SceneProblem> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or_else(|| SceneProblem::mesh("a scene with nodes", "none"))?;
    let mut waiting: Vec<_> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    let mut found = Vec::new();
    while let Some((node, parent)) = waiting.pop() {
        let own = node.transform().matrix().map(|column| column.map(f64::from));
        let to_world = parent * DMat4::from_cols_array_2d(&own);
        waiting.extend(node.children().map(|child| (child, to_world)));
        found.push((node, to_world));
        if found.len() + waiting.len() > MAX_NODES {
            return Err(SceneProblem::mesh(format!("at most {MAX_NODES} nodes, none within itself"), "more"));
        }
    }
    Ok(found)
}

/// What was read so far.
struct Reading {
    buffers: Buffers,
    primitives: usize,
    corners: usize,
    triangles: Vec<Triangle>,
}

impl Reading {
    fn add(&mut self, primitive: &Primitive, to_world: DMat4) -> Result<(), SceneProblem> {
        self.primitives += 1;
        if self.primitives > MAX_PRIMITIVES {
            return Err(SceneProblem::mesh(format!("at most {MAX_PRIMITIVES} primitives in all nodes"), "more"));
        }
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(());
        }
        let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        self.count(accessor.count())?;
        let kind = (DataType::F32, Dimensions::Vec3);
        let positions: Vec<DVec3> = self.buffers.elements(&accessor, &[kind])?.map(vector).collect();
        let positions: Vec<DVec3> = positions.into_iter().map(|place| to_world.transform_point3(place)).collect();
        if positions.iter().any(|place| !place.is_finite() || place.abs().max_element() > LARGEST) {
            return Err(SceneProblem::mesh(format!("places within {LARGEST:e}"), "others"));
        }
        let indices: Vec<u32> = match primitive.indices() {
            Some(accessor) => {
                self.count(accessor.count())?;
                let kinds = [DataType::U8, DataType::U16, DataType::U32].map(|kind| (kind, Dimensions::Scalar));
                self.buffers.elements(&accessor, &kinds)?.map(index).collect()
            }
            None => (0..u32::try_from(positions.len()).unwrap_or(u32::MAX)).collect(),
        };
        let faces = faces(&indices, mode);
        if self.triangles.len() + faces.len() > MAX_TRIANGLES {
            return Err(too_many());
        }
        let nowhere = || SceneProblem::mesh("indices of the primitive's corners", "others");
        let normals = match primitive.get(&Semantic::Normals) {
            Some(accessor) => {
                self.count(accessor.count())?;
                // Normals stay across faces, whatever is done to these.
                let turn = DMat3::from_mat4(to_world).inverse().transpose();
                self.buffers.elements(&accessor, &[kind])?.map(|bytes| turn * vector(bytes)).collect()
            }
            None => around(&positions, faces.as_flattened()).ok_or_else(nowhere)?,
        };
        for face in faces {
            let corners = face.map(|i| Some((*positions.get(i as usize)?, *normals.get(i as usize)?)));
            let [Some(a), Some(b), Some(c)] = corners else { return Err(nowhere()) };
            let corners = [a.0, b.0, c.0];
            let own = area(&corners).normalize_or(DVec3::Y);
            self.triangles.push(Triangle { corners, normals: [a.1, b.1, c.1].map(|normal| normal.normalize_or(own)) });
        }
        Ok(())
    }

    /// Refuses too much, before it is read.
    fn count(&mut self, more: usize) -> Result<(), SceneProblem> {
        self.corners = self.corners.saturating_add(more);
        if self.corners > MAX_CORNERS {
            return Err(too_many());
        }
        Ok(())
    }
}

fn too_many() -> SceneProblem {
    SceneProblem::mesh(format!("at most {MAX_TRIANGLES} triangles"), "more")
}

/// Corners of each triangle.
fn faces(indices: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let turned =
                |(place, w): (usize, &[u32])| if place % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
            indices.windows(3).enumerate().map(turned).collect()
        }
        Mode::TriangleFan => {
            let Some((first, rest)) = indices.split_first() else { return Vec::new() };
            rest.windows(2).map(|w| [*first, w[0], w[1]]).collect()
        }
        _ => indices.as_chunks().0.to_vec(),
    }
}

/// Of three numbers.
fn vector(bytes: &[u8]) -> DVec3 {
    let mut numbers = bytes.as_chunks().0.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes)));
    let mut next = || numbers.next().unwrap_or(f64::NAN);
    DVec3::new(next(), next(), next())
}

/// Of one, two or four bytes.
fn index(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |index, byte| index << 8 | u32::from(*byte))
}

#[cfg(test)]
mod tests;
