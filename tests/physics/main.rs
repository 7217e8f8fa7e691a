//! Engines and what they are held against: closed forms, slow programs that share no code with
//! them, numbers of 32 digits, and one another.

#[path = "../support/dice.rs"]
mod dice;
#[path = "../support/scenes.rs"]
mod scenes;

mod double_double;
mod oracle;
mod sampled_roots;

mod clones;
mod collapse;
mod edits;
mod engines;
mod exact;
mod exact_motion;
mod exact_random;
mod lattice;
mod lattice_reference;
mod matrix;
mod paper;
mod plate;
mod power_law_runs;
mod power_laws;
mod power_laws_random;
mod random_scenes;
mod reference;
