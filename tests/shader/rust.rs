//! Rust, with and without its standard library.

use nbrdf_core::shader::Language;

use super::materials;
use super::program::Compiler;

const PROGRAM: Compiler = Compiler {
    variable: "RUSTC",
    program: "rustc",
    source: "program.rs",
    words: &["--edition=2021", "-Dwarnings", "-Copt-level=1", "-o", "program"],
    libraries: &[],
};

fn sources() -> String {
    materials().iter().map(|(shader, _)| shader.source(Language::Rust) + "\n").collect()
}

#[test]
fn rust_gives_what_the_library_gives() {
    let functions: Vec<String> = materials().iter().map(|(shader, _)| shader.function()).collect();
    PROGRAM.compare(&format!(
        "use std::io::{{Read, Write}};\n{}\nfn main() {{\n    let mut bytes = Vec::new();\n    \
         std::io::stdin().read_to_end(&mut bytes).unwrap();\n    \
         let at: Vec<f32> = bytes.chunks(4).map(|b| f32::from_ne_bytes(b.try_into().unwrap())).collect();\n    \
         for f in [{}] {{\n        for at in at.chunks(6) {{\n            \
         let rgb = f(at[..3].try_into().unwrap(), at[3..].try_into().unwrap());\n            \
         for v in rgb {{ std::io::stdout().write_all(&v.to_ne_bytes()).unwrap(); }}\n        }}\n    }}\n}}\n",
        sources(),
        functions.join(", "),
    ));
}

#[test]
fn rust_needs_two_functions_where_there_is_no_standard_library() {
    let words = &["--edition=2021", "--crate-type=lib", "-Dwarnings", "--emit=metadata"];
    let library = Compiler { words, ..PROGRAM };
    let float = "trait Float { fn sqrt(self) -> f32; fn exp_m1(self) -> f32; }\n\
                 impl Float for f32 {\n    fn sqrt(self) -> f32 { self }\n    fn exp_m1(self) -> f32 { self }\n}\n";
    library.compile(&format!("#![no_std]\n{float}{}", sources()));
}
