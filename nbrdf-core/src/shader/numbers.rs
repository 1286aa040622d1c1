//! Weights as lists of numbers in source code.

use crate::Nbrdf;

/// What the lines of lists begin with.
const INDENT: &str = "        ";
/// The longest line.
const WIDTH: usize = 110;

/// A layer's kernel: for each unit a row of the weights of its inputs, on lines of its own. `inputs` are those that the
/// first layer reads.
pub(super) fn kernel(network: &Nbrdf, layer: usize, inputs: &[usize], suffix: &str) -> String {
    let (kernel, bias) = network.layout().layers[layer].clone();
    let (weights, units) = (&network.weights()[kernel], bias.len());
    let read: Vec<usize> = if layer == 0 { inputs.to_vec() } else { (0..weights.len() / units).collect() };
    list((0..units).map(|unit| read.iter().map(|row| weights[row * units + unit]).collect()), suffix)
}

/// A layer's biases.
pub(super) fn biases(network: &Nbrdf, layer: usize, suffix: &str) -> String {
    let (_, bias) = network.layout().layers[layer].clone();
    list(std::iter::once(network.weights()[bias].to_vec()), suffix)
}

/// Numbers with commas between them, each row beginning a line.
fn list(rows: impl Iterator<Item = Vec<f32>>, suffix: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for row in rows {
        lines.push(INDENT.to_owned());
        for value in row {
            let number = literal(value) + suffix + ",";
            let line = lines.last_mut().filter(|line| line.len() + 1 + number.len() <= WIDTH);
            match line {
                Some(line) if line.trim().is_empty() => *line += &number,
                Some(line) => *line = format!("{line} {number}"),
                None => lines.push(format!("{INDENT}{number}")),
            }
        }
    }
    // GLSL has no comma after the last one.
    lines.join("\n").trim_end_matches(',').to_owned()
}

/// Nine significant digits, trailing zeros left out: read as a number of 32 bits, also by way of one of 64, it is `value`
/// again.
pub(super) fn literal(value: f32) -> String {
    let rounded: f64 = format!("{value:.8e}").parse().unwrap_or_else(|_| value.into());
    format!("{rounded:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::random_hidden;

    #[test]
    fn numbers_come_back_to_the_bit_and_are_floats_in_every_language() {
        for bits in (0..u32::MAX).step_by(65_521) {
            let value = f32::from_bits(bits);
            if value.is_finite() {
                let text = literal(value);
                assert_eq!(text.parse::<f32>().unwrap().to_bits(), bits, "{text}");
                assert_eq!((text.parse::<f64>().unwrap() as f32).to_bits(), bits, "{text}");
                assert!(text.contains(['.', 'e']) && text.len() < 20, "{text}");
            }
        }
        assert_eq!(literal(0.1), "0.100000001", "by way of 64 bits, too");
        assert_eq!(literal(-2.0), "-2.0");
    }

    #[test]
    fn a_list_holds_every_weight_of_the_inputs_read_unit_by_unit() {
        let network = random_hidden(3, 0, [30, 2]);
        let read = |text: &str| -> Vec<f32> { text.split(',').map(|number| number.trim().parse().unwrap()).collect() };
        let first = kernel(&network, 0, &[0, 2, 3, 4, 5], "");
        assert_eq!(read(&first).len(), 150);
        assert_eq!(read(&first)[6], network.weights()[2 * 30 + 1], "h.z of the second unit");
        assert_eq!(first.lines().count(), 30);
        let second = kernel(&network, 1, &[], "");
        assert_eq!(read(&second)[31], network.weights()[180 + 30 + 3], "the second input of the second unit");
        assert!(second.lines().all(|line| line.len() <= WIDTH));
        assert_eq!(read(&biases(&network, 2, "")), network.weights()[network.weights().len() - 3..]);
    }
}
