//! Meshes in Wavefront OBJ files: positions, faces, and normals where there are some.

use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use tobj::{LoadError, LoadOptions};

use super::mesh::{Mesh, Triangle};
use super::{SceneError, SceneProblem};
use crate::bounded;

/// Largest file \[bytes\].
pub(super) const MAX_BYTES: u64 = 128 << 20;
/// Most triangles of a scene.
pub(super) const MAX_TRIANGLES: usize = 1 << 20;
/// Largest coordinate.
pub(super) const LARGEST: f64 = 1e9;

/// The meshes of a scene, each read once.
#[derive(Default)]
pub(super) struct Meshes {
    known: Vec<(PathBuf, f64, DVec3, Arc<Mesh>)>,
    triangles: usize,
}

impl Meshes {
    /// Reads all objects of a file as one mesh, scaled and moved. Corners have the file's normals where all of them have
    /// one, else the mean of those of the faces around them, by area.
    pub fn load(&mut self, path: &Path, scale: f64, at: DVec3) -> Result<Arc<Mesh>, SceneError> {
        let of = |problem: SceneProblem| problem.of(path);
        let real = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let same = |known: &&(PathBuf, f64, DVec3, Arc<Mesh>)| known.0 == real && known.1 == scale && known.2 == at;
        if let Some((.., mesh)) = self.known.iter().find(same) {
            return Ok(Arc::clone(mesh));
        }
        let bytes = bounded::read(path, MAX_BYTES).map_err(|error| of(error.into()))?;
        let bytes = bytes.ok_or_else(|| of(SceneProblem::mesh(format!("at most {MAX_BYTES} bytes"), "more")))?;
        let lines = surface(&bytes);
        let faces = lines.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"f ")).count();
        self.triangles += faces;
        if faces == 0 || self.triangles > MAX_TRIANGLES {
            let most = format!("1 to {MAX_TRIANGLES} faces in a scene");
            return Err(of(SceneProblem::mesh(most, self.triangles)));
        }
        let mesh = Arc::new(parse(&lines, scale, at).map_err(of)?);
        self.triangles += mesh.len().saturating_sub(faces);
        self.known.push((real, scale, at, Arc::clone(&mesh)));
        Ok(mesh)
    }
}

impl Mesh {
    /// All objects in the text of an OBJ file as one mesh.
    ///
    /// # Errors
    /// [`SceneProblem::Mesh`]: no OBJ, no faces, too many, or corners that lead nowhere.
    pub fn of_obj(bytes: &[u8]) -> Result<Self, SceneProblem> {
        parse(&surface(bytes), 1.0, DVec3::ZERO)
    }
}

/// The lines that tell a surface: the rest (groups, textures, colours) would split it. Normals are left out where a face
/// has none: the reader would make some up.
fn surface(bytes: &[u8]) -> Vec<u8> {
    let lines = || bytes.split(|byte| *byte == b'\n').map(words);
    let are_whole =
        lines().filter(|(kind, _)| *kind == b"f").all(|(_, mut corners)| corners.all(|c| !normal(c).is_empty()));
    let mut kept = Vec::new();
    for (kind, words) in lines() {
        if !(kind == b"f" || kind == b"v" || (are_whole && kind == b"vn")) {
            continue;
        }
        kept.extend(kind);
        for word in words {
            kept.push(b' ');
            match (kind == b"f", are_whole) {
                (true, true) => kept.extend([position(word), b"//", normal(word)].concat()),
                (true, false) => kept.extend(position(word)),
                _ => kept.extend(word),
            }
        }
        kept.push(b'\n');
    }
    kept
}

/// A line's first word, and the others.
fn words(line: &[u8]) -> (&[u8], impl Iterator<Item = &[u8]>) {
    let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    (words.next().unwrap_or_default(), words)
}

/// Of a corner `position/texture/normal`, of which all but the first may be left out.
fn position(corner: &[u8]) -> &[u8] {
    corner.split(|byte| *byte == b'/').next().unwrap_or_default()
}

fn normal(corner: &[u8]) -> &[u8] {
    corner.split(|byte| *byte == b'/').nth(2).unwrap_or_default()
}

/// Refuses corners that lead before the first vertex or normal, or beyond all: the reader's products of indices would wrap,
/// and a wrapped one may lead to another place.
fn check_corners(lines: &[u8]) -> Result<(), SceneProblem> {
    let (mut positions, mut normals) = (0, 0);
    for (kind, corners) in lines.split(|byte| *byte == b'\n').map(words) {
        match kind {
            b"v" => positions += 1,
            b"vn" => normals += 1,
            _ => {}
        }
        for corner in corners.filter(|_| kind == b"f") {
            let leads_nowhere = |index: &[u8], count: i64| {
                // What is no number, the reader refuses itself.
                let index = std::str::from_utf8(index).ok().and_then(|index| index.parse::<i64>().ok());
                index.is_some_and(|index| index == 0 || index < -count || index > MAX_BYTES as i64)
            };
            if leads_nowhere(position(corner), positions) || leads_nowhere(normal(corner), normals) {
                let found = format!("'{}'", String::from_utf8_lossy(corner));
                return Err(SceneProblem::mesh("corners that lead to places and normals of the file", found));
            }
        }
    }
    Ok(())
}

fn parse(lines: &[u8], scale: f64, at: DVec3) -> Result<Mesh, SceneProblem> {
    check_corners(lines)?;
    let options = LoadOptions { triangulate: true, ignore_points: true, ignore_lines: true, ..LoadOptions::default() };
    let no_materials = |_: &Path| Err(LoadError::GenericFailure);
    let (models, _) = tobj::load_obj_buf(&mut BufReader::new(lines), &options, no_materials)
        .map_err(|error| SceneProblem::mesh("an OBJ file", error))?;
    let mut triangles = Vec::new();
    for model in &models {
        triangles.extend(placed(&model.mesh, scale, at).ok_or_else(|| {
            SceneProblem::mesh(format!("corners within {LARGEST:e}, with as many normals"), "others")
        })?);
    }
    whole(triangles)
}

/// The mesh of those triangles that have an area.
pub(super) fn whole(mut triangles: Vec<Triangle>) -> Result<Mesh, SceneProblem> {
    // What has no area is never hit.
    triangles.retain(|triangle| area(&triangle.corners).length_squared() > 0.0);
    match triangles.len() {
        0 => Err(SceneProblem::mesh("triangles with an area", "none")),
        1..=MAX_TRIANGLES => Ok(Mesh::new(triangles)),
        count => Err(SceneProblem::mesh(format!("at most {MAX_TRIANGLES} triangles"), count)),
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
pub(super) fn around(positions: &[DVec3], indices: &[u32]) -> Option<Vec<DVec3>> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for face in indices.chunks_exact(3) {
        let corner = |i: usize| positions.get(face[i] as usize).copied();
        let own = area(&[corner(0)?, corner(1)?, corner(2)?]);
        face.iter().for_each(|&i| sums[i as usize] += own);
    }
    Some(sums)
}

/// Normal, as long as twice the area.
pub(super) fn area([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_that_lead_nowhere_are_refused() {
        let mesh = |face: &str| Mesh::of_obj(format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n{face}\n").as_bytes());
        for whole in ["f 1 2 3", "f -3 -2 -1", "f 1//1 2//1 3//-1"] {
            assert_eq!(mesh(whole).unwrap().len(), 1, "{whole}");
        }
        // The last of them is 2 when it is multiplied by 3.
        for face in ["f -4 2 3", "f 1//-4 2//1 3//1", "f 0 1 2", "f 1//1 2//1 3//6148914691236517206"] {
            let error = mesh(face).unwrap_err().to_string();
            assert!(error.contains("corners that lead to places and normals of the file"), "{face}: {error}");
        }
    }
}
