//! A plan beside that of somebody who tries everything.

use std::time::Instant;

use anyhow::Result;
use nbrdf_core::plan::{Models, Options, Plan, Planner};
use serde_json::{Value, json};

use super::{Opened, watched};
use crate::command::Global;

/// How many objects take the same model when every model is made of every material and rendered, and what that costs.
/// Models that both have made count the times that the plan has measured, so that the two differ in nothing but what they
/// tried; fits are made anew.
pub fn json(
    opened: &Opened,
    planner: &Planner,
    plan: &Plan,
    options: Options,
    seconds: f64,
    global: &Global,
) -> Result<Value> {
    let ladder = opened.new_ladder()?;
    let models = Models::new(&opened.materials, &ladder);
    let start = Instant::now();
    let everything = Planner::new(planner.view(), &models, &opened.material)?;
    everything.take_times(planner);
    let exhaustive = watched(&everything, Options { exhaustive: true, ..options }, global)?;
    let exhaustive_s = start.elapsed().as_secs_f64();
    let differs = |object: &usize| plan.choices[*object].rung != exhaustive.choices[*object].rung;
    let difference = |object: usize| {
        let [own, other] = [plan, &exhaustive].map(|plan| &opened.ladder[plan.choices[object].rung].name);
        json!({"object": opened.scene.objects[object].name, "plan": own, "exhaustive": other})
    };
    let differences: Vec<Value> = (0..plan.choices.len()).filter(differs).map(difference).collect();
    let count = plan.choices.len();
    Ok(json!({
        "agreement": (count - differences.len()) as f64 / count as f64, "differences": differences,
        "seconds": seconds, "exhaustive_s": exhaustive_s, "share_of_time": seconds / exhaustive_s,
        "models_tried": exhaustive.tried,
    }))
}

/// The same for people; nothing where nothing was checked.
pub fn text(check: &Value) -> String {
    let number = |key: &str| check[key].as_f64().unwrap_or(f64::NAN);
    let Some(differences) = check["differences"].as_array() else { return String::new() };
    let different = differences.iter().map(|own| {
        let word = |key: &str| own[key].as_str().unwrap_or_default().to_owned();
        format!("; {}: {} instead of {}", word("object"), word("plan"), word("exhaustive"))
    });
    format!(
        "every model on every object: the same choice for {:.0} % of the objects, in {:.1} s ({:.0} %){}\n",
        100.0 * number("agreement"),
        number("exhaustive_s"),
        100.0 * number("share_of_time"),
        different.collect::<String>()
    )
}
