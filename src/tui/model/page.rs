//! The page on the screen: its samples, its vertical scale, its turn.

use std::borrow::Cow;

use super::Ghost;
use super::lens::Lens;
use super::scale::{Scale, extent};
use crate::live::{ColumnSample, History, Sample, Sampling};
use crate::scene::{Launch, Scene, Shake};

/// Everything the traces are drawn from.
#[derive(Debug, Clone)]
pub struct Page {
    /// Length and sampling of the page.
    pub sweep: Sampling,
    /// Samples of this page, and those of the last one that are not written over.
    pub samples: History,
    /// Vertical scale of heights.
    pub scale: Scale,
    /// What small motion is looked at through.
    pub lens: Option<Lens>,
    /// An earlier page that is kept behind it.
    pub ghost: Option<Ghost>,
    /// Where the pen is, s.
    pub now: f64,
    /// No scale is smaller than this, m: the noise of a column at rest is not shown.
    least: f64,
}

/// The least scale as a part of the one expected.
const LEAST: f64 = 0.01;

impl Page {
    /// An empty page for these scenes.
    pub fn new(sweep: Sampling, scenes: &[Scene]) -> Page {
        let scale = expected(scenes, sweep.span);
        Page {
            sweep,
            samples: History::new(sweep.columns + 1),
            scale,
            lens: None,
            ghost: None,
            now: 0.0,
            least: LEAST * (scale.top() - scale.bottom()),
        }
    }

    /// The same page with a ghost behind it, for which its scale has room.
    #[must_use]
    pub(super) fn behind(mut self, ghost: Option<Ghost>) -> Page {
        if let Some((bottom, top)) = ghost.as_ref().and_then(Ghost::extent) {
            self.scale = self.scale.grown(bottom, top);
        }
        self.ghost = ghost;
        self
    }

    /// Keeps what is drawn as the ghost of pages to come, of a plate with that period, s;
    /// whether there was anything.
    pub(in crate::tui) fn keep_ghost(&mut self, period: Option<f64>) -> bool {
        let span = self.sweep.span;
        let visible = self.visible(0.0);
        let samples: Vec<(f64, Sample)> = visible
            .map(|(place, sample)| (place * span, sample.clone()))
            .collect();
        let any = !samples.is_empty();
        let (start, _) = self.begun();
        self.ghost = any.then(|| Ghost::new(samples, self.lens.clone(), start, period));
        any
    }

    /// The ghost, if it is seen: that of a page through the lens through the lens.
    pub fn shown_ghost(&self) -> Option<&Ghost> {
        let ghost = self.ghost.as_ref();
        ghost.filter(|ghost| ghost.lens().is_some() == self.lens.is_some())
    }

    /// What is drawn of a column of the ghost, with its places on the page from 0 to 1, in the
    /// order in which it was taken; none where there is a gap.
    pub fn ghost_rows(
        &self,
        side: usize,
    ) -> impl Iterator<Item = (f64, Option<Cow<'_, ColumnSample>>)> {
        let ghost = self.shown_ghost().into_iter();
        ghost.flat_map(move |ghost| ghost.rows(side, self.sweep.span, self.lens.as_ref()))
    }

    /// Puts the ghost where the plate, which has that period, s, has the phase of then.
    pub(super) fn align_ghost(&mut self, period: Option<f64>) {
        let (start, _) = self.begun();
        if let Some(ghost) = &mut self.ghost {
            ghost.align(&self.sweep, start, period);
        }
    }

    /// The ghost's columns become those that the present ones come from.
    pub(in crate::tui) fn rearrange_ghost(&mut self, from: &[usize]) {
        if let Some(ghost) = &mut self.ghost {
            ghost.rearrange(from);
        }
    }

    /// Takes in the new samples, or those of the `whole` page in place of all others, now
    /// that simulated time has come to `time`; whether the page was turned.
    pub fn take(&mut self, time: f64, history: History, whole: bool) -> bool {
        if whole || time < self.now {
            self.samples.clear();
        }
        let turned = !whole && self.sweep.page(time) > self.sweep.page(self.now);
        self.now = time;
        let ghost = self.ghost.as_ref();
        let behind = ghost.and_then(Ghost::extent);
        let both = |(bottom, top): (f64, f64)| {
            behind.map_or((bottom, top), |(low, high)| {
                (bottom.min(low), top.max(high))
            })
        };
        let seen = extent(self.samples.iter()).map(both);
        if let (true, Some((bottom, top))) = (turned, seen) {
            self.scale = self
                .scale
                .for_next_page(bottom, top.max(bottom + self.least));
        }
        if let Some((bottom, top)) = extent(history.iter()) {
            self.scale = self.scale.grown(bottom, top);
        }
        self.samples.append(history);
        if let Some(lens) = &mut self.lens {
            lens.look(self.samples.iter(), &self.sweep, time);
            if let Some(then) = self.ghost.as_ref().and_then(Ghost::lens) {
                lens.hold(then);
            }
        }
        turned
    }

    /// Vertical scale of the traces.
    pub fn trace_scale(&self) -> &Scale {
        self.lens.as_ref().map_or(&self.scale, |lens| &lens.scale)
    }

    /// What is drawn of a column's sample, if anything.
    pub fn drawn<'a>(
        &self,
        side: usize,
        time: f64,
        row: &'a ColumnSample,
    ) -> Option<Cow<'a, ColumnSample>> {
        match &self.lens {
            None => Some(Cow::Borrowed(row)),
            Some(lens) => lens.heights(side, time, row).map(Cow::Owned),
        }
    }

    /// Another sampling of the page, or one of another length; what was drawn before
    /// it begins is forgotten.
    pub fn set_sweep(&mut self, sweep: Sampling) {
        if sweep.span.to_bits() != self.sweep.span.to_bits() {
            self.samples.forget_before(sweep.origin);
            self.lens = self.lens.take().map(Lens::afresh);
        }
        self.sweep = sweep;
        self.samples.set_capacity(sweep.columns + 1);
    }

    /// The samples with their place on the page from 0 to 1, in the order in which
    /// they were taken, where they are not written over: the old page ends `gap`
    /// (a part of the page) ahead of the pen.
    pub fn visible(&self, gap: f64) -> impl Iterator<Item = (f64, &Sample)> {
        let sweep = self.sweep;
        let columns = sweep.columns as f64;
        let grid = move |time: f64| ((time - sweep.origin) / sweep.interval()).round();
        let (page, pen) = self.pen();
        self.samples.iter().filter_map(move |sample| {
            let index = grid(sample.time);
            let place = index.rem_euclid(columns) / columns;
            let turned = page - (index / columns).floor();
            let old = turned <= 1.0 && place > pen + gap;
            (turned <= 0.0 || old).then_some((place, sample))
        })
    }

    /// The number of the page that the pen is on, and where on it, from 0 to 1. Rounding must
    /// not keep it on a page that is full.
    fn pen(&self) -> (f64, f64) {
        let columns = self.sweep.columns as f64;
        let column = (self.now - self.sweep.origin) / self.sweep.interval() + 1e-6;
        let pages = (column / columns).max(0.0);
        (pages.floor(), pages.fract())
    }

    /// When the page began, s, and where on it the pen is, from 0 to 1.
    pub fn begun(&self) -> (f64, f64) {
        let (page, pen) = self.pen();
        (page.mul_add(self.sweep.span, self.sweep.origin), pen)
    }

    /// The time of what is drawn at a place of the page, from 0 to 1, s: of this page up to
    /// the pen, and of the last one from `gap` ahead of it on.
    pub fn time_at(&self, place: f64, gap: f64) -> Option<f64> {
        let (start, pen) = self.begun();
        let fresh = place.mul_add(self.sweep.span, start);
        if place <= pen {
            return Some(fresh);
        }
        let old = fresh - self.sweep.span;
        // Rounding must not take the first sample's column from it.
        let first = self.samples.iter().next()?.time - 0.5 * self.sweep.interval();
        (place > pen + gap && old >= first).then_some(old)
    }
}

/// A scale to begin with. That of a lattice has room for its flight up to the end of the
/// page: discs are best watched on a scale that stays.
fn expected(scenes: &[Scene], span: f64) -> Scale {
    let (mut bottom, mut top) = (0.0f64, 0.0f64);
    for scene in scenes {
        if let Some(Shake { amplitude, .. }) = scene.shake() {
            bottom = bottom.min(-amplitude);
            top = top.max(4.0 * amplitude);
        }
        if let Some(Launch { s0, v0, .. }) = scene.launch() {
            let overlap = v0.abs() * scene.contact_time().unwrap_or(0.0);
            bottom = bottom.min(-2.0 * overlap);
            top = top.max(s0 * scene.layers() as f64).max(4.0 * overlap);
            if scene.sites().is_some() {
                top = top.max(v0.abs() * span);
            }
        }
    }
    if top <= bottom {
        top = scenes.first().map_or(1e-3, |scene| scene.diameter);
    }
    Scale::holding(bottom, top)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page() -> Page {
        let sweep = Sampling {
            origin: 0.0,
            span: 1.0,
            columns: 10,
            hold: false,
        };
        Page::new(sweep, &[])
    }

    fn take(page: &mut Page, times: &[f64]) -> bool {
        let mut history = History::new(64);
        for &time in times {
            history.push(Sample {
                time,
                rows: Vec::new(),
            });
        }
        page.take(times.last().copied().unwrap_or(0.0), history, false)
    }

    #[test]
    fn the_pen_writes_over_the_old_page() {
        let mut page = page();
        assert!(!take(
            &mut page,
            &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
        ));
        assert!(take(&mut page, &[1.0, 1.1, 1.2]));
        let places: Vec<f64> = page
            .visible(0.15)
            .map(|(place, _)| (place * 10.0).round())
            .collect();
        assert_eq!(places, [4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 0.0, 1.0, 2.0]);
    }

    #[test]
    fn a_restart_empties_the_page() {
        let mut page = page();
        take(&mut page, &[0.0, 0.1, 0.2]);
        take(&mut page, &[0.0, 0.1]);
        assert_eq!(page.samples.len(), 2);
    }
}
