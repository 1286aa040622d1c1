//! Colours of a heat map.

use nbrdf_core::Rgb;

use crate::strip::text::ink;

/// From black over violet and orange to white, for shares of 0 to 1.
pub fn heat(share: f64) -> Rgb {
    const STOPS: [[f32; 3]; 5] =
        [[0.0, 0.0, 0.02], [0.31, 0.07, 0.48], [0.72, 0.21, 0.47], [0.98, 0.53, 0.38], [0.99, 0.99, 0.86]];
    let at = share.clamp(0.0, 1.0) as f32 * (STOPS.len() - 1) as f32;
    let below = (at as usize).min(STOPS.len() - 2);
    let between = at - below as f32;
    let mix = |channel: usize| STOPS[below][channel] * (1.0 - between) + STOPS[below + 1][channel] * between;
    // The stops are as displayed.
    Rgb([0, 1, 2].map(|channel| ink(mix(channel))[channel]))
}
