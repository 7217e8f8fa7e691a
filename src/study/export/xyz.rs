//! A motion as extended XYZ: a frame a moment, which OVITO, ASE and others read.
//!
//! Heights are those of the beads' centres over the floor's rest position, not reduced.

use super::{Format, MotionWriter};
use crate::physics::Observation;
use crate::scene::{Scene, diameters};
use std::io::{self, Write};

pub(super) const FORMAT: Format = Format {
    name: "xyz",
    meaning: "Extended XYZ: with --every, the motion as frames",
    for_people: false,
    results: None,
    motion: Some(begin),
};

struct Frames<'a> {
    radii: Vec<f64>,
    /// Heights of the centres of beads that just touch on a floor at 0, m.
    standing: Vec<f64>,
    output: &'a mut dyn Write,
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "other formats have a header to write"
)]
/// Begins with nothing: every frame says itself what it has.
fn begin<'a>(
    scene: &'a Scene,
    output: &'a mut dyn Write,
) -> io::Result<Box<dyn MotionWriter + 'a>> {
    let diameters = diameters(scene);
    let mut below = 0.0;
    let standing = diameters.iter().map(|d| {
        below += d;
        below - 0.5 * d
    });
    Ok(Box::new(Frames {
        standing: standing.collect(),
        radii: diameters.iter().map(|d| 0.5 * d).collect(),
        output,
    }))
}

impl MotionWriter for Frames<'_> {
    fn moment(&mut self, now: &Observation) -> io::Result<()> {
        writeln!(self.output, "{}", now.reduced.len())?;
        writeln!(
            self.output,
            "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1 pbc=\"F F F\" Time={} Floor={}",
            now.time + 0.0,
            now.floor + 0.0
        )?;
        for (k, velocity) in now.velocities.iter().enumerate() {
            let (x, z) = match &now.discs {
                Some(discs) => (discs.x[k], discs.heights[k]),
                None => (0.0, self.standing[k] + now.reduced[k]),
            };
            let radius = self.radii[k];
            // −0 is a sign that means nothing.
            let (x, z, w) = (x + 0.0, z + 0.0, velocity + 0.0);
            writeln!(self.output, "B {x} 0 {z} 0 0 {w} {radius}")?;
        }
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}
