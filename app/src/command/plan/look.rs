//! Looking at a scene, with a bar that tells how far it is.

use anyhow::{Result, bail};
use nbrdf_core::scene::{Gathering, Scene, View};

use super::Opened;
use crate::command::Global;
use crate::failure::Failure;
use crate::progress;

/// What the picture asks for, from the camera of `scene`, which has the same objects.
pub fn from(opened: &Opened, scene: &Scene, global: &Global) -> Result<View> {
    let bar = progress::bar(scene.picture.height as u64, "looking", global.quiet);
    let done = || bar.inc(1);
    let how = Gathering { seed: global.seed(), done: &done, cancelled: &progress::cancelled };
    let Some(view) = opened.view(scene, how) else { bail!("cancelled: nothing was written") };
    bar.finish_and_clear();
    Ok(view)
}

/// The same from the scene's own camera; refuses objects that are not in the picture.
pub fn whole(opened: &Opened, global: &Global) -> Result<View> {
    let view = from(opened, &opened.scene, global)?;
    opened.refuse_unseen(&view)?;
    Ok(view)
}

/// The place of the object of this name; of the only one where there is no name.
pub fn object(opened: &Opened, name: Option<&str>) -> Result<usize> {
    let objects = &opened.scene.objects;
    let names = || objects.iter().map(|object| object.name.as_str());
    let found = match name {
        Some(name) => names().position(|own| own == name),
        None => (objects.len() == 1).then_some(0),
    };
    found.ok_or_else(|| {
        let all = names().collect::<Vec<_>>().join("', '");
        let asked = name.map_or_else(|| "no name".to_owned(), |name| format!("'{name}'"));
        Failure::Usage(format!("--object: expected one of '{all}', found {asked}")).into()
    })
}
