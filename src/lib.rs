//! beadlab: a terminal laboratory for the detachment effect.
//!
//! Molecular-dynamics (MD) simulations with soft contacts of a dense column of beads lose far
//! too little energy, and the column flies apart; event-driven (ED) simulations of hard spheres
//! and experiments do not. The source is Luding, Clément, Blumen, Rajchenbach and Duran (1994),
//! "the paper" throughout.
//!
//! # A column in ten lines
//!
//! ```
//! use beadlab::scene::Preset;
//! use beadlab::study::{Drive, measure};
//! use std::ops::ControlFlow;
//!
//! let soft = Preset::load("fig1a")?.scene;
//! let hard = Preset::load("fig1d")?.scene;
//! let mut watch = |_time| ControlFlow::Continue(());
//! let soft = measure(&soft, &mut Drive::new(&soft, &mut watch))?;
//! let hard = measure(&hard, &mut Drive::new(&hard, &mut watch))?;
//! // The paper: 0.97 of soft beads that touch, 0.34 of hard ones (Sec. III A).
//! assert!((soft.eps_eff.unwrap_or(0.0) - 0.9667).abs() < 1e-3);
//! assert!((hard.eps_eff.unwrap_or(0.0) - 0.3416).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The rooms
//!
//! ```text
//!            commands   one file a subcommand; writes files, prints
//!           /    |    \
//!        tui     |     \      the explorer on the terminal
//!         |      |      \
//!       live     |     study  many runs, and what they say; tables and plots
//!          \     |     /      live: the simulation thread and its channels; what was
//!           tape |    /       a session as lines of text, to be played again; pure
//!            \   |   /
//!             physics         how beads move; pure
//!                |
//!              scene          what is simulated; the table of parameters; presets
//!                |
//!               math          sine, exponential, power: the same bits everywhere
//! ```
//!
//! Arrows would point down: a room uses those below it, never one above, and `study` and
//! `live` do not know each other (but `tui` asks `study` for verdicts). [`cli`] is the command
//! line's grammar, and any room may write numbers by [`numerals`]. `tests/` holds the rooms to
//! this.
//!
//! A run goes so: [`scene::Preset`] reads a TOML file into [`scene::Facts`]; [`scene::Scene`]
//! is facts that were checked, once. [`physics::build`] makes the [`physics::Engine`] of a scene:
//! MD on a grid of time steps, exact, adaptive, ED, or a lattice. Each of these is a mover, and
//! only moves; one shell around it starts it, shows it and hands its state over. What acts on
//! gaps beside contacts is a ground, chosen in one place for all columns. [`study::Drive`] moves
//! an engine in slices of work; [`study::measure`] follows one to its end; [`live`] follows two,
//! beside each other on one clock, for the explorer. Engines can be cloned: `live` keeps clones
//! as moments to go back to, and makes edits again on the way on; [`tape`] writes them down.
//!
//! # Words
//!
//! | word | meaning |
//! |---|---|
//! | ε, restitution | speed after over before, of two beads that collide |
//! | t_c, contact time | how long a soft collision of two beads takes |
//! | overlap, penetration | how deep two soft beads are in each other; a gap below zero |
//! | ε_eff | √(E_f/E_0), of a whole column that hits the floor |
//! | E_r, relative energy | kinetic energy in the centre of mass's frame: granular temperature |
//! | σ | mean free flight over t_c: small where contacts last while the next ones begin |
//! | α | largest acceleration of the plate over gravity; above 1 beads take off |
//! | collapse | inelastic collapse: infinitely many collisions of hard beads in a finite time |
//! | LRV, TC | collision rules of ED: largest relative velocity first; none lost within t_c |
//! | facts, scene | what a file says; the same, checked |
//! | mover | what moves beads by one method; its shell starts it, looks at it and hands it over |
//! | books, ledger | contacts and counts of a run; where its energy went |
//! | moment, past | a clone of both columns at a time; all that can be gone back to |
//! | tape | scenes, edits and hashes of states, as lines of text |
//! | handover | going on from another engine's state, after an edit |
//! | twin | the same column of hard spheres, beside the soft one |
//! | shadow | an exact run that a soft column is held against |
//! | bench | the scenes that are edited; page: the stretch of time on the screen |
//! | receipt | a terminal's answer that it has read a frame |
//!
//! # To add …
//!
//! | what | touch |
//! |---|---|
//! | a contact law | `scene/law.rs` (what it is; the compiler asks for the rest), `physics/contact_law.rs` (its force), a row in `scene/parameters/rows/contact.rs` for each constant, a preset |
//! | a way to move columns | a file in `physics/` with a `Mover`, which `physics.rs` builds over every `Ground` |
//! | what acts on gaps beside contacts | `physics/ground.rs`: a `Ground`, its line in `build`; its energy in `physics/matter.rs`; of a grid what it does to gaps above the lowest in `physics/md/chain.rs` |
//! | a way in which a cluster of the exact engine moves | a file in `physics/exact/plan/`, and its three lines in `plan.rs` |
//! | a parameter | a row in `scene/parameters/rows.rs`, and what it acts on; `--set`, files, help, errors, panel, undo and sweeps read the row |
//! | a measured number | a row in `study/quantity/rows.rs`; `run` in all its formats, `sweep` and the explorer read it; and `study/measure.rs`, if nothing measures it yet |
//! | a figure | a file in `study/figures/`, and its line in `study/figures.rs` |
//! | a view, a key | `tui/keys.rs` (the key and its help), `tui/update.rs` (what it does), a widget in `tui/widgets/` |
//! | an output format | a file in `study/export/`, and its line in `study/export.rs`; `--format` and help read it |
//! | a preset | a file in `presets/`, and its name in `scene/preset/embedded.rs` |

#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod cli;
pub mod commands;
pub mod live;
pub mod math;
pub mod numerals;
pub mod physics;
pub mod scene;
pub mod study;
pub mod tape;
pub mod tui;
