//! What stands above the function: what it is and whose the numbers are.

use super::{Language, Shader, identifier};
use crate::nbrdf::INPUTS;

/// Whose the code and the numbers are.
const TERMS: &str =
    "Terms: this code is MIT OR Apache-2.0. Its numbers derive from measurements, whose terms apply. The networks and
codes that come with nbrdf derive from networks published under the MIT license (Sztrajman et al. 2021) of the MERL BRDF
database (Matusik et al. 2003; free for research, see its license) and the RGL material database (Dupuy, Jakob 2018).";

/// The comment, line by line.
pub(super) fn of(shader: &Shader, language: Language) -> String {
    let name = identifier::in_comment(&shader.name);
    let version = env!("CARGO_PKG_VERSION");
    let about = language.about();
    let ([first, second], kept) = (shader.hidden, shader.network.hidden());
    let units = if kept == shader.hidden {
        String::new()
    } else {
        format!(" ({} and {} hidden units ever fire: the others are left out)", kept[0], kept[1])
    };
    let sha256 = &shader.sha256;
    let text = format!(
        "Material \"{name}\" as a neural BRDF, written by nbrdf {version}.
{about}
light, view: unit vectors away from the surface in the shading frame, whose normal is +z.
The result is f_r in 1/sr, linear RGB of BT.709 primaries, without the cosine; 0 below either horizon, never negative.
Network {INPUTS}-{first}-{second}-3{units}.
SHA-256 of its weights, f32 in little endian: {sha256}
Method: Sztrajman, Rainer, Ritschel, Weyrich, Neural BRDF Representation and Importance Sampling, 2021,
doi 10.1111/cgf.14335; the clamps are nbrdf's.
{TERMS}"
    );
    text.lines().map(|line| format!("// {line}\n")).collect()
}
