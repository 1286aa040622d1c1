//! Linear RGB triples (BT.709 primaries).

use std::ops::{Add, AddAssign, Index, IndexMut, Mul};

use serde::{Deserialize, Serialize};

/// Three linear channels, red, green, blue: a reflectance \[1/sr\] or a radiance, by context.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, bytemuck::Pod, bytemuck::Zeroable)]
#[serde(transparent)]
#[repr(transparent)]
pub struct Rgb(pub [f32; 3]);

/// Luminance of linear BT.709; above 0 for every colour but black.
pub fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

impl Rgb {
    /// All channels zero.
    pub const BLACK: Self = Self([0.0; 3]);

    /// The same value in all channels.
    pub const fn splat(value: f32) -> Self {
        Self([value; 3])
    }

    /// All channels of many triples, one after the other.
    pub fn flat(values: &[Self]) -> &[f32] {
        bytemuck::cast_slice(values)
    }

    /// As [`flat`](Self::flat), to be changed.
    pub fn flat_mut(values: &mut [Self]) -> &mut [f32] {
        bytemuck::cast_slice_mut(values)
    }

    /// Applies `f` to each channel.
    pub fn map(self, f: impl FnMut(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// Combines two triples channel by channel.
    pub fn zip(self, other: Self, mut f: impl FnMut(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// Smallest channel.
    pub fn min(self) -> f32 {
        self.0[0].min(self.0[1]).min(self.0[2])
    }

    /// Largest channel.
    pub fn max(self) -> f32 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }

    /// Mean of the three channels.
    pub fn mean(self) -> f32 {
        (self.0[0] + self.0[1] + self.0[2]) / 3.0
    }

    /// See [`luminance`].
    pub fn luminance(self) -> f64 {
        luminance(self.0.map(f64::from))
    }

    /// Whether no channel is NaN or infinite.
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|v| v.is_finite())
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f32> for Rgb {
    type Output = Self;
    fn mul(self, scale: f32) -> Self {
        self.map(|v| v * scale)
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Index<usize> for Rgb {
    type Output = f32;
    fn index(&self, channel: usize) -> &f32 {
        &self.0[channel]
    }
}

impl IndexMut<usize> for Rgb {
    fn index_mut(&mut self, channel: usize) -> &mut f32 {
        &mut self.0[channel]
    }
}
