//! How results and motions are written: a format is a file of this folder and its lines
//! here.

mod csv;
mod json;
mod series;
mod text;
mod xyz;

use super::findings::Finding;
use crate::physics::Observation;
use crate::scene::Scene;
use std::io::{self, Write};

/// All formats, as help lists them.
pub static FORMATS: [Format; 4] = [text::FORMAT, json::FORMAT, csv::FORMAT, xyz::FORMAT];

/// A format of `beadlab run`.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Whether it is for people, who like to know how long it took.
    pub for_people: bool,
    /// Writes the results of a preset with that title, with a newline at the end.
    pub results: Option<fn(&str, &[Finding]) -> String>,
    /// Begins to write a scene's motion.
    pub motion: Option<Begin>,
}

/// What begins to write the motion of a scene.
pub type Begin = for<'a> fn(&'a Scene, &'a mut dyn Write) -> io::Result<Box<dyn MotionWriter + 'a>>;

/// A motion that is written, moment by moment.
pub trait MotionWriter {
    /// Writes a moment, all of whose numbers are finite.
    ///
    /// # Errors
    /// As the writer.
    fn moment(&mut self, now: &Observation) -> io::Result<()>;

    /// Passes on what was written.
    ///
    /// # Errors
    /// As the writer.
    fn flush(&mut self) -> io::Result<()>;
}

/// Whether all numbers of a moment are finite.
pub fn is_finite(now: &Observation) -> bool {
    let energies = [now.energy.kinetic, now.energy.relative];
    let across = now.discs.iter().flat_map(|discs| &discs.x);
    [now.time, now.floor]
        .iter()
        .chain(&energies)
        .chain(across)
        .chain(&now.reduced)
        .chain(&now.free_flight)
        .all(|x| x.is_finite())
}
