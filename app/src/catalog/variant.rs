//! How representations make their codes.

/// How a representation makes its codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// By one pass of its encoder.
    FeedForward,
    /// By its encoder and a few fixed steps against the target: still at once, a part of encoding.
    Unrolled,
    /// By projection onto a linear basis.
    Projection,
    /// By a fit to the material.
    Fitted,
    /// By asking the material in every cell.
    Tabulated,
    /// By an encoder or a projection, then a few steps against the target itself.
    Refined,
}

impl Variant {
    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FeedForward => "feed_forward",
            Self::Unrolled => "unrolled",
            Self::Projection => "projection",
            Self::Fitted => "fitted",
            Self::Tabulated => "tabulated",
            Self::Refined => "refined",
        }
    }
}
