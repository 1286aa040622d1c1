//! The polygon with a material at each corner: its geometry, and the weights of its corners.

/// Corners of the polygon, the first on top, clockwise; +y is up.
pub fn corners(count: usize) -> Vec<[f32; 2]> {
    let angle = |corner: usize| std::f32::consts::TAU * corner as f32 / count as f32;
    (0..count).map(|corner| [angle(corner).sin(), angle(corner).cos()]).collect()
}

/// Where a place comes to lie when the corners are listed backwards.
pub(super) fn mirrored([x, y]: [f32; 2], count: usize) -> [f32; 2] {
    // Reversed, corner k takes the place of corner n − 1 − k: a reflection about the axis at half of n − 1 steps.
    let axis = std::f32::consts::TAU * (count as f32 - 1.0) / count as f32;
    let (sin, cos) = axis.sin_cos();
    [-x * cos + y * sin, x * sin + y * cos]
}

/// Weights of corners for a place within (M. S. Floater, *Mean value coordinates*, 2003): smooth, exact at corners and
/// straight along edges.
pub(super) fn mean_values(place: [f32; 2], corners: &[[f32; 2]]) -> Vec<f32> {
    let count = corners.len();
    let rays: Vec<[f64; 2]> = corners.iter().map(|c| [0, 1].map(|i| f64::from(c[i]) - f64::from(place[i]))).collect();
    let length = |k: usize| rays[k][0].hypot(rays[k][1]);
    let one_hot = |at: &[(usize, f64)]| {
        let mut weights = vec![0.0; count];
        at.iter().for_each(|&(k, weight)| weights[k] = weight as f32);
        weights
    };
    let mut tangents = Vec::with_capacity(count);
    for k in 0..count {
        let next = (k + 1) % count;
        if length(k) < 1e-6 {
            return one_hot(&[(k, 1.0)]);
        }
        let area = rays[k][0] * rays[next][1] - rays[k][1] * rays[next][0];
        let cosine = rays[k][0] * rays[next][0] + rays[k][1] * rays[next][1];
        if area.abs() < 1e-6 && cosine <= 0.0 {
            return one_hot(&[(k, length(next)), (next, length(k))]);
        }
        tangents.push((length(k) * length(next) - cosine) / area);
    }
    let weight = |k: usize| ((tangents[(k + count - 1) % count] + tangents[k]) / length(k)) as f32;
    // Clockwise corners have negative areas.
    (0..count).map(|k| weight(k).abs()).collect()
}

/// The place itself, or the nearest one on the rim.
pub(super) fn into_polygon(place: [f32; 2], corners: &[[f32; 2]]) -> [f32; 2] {
    let edges = (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]));
    let is_inside =
        |([ax, ay], [bx, by]): ([f32; 2], [f32; 2])| (bx - ax) * (place[1] - ay) - (by - ay) * (place[0] - ax) <= 0.0;
    if edges.clone().all(is_inside) {
        return place;
    }
    let onto = |([ax, ay], [bx, by]): ([f32; 2], [f32; 2])| {
        let (dx, dy) = (bx - ax, by - ay);
        let s = (((place[0] - ax) * dx + (place[1] - ay) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        [ax + s * dx, ay + s * dy]
    };
    let distance = |to: &[f32; 2]| (to[0] - place[0]).hypot(to[1] - place[1]);
    edges.map(onto).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(place)
}

/// The place at a share of the way around, 0 and 1 at the first corner.
pub fn rim_of(share: f32, corners: &[[f32; 2]]) -> [f32; 2] {
    let along = share.rem_euclid(1.0) * corners.len() as f32;
    let corner = (along as usize).min(corners.len() - 1);
    let (from, to, s) = (corners[corner], corners[(corner + 1) % corners.len()], along - corner as f32);
    [0, 1].map(|i| from[i] + s * (to[i] - from[i]))
}

/// The share of the way around at which the rim is nearest, and its distance.
pub(super) fn on_rim(place: [f32; 2], corners: &[[f32; 2]]) -> (f32, f32) {
    let count = corners.len();
    let onto = |corner: usize| {
        let (from, to) = (corners[corner], corners[(corner + 1) % count]);
        let way = [to[0] - from[0], to[1] - from[1]];
        let along = (place[0] - from[0]) * way[0] + (place[1] - from[1]) * way[1];
        let s = (along / (way[0] * way[0] + way[1] * way[1])).clamp(0.0, 1.0);
        let distance = (from[0] + s * way[0] - place[0]).hypot(from[1] + s * way[1] - place[1]);
        ((corner as f32 + s) / count as f32, distance)
    };
    (0..count).map(onto).min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, 0.0))
}

/// A blend of so many ends in a polygon.
#[cfg(test)]
pub(super) fn of(count: usize) -> super::Blend {
    let ends = (0..count).map(|end| super::letter(end).to_string()).collect();
    super::Blend { ends, way: super::Way::Polygon, ..super::Blend::default() }
}
