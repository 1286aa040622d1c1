//! The commands that draw: blends, and materials as they are.

use super::line::Line;
use super::unsaid::walked;
use crate::gui::Session;
use crate::worker::export::SAMPLES;
use crate::worker::{Asset, Lighting};

/// Where on the path.
#[derive(Clone, Copy)]
pub enum At {
    Here,
    Steps(u16),
}

/// Points between materials.
pub fn blend(session: &Session, at: At, methods: &[&str], size: u16, output: &str) -> Line {
    let blend = &session.blend;
    let mut line = Line::default();
    line.say("blend");
    let mut options = Line::default();
    match at {
        At::Steps(steps) => options.option("steps", steps),
        At::Here if blend.ends.len() == 2 => options.option("at", blend.t),
        At::Here => {
            let weights: Vec<String> = blend.weights().as_slice().iter().map(f32::to_string).collect();
            options.option("at", weights.join(","));
        }
    }
    methods.iter().for_each(|method| options.option("method", method));
    match session.look.scenery.lighting {
        lighting @ (Lighting::Studio | Lighting::Point(_)) => options.lamps(lighting),
        Lighting::Around { .. } => {
            options.option("light", "studio");
            options.remarks.push("light from all around: see nbrdf render --environment".to_owned());
        }
    }
    options.remarks.extend(walked(session, at));
    options.picture(session, size, output);
    line.with_materials(&blend.ends, options)
}

/// A material.
pub fn render(session: &Session, end: usize, size: u16, output: &str) -> Line {
    let mut line = Line::default();
    line.say("render");
    let mut options = Line::default();
    match session.look.scenery.lighting {
        lighting @ (Lighting::Studio | Lighting::Point(_)) => options.lamps(lighting),
        Lighting::Around { map, turn } => {
            options.option("environment", "softboxes");
            options.option("rotate", turn.to_degrees());
            options.option("samples", SAMPLES);
            if map != Asset::BuiltIn {
                options.remarks.push("name the file of the map in place of softboxes".to_owned());
            }
        }
    }
    options.picture(session, size, output);
    line.with_materials(&session.blend.ends[end..=end], options)
}
