//! Writes the files that fuzzing begins with, small ones of every kind that is read: `fuzz_seeds fuzz/seeds`.

use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

use hdf5_pure::FileBuilder;
use image::codecs::hdr::HdrEncoder;
use nbrdf_core::library::{Entry, Provenance};
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::nbrdf::fit::random_hidden;
use nbrdf_core::nbrdf::{npy, safetensors};
use nbrdf_core::parametric::{FitErrors, GltfPbr, OpenPbr, Parameter, Principled, ShadingModel};
use nbrdf_core::shader::{Language, Shader};
use nbrdf_core::tensor_file::{Numbers, TensorFile};
use nbrdf_core::{Image, Library, Nbrdf, Rgb};
use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Seeds as (folder, name, bytes).
struct Seeds(PathBuf);

impl Seeds {
    fn put(&self, reader: &str, name: &str, bytes: &[u8]) -> Outcome<()> {
        std::fs::create_dir_all(self.0.join(reader))?;
        Ok(std::fs::write(self.0.join(reader).join(name), bytes)?)
    }
}

fn main() -> Outcome<()> {
    let seeds = Seeds(std::env::args_os().nth(1).ok_or("expected the folder to write to")?.into());
    let network = random_hidden(0, 0, [2, 3]);
    networks(&seeds, &network)?;
    learned(&seeds)?;
    measured(&seeds)?;
    pictures(&seeds)?;
    exports(&seeds, &network)?;
    texts(&seeds)
}

fn networks(seeds: &Seeds, network: &Nbrdf) -> Outcome<()> {
    let [single, many] = [npy::write_npz(network), npy::write_npz(&random_hidden(1, 0, [3, 2]))];
    seeds.put("npz", "network", &single)?;
    seeds.put("npy", "network", &npy::write_npy(network).iter().flat_map(|file| sized(file)).collect::<Vec<u8>>())?;
    let tensors = safetensors::write_safetensors(network);
    seeds.put("network_safetensors", "network", &tensors)?;
    let turning = safetensors::write_anisotropic(&AnisotropicNbrdf::of(network.clone()));
    seeds.put("network_safetensors", "turning", &turning)?;
    seeds.put("keras", "network", &keras(network)?)?;
    for (name, method) in [("stored", CompressionMethod::Stored), ("deflated", CompressionMethod::Deflated)] {
        let files = [("a/one.npz", single.as_slice()), ("two.safetensors", &tensors), ("three.npz", &many)];
        seeds.put("archive", name, &archive(&files, method)?)?;
    }
    let entries = vec![Entry::new("one", "one.npz", network.clone())];
    let folder = tempfile::tempdir()?;
    Library::new(Provenance::default(), Some(network.clone()), entries)?.save(folder.path())?;
    let read = |name: &str| std::fs::read(folder.path().join(name));
    let manifest = String::from_utf8(read("manifest.json")?)?;
    // Without the checksum, which no change would survive.
    let lines: Vec<&str> = manifest.lines().filter(|line| !line.contains("tensors_sha256")).collect();
    let whole = [sized(&read("library.safetensors")?), lines.join("\n").into_bytes()].concat();
    seeds.put("library", "one", &whole)
}

/// A file after its length.
fn sized(file: &[u8]) -> Vec<u8> {
    [&(file.len() as u32).to_le_bytes(), file].concat()
}

/// As Keras writes it, names included.
fn keras(network: &Nbrdf) -> Outcome<Vec<u8>> {
    let mut file = FileBuilder::new();
    let [first, second] = network.hidden();
    let mut rest = network.weights();
    for (layer, (rows, columns)) in [(6, first), (first, second), (second, 3)].into_iter().enumerate() {
        let name = format!("dense_{}", layer + 1);
        let [kernel, bias] = [rows * columns, columns].map(|count| {
            let (own, after) = rest.split_at(count);
            rest = after;
            own
        });
        let mut group = file.create_group(&name);
        group.create_dataset("kernel:0").with_f32_data(kernel).with_shape(&[rows as u64, columns as u64]);
        group.create_dataset("bias:0").with_f32_data(bias).with_shape(&[columns as u64]);
        file.add_group(group.finish());
    }
    Ok(file.finish()?)
}

fn archive(files: &[(&str, &[u8])], method: CompressionMethod) -> Outcome<Vec<u8>> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method).last_modified_time(DateTime::default());
    for (name, bytes) in files {
        writer.start_file(*name, options)?;
        writer.write_all(bytes)?;
    }
    Ok(writer.finish()?.into_inner())
}

fn learned(seeds: &Seeds) -> Outcome<()> {
    let file = tempfile::NamedTempFile::new()?;
    let saved = |tensors: TensorFile, path: &Path| -> Outcome<Vec<u8>> {
        tensors.save(path)?;
        Ok(std::fs::read(path)?)
    };
    let header = |name: &str| format!(r#"{{"schema":1,"name":"{name}","checkpoint":"c","details":null}}"#);
    let weights = |value: f32| Numbers::F32((0..675).map(|i| value * (i % 7) as f32).collect());
    let pca = TensorFile::new("basis", header("pca_weights")).with("mean", &[675], weights(0.01)).with(
        "components",
        &[1, 675],
        weights(0.001),
    );
    seeds.put("basis", "pca_weights", &saved(pca, file.path())?)?;
    for name in ["pca_tables", "charting_2", "linear_combination", "optimal_sampling_5"] {
        let tensors = TensorFile::new("basis", header(name))
            .with("mean", &[3], Numbers::F32(vec![0.5; 3]))
            .with("tables", &[2, 3], Numbers::F32(vec![0.5; 6]))
            .with("cells", &[2], Numbers::U32(vec![7, 9]));
        seeds.put("basis", name, &saved(tensors, file.path())?)?;
    }
    for name in ["znbrdf", "published_autoencoder"] {
        let tensors = TensorFile::new("model", name.to_owned()).with("centre", &[3], Numbers::F32(vec![0.5; 3])).with(
            "decoder.0.weight",
            &[2, 2],
            Numbers::F32(vec![0.5; 4]),
        );
        seeds.put("checkpoint", name, &saved(tensors, file.path())?)?;
    }
    Ok(())
}

fn measured(seeds: &Seeds) -> Outcome<()> {
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let flat = |count: usize| floats(&(0..count).map(|i| 0.2 + (i % 5) as f32 * 0.1).collect::<Vec<f32>>());
    /// Bytes before the normals: one azimuth, two polar angles. Four normals and four areas follow.
    const NORMALS: usize = 4 * (1 + 2);
    let fields: [(&str, u8, &[u64], Vec<u8>); 7] = [
        ("phi_i", 10, &[1], floats(&[0.0])),
        ("theta_i", 10, &[2], floats(&[0.0, 1.4])),
        ("ndf", 10, &[2, 2], flat(4)),
        ("sigma", 10, &[2, 2], flat(4)),
        ("vndf", 10, &[1, 2, 3, 2], flat(12)),
        ("rgb", 10, &[1, 2, 3, 3, 2], flat(36)),
        ("jacobian", 1, &[1], vec![1]),
    ];
    let head: usize = fields.iter().map(|(name, _, shape, _)| 2 + name.len() + 2 + 1 + 8 + 8 * shape.len()).sum();
    let mut header = [b"tensor_file\0\x01\0".as_slice(), &(fields.len() as u32).to_le_bytes()].concat();
    let mut data = Vec::new();
    let start = header.len() + head;
    for (name, kind, shape, bytes) in &fields {
        header.extend((name.len() as u16).to_le_bytes());
        header.extend(name.bytes());
        header.extend((shape.len() as u16).to_le_bytes());
        header.push(*kind);
        header.extend(((start + data.len()) as u64).to_le_bytes());
        shape.iter().for_each(|size| header.extend(size.to_le_bytes()));
        data.extend(bytes);
    }
    seeds.put("rgl", "flat", &[header.as_slice(), &data].concat())?;
    // What fuzzing has found: next to no area, by which normals are divided.
    data[NORMALS..][..32].copy_from_slice(&floats(&[1e5, 1e5, 1e5, 1e5, 0.0, 0.0, 0.0, 0.0]));
    seeds.put("rgl", "no_area", &[header, data].concat())?;
    let dimensions = [90, 90, 180].map(i32::to_le_bytes).concat();
    seeds.put("merl", "valid", &dimensions)?;
    let change = |at: u32, value: f64| [&at.to_le_bytes()[..], &value.to_le_bytes()].concat();
    seeds.put("merl", "unmeasured", &[dimensions.clone(), change(12, -1.0), change(20, 0.5)].concat())?;
    seeds.put("merl", "nan", &[dimensions, change(12, f64::NAN)].concat())?;
    let text = "# a blue\n4\n400 500 600 700\n0.1 0 0.2 1 0.3 0.2 0.1 0.1\n0.5 0.3 0.6 2 0.3 0.2 0.1 0.1\n";
    seeds.put("goniometer", "blue", text.as_bytes())?;
    let text = "light_x,light_y,light_z,view_x,view_y,view_z,r,g,b\n0,0,1,0,0,1,.1,.2,.3\n0.6,0,0.8,0,0.6,0.8,1,2,3\n";
    seeds.put("csv", "two", text.as_bytes())
}

fn pictures(seeds: &Seeds) -> Outcome<()> {
    let pixel = |i: usize| Rgb([(i % 16) as f32 / 4.0, 0.5, (i / 16) as f32]);
    let image = Image::new(16, 8, (0..128).map(pixel).collect());
    let file = tempfile::Builder::new().suffix(".exr").tempfile()?;
    image.write_exr(file.path())?;
    seeds.put("exr", "softbox", &std::fs::read(file.path())?)?;
    let pixels: Vec<_> = image.pixels().iter().map(|pixel| image::Rgb(pixel.0)).collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, 16, 8)?;
    seeds.put("hdr", "softbox", &bytes)?;
    let plain = [&b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 4\n"[..], &[99, 50, 20, 129].repeat(8)];
    seeds.put("hdr", "plain", &plain.concat())
}

fn exports(seeds: &Seeds, network: &Nbrdf) -> Outcome<()> {
    let shader = Shader::new("one", network);
    for language in Language::ALL {
        seeds.put("source_code", language.extension(), shader.source(language).as_bytes())?;
    }
    let turning = Shader::turning("turning", &AnisotropicNbrdf::of(network.clone()));
    seeds.put("source_code", "turning", turning.source(Language::C).as_bytes())?;
    let errors = FitErrors { log_error: 0.01, relative_log: 0.2, studio_psnr: 40.0, studio_delta_e_itp: 3.0 };
    // Off neutral, so that every part is written; without the sphere, which is not read.
    let mut gltf: serde_json::Value = serde_json::from_slice(&shifted::<GltfPbr>().write("one", &errors))?;
    gltf.as_object_mut().ok_or("a glTF file is an object")?.retain(|key, _| key == "asset" || key == "materials");
    seeds.put("shading_model", "gltf", gltf.to_string().as_bytes())?;
    seeds.put("shading_model", "open_pbr", &shifted::<OpenPbr>().write("one", &errors))?;
    seeds.put("shading_model", "principled", &shifted::<Principled>().write("one", &errors))
}

/// Every number a third into its range.
fn shifted<M: ShadingModel>() -> M {
    let third = |parameter: &Parameter| {
        let [low, high] = parameter.range;
        std::iter::repeat_n(low + (high - low) / 3.0, parameter.size)
    };
    M::from_values(&M::PARAMETERS.iter().flat_map(third).collect::<Vec<_>>())
}

fn texts(seeds: &Seeds) -> Outcome<()> {
    let numbers = vec!["0.25"; 32].join(",");
    let code = format!(r#"{{"schema":1,"model":"znbrdf","checkpoint":"c","code":[{numbers}],"material":"one"}}"#);
    seeds.put("code", "znbrdf", code.as_bytes())?;
    seeds.put("chart_report", "two", REPORT.as_bytes())?;
    seeds.put("stress_report", "three", STRESS.as_bytes())?;
    seeds.put("obj", "cube", CUBE.as_bytes())?;
    seeds.put("obj", "fan", FAN.as_bytes())?;
    for (name, bytes) in gltf() {
        seeds.put("gltf", name, &bytes)?;
    }
    // What fuzzing has found: a normal before the first.
    seeds.put("obj", "before_the_first", FAN.replace("-4//1", "-4//-4").as_bytes())?;
    seeds.put("scene", "part", PART.as_bytes())?;
    seeds.put("scene", "whole", SCENE.as_bytes())
}

const REPORT: &str = r#"{"schema":1,"reference":"built in","materials":3,"quick":true,"points":[
{"name":"lambert","variant":"fitted","family":"formula","ns":2.5,"ratio_to_reference_loop":0.1,"encode_s":0.1,
"bytes":12,"shared_bytes":0,"error":{"log_error":{"mean":0.5,"p10":0.1,"p90":0.9,"max":1}}},
{"name":"znbrdf_32","variant":"refined","family":"code","ns":40,"ratio_to_reference_loop":0.2,"encode_s":0.2,
"bytes":128,"shared_bytes":9000,"error":{"log_error":{"mean":0.01,"p10":0,"p90":0.02,"max":0.1}}}]}"#;

const STRESS: &str = r#"{"schema":1,"reference":"built in","checkpoint":"c","extent":{"materials":4,"few":1,"ends":12,
"pairs":6,"steps":60},"counted":{"materials":4,"few":1,"ends":12,"pairs":6,"steps":60},"work":"w","seed":0,"asked":[[],["lambert"]],"groups":["directions","paths"],"cells":[
{"hazard":"mirror","group":"directions","method":"lambert","value":8.3,"threshold":{"holds":0.182,"fails":0.693},
"verdict":"fails","count":4,"share":0.5,"worst":["chrome"],"warnings":["not_carried"],"picture":"iVBORw0KGgo="},
{"hazard":"retro","group":"directions","method":"znbrdf","variant":"refined","value":null,"threshold":{"holds":0.182,
"fails":0.693},"verdict":"refuses","count":1,"share":1,"worst":[],"warnings":[],"note":"no code"},
{"hazard":"many","group":"paths","method":"latent","value":0.8,"threshold":{"holds":0.84,"fails":1},"verdict":"holds",
"count":1,"share":0,"worst":["a > b"],"warnings":[]}]}"#;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const FAN: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf -4//1 -3//1 -2//1 -1//1\n";

/// A unit square, moved and enlarged: as text, as binary, and as a fan with normals.
fn gltf() -> [(&'static str, Vec<u8>); 3] {
    use base64::Engine as _;
    let place = |x: f32, y: f32| [x, y, 0.0].map(f32::to_le_bytes).concat();
    let places = [place(-0.5, -0.5), place(0.5, -0.5), place(0.5, 0.5), place(-0.5, 0.5)].concat();
    let short = |indices: [u16; 6]| indices.map(u16::to_le_bytes).concat();
    let plain = [places.clone(), short([0, 1, 2, 0, 2, 3])].concat();
    let normals = [0.0_f32, 0.0, 1.0].map(f32::to_le_bytes).concat().repeat(4);
    let fan = [places, short([0, 1, 2, 3, 0, 0]), normals].concat();
    let uri = |kind: &str, bytes: &[u8]| {
        let text = base64::engine::general_purpose::STANDARD.encode(bytes);
        format!(",\"uri\":\"data:{kind};base64,{text}\"")
    };
    let square = |uri: &str| GLTF.replace("URI", uri);
    let in_a_fan = square(&uri("", &fan))
        .replace("\"POSITION\":0},\"indices\":1", "\"POSITION\":0,\"NORMAL\":2},\"indices\":1,\"mode\":6")
        .replace(
            "\"count\":6,\"type\":\"SCALAR\"}",
            "\"count\":4,\"type\":\"SCALAR\"},\
                 {\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}",
        )
        .replace("\"byteLength\":12}", "\"byteLength\":12},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":48}")
        .replace("\"byteLength\":60", "\"byteLength\":108");
    let mut text = square("").into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let size = |bytes: usize| (bytes as u32).to_le_bytes();
    let header = [b"glTF".as_slice(), &size(2), &size(28 + text.len() + plain.len())].concat();
    let parts = [size(text.len()).as_slice(), b"JSON", &text, &size(plain.len()), b"BIN\0", &plain].concat();
    let text = square(&uri("application/octet-stream", &plain)).into_bytes();
    [("square", text), ("binary", [header, parts].concat()), ("fan", in_a_fan.into_bytes())]
}

const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[3,0,0],"scale":[2,2,2]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.5,-0.5,0],"max":[0.5,0.5,0]},{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],"buffers":[{"byteLength":60URI}]}"#;
const PART: &str = "[[object]]\nmaterial = \"chrome\"\nsphere = { centre = [0, 0, 0], radius = 1 }\n\
                    [[light]]\nkind = \"point\"\nat = [0, 3, 3]\nintensity = [1, 1, 1]\n";

const SCENE: &str = "include = [\"part.toml\"]\ntolerance = 0.1\n\
[image]\nwidth = 4\nheight = 3\nsamples = 1\nexposure = 1.5\n\
[camera]\nfrom = [0, 0.5, 6]\nto = [0, 0, 0]\nfield = 34\n\
[[light]]\nkind = \"environment\"\nmap = \"map.hdr\"\nrotate = 30\nseen = false\n\
[[light]]\nkind = \"area\"\ncentre = [-3, 5, 4]\nu = [1, 0, 1]\nv = [-0.5, 0.6, 0.5]\nradiance = [9, 9, 8]\n\
[[object]]\nname = \"cube\"\nmaterial = \"pink-felt\"\nmesh = { file = \"cube.obj\", scale = 0.5, at = [0, 1, 0] }\n\
[[object]]\nname = \"wall\"\nmaterial = \"white-paint\"\nplane = { point = [0, 0, -3], normal = [0, 0, 1] }\n\
[[object]]\nname = \"card\"\nmaterial = \"brass\"\nrectangle = { centre = [0, 0, -3], u = [1, 0, 0], v = [0, 1, 0] }\n";
