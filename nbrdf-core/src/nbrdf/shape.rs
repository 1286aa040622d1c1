//! From six array shapes to hidden widths: what every file format of a network shares.

use std::fmt;

use super::{INPUTS, MAX_HIDDEN};

/// Names of the six arrays in `.npz` files and of the endings in `.npy` sets, in flattened order.
pub const ARRAYS: [&str; 6] = ["fc1", "b1", "fc2", "b2", "fc3", "b3"];

/// An array of a file does not fit a network.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("array {array} has shape {}, expected {expected}", Dimensions(found))]
pub struct ShapeError {
    /// Name of the array in its file.
    pub array: String,
    /// What fits, in words.
    pub expected: String,
    /// What the file says.
    pub found: Vec<u64>,
}

/// Hidden widths of a network from the shapes of kernel, bias, kernel, bias, kernel, bias.
///
/// Kernels are (inputs, outputs). Only shapes are looked at, so that a file is refused before its numbers are read.
pub(super) fn hidden_from_shapes(arrays: &[(String, Vec<u64>); 6]) -> Result<[usize; 2], ShapeError> {
    let [first, first_bias, second, second_bias, third, third_bias] = arrays;
    let first_width = kernel(first, INPUTS, None)?;
    bias(first_bias, first_width)?;
    let second_width = kernel(second, first_width, None)?;
    bias(second_bias, second_width)?;
    kernel(third, second_width, Some(3))?;
    bias(third_bias, 3)?;
    Ok([first_width, second_width])
}

fn kernel((name, found): &(String, Vec<u64>), inputs: usize, outputs: Option<usize>) -> Result<usize, ShapeError> {
    let width = match *found.as_slice() {
        [rows, columns] if rows == inputs as u64 => usize::try_from(columns).ok(),
        _ => None,
    };
    let fits = |width: &usize| match outputs {
        Some(outputs) => *width == outputs,
        None => (1..=MAX_HIDDEN).contains(width),
    };
    width.filter(fits).ok_or_else(|| {
        let mut expected = match outputs {
            Some(outputs) => format!("({inputs}, {outputs})"),
            None => format!("({inputs}, n) with n from 1 to {MAX_HIDDEN}"),
        };
        if matches!(found.as_slice(), [_, columns] if *columns == inputs as u64) {
            expected += ": kernels are (inputs, outputs), transpose it";
        }
        ShapeError { array: name.clone(), expected, found: found.clone() }
    })
}

fn bias((name, found): &(String, Vec<u64>), width: usize) -> Result<(), ShapeError> {
    if found.as_slice() == [width as u64] {
        return Ok(());
    }
    Err(ShapeError { array: name.clone(), expected: format!("({width},)"), found: found.clone() })
}

/// A shape as Python writes it.
struct Dimensions<'a>(&'a [u64]);

impl fmt::Display for Dimensions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [single] => write!(f, "({single},)"),
            many => {
                let many: Vec<_> = many.iter().map(u64::to_string).collect();
                write!(f, "({})", many.join(", "))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes(kernels: [[u64; 2]; 3], biases: [u64; 3]) -> [(String, Vec<u64>); 6] {
        std::array::from_fn(|i| {
            let shape = if i % 2 == 0 { kernels[i / 2].to_vec() } else { vec![biases[i / 2]] };
            (ARRAYS[i].to_owned(), shape)
        })
    }

    #[test]
    fn any_consistent_widths_are_a_network() {
        assert_eq!(hidden_from_shapes(&shapes([[6, 21], [21, 21], [21, 3]], [21, 21, 3])), Ok([21, 21]));
        assert_eq!(hidden_from_shapes(&shapes([[6, 1], [1, 256], [256, 3]], [1, 256, 3])), Ok([1, 256]));
    }

    #[test]
    fn a_transposed_kernel_is_told_so() {
        let error = hidden_from_shapes(&shapes([[21, 6], [21, 21], [3, 21]], [21, 21, 3])).unwrap_err();
        assert_eq!(
            error.to_string(),
            "array fc1 has shape (21, 6), expected (6, n) with n from 1 to 256: kernels are (inputs, outputs), \
             transpose it"
        );
    }

    #[test]
    fn widths_that_disagree_or_are_out_of_range_are_refused() {
        for (kernels, biases, culprit) in [
            ([[6, 21], [20, 21], [21, 3]], [21, 21, 3], "fc2"),
            ([[6, 21], [21, 21], [21, 4]], [21, 21, 4], "fc3"),
            ([[6, 21], [21, 21], [21, 3]], [21, 20, 3], "b2"),
            ([[6, 0], [0, 21], [21, 3]], [0, 21, 3], "fc1"),
            ([[6, u64::MAX], [21, 21], [21, 3]], [21, 21, 3], "fc1"),
            ([[6, 257], [257, 21], [21, 3]], [257, 21, 3], "fc1"),
        ] {
            assert_eq!(hidden_from_shapes(&shapes(kernels, biases)).unwrap_err().array, culprit);
        }
    }
}
