//! Studies: runs without a screen, many of them, and what they say.
//!
//! A study takes scenes and gives numbers, tables and plots. It prints nothing; who
//! waits for it is told through a callback how far it is, and may stop it.

mod drive;
mod measure;
pub mod plot;
pub mod table;

pub use drive::{Drive, RunError, Watch, natural_time};
pub use measure::{Results, measure};
