//! WGSL and GLSL: read and checked by naga, run by whatever Vulkan, Metal or Direct3D there is, in software or not.

use nbrdf_core::shader::{Language, Shader};
use wgpu::ShaderSource;
use wgpu::naga::front::{glsl, wgsl};
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{Module, ShaderStage};

use super::driver::{Driver, GROUP};
use super::{compare, directions, materials, numbers};

/// A program that evaluates one pair after another.
fn wgsl(shader: &Shader) -> String {
    let (source, function, pairs) = (shader.source(Language::Wgsl), shader.function(), directions().len());
    format!(
        "{source}
@group(0) @binding(0) var<storage, read> at: array<f32>;
@group(0) @binding(1) var<storage, read_write> rgb: array<f32>;
@compute @workgroup_size({GROUP}) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let k = id.x;
    if (k >= {pairs}u) {{ return; }}
    let light = vec3<f32>(at[6u * k], at[6u * k + 1u], at[6u * k + 2u]);
    let view = vec3<f32>(at[6u * k + 3u], at[6u * k + 4u], at[6u * k + 5u]);
    let f = {function}(light, view);
    rgb[3u * k] = f.x;
    rgb[3u * k + 1u] = f.y;
    rgb[3u * k + 2u] = f.z;
}}
"
    )
}

/// The same.
fn glsl(shader: &Shader) -> String {
    let (source, function, pairs) = (shader.source(Language::Glsl), shader.function(), directions().len());
    format!(
        "#version 450
precision highp float;
layout(local_size_x = {GROUP}) in;
layout(std430, set = 0, binding = 0) readonly buffer At {{ float at[]; }};
layout(std430, set = 0, binding = 1) buffer Found {{ float rgb[]; }};
{source}
void main() {{
    uint k = gl_GlobalInvocationID.x;
    if (k >= {pairs}u) {{ return; }}
    vec3 light = vec3(at[6u * k], at[6u * k + 1u], at[6u * k + 2u]);
    vec3 view = vec3(at[6u * k + 3u], at[6u * k + 4u], at[6u * k + 5u]);
    vec3 f = {function}(light, view);
    rgb[3u * k] = f.x;
    rgb[3u * k + 1u] = f.y;
    rgb[3u * k + 2u] = f.z;
}}
"
    )
}

fn check(who: &str, module: &Module) {
    let checked = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module);
    assert!(checked.is_ok(), "{who}: {checked:?}");
}

#[test]
fn naga_accepts_wgsl_and_glsl() {
    for (shader, _) in materials() {
        let who = shader.name();
        let module = wgsl::parse_str(&wgsl(&shader)).unwrap_or_else(|error| panic!("{who}: {error}"));
        check(who, &module);
        let options = glsl::Options::from(ShaderStage::Compute);
        let module = glsl::Frontend::default().parse(&options, &glsl(&shader));
        check(who, &module.unwrap_or_else(|error| panic!("{who}: {error}")));
    }
}

#[test]
fn wgsl_and_glsl_give_what_the_library_gives() {
    let Some(driver) = Driver::found_or_skip() else { return };
    println!("{}", driver.name());
    let at = numbers(&directions());
    let all = materials();
    // Drivers in software take seconds for each.
    let is_run = |shader: &Shader| ["chrome", "gold-metallic-paint", "30 8", "brushed"].contains(&shader.name());
    for (shader, brdf) in all.iter().filter(|(shader, _)| is_run(shader)) {
        let found = driver.run(ShaderSource::Wgsl(wgsl(shader).into()), &at);
        compare("WGSL", shader, brdf.as_ref(), &found);
    }
    // And for GLSL longer, of which naga copies the constant arrays at every index; this one is small.
    let (shader, brdf) = all.iter().find(|(shader, _)| shader.name() == "3-5").unwrap();
    let source = ShaderSource::Glsl { shader: glsl(shader).into(), stage: ShaderStage::Compute, defines: &[] };
    compare("GLSL", shader, brdf.as_ref(), &driver.run(source, &at));
}
