//! Which of several models are worth what they cost.

/// Times within this factor are the same: what measures as 15.0 and 15.1 ns takes turns from run to run.
pub const TIE: f64 = 1.1;
/// Counts are exact.
pub const EXACT: f64 = 1.0;

/// Places of the models that are worth their cost, by rising cost: from the closest on, each that costs less than the last
/// one that was, by more than a factor `tie`. Values that a logarithmic axis cannot show are on no front.
pub fn front(models: &[(f64, f64)], tie: f64) -> Vec<usize> {
    chosen(models, |own, cheapest| models[own].0 * tie < models[cheapest].0)
}

/// The same by the costs of one run of several, of which `models` are the medians: where a run is within a factor `tie` of
/// deciding otherwise, the medians decide.
pub fn front_of_run(run: &[f64], models: &[(f64, f64)], tie: f64) -> Vec<usize> {
    chosen(models, |own, cheapest| {
        let share = run[own] * tie / run[cheapest];
        let is_near = share < tie && share * tie > 1.0;
        if is_near { models[own].0 * tie < models[cheapest].0 } else { share < 1.0 }
    })
}

/// Those that are worth their cost beside the cheapest that is closer and worth its own.
fn chosen(models: &[(f64, f64)], is_worth_it: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    let is_shown = |value: f64| value > 0.0 && value.is_finite();
    let mut order: Vec<usize> = (0..models.len()).filter(|&i| is_shown(models[i].0) && is_shown(models[i].1)).collect();
    // Of two that are as close, the cheaper one first.
    order.sort_by(|&a, &b| models[a].1.total_cmp(&models[b].1).then(models[a].0.total_cmp(&models[b].0)));
    let mut cheapest = None;
    order.retain(|&i| {
        let is_chosen = cheapest.is_none_or(|cheapest| is_worth_it(i, cheapest));
        if is_chosen {
            cheapest = Some(i);
        }
        is_chosen
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

    #[test]
    fn the_medians_decide_near_ties_of_a_run_and_nothing_else() {
        // The second is a tenth faster than the third, within noise; the first is twice as fast.
        let models = [(4.0, 0.06), (9.0, 0.03), (10.0, 0.01)];
        assert_eq!(front(&models, TIE), [0, 1, 2]);
        for [second, third] in [[9.4, 9.6], [8.6, 10.4]] {
            assert_eq!(front_of_run(&[4.2, second, third], &models, TIE), [0, 1, 2]);
        }
        assert_eq!(front(&[(4.2, 0.06), (9.4, 0.03), (9.6, 0.01)], TIE), [0, 2], "a run by itself is not so sure");
        assert_eq!(front_of_run(&[4.0, 12.0, 10.0], &models, TIE), [0, 2]);
        assert_eq!(front_of_run(&[11.0, 9.0, 10.0], &models, TIE), [1, 2]);
    }
}
