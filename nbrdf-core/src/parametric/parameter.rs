//! What a parameter is called, where it may be, and what it is where it is not needed.

use crate::Rgb;

/// A parameter of a shading model: a number, or a colour of three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in the specification.
    pub name: &'static str,
    /// The part of the model that it belongs to: empty for the core, which is always fitted, else a part that is used
    /// only where it lowers the error.
    pub part: &'static str,
    /// 1, or 3 of a colour.
    pub size: usize,
    /// Least and most that is fitted, both within the specification's range.
    pub range: [f32; 2],
    /// Its value where its part is not used.
    pub neutral: f32,
    /// Where fits of its part begin, one after the other.
    pub tried: [f32; 2],
}

impl Parameter {
    /// A number of the core.
    pub const fn core(name: &'static str, range: [f32; 2]) -> Self {
        Self { name, part: "", size: 1, range, neutral: 0.5, tried: [0.5; 2] }
    }

    /// A number of a part.
    pub const fn of(part: &'static str, name: &'static str, range: [f32; 2], neutral: f32, tried: [f32; 2]) -> Self {
        Self { name, part, size: 1, range, neutral, tried }
    }

    /// The same as a colour.
    pub const fn color(self) -> Self {
        Self { size: 3, ..self }
    }
}

/// Numbers that are taken one after the other.
pub struct Sequence<'a>(std::slice::Iter<'a, f32>);

impl<'a> Sequence<'a> {
    /// Of these.
    pub fn new(values: &'a [f32]) -> Self {
        Self(values.iter())
    }

    /// The next; 0 beyond the last.
    pub fn number(&mut self) -> f32 {
        self.0.next().copied().unwrap_or_default()
    }

    /// The next three.
    pub fn color(&mut self) -> Rgb {
        Rgb([(); 3].map(|()| self.number()))
    }
}
