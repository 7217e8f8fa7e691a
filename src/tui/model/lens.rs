//! How a page shows motion that is small beside the heights: each bead by how far it has
//! moved since the page began, one above the other.

use super::Scale;
use crate::live::{ColumnSample, Sample, Sampling};

/// Bead lines are apart by this part of the longest way.
const APART: f64 = 0.4;

/// The places that motion is drawn from.
#[derive(Debug, Clone)]
pub struct Lens {
    /// The first sample of the page.
    first: Option<Sample>,
    /// The least motion that is looked for, m.
    least: f64,
    /// Distance of two lines, m.
    step: f64,
    /// How many lines there are above the floor's.
    lines: usize,
    /// The scale of the lines.
    pub scale: Scale,
}

impl Lens {
    /// A lens on a page that is to begin, for motion of about this size, m.
    pub fn new(size: f64) -> Lens {
        Lens {
            first: None,
            least: size,
            step: APART * size,
            lines: 1,
            scale: Scale::holding(0.0, size),
        }
    }

    /// The same lens on a page that begins: what moved before tells nothing.
    #[must_use]
    pub fn afresh(self) -> Lens {
        Lens::new(self.least)
    }

    /// Looks at the samples of the page that holds `now`, s.
    pub fn look<'a>(
        &mut self,
        samples: impl Iterator<Item = &'a Sample>,
        sweep: &Sampling,
        now: f64,
    ) {
        let start = sweep.page_start(now) - 0.5 * sweep.interval();
        let mut page = samples.filter(|sample| sample.time >= start).peekable();
        self.first = page.peek().copied().cloned();
        let mut longest = 0.0f64;
        self.lines = 1;
        for sample in page {
            for (side, row) in sample.rows.iter().enumerate() {
                let Some(row) = row else { continue };
                self.lines = self.lines.max(row.reduced.len());
                for way in self.ways(side, row) {
                    longest = longest.max(way.abs());
                }
            }
        }
        // It grows by steps, so that lines are not drawn anew all the time.
        while APART * longest > self.step {
            self.step *= 2.0;
        }
        self.fit_scale();
    }

    /// Has room for what another lens shows too.
    pub fn hold(&mut self, other: &Lens) {
        self.step = self.step.max(other.step);
        self.lines = self.lines.max(other.lines);
        self.fit_scale();
    }

    fn fit_scale(&mut self) {
        let top = self.step * (self.lines as f64 + 1.0);
        self.scale = Scale::holding(-self.step, top);
    }

    /// How far the floor and the beads of a column have moved, m, from the floor up.
    fn ways<'a>(&'a self, side: usize, row: &'a ColumnSample) -> impl Iterator<Item = f64> + 'a {
        let first = self
            .first
            .as_ref()
            .and_then(|sample| sample.rows.get(side)?.as_ref());
        let from =
            first.map(|first| std::iter::once(first.floor).chain(first.reduced.iter().copied()));
        let now = std::iter::once(row.floor).chain(row.reduced.iter().copied());
        now.zip(from.into_iter().flatten())
            .map(|(now, from)| f64::from(now) - f64::from(from))
    }

    /// Where the floor and the beads are drawn, m; none of a page before.
    pub fn heights(&self, side: usize, time: f64, row: &ColumnSample) -> Option<ColumnSample> {
        self.heights_as(self, side, time, row)
    }

    /// The same of a page that another lens was on, with the lines apart as here.
    pub fn heights_as(
        &self,
        other: &Lens,
        side: usize,
        time: f64,
        row: &ColumnSample,
    ) -> Option<ColumnSample> {
        let first = other.first.as_ref()?;
        if time < first.time {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "drawn, not computed with")]
        let mut lines = (0u32..)
            .zip(other.ways(side, row))
            .map(|(k, way)| (f64::from(k) * self.step + way) as f32);
        let floor = lines.next()?;
        Some(ColumnSample {
            floor,
            reduced: lines.collect(),
            ..row.clone()
        })
    }
}
