//! Kinds of numbers in files, and their bytes.

use std::borrow::Cow;

use safetensors::tensor::{Dtype, TensorView, View};

/// Numbers of one kind, all finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
    /// Indices.
    U32(Vec<u32>),
}

mod sealed {
    pub trait Sealed {}

    impl Sealed for f32 {}
    impl Sealed for f64 {}
    impl Sealed for u32 {}
}

/// A kind of numbers: `f32`, `f64` or `u32`.
pub trait Number: Copy + sealed::Sealed {
    /// Its name in messages.
    const KIND: &str;

    /// These numbers, if they are of this kind.
    fn of(numbers: &Numbers) -> Option<&[Self]>;
}

impl Number for f32 {
    const KIND: &str = "F32";

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::F32(own) = numbers { Some(own) } else { None }
    }
}

impl Number for f64 {
    const KIND: &str = "F64";

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::F64(own) = numbers { Some(own) } else { None }
    }
}

impl Number for u32 {
    const KIND: &str = "U32";

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::U32(own) = numbers { Some(own) } else { None }
    }
}

/// The numbers of a tensor in a file, if they are of a kind that is known here.
pub(super) fn numbers(view: &TensorView) -> Option<Numbers> {
    let words = || view.data().as_chunks().0.iter();
    match view.dtype() {
        Dtype::F32 => Some(Numbers::F32(words().map(|word| f32::from_le_bytes(*word)).collect())),
        Dtype::U32 => Some(Numbers::U32(words().map(|word| u32::from_le_bytes(*word)).collect())),
        Dtype::F64 => Some(Numbers::F64(view.data().as_chunks().0.iter().map(|w| f64::from_le_bytes(*w)).collect())),
        _ => None,
    }
}

impl Numbers {
    /// The first number beyond ±`largest`, or that is none.
    pub(super) fn beyond(&self, largest: f64) -> Option<f64> {
        let is_beyond = |v: &f64| v.is_nan() || v.abs() > largest;
        match self {
            Self::F32(own) => own.iter().map(|&v| f64::from(v)).find(is_beyond),
            Self::F64(own) => own.iter().copied().find(is_beyond),
            Self::U32(own) => own.iter().map(|&v| f64::from(v)).find(is_beyond),
        }
    }
}

/// A tensor on its way into a file.
pub(super) struct Stored<'a> {
    pub shape: &'a [usize],
    pub numbers: &'a Numbers,
}

impl View for Stored<'_> {
    fn dtype(&self) -> Dtype {
        match self.numbers {
            Numbers::F32(_) => Dtype::F32,
            Numbers::F64(_) => Dtype::F64,
            Numbers::U32(_) => Dtype::U32,
        }
    }

    fn shape(&self) -> &[usize] {
        self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        match self.numbers {
            Numbers::F32(own) if cfg!(target_endian = "little") => Cow::Borrowed(bytemuck::cast_slice(own)),
            Numbers::F32(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Numbers::F64(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Numbers::U32(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }

    fn data_len(&self) -> usize {
        match self.numbers {
            Numbers::F32(own) => size_of_val(own.as_slice()),
            Numbers::F64(own) => size_of_val(own.as_slice()),
            Numbers::U32(own) => size_of_val(own.as_slice()),
        }
    }
}
