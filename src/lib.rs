//! beadlab: a terminal laboratory for the detachment effect.
//!
//! Source: Luding, Clément, Blumen, Rajchenbach, Duran (1994), "the paper"
//! throughout. One line a room:
//!
//! - [`math`]: sine, exponential and the like with the same bits on every machine;
//! - [`scene`]: what is simulated, the table of parameters, presets;
//! - [`physics`]: how it moves; pure;
//! - [`study`]: many runs, and what they say; tables and plots;
//! - [`live`]: the simulation thread and its channels;
//! - [`tui`]: the explorer on the terminal;
//! - [`cli`]: the command line's grammar;
//! - [`commands`]: one file a subcommand.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod cli;
pub mod commands;
pub mod live;
pub mod math;
pub mod physics;
pub mod scene;
pub mod study;
pub mod tui;
