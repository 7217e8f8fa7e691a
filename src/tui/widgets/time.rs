//! The time axis: when the page begins, where now is, and what the part that the pen has not
//! come to yet is of.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::trace::clear;
use crate::tui::model::{Model, Page};
use crate::tui::numbers;
use crate::tui::text::{columns, line};

/// Columns at the right end that are for the scale of the gaps.
const FOR_SCALE: u16 = 3;

/// Something that stands on the axis.
#[derive(Debug, Clone, PartialEq)]
struct TimeLabel {
    /// The column where it begins.
    start: u16,
    text: String,
    /// The time that it is of, s, and where that is on the page, from 0 to 1.
    of: (f64, f64),
}

/// Draws the axis below a trace of that width.
pub fn render(model: &Model, trace: Rect, area: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    for TimeLabel { start, text, of } in labels(&model.page, trace) {
        let now = of.0 == model.page.now;
        let style = if now { Style::new() } else { theme.quiet() };
        line(theme, buffer, area, 0).skip(start).put(&text, style);
    }
}

fn labels(page: &Page, trace: Rect) -> Vec<TimeLabel> {
    let (sweep, width) = (&page.sweep, trace.width);
    let (start, phase) = page.begun();
    let clock = |time| numbers::clock(time, sweep.span);
    let end = width.saturating_sub(FOR_SCALE);
    let mut labels = vec![TimeLabel {
        start: 0,
        text: clock(start),
        of: (start, 0.0),
    }];
    let taken = columns(&labels[0].text);
    if taken > end {
        return Vec::new();
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a column of the trace"
    )]
    let pen = (phase * f64::from(width)).floor() as u16;
    let last = 1.0 - 0.5 / f64::from(width.max(1));
    let older = page.time_at(last, clear(trace));
    let (texts, of) = match older {
        // What the pen has not written over was drawn up to when this page began.
        Some(_) => {
            let time = clock(start);
            let long = [format!("older, to {time}"), format!("older: {time}")];
            (
                long.into_iter().chain(["older".to_owned()]).collect(),
                start,
            )
        }
        None if phase + clear(trace) < last => {
            (vec![clock(start + sweep.span)], start + sweep.span)
        }
        None => (Vec::new(), start),
    };
    // Nothing old is told to be left of the pen.
    let least = (taken + 2).max(if older.is_some() { pen + 2 } else { 0 });
    let right = texts
        .into_iter()
        .find(|text: &String| least + columns(text) <= end);
    let right = right.map(|text| TimeLabel {
        start: end - columns(&text),
        text,
        of: (of, 1.0),
    });
    let free = right.as_ref().map_or(end, |label| label.start - 1);
    let word = "now";
    if pen + 1 >= taken + 1 + columns(word) && pen < free {
        labels.push(TimeLabel {
            start: pen + 1 - columns(word),
            text: word.to_owned(),
            of: (page.now, phase),
        });
    }
    labels.extend(right);
    labels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::{History, Sample, Sampling};

    const SPAN: f64 = 0.3;

    /// A page whose pen has come to `time`, of samples on its grid.
    fn page(width: u16, origin: f64, time: f64) -> Page {
        let sweep = Sampling {
            origin,
            span: SPAN,
            columns: usize::from(width) * 2,
            hold: false,
        };
        let mut page = Page::new(sweep, &[]);
        let mut history = History::new(sweep.columns + 1);
        let mut number = 0;
        while sweep.sample_time(number) <= time {
            let time = sweep.sample_time(number);
            history.push(Sample {
                time,
                rows: Vec::new(),
            });
            number += 1;
        }
        page.take(time, history, false);
        page
    }

    /// On every page, wherever the pen is: each column of dots is of the time that the page
    /// tells, and each label of the time of the column that it stands for.
    #[test]
    fn every_label_tells_the_time_of_what_is_drawn_there() {
        let (mut older, mut now) = (0, 0);
        for (width, origin) in [(12, 0.0), (29, 0.0), (29, 0.07), (45, 0.0), (74, 1.3)] {
            let trace = Rect::new(0, 0, width, 10);
            let column = SPAN / f64::from(width);
            for k in 0..400 {
                let time = origin + f64::from(k) * SPAN / 131.0;
                let page = page(width, origin, time);
                let mut drawn = Vec::new();
                for (place, sample) in page.visible(clear(trace)) {
                    let told = page
                        .time_at(place, clear(trace))
                        .expect("something is there");
                    assert!(
                        (told - sample.time).abs() <= column,
                        "{place}: {told} at {time}: {}",
                        sample.time
                    );
                    drawn.push((place, sample.time));
                }
                let labels = labels(&page, trace);
                for pair in labels.windows(2) {
                    let end = pair[0].start + columns(&pair[0].text);
                    assert!(end < pair[1].start, "{labels:?}");
                }
                for TimeLabel { start, text, of } in labels {
                    assert!(start + columns(&text) <= width - FOR_SCALE);
                    let nearest = drawn
                        .iter()
                        .min_by(|a, b| (a.0 - of.1).abs().total_cmp(&(b.0 - of.1).abs()));
                    let (place, drawn) = *nearest.expect("a sample");
                    // At the right end of a first page nothing is drawn yet, nor at the left
                    // end of a page before its first sample.
                    if (place - of.1).abs() <= 1.01 / f64::from(width) {
                        assert!((drawn - of.0).abs() <= 1.01 * column, "{text} at {time}");
                    } else {
                        let begins = page.begun().1 < 1e-5;
                        assert!(begins || time < origin + SPAN, "{text} at {time}");
                    }
                    if text.starts_with("older") {
                        older += 1;
                        let pen = page.begun().1 * f64::from(width);
                        assert!(f64::from(start) > pen, "{text} at {time}");
                        assert!(of.0 <= time);
                    }
                    now += u32::from(text == "now");
                }
            }
        }
        assert!(older > 300 && now > 300, "{older} {now}");
    }

    #[test]
    fn the_axis_at_80_by_24() {
        let read = |time| -> Vec<String> {
            let labels = labels(&page(29, 0.0, time), Rect::new(0, 0, 29, 10));
            labels.into_iter().map(|label| label.text).collect()
        };
        assert_eq!(read(0.15), ["0.000 s", "now", "0.300 s"]);
        assert_eq!(read(0.31), ["0.300 s", "older, to 0.300 s"]);
        assert_eq!(read(0.43), ["0.300 s", "now", "older"]);
        assert_eq!(read(0.54), ["0.300 s", "now"]);
    }
}
