//! A page that is kept and stays behind those that follow.

use std::borrow::Cow;

use super::lens::Lens;
use super::scale::extent;
use crate::live::{ColumnSample, Sample, Sampling};

/// A page that is kept.
#[derive(Debug, Clone)]
pub struct Ghost {
    /// Its samples, each with how long after the begin of a page it stands, s, in the order in
    /// which they were taken.
    samples: Vec<(f64, Sample)>,
    /// What it was seen through.
    lens: Option<Lens>,
    /// When it began, s.
    start: f64,
    /// The period of the plate then, s, as long as that is the plate's still.
    period: Option<f64>,
    /// How much later on a page all of it stands now, s, for the sake of the plate's phase.
    shift: f64,
}

impl Ghost {
    /// The ghost of a page that began at `start`, s, was seen through that lens and whose plate
    /// has that period, s; each sample with how long after the page's begin it stands.
    pub(super) fn new(
        samples: Vec<(f64, Sample)>,
        lens: Option<Lens>,
        start: f64,
        period: Option<f64>,
    ) -> Ghost {
        Ghost {
            samples,
            lens,
            start,
            period,
            shift: 0.0,
        }
    }

    /// Its samples.
    pub fn samples(&self) -> impl Iterator<Item = &Sample> {
        self.samples.iter().map(|(_, sample)| sample)
    }

    /// What it was seen through.
    pub(super) fn lens(&self) -> Option<&Lens> {
        self.lens.as_ref()
    }

    /// The lowest and the highest thing in it, m, where it is drawn as it is.
    pub(super) fn extent(&self) -> Option<(f64, f64)> {
        match self.lens {
            Some(_) => None,
            None => extent(self.samples()),
        }
    }

    /// Puts it where the plate of a page that began at `start`, s, has the phase that it had
    /// then, if it has that period still and a page is as long as one.
    pub(super) fn align(&mut self, sweep: &Sampling, start: f64, period: Option<f64>) {
        // Who changed the frequency changed the phase too.
        self.period = self.period.filter(|_| self.period == period);
        let held = self.period.filter(|period| *period <= sweep.span);
        let apart = self.start - start;
        let shift = held.map_or(0.0, |period| apart - period * (apart / period).round());
        // Rounding must not move it by a dot.
        let least = 0.5 * sweep.interval();
        self.shift = if self.lens.is_some() || shift.abs() < least {
            0.0
        } else {
            shift
        };
    }

    /// Its columns are those that the present ones come from.
    pub(super) fn rearrange(&mut self, from: &[usize]) {
        for (_, Sample { rows, .. }) in &mut self.samples {
            let row = |&side: &usize| rows.get(side).cloned().flatten();
            *rows = from.iter().map(row).collect();
        }
    }

    /// What is drawn of a column on a page of that span, s, through that lens, with its places
    /// on the page from 0 to 1, in the order in which it was taken; none where there is a gap.
    pub(super) fn rows<'a>(
        &'a self,
        side: usize,
        span: f64,
        lens: Option<&'a Lens>,
    ) -> impl Iterator<Item = (f64, Option<Cow<'a, ColumnSample>>)> {
        let lenses = self.lens.as_ref().zip(lens);
        self.samples.iter().map(move |(after, sample)| {
            let place = (after + self.shift) / span;
            let row = sample.rows.get(side).and_then(Option::as_ref);
            let drawn = row.and_then(|row| match lenses {
                None => Some(Cow::Borrowed(row)),
                Some((then, now)) => now.heights_as(then, side, sample.time, row).map(Cow::Owned),
            });
            let on_page = (0.0..1.0).contains(&place);
            (place, drawn.filter(|_| on_page))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::History;
    use crate::tui::model::Page;

    const PERIOD: f64 = 0.04;

    /// A page of samples at heights that tell the plate's phase.
    fn page(origin: f64, from: f64, to: f64) -> Page {
        let sweep = Sampling {
            origin,
            span: 0.2,
            columns: 100,
            hold: false,
        };
        let mut page = Page::new(sweep, &[]);
        fill(&mut page, from, to, 1e-3);
        page
    }

    fn fill(page: &mut Page, from: f64, to: f64, height: f32) {
        let mut history = History::new(300);
        let mut number = page.sweep.next_sample(from, 1);
        while page.sweep.sample_time(number) <= to {
            let time = page.sweep.sample_time(number);
            #[expect(clippy::cast_possible_truncation, reason = "a phase")]
            let floor = (time / PERIOD).rem_euclid(1.0) as f32 * 1e-4;
            let row = ColumnSample {
                floor,
                reduced: vec![height],
                kinetic: 1.0,
                relative: 0.5,
                error: None,
            };
            let rows = vec![Some(row.clone()), Some(row)];
            history.push(Sample { time, rows });
            number += 1;
        }
        page.take(to, history, false);
    }

    fn keep(page: &mut Page) {
        assert!(page.keep_ghost(Some(PERIOD)) && page.shown_ghost().is_some());
    }

    fn rows(page: &Page) -> Vec<(f64, ColumnSample)> {
        let rows = page.ghost_rows(0);
        rows.filter_map(|(place, row)| Some((place, row?.into_owned())))
            .collect()
    }

    /// A page that turns, and one of a restart: the same heights at the same places.
    #[test]
    fn a_ghost_stands_where_its_page_was() {
        let mut page = page(0.0, 0.0, 0.15);
        let drawn: Vec<(f64, ColumnSample)> = page
            .visible(0.0)
            .map(|(place, sample)| (place, sample.rows[0].clone().expect("a row")))
            .collect();
        keep(&mut page);
        let same = |page: &Page| {
            let rows = rows(page);
            assert_eq!(rows.len(), drawn.len());
            for (ghost, then) in rows.iter().zip(&drawn) {
                assert!((ghost.0 - then.0).abs() < 1e-9 && ghost.1 == then.1);
            }
        };
        same(&page);
        fill(&mut page, 0.15, 0.65, 2e-3);
        page.align_ghost(Some(PERIOD));
        same(&page);
        assert!(page.scale.bottom() <= 0.0 && page.scale.top() >= 2e-3);
        let mut restarted = Page::new(page.sweep, &[]).behind(page.ghost.take());
        restarted.align_ghost(Some(PERIOD));
        same(&restarted);
    }

    /// What shrinks a scale does not cut the ghost off, and a fresh page holds it too.
    #[test]
    fn the_scale_holds_the_ghost() {
        let mut page = page(0.0, 0.0, 0.19);
        fill(&mut page, 0.19, 0.21, 0.8);
        keep(&mut page);
        fill(&mut page, 0.21, 1.0, 1e-3);
        assert!(page.scale.top() >= 0.8, "{:?}", page.scale);
        let small = Page::new(page.sweep, &[]);
        assert!(small.scale.top() < 0.8);
        assert!(small.behind(page.ghost.take()).scale.top() >= 0.8);
        page.ghost = None;
        fill(&mut page, 1.0, 1.5, 1e-3);
        assert!(page.scale.top() < 0.1, "{:?}", page.scale);
    }

    /// On a page that begins at another phase of the plate the ghost's floor lies on the
    /// page's own; under another frequency it stays at its places.
    #[test]
    fn a_ghost_keeps_the_phase_of_the_plate() {
        let mut first = page(0.0, 0.0, 0.19);
        keep(&mut first);
        let ghost = first.ghost.take();
        for origin in [0.5 * PERIOD, 0.17, 3.013] {
            let mut page = page(origin, origin, origin + 0.19).behind(ghost.clone());
            page.align_ghost(Some(PERIOD));
            let rows = rows(&page);
            assert!(rows.len() > 50);
            for (place, row) in &rows {
                let time = page.begun().0 + place * page.sweep.span;
                let phase = (time / PERIOD).rem_euclid(1.0) * 1e-4;
                let apart = (phase - f64::from(row.floor)).abs();
                assert!(apart.min(1e-4 - apart) < 1e-9, "{origin} {place}");
            }
            page.align_ghost(Some(0.9 * PERIOD));
            assert_eq!(
                page.ghost_rows(0).next().map(|row| row.0),
                first_place(ghost.as_ref())
            );
        }
    }

    fn first_place(ghost: Option<&Ghost>) -> Option<f64> {
        Some(ghost?.samples.first()?.0 / 0.2)
    }

    #[test]
    fn a_ghost_is_seen_through_what_it_was_seen_through() {
        let mut page = page(0.0, 0.0, 0.1);
        keep(&mut page);
        page.lens = Some(Lens::new(1e-6));
        assert!(page.shown_ghost().is_none() && rows(&page).is_empty());
        fill(&mut page, 0.1, 0.15, 1.5e-3);
        let shown = |page: &Page| -> Vec<ColumnSample> {
            let each = page.samples.iter();
            let row = |sample: &Sample| {
                let row = sample.rows[0].as_ref()?;
                Some(page.drawn(0, sample.time, row)?.into_owned())
            };
            each.filter_map(row).collect()
        };
        let live = shown(&page);
        keep(&mut page);
        let ghost: Vec<ColumnSample> = rows(&page).into_iter().map(|(_, row)| row).collect();
        assert_eq!(ghost, live);
        // The lens of another page, on which less moves, has the lines as far apart as then.
        let mut next = Page::new(page.sweep, &[]).behind(page.ghost.take());
        next.lens = Some(Lens::new(1e-6));
        fill(&mut next, 0.0, 0.1, 1e-3);
        let again: Vec<ColumnSample> = rows(&next).into_iter().map(|(_, row)| row).collect();
        assert_eq!(again, live);
    }

    #[test]
    fn a_column_taken_away_takes_its_ghost_with_it() {
        let mut page = page(0.0, 0.0, 0.1);
        keep(&mut page);
        page.rearrange_ghost(&[1]);
        assert!(page.ghost_rows(0).all(|(_, row)| row.is_some()));
        assert!(page.ghost_rows(1).all(|(_, row)| row.is_none()));
    }
}
