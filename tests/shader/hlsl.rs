//! HLSL, made SPIR-V by glslang, run by the driver.

use std::borrow::Cow;
use std::fs;

use nbrdf_core::shader::{Language, Shader};
use wgpu::ShaderSource;
use wgpu::util::make_spirv_raw;

use super::driver::{Driver, GROUP};
use super::program::Compiler;
use super::{compare, directions, materials, numbers};

const HLSL: Compiler = Compiler {
    variable: "GLSLANG",
    program: "glslangValidator",
    source: "program.hlsl",
    words: &["--quiet", "-D", "-V", "--target-env", "vulkan1.1", "-S", "comp", "-e", "main", "-o", "program"],
    libraries: &[],
};

/// A program that evaluates one pair after another.
fn program(shader: &Shader) -> String {
    let (source, function, pairs) = (shader.source(Language::Hlsl), shader.function(), directions().len());
    format!(
        "{source}
[[vk::binding(0, 0)]] RWStructuredBuffer<float> at;
[[vk::binding(1, 0)]] RWStructuredBuffer<float> rgb;
[numthreads({GROUP}, 1, 1)] void main(uint3 id : SV_DispatchThreadID)
{{
    uint k = id.x;
    if (k >= {pairs}) {{ return; }}
    float3 light = float3(at[6 * k], at[6 * k + 1], at[6 * k + 2]);
    float3 view = float3(at[6 * k + 3], at[6 * k + 4], at[6 * k + 5]);
    float3 f = {function}(light, view);
    rgb[3 * k] = f.x;
    rgb[3 * k + 1] = f.y;
    rgb[3 * k + 2] = f.z;
}}
"
    )
}

#[test]
fn hlsl_gives_what_the_library_gives() {
    let driver = Driver::found_or_skip();
    let at = numbers(&directions());
    for (shader, brdf) in materials() {
        let Some(folder) = HLSL.compile(&program(&shader)) else { return };
        // Drivers in software take seconds for each.
        if let (Some(driver), "chrome" | "3-5" | "brushed") = (&driver, shader.name()) {
            let module = fs::read(folder.path().join("program")).unwrap();
            let source = ShaderSource::SpirV(Cow::Owned(make_spirv_raw(&module).into_owned()));
            compare("HLSL", &shader, brdf.as_ref(), &driver.run(source, &at));
        }
    }
}
