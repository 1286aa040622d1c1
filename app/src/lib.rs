//! The tool: command line and desktop app.

pub mod catalog;
pub mod cli;
pub mod command;
pub mod editor;
pub mod exported;
pub mod failure;
pub mod families;
pub mod fitted;
#[cfg(feature = "gui")]
pub mod gui;
pub mod input;
pub mod material;
pub mod measure;
pub mod output;
pub mod progress;
pub mod report;
pub mod shell;
pub mod strip;
pub mod visible;
#[cfg(feature = "gui")]
pub mod worker;
