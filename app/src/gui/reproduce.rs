//! The present state as a line for the shell.

mod draw;
mod line;
mod unsaid;

use super::Session;
use super::session::What;
use crate::worker::Card;
use crate::worker::export::{Goods, PictureForm};
use draw::{At, blend, render};

/// What is said of an explored card.
const EXPLORED: &str = "a place of the latent map has no command";

/// The command that draws what the window shows.
pub fn command(session: &Session) -> String {
    let methods = &session.methods.0;
    let mut line = blend(session, At::Here, methods, 128, "blend.png");
    if methods.is_empty() {
        line.remarks.push("without a method, all of them are drawn".to_owned());
    }
    if session.explored.is_some() {
        line.remarks.push(format!("left out: {EXPLORED}"));
    }
    line.seen(session, At::Here, PictureForm::Png);
    line.text()
}

/// The command that makes what is written to files, or comes near it.
///
/// # Errors
/// Why there is none.
pub fn export(session: &Session, goods: &Goods) -> Result<String, String> {
    let name = session.export_name();
    let picture = |form: PictureForm| format!("{name}.{}", form.extension());
    let mut line = match *goods {
        Goods::Picture { card: Card::End(end), form, size } => render(session, end, size, &picture(form)),
        Goods::Picture { card: Card::Method(method), form, size } => {
            let mut line = blend(session, At::Here, &[method], size, &picture(form));
            if form == PictureForm::Png {
                line.remarks.push("its PNG has labels".to_owned());
            }
            line
        }
        Goods::Material { card: Card::Explored, .. } | Goods::Picture { card: Card::Explored, .. } => {
            return Err(EXPLORED.to_owned());
        }
        Goods::Strip { form, size, steps } => {
            blend(session, At::Steps(steps), &session.methods.0, size, &picture(form))
        }
        Goods::Material { card: Card::End(end), .. } => render(session, end, 512, &picture(PictureForm::Png)),
        Goods::Material { card: Card::Method(method), .. } => {
            blend(session, At::Here, &[method], 128, &picture(PictureForm::Png))
        }
        Goods::Steps { method, steps, .. } => {
            blend(session, At::Steps(steps), &[method], 128, &picture(PictureForm::Png))
        }
        Goods::Curve { steps } => blend(session, At::Steps(steps), &session.methods.0, 128, &picture(PictureForm::Png)),
    };
    let what = session.export.what;
    if !matches!(what, What::Picture | What::Strip) {
        line.remarks
            .insert(0, format!("a picture of it, the command line writes no {}", what.about()[0].to_lowercase()));
    }
    match *goods {
        Goods::Picture { form, .. } => line.seen(session, At::Here, form),
        Goods::Strip { form, steps, .. } => line.seen(session, At::Steps(steps), form),
        // Materials and figures are the same however they are looked at.
        Goods::Material { .. } | Goods::Steps { .. } | Goods::Curve { .. } => {}
    }
    Ok(line.text())
}

#[cfg(test)]
mod tests;
