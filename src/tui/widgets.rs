//! What the screen is made of, one widget a file.

pub mod accuracy;
pub mod axis;
pub mod beads;
pub mod details;
pub mod discs;
pub mod footer;
pub mod header;
pub mod help;
pub mod menu;
pub mod parameters;
pub mod past;
pub mod prompt;
pub mod raster;
pub mod rules;
pub mod sigma;
pub mod strip;
pub mod time;
pub mod title;
pub mod trace;
pub mod verdict;
