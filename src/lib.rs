//! beadlab: a terminal laboratory for the detachment effect.
//!
//! Source: Luding, Clément, Blumen, Rajchenbach, Duran (1994), "the paper"
//! throughout. One line a room:
//!
//! - [`scene`]: what is simulated, the table of parameters, presets;
//! - [`physics`]: how it moves; pure;
//! - [`study`]: many runs, and what they say; tables and plots;
//! - [`live`]: the simulation thread and its channels;
//! - [`tui`]: the explorer on the terminal;
//! - [`cli`]: the command line's grammar;
//! - [`commands`]: one file a subcommand.

pub mod cli;
pub mod commands;
pub mod live;
pub mod physics;
pub mod scene;
pub mod study;
pub mod tui;
