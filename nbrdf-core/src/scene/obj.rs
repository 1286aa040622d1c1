//! Meshes in Wavefront OBJ files: positions, faces, and normals where there are some.

use std::io::BufReader;
use std::path::Path;

use glam::DVec3;
use tobj::{LoadError, LoadOptions};

use super::mesh::{Mesh, Triangle};
use super::{SceneError, SceneProblem};
use crate::bounded;

/// Largest file \[bytes\].
const MAX_BYTES: u64 = 256 << 20;
/// Most triangles.
const MAX_TRIANGLES: usize = 4 << 20;
/// Largest coordinate: beyond, areas and volumes leave f64.
const LARGEST: f64 = 1e9;

/// Reads all objects of a file as one mesh, scaled and moved. Corners without normals get the mean of those of the
/// faces around them.
pub(super) fn load(path: &Path, scale: f64, at: DVec3) -> Result<Mesh, SceneError> {
    let of = |problem: SceneProblem| problem.of(path);
    let bytes = bounded::read(path, MAX_BYTES).map_err(|error| of(error.into()))?;
    let bytes = bytes.ok_or_else(|| of(SceneProblem::mesh("at most 256 MB", "a longer file")))?;
    let options = LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..LoadOptions::default() };
    // Colours and textures mean nothing here: the material is named by the scene.
    let no_materials = |_: &Path| Err(LoadError::GenericFailure);
    let (models, _) = tobj::load_obj_buf(&mut BufReader::new(&bytes[..]), &options, no_materials)
        .map_err(|error| of(SceneProblem::mesh("an OBJ file", error)))?;
    let count: usize = models.iter().map(|model| model.mesh.indices.len() / 3).sum();
    if count == 0 || count > MAX_TRIANGLES {
        return Err(of(SceneProblem::mesh(format!("1 to {MAX_TRIANGLES} triangles"), count)));
    }
    let mut triangles = Vec::with_capacity(count);
    for model in &models {
        triangles.extend(placed(&model.mesh, scale, at).ok_or_else(|| {
            of(SceneProblem::mesh(format!("corners within {LARGEST:e}, with as many normals"), "others"))
        })?);
    }
    // What has no area is never hit.
    triangles.retain(|triangle| area(&triangle.corners).length_squared() > 0.0);
    match triangles.is_empty() {
        true => Err(of(SceneProblem::mesh("triangles with an area", "none"))),
        false => Ok(Mesh::new(triangles)),
    }
}

/// The triangles; none where a number is out of range or an index leads nowhere.
fn placed(mesh: &tobj::Mesh, scale: f64, at: DVec3) -> Option<Vec<Triangle>> {
    let vectors = |flat: &[f32]| -> Vec<DVec3> {
        flat.chunks_exact(3).map(|v| DVec3::new(v[0].into(), v[1].into(), v[2].into())).collect()
    };
    let positions: Vec<DVec3> = vectors(&mesh.positions).into_iter().map(|v| v * scale + at).collect();
    if positions.iter().any(|v| !v.is_finite() || v.abs().max_element() > LARGEST) {
        return None;
    }
    let given = vectors(&mesh.normals);
    let around = if mesh.normal_indices.is_empty() { around(&positions, &mesh.indices)? } else { Vec::new() };
    let triangle = |face: usize| {
        let corner = |i: usize| {
            let position = mesh.indices[3 * face + i] as usize;
            let normal = match mesh.normal_indices.get(3 * face + i) {
                Some(&normal) => *given.get(normal as usize)?,
                None => *around.get(position)?,
            };
            Some((*positions.get(position)?, normal))
        };
        let [a, b, c] = [corner(0)?, corner(1)?, corner(2)?];
        let corners = [a.0, b.0, c.0];
        let own = area(&corners).normalize_or(DVec3::Y);
        Some(Triangle { corners, normals: [a.1, b.1, c.1].map(|normal| normal.normalize_or(own)) })
    };
    (0..mesh.indices.len() / 3).map(triangle).collect()
}

/// Of every position the sum of the normals of its faces, by area.
fn around(positions: &[DVec3], indices: &[u32]) -> Option<Vec<DVec3>> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for face in indices.chunks_exact(3) {
        let corner = |i: usize| positions.get(face[i] as usize).copied();
        let own = area(&[corner(0)?, corner(1)?, corner(2)?]);
        face.iter().for_each(|&i| sums[i as usize] += own);
    }
    Some(sums)
}

/// Normal, as long as twice the area.
fn area([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a)
}
