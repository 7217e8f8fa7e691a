//! A motion as comma-separated values: a header, a row a moment.

use super::MotionWriter;
use crate::physics::Observation;
use crate::scene::Scene;
use crate::study::measure::sigma;
use std::io::{self, Write};

struct SeriesWriter<'a> {
    scene: &'a Scene,
    writer: csv::Writer<&'a mut dyn Write>,
}

/// Begins with the header.
pub(super) fn begin<'a>(
    scene: &'a Scene,
    output: &'a mut dyn Write,
) -> io::Result<Box<dyn MotionWriter + 'a>> {
    let mut writer = csv::Writer::from_writer(output);
    writer.write_record(header(scene)).map_err(of_output)?;
    Ok(Box::new(SeriesWriter { scene, writer }))
}

impl MotionWriter for SeriesWriter<'_> {
    fn moment(&mut self, now: &Observation) -> io::Result<()> {
        self.writer
            .serialize(cells(self.scene, now))
            .map_err(of_output)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

fn of_output(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Names of the columns; a lattice also has the places of its beads across.
fn header(scene: &Scene) -> Vec<String> {
    let each = |name: &'static str, n: usize| (1..=n).map(move |bead| format!("{name}{bead}"));
    let across = if scene.sites().is_some() { scene.n } else { 0 };
    let beads = each("x", across).chain(each("z", scene.n));
    let head = ["time", "floor"].map(String::from);
    let tail = ["kinetic", "relative", "sigma"].map(String::from);
    head.into_iter().chain(beads).chain(tail).collect()
}

/// The numbers of a row; σ may be none.
fn cells(scene: &Scene, now: &Observation) -> Vec<Option<f64>> {
    let head = [now.time, now.floor];
    let tail = [now.energy.kinetic, now.energy.relative];
    head.iter()
        .chain(now.discs.iter().flat_map(|discs| &discs.x))
        .chain(&now.reduced)
        .chain(&tail)
        // −0 is a sign that means nothing.
        .map(|&x| Some(x + 0.0))
        .chain([sigma(scene, now.free_flight)])
        .collect()
}
