//! Studies: what they find, by the library and by the built program.

#[path = "../support/program.rs"]
mod program;
#[path = "../support/scenes.rs"]
mod scenes;

mod advise;
mod digits;
mod figure4;
mod figures;
mod means;
mod studies;
mod tables_and_plots;
