//! What the threads have to say.

use std::path::PathBuf;

use super::{
    Asset, ChartNews, Difference, Figures, Findings, Job, Listed, MapAnswer, Measured, PastedCode, Picture, Point,
    Property, export, scene,
};

/// One sphere of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Card {
    /// The material at this end.
    End(usize),
    /// What an interpolation, by catalog name, makes of the ends.
    Method(&'static str),
    /// What is at a place of the latent map.
    Explored,
}

/// What the threads have to say.
#[derive(Debug)]
pub enum Answer {
    /// A sphere, coarse or fine.
    Picture(Card, Picture),
    /// How a sphere compares with the linear mix; none where the light is too noisy to tell.
    Figures(Card, Option<Figures>),
    /// Qualities of the point a sphere shows; none where they cannot be told.
    Measured(Card, Option<Measured>),
    /// A sphere has to wait for its path.
    Pending(Card),
    /// There is no such sphere.
    Failed(Card, String),
    /// One point of a film strip.
    Frame(Card, usize, Picture),
    /// The request of this number is shown in full.
    Done(u64),
    /// Which path is being prepared, if any.
    Preparing(Option<&'static str>),
    /// A small picture of a material.
    Thumbnail(String, Picture),
    /// Materials were read from a file: names of all that are there now.
    Opened(Vec<String>),
    /// A file was read, and gave these materials; a map or a mesh gives none.
    Kept(PathBuf, Vec<String>),
    /// A file gave nothing, or its fit was cancelled.
    Lost(PathBuf),
    /// A code that was pasted is in the list.
    Pasted(PastedCode),
    /// All files of the last session were read, are missing, or wait to be fitted.
    Reopened,
    /// All fits that run or wait.
    Jobs(Vec<Job>),
    /// Something that a list can be sorted by.
    Property(String, Property),
    /// The system's dialog for files was closed, or cannot be shown, for this reason.
    Dialog(Option<String>),
    /// A map was read: all maps, and which of them is to be shown now, unless it is one of the last session.
    Maps(Vec<Listed>, Option<Asset>),
    /// A mesh was read: all meshes, and which of them is to be shown now, unless it is one of the last session.
    Meshes(Vec<Listed>, Option<Asset>),
    /// How two spheres differ, pixel by pixel.
    Difference(Difference),
    /// Directions and values at one place of the spheres.
    Point(Point),
    /// A figure, coarse or fine.
    Findings(Box<Findings>),
    /// How far the chart of all representations has come.
    Chart(Box<ChartNews>),
    /// The latent map.
    Map(MapAnswer),
    /// Something about the scene that is planned.
    Scene(scene::News),
    /// Of files that are written.
    Export(export::News),
    /// Something to tell the user.
    Notice(String),
}
