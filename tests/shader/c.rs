//! C.

use nbrdf_core::shader::Language;

use super::program::Compiler;
use super::{directions, materials};

const C: Compiler = Compiler {
    variable: "CC",
    program: "cc",
    source: "program.c",
    words: &["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-o", "program"],
    libraries: &["-lm"],
};

#[test]
fn c_gives_what_the_library_gives() {
    let sources: String = materials().iter().map(|(shader, _)| shader.source(Language::C) + "\n").collect();
    let call = |function: String| {
        format!("    for (int k = 0; k < n; ++k) {{ {function}(at[k], at[k] + 3, rgb); fwrite(rgb, 4, 3, stdout); }}\n")
    };
    let calls: String = materials().iter().map(|(shader, _)| call(shader.function())).collect();
    let pairs = directions().len();
    C.compare(&format!(
        "#include <stdio.h>\n{sources}static float at[{pairs}][6];\nint main(void)\n{{\n    float rgb[3];\n    \
         const int n = (int)fread(at, 24, {pairs}, stdin);\n{calls}    return n != {pairs};\n}}\n"
    ));
}
