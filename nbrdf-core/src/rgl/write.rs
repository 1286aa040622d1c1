//! Tensor files, written: the header of all fields, then their numbers. The layout is that of [`fields`](super::fields).

use super::fields::{F32, MAGIC, U8};

/// A field on its way into a file.
pub(super) struct Outgoing<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its sizes, slowest first.
    pub shape: &'a [usize],
    /// Its numbers.
    pub numbers: Numbers<'a>,
}

/// Numbers of either type.
pub(super) enum Numbers<'a> {
    Bytes(&'a [u8]),
    Floats(&'a [f32]),
}

impl Numbers<'_> {
    const fn kind(&self) -> u8 {
        match self {
            Self::Bytes(_) => U8,
            Self::Floats(_) => F32,
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Bytes(bytes) => bytes.to_vec(),
            Self::Floats(numbers) => numbers.iter().flat_map(|number| number.to_le_bytes()).collect(),
        }
    }
}

/// The bytes of a file of these fields.
pub(super) fn bytes(fields: &[Outgoing<'_>]) -> Vec<u8> {
    let header_of = |field: &Outgoing<'_>| 2 + field.name.len() + 2 + 1 + 8 + 8 * field.shape.len();
    let start = MAGIC.len() + 2 + 4 + fields.iter().map(header_of).sum::<usize>();
    let mut header = MAGIC.to_vec();
    header.extend([1, 0]);
    header.extend((fields.len() as u32).to_le_bytes());
    let mut data = Vec::new();
    for Outgoing { name, shape, numbers } in fields {
        header.extend((name.len() as u16).to_le_bytes());
        header.extend(name.as_bytes());
        header.extend((shape.len() as u16).to_le_bytes());
        header.push(numbers.kind());
        header.extend(((start + data.len()) as u64).to_le_bytes());
        header.extend(shape.iter().flat_map(|&size| (size as u64).to_le_bytes()));
        data.extend(numbers.to_bytes());
    }
    header.append(&mut data);
    header
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rgl::fields::Fields;

    #[test]
    fn fields_that_are_written_are_read() {
        let numbers = [1.5, -2.0, 0.0, 3.25, 5.0, 6.0];
        let file = bytes(&[
            Outgoing { name: "description", shape: &[3], numbers: Numbers::Bytes(b"abc") },
            Outgoing { name: "rgb", shape: &[2, 3], numbers: Numbers::Floats(&numbers) },
        ]);
        let fields = Fields::parse(&file).unwrap();
        let read = fields.floats("rgb").unwrap();
        assert_eq!((read.shape.as_slice(), read.values.as_slice()), (&[2, 3][..], &numbers[..]));
        assert_eq!(fields.bytes("description").unwrap(), b"abc");
    }
}
