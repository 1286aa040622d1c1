//! Which of several models are worth what they cost.

/// Times within this factor are the same: what measures as 15.0 and 15.1 ns takes turns from run to run.
pub const TIE: f64 = 1.1;
/// Counts are exact.
pub const EXACT: f64 = 1.0;

/// Places of the models that are worth their cost, by rising cost: from the closest on, each that costs less than the last
/// one that was, by more than a factor `tie`. Values that a logarithmic axis cannot show are on no front.
pub fn front(models: &[(f64, f64)], tie: f64) -> Vec<usize> {
    let is_shown = |value: f64| value > 0.0 && value.is_finite();
    let mut order: Vec<usize> = (0..models.len()).filter(|&i| is_shown(models[i].0) && is_shown(models[i].1)).collect();
    // Of two that are as close, the cheaper one first.
    order.sort_by(|&a, &b| models[a].1.total_cmp(&models[b].1).then(models[a].0.total_cmp(&models[b].0)));
    let mut cheapest = f64::INFINITY;
    order.retain(|&i| {
        let is_worth_it = models[i].0 * tie < cheapest;
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
        let models = [
            (15.1, 0.009),
            (15.0, 0.024),
            (2.0, 0.12),
            (150.0, 0.011),
            (4.0, 0.06),
            (3.9, 0.06),
            (f64::NAN, 0.0),
            (1.0, 0.0),
        ];
        assert_eq!(front(&models, TIE), [2, 5, 0]);
        assert_eq!(front(&models, EXACT), [2, 5, 1, 0]);
        assert_eq!(front(&[], TIE), [0usize; 0]);
    }

    #[test]
    fn noise_within_a_tie_changes_nothing() {
        let models = [(15.1, 0.009), (15.0, 0.024), (2.0, 0.12), (150.0, 0.001), (4.0, 0.06)];
        for noise in [0.97, 1.03] {
            let mut shaken = models;
            shaken.iter_mut().step_by(2).for_each(|model| model.0 *= noise);
            assert_eq!(front(&shaken, TIE), front(&models, TIE), "{noise}");
        }
    }
}
