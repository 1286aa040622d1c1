//! Which of several models are worth what they cost.

/// Costs within this factor are the same: what measures as 15.0 and 15.1 ns takes turns from run to run.
pub const TIE: f64 = 1.1;

/// Places of the models that no other one beats: from the closest on, each that costs less than all closer ones by more
/// than a [`TIE`]; by rising cost. Values that are no numbers are on no front.
pub fn front(models: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..models.len()).filter(|&i| models[i].0.is_finite() && models[i].1.is_finite()).collect();
    // Of two that are as close, the cheaper one first.
    order.sort_by(|&a, &b| models[a].1.total_cmp(&models[b].1).then(models[a].0.total_cmp(&models[b].0)));
    let mut cheapest = f64::INFINITY;
    order.retain(|&i| {
        let is_worth_it = models[i].0 * TIE < cheapest;
        if is_worth_it {
            cheapest = models[i].0;
        }
        is_worth_it
    });
    order.reverse();
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_on_the_front_is_beaten_by_more_than_a_tie() {
        let models =
            [(15.1, 0.009), (15.0, 0.024), (2.0, 0.12), (150.0, 0.011), (4.0, 0.06), (3.9, 0.06), (f64::NAN, 0.0)];
        assert_eq!(front(&models), [2, 5, 0]);
        assert_eq!(front(&[]), [0usize; 0]);
    }

    #[test]
    fn noise_within_a_tie_changes_nothing() {
        let models = [(15.1, 0.009), (15.0, 0.024), (2.0, 0.12), (150.0, 0.001), (4.0, 0.06)];
        for noise in [0.97, 1.03] {
            let mut shaken = models;
            shaken.iter_mut().step_by(2).for_each(|model| model.0 *= noise);
            assert_eq!(front(&shaken), front(&models), "{noise}");
        }
    }
}
