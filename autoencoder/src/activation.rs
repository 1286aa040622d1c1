//! What stands between two dense layers.

use nbrdf_core::dense::silu;

/// A function of one number, and its slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Activation {
    /// x / (1 + exp(−x)).
    Silu,
    /// max(0, x).
    Relu,
}

impl Activation {
    /// In place; `slopes`, where asked for, becomes the derivatives.
    pub fn apply(self, x: &mut [f32], slopes: Option<&mut [f32]>) {
        match self {
            Self::Silu => silu(x, slopes),
            Self::Relu => {
                if let Some(slopes) = slopes {
                    slopes.iter_mut().zip(&*x).for_each(|(slope, x)| *slope = f32::from(u8::from(*x > 0.0)));
                }
                x.iter_mut().for_each(|x| *x = x.max(0.0));
            }
        }
    }
}
