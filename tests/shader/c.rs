//! C, also read as C++.

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

/// Of which C++ has other rules for constants and for what may follow what.
const CPP: Compiler = Compiler {
    variable: "CXX",
    program: "c++",
    source: "program.cpp",
    words: &["-std=c++11", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-o", "program"],
    libraries: &[],
};

#[test]
fn c_and_cpp_give_what_the_library_gives() {
    let sources: String = materials().iter().map(|(shader, _)| shader.source(Language::C) + "\n").collect();
    let call = |function: String| {
        format!("    for (int k = 0; k < n; ++k) {{ {function}(at[k], at[k] + 3, rgb); fwrite(rgb, 4, 3, stdout); }}\n")
    };
    let calls: String = materials().iter().map(|(shader, _)| call(shader.function())).collect();
    let pairs = directions().len();
    let program = format!(
        "#include <stdio.h>\n{sources}static float at[{pairs}][6];\nint main(void)\n{{\n    float rgb[3];\n    \
         const int n = (int)fread(at, 24, {pairs}, stdin);\n{calls}    return n != {pairs};\n}}\n"
    );
    C.compare(&program);
    CPP.compare(&program);
}
