//! What the worker answered about a scene.

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use crate::worker::scene::{News, Planned, Run, Sight, Still};

/// A scene, as far as it is seen and planned.
#[derive(Default)]
pub struct Tableau {
    /// The picture of the materials themselves.
    pub reference: Option<TextureHandle>,
    /// The picture of the models.
    pub planned: Option<TextureHandle>,
    /// Their difference.
    pub difference: Option<TextureHandle>,
    /// The newest plan.
    pub plan: Option<Planned>,
    /// What is being done.
    pub doing: String,
    /// Why there is nothing.
    pub failure: Option<String>,
    /// The tolerance that the scene asks for itself.
    pub tolerance: Option<f64>,
    /// Whether the user has stopped it.
    pub is_stopped: bool,
    sight: Option<Sight>,
    asked: u64,
    done: u64,
}

impl Tableau {
    /// Notes that something was asked for.
    pub fn ask(&mut self, number: u64) {
        self.asked = number;
        self.is_stopped = false;
        self.failure = None;
    }

    /// Whether an answer is on its way.
    pub const fn is_busy(&self) -> bool {
        self.done < self.asked
    }

    /// Takes news in.
    pub fn take(&mut self, context: &Context, news: News) {
        match news {
            // The session knows which scene is meant.
            News::Named(_) => {}
            News::Reading => *self = Self { asked: self.asked, done: self.done, ..Self::default() },
            News::Read(tolerance) => self.tolerance = tolerance,
            News::Doing(what) => self.doing = what,
            News::Seen(sight) => {
                show(context, &mut self.reference, &sight.reference);
                self.sight = Some(*sight);
            }
            News::Planned(plan) => {
                show(context, &mut self.planned, &plan.picture);
                show(context, &mut self.difference, &plan.difference);
                self.plan = Some(*plan);
            }
            News::Failed(why) => self.failure = Some(why),
            News::Stopped => self.is_stopped = true,
            News::Done(number) => self.done = number,
        }
    }

    /// The object at this place of the picture, 0..1 from its top left.
    pub fn object_at(&self, [x, y]: [f32; 2]) -> Option<&str> {
        let sight = self.sight.as_ref()?;
        let [width, height] = sight.reference.size;
        let pixel = |share: f32, side: usize| ((share * side as f32).max(0.0) as usize).min(side.saturating_sub(1));
        let owner = *sight.owners.get(pixel(y, height) * width + pixel(x, width))?;
        owner.map(|object| sight.objects[object].as_str())
    }

    /// The rim of an object, in pixels from the top left.
    pub fn outline(&self, object: &str) -> &[Run] {
        let found = |sight: &Sight| sight.objects.iter().position(|name| name == object);
        let outline = self.sight.as_ref().and_then(|sight| Some(sight.outlines[found(sight)?].as_slice()));
        outline.unwrap_or_default()
    }

    /// Pixels per row, and rows.
    pub fn size(&self) -> Option<[usize; 2]> {
        self.sight.as_ref().map(|sight| sight.reference.size)
    }
}

fn show(context: &Context, texture: &mut Option<TextureHandle>, still: &Still) {
    let image = ColorImage::from_rgb(still.size, &still.rgb);
    match texture {
        Some(texture) => texture.set(image, TextureOptions::LINEAR),
        None => *texture = Some(context.load_texture("scene", image, TextureOptions::LINEAR)),
    }
}
