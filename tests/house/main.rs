//! What the house holds: its rooms, its presets, and that they move as they did.

#[path = "../support/program.rs"]
mod program;

mod source;
mod top_level;

mod circles;
mod names;
mod preset_files;
mod presets;
mod rooms;
mod same_bits;
