//! A quantity over a region as a plane and a bound of the distance from it.
//!
//! centre + Σ slope_k δ_k ± error, with δ_k in −1..1 along the three angles of the region: unlike intervals, this keeps
//! that units see the same direction, so that bounds are second order in the size of the region.

/// centre + Σ slope_k δ_k ± Σ error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Affine {
    pub centre: f64,
    pub slope: [f64; 3],
    /// By the angle whose halving makes it smaller; the last stays whatever is halved.
    pub error: [f64; 4],
}

impl Affine {
    /// The same number everywhere.
    pub const fn constant(centre: f64) -> Self {
        Self { centre, slope: [0.0; 3], error: [0.0; 4] }
    }

    /// How far it may be from its centre along an angle.
    pub fn reach_along(&self, angle: usize) -> f64 {
        self.slope[angle].abs() + self.error[angle]
    }

    /// How far it may be from its centre.
    fn reach(&self) -> f64 {
        (0..3).map(|angle| self.reach_along(angle)).sum::<f64>() + self.error[3]
    }

    /// Never exceeded.
    pub fn upper(&self) -> f64 {
        self.centre + self.reach()
    }

    /// Largest absolute value.
    pub fn largest(&self) -> f64 {
        self.centre.abs() + self.reach()
    }

    /// With a larger error that stays.
    pub fn widened(mut self, by: f64) -> Self {
        self.error[3] += by;
        self
    }

    /// constant + Σ weight · part.
    pub fn weighted_sum(constant: f64, weights: &[f64], parts: &[Self]) -> Self {
        let mut sum = Self::constant(constant);
        for (weight, part) in weights.iter().zip(parts) {
            sum.centre += weight * part.centre;
            sum.slope.iter_mut().zip(part.slope).for_each(|(sum, slope)| *sum += weight * slope);
            sum.error.iter_mut().zip(part.error).for_each(|(sum, error)| *sum += weight.abs() * error);
        }
        sum
    }

    /// max(0, ·): itself, 0, or, where it changes sign, the plane through the middle of the smallest parallelogram
    /// around the bend.
    pub fn relu(&self) -> Self {
        let reach = self.reach();
        let (lower, upper) = (self.centre - reach, self.centre + reach);
        if lower >= 0.0 {
            return *self;
        }
        if upper <= 0.0 {
            return Self::constant(0.0);
        }
        let steepness = upper / (upper - lower);
        let half = -0.5 * steepness * lower;
        let mut bent = Self::weighted_sum(half, &[steepness], std::slice::from_ref(self));
        // The bend's error shrinks with whatever makes the quantity reach across it.
        for angle in 0..3 {
            bent.error[angle] += half * self.reach_along(angle) / reach;
        }
        bent.error[3] += half * self.error[3] / reach;
        bent
    }
}
