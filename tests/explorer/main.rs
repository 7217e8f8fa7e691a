//! The explorer: keys on its model, its simulation thread, its loop on a screen in memory, and
//! the built program on pseudo-terminals.

#[path = "../support/dice.rs"]
mod dice;

mod play;
mod screen;
#[cfg(target_os = "linux")]
mod session;
#[cfg(target_os = "linux")]
mod slow_proxy;
mod typist;

mod discs;
#[cfg(target_os = "linux")]
mod fuzz;
mod keys;
mod live;
mod methods;
mod past;
mod prompt;
mod screens;
mod shadow;
#[cfg(target_os = "linux")]
mod slow_link;
mod tape;
#[cfg(target_os = "linux")]
mod terminal;
mod verdict;
