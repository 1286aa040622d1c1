//! How the numbers of a ZNBRDF code are shared out between what all colour channels have in common and what each has of
//! its own.

use super::{DIM, MAX_DIM};
use crate::checkpoint::{Checkpoint, CheckpointError};

/// `shared` numbers, then `channel` for each of the three channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CodeLayout {
    /// Numbers that all channels share.
    pub shared: usize,
    /// Numbers for each channel.
    pub channel: usize,
}

impl CodeLayout {
    /// An eighth for each channel and one at least: 32 = 20 + 3 · 4, 8 = 5 + 3 · 1. Fewer than 4 numbers cannot tell the
    /// channels apart: such codes are grey.
    pub const fn new(dim: usize) -> Self {
        let channel = match dim {
            0..4 => 0,
            4..16 => 1,
            _ => dim / 8,
        };
        Self { shared: dim - 3 * channel, channel }
    }

    /// What a shorter code of `length` numbers keeps of this one, 1 or 0 for every number.
    pub fn prefix(self, length: usize) -> impl Iterator<Item = f32> {
        let kept = Self::new(length);
        let shared = (0..self.shared).map(move |number| number < kept.shared);
        let channels = (0..3 * self.channel).map(move |number| number % self.channel < kept.channel);
        shared.chain(channels).map(|is_kept| f32::from(u8::from(is_kept)))
    }

    /// As the tensors of a checkpoint say.
    pub fn of(file: &Checkpoint) -> Result<Self, CheckpointError> {
        let rows = |name: &str| file.file.shape(name).ok().and_then(|shape| shape.first().copied());
        let found = Self {
            shared: rows("encoder.shared.weight").unwrap_or(0),
            channel: rows("encoder.channel.weight").unwrap_or(0),
        };
        let dim = found.channel.saturating_mul(3).saturating_add(found.shared);
        if !(1..=MAX_DIM).contains(&dim) || found != Self::new(dim) {
            let expected = format!("the encoder of a code of 1 to {MAX_DIM} numbers, {DIM} by default");
            return Err(file.lacks(expected, format!("{} shared and 3 times {} numbers", found.shared, found.channel)));
        }
        Ok(found)
    }

    /// Numbers in a code.
    pub const fn dim(self) -> usize {
        self.shared + 3 * self.channel
    }

    /// What every column of the decoded output layer knows: the shared numbers, and the mean of the channels'.
    pub const fn common(self) -> usize {
        self.shared + self.channel
    }

    /// What one column knows: that, and its channel's own.
    pub const fn own(self) -> usize {
        self.common() + self.channel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shorter_code_keeps_the_first_shared_numbers_and_the_first_of_every_channel() {
        let kept = |length: usize| -> Vec<usize> {
            let mask = CodeLayout::new(32).prefix(length).enumerate();
            mask.filter(|(_, kept)| *kept == 1.0).map(|(number, _)| number).collect()
        };
        assert_eq!(kept(4), [0, 20, 24, 28]);
        assert_eq!(kept(8), [0, 1, 2, 3, 4, 20, 24, 28]);
        assert_eq!(kept(16), [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 20, 21, 24, 25, 28, 29]);
        assert_eq!(kept(32).len(), 32);
    }

    #[test]
    fn every_length_is_shared_out_whole() {
        for dim in 1..=MAX_DIM {
            assert_eq!(CodeLayout::new(dim).dim(), dim);
        }
        assert_eq!(CodeLayout::new(32), CodeLayout { shared: 20, channel: 4 });
        assert_eq!(CodeLayout::new(4), CodeLayout { shared: 1, channel: 1 });
        assert_eq!(CodeLayout::new(2), CodeLayout { shared: 2, channel: 0 });
    }
}
