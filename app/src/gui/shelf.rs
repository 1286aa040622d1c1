//! The library: every material, to be put at an end, and files to be opened.

mod controls;
mod entry;
mod grid;
mod jobs;
mod opener;
mod row;
mod star;

use std::path::PathBuf;

use egui::{RichText, ScrollArea, TextEdit, Ui, vec2};

use super::session::{Listing, Sort};
use super::{Gallery, Session};
use crate::worker::Inquiry;

pub use opener::Opener;

/// What the library cannot do itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Errand {
    /// Show the system's dialog for files.
    Choose,
    /// Read a file.
    Open(PathBuf),
    /// End a fit.
    Cancel(u64),
}

/// The library.
pub struct Shelf<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
    /// Whether the search field is to have the focus.
    pub is_searching: &'a mut bool,
    /// Where paths are typed.
    pub opener: &'a mut Opener,
    pub errands: &'a mut Vec<Errand>,
}

impl Shelf<'_> {
    /// What has to be known of all materials for this order.
    pub fn show(mut self, ui: &mut Ui) -> Option<Inquiry> {
        self.search(ui);
        controls::show(ui, &mut self.session.listing, self.opener, self.errands);
        let paths = self.opener.show(ui, self.gallery.dialog.as_deref());
        self.errands.extend(paths.into_iter().map(Errand::Open));
        jobs::show(ui, &self.gallery.jobs, self.errands);
        let (names, sort) = (&self.gallery.names, self.session.listing.sort);
        let listed = self.session.listing.order(names, |name| value(sort, self.gallery, name));
        let about = match listed.len() == names.len() {
            true => "Click for A, shift-click for B, or drag".to_owned(),
            false => format!("{} of {} materials", listed.len(), names.len()),
        };
        ui.add(egui::Label::new(RichText::new(about).small().weak()).truncate());
        if listed.is_empty() {
            nothing(ui, &mut self.session.listing);
        }
        self.list(ui, &listed);
        inquiry(sort)
    }

    fn search(&mut self, ui: &mut Ui) {
        let hint = format!("Search {} materials", self.gallery.names.len());
        let field = TextEdit::singleline(&mut self.session.listing.search)
            .hint_text(hint)
            .desired_width(f32::INFINITY)
            .margin(vec2(8.0, 6.0));
        let field = ui.add(field).on_hover_text("Words in any order (Ctrl+F)");
        if std::mem::take(self.is_searching) {
            field.request_focus();
        }
    }

    fn list(&mut self, ui: &mut Ui, listed: &[&str]) {
        let area = ScrollArea::vertical().auto_shrink(false);
        if self.session.listing.is_grid {
            let columns = grid::columns(ui.available_width());
            ui.spacing_mut().item_spacing.y = grid::GAP;
            area.show_rows(ui, grid::CELL, listed.len().div_ceil(columns), |ui, range| {
                for line in listed.chunks(columns).skip(range.start).take(range.len()) {
                    grid::line(ui, self.session, self.gallery, line);
                }
            });
        } else {
            ui.spacing_mut().item_spacing.y = 2.0;
            area.show_rows(ui, row::HEIGHT, listed.len(), |ui, range| {
                for name in &listed[range] {
                    ui.push_id(name, |ui| row::show(ui, self.session, self.gallery, name));
                }
            });
        }
    }
}

/// What a material is sorted by, in the unit it is shown in; none before it is known.
fn value(sort: Sort, gallery: &Gallery, name: &str) -> Option<f64> {
    let qualities = || gallery.qualities(name);
    match sort {
        Sort::Database | Sort::Name => None,
        Sort::Lightness => qualities().map(|[lightness, _, _]| 100.0 * lightness),
        Sort::Gloss => qualities().map(|[_, gloss, _]| gloss),
        Sort::Roughness => qualities().map(|[_, _, roughness]| roughness),
        Sort::Error => gallery.error(name),
    }
}

const fn inquiry(sort: Sort) -> Option<Inquiry> {
    match sort {
        Sort::Database | Sort::Name => None,
        Sort::Lightness | Sort::Gloss | Sort::Roughness => Some(Inquiry::Qualities),
        Sort::Error => Some(Inquiry::Error),
    }
}

/// Why the list is empty, and the way out.
fn nothing(ui: &mut Ui, listing: &mut Listing) {
    ui.add_space(24.0);
    ui.vertical_centered(|ui| {
        let text = match (listing.is_favourites && listing.favourites.is_empty(), listing.is_filtered()) {
            (true, _) => "There are no favourites yet: click the star on a material.",
            (false, true) => "No material has such a name and passes the filter.",
            (false, false) => "No material has such a name.",
        };
        ui.label(RichText::new(text).weak());
        if !listing.search.is_empty() && ui.button("Clear search").clicked() {
            listing.search.clear();
        }
        if listing.is_filtered() && ui.button("Clear filter").clicked() {
            listing.clear_filters();
        }
    });
}
