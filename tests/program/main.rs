//! The built program as its users meet it: command line, files, signals.

#[path = "../support/program.rs"]
mod program;

mod bad_input;
mod command_line;
mod lattice;
mod motion_series;
mod outputs;
mod replay;
mod resume;
mod sweep;
mod unsound_runs;
