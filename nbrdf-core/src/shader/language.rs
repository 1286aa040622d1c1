//! Languages that networks are written in.

use crate::brdf::Azimuth;

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// GLSL ES 3.00 and newer, GLSL 3.30 and newer: `vec3 f_r(vec3 light, vec3 view)`.
    Glsl,
    /// HLSL, as glslang reads it (shader model 5): `float3 f_r(float3 light, float3 view)`.
    Hlsl,
    /// WGSL: `fn f_r(light: vec3<f32>, view: vec3<f32>) -> vec3<f32>`.
    Wgsl,
    /// C99: `void f_r(const float light[3], const float view[3], float rgb[3])`.
    C,
    /// Rust: `pub fn f_r(light: [f32; 3], view: [f32; 3]) -> [f32; 3]`.
    Rust,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Glsl, Self::Hlsl, Self::Wgsl, Self::C, Self::Rust];

    /// The extension of its files, without the dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Wgsl => "wgsl",
            Self::C => "c",
            Self::Rust => "rs",
        }
    }

    /// What whoever takes the file must know of the language, a sentence.
    pub(super) const fn about(self) -> &'static str {
        match self {
            Self::Glsl => "GLSL ES 3.00 or GLSL 3.30 and newer; in ES, `precision highp float;` comes before it.",
            Self::Hlsl => "HLSL of shader model 5, tested through glslang.",
            Self::Wgsl => "WGSL, as WebGPU reads it.",
            Self::C => "C99, also C++; `rgb` is the result.",
            Self::Rust => {
                "Rust; under no_std a trait with `sqrt` and `exp_m1`, as num_traits::Float, must be in scope."
            }
        }
    }

    /// The function, with names between @ for what differs from network to network.
    pub(super) const fn template(self) -> &'static str {
        match self {
            Self::Glsl => include_str!("f_r.glsl"),
            Self::Hlsl => include_str!("f_r.hlsl"),
            Self::Wgsl => include_str!("f_r.wgsl"),
            Self::C => include_str!("f_r.c"),
            Self::Rust => include_str!("f_r.rs.txt"),
        }
    }

    /// What follows the digits of a number of 32 bits.
    pub(super) const fn suffix(self) -> &'static str {
        match self {
            Self::C => "f",
            Self::Glsl | Self::Hlsl | Self::Wgsl | Self::Rust => "",
        }
    }

    /// The half vector's components that a network reads.
    pub(super) const fn half(self, azimuth: Azimuth) -> &'static str {
        match (self, azimuth) {
            (Self::Glsl | Self::Hlsl | Self::Wgsl, Azimuth::Dropped) => "across * inverse, s.z * inverse",
            (Self::Glsl | Self::Hlsl | Self::Wgsl, Azimuth::Kept) => "s.x * inverse, s.y * inverse, s.z * inverse",
            (Self::C | Self::Rust, Azimuth::Dropped) => "across * inverse, sz * inverse",
            (Self::C | Self::Rust, Azimuth::Kept) => "sx * inverse, sy * inverse, sz * inverse",
        }
    }
}
