//! What is said of a scene, a few whole sentences at a time, each for as long as it takes
//! to be read.

use std::time::{Duration, Instant};

use super::text::{columns, wrapped};
use super::theme::Theme;
use crate::scene::Preset;
use ratatui::layout::Rect;

/// Reading goes at about so many characters a second, which is slow, and begins when a
/// changed line has been noticed and found.
const CHARACTERS_A_SECOND: f64 = 15.0;
const NOTICING: f64 = 3.0;
/// A frame that comes later than this, s, was waited for by nobody.
const LONGEST: Duration = Duration::from_secs(1);
/// Lines of fewer columns have no room for a mark that they go on.
const MARKED: u16 = 16;

/// Words that end in a full stop and no sentence.
const SHORTENED: [&str; 5] = ["Fig.", "Figs.", "Eq.", "Eqs.", "Sec."];

/// A text, and the words before it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text {
    /// What is read before every part of it, such as `look for: `; may be empty.
    pub label: &'static str,
    /// Sentences.
    pub sentences: String,
}

/// What stands on the screen at a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaptionPart {
    /// The words at the beginning of the first line that tell what it is.
    pub label: String,
    /// Its lines, the label included.
    pub lines: Vec<String>,
}

/// For how long the texts have been there to be read.
#[derive(Debug, Clone, Copy, Default)]
pub struct ReadingTime {
    so_far: Duration,
    last: Option<Instant>,
}

impl ReadingTime {
    /// The time up to `now` was for reading.
    pub fn go_on(&mut self, now: Instant) {
        if let Some(last) = self.last {
            self.so_far += now.duration_since(last).min(LONGEST);
        }
        self.last = Some(now);
    }

    /// Something else is read from here on.
    pub fn rest(&mut self) {
        self.last = None;
    }

    /// The turn that is due, over and over again.
    pub fn due(self, turns: &[CaptionPart]) -> Option<&CaptionPart> {
        let all: f64 = turns.iter().map(CaptionPart::seconds).sum();
        let mut left = self.so_far.as_secs_f64() % all.max(1.0);
        let due = turns.iter().find(|turn| {
            left -= turn.seconds();
            left < 0.0
        });
        due.or(turns.last())
    }
}

impl CaptionPart {
    /// How long it stays, s.
    fn seconds(&self) -> f64 {
        let characters: u16 = self.lines.iter().map(|line| columns(line)).sum();
        NOTICING + f64::from(characters) / CHARACTERS_A_SECOND
    }
}

/// What a preset says, in the order in which it matters to who looks at the columns.
pub fn texts(preset: &Preset) -> [Text; 3] {
    [
        ("", &preset.caption),
        ("look for: ", &preset.look_for),
        ("try next: ", &preset.try_next),
    ]
    .map(|(label, text)| Text {
        label,
        sentences: text.clone(),
    })
}

/// Columns for texts in an area.
pub fn text_width(area: Rect) -> u16 {
    area.width.saturating_sub(2)
}

/// The texts in turns of at most `rows` lines of `width` columns: as many sentences of a text
/// as fit, and of one that does not fit itself as many words.
pub fn turns(theme: Theme, texts: &[Text], width: u16, rows: u16) -> Vec<CaptionPart> {
    let mut turns = Vec::new();
    if width == 0 || rows == 0 {
        return turns;
    }
    for text in texts {
        let label = theme.text(text.label).into_owned();
        let fits = |part: &str| wrapped(part, width).len() <= usize::from(rows);
        let mut parts: Vec<String> = Vec::new();
        for sentence in sentences(&theme.text(&text.sentences)) {
            let joined = parts.last().map(|part| format!("{part} {sentence}"));
            match joined.filter(|joined| fits(joined)) {
                Some(joined) => {
                    parts.pop();
                    parts.push(joined);
                }
                None => parts.push(format!("{label}{sentence}")),
            }
        }
        for part in parts {
            let divided = divided(theme, &part, width, usize::from(rows));
            turns.extend(
                divided
                    .into_iter()
                    .enumerate()
                    .map(|(k, lines)| CaptionPart {
                        label: if k == 0 { label.clone() } else { String::new() },
                        lines,
                    }),
            );
        }
    }
    turns
}

/// A part in the fewest turns that hold it, which are about as long as each other; what goes
/// on in the next turn ends in dots.
fn divided(theme: Theme, part: &str, width: u16, rows: usize) -> Vec<Vec<String>> {
    let lines = wrapped(part, width);
    if lines.len() <= rows {
        return vec![lines];
    }
    let mark = if width < MARKED {
        ""
    } else {
        theme.symbol(" …", " ...")
    };
    let room = width - columns(mark);
    let count = wrapped(part, room).len().div_ceil(rows);
    let narrowest = (1..room).find(|&narrow| {
        let lines = wrapped(part, narrow);
        lines.len().div_ceil(rows) <= count && lines.iter().all(|line| columns(line) <= room)
    });
    let lines = wrapped(part, narrowest.unwrap_or(room));
    let mut turns: Vec<Vec<String>> = lines.chunks(rows).map(<[String]>::to_vec).collect();
    let last = turns.len() - 1;
    for line in turns[..last].iter_mut().filter_map(|turn| turn.last_mut()) {
        line.push_str(mark);
    }
    turns
}

/// The sentences of a text.
fn sentences(text: &str) -> Vec<String> {
    let mut sentences: Vec<String> = Vec::new();
    let mut ended = true;
    let mut words = text.split_whitespace().peekable();
    while let Some(word) = words.next() {
        match sentences.last_mut().filter(|_| !ended) {
            Some(sentence) => {
                sentence.push(' ');
                sentence.push_str(word);
            }
            None => sentences.push(word.to_owned()),
        }
        let capital = words
            .peek()
            .and_then(|next| next.chars().next())
            .is_some_and(|first| !first.is_lowercase() && !first.is_numeric() && first != '(');
        ended = capital && word.ends_with(['.', '?', '!']) && !SHORTENED.contains(&word);
    }
    sentences
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::preset::embedded;

    const UNICODE: Theme = Theme {
        ascii: false,
        colour: false,
    };
    const ASCII: Theme = Theme {
        ascii: true,
        colour: false,
    };

    fn presets() -> Vec<Preset> {
        let names = embedded().iter().map(|(name, _)| *name);
        names
            .map(|name| Preset::load(name).expect("an embedded preset"))
            .collect()
    }

    #[test]
    fn sentences_end_where_they_end() {
        let text = "As Fig. 5(b), ε = 0.6. It stays! Does it? Eq. (10) says 3.5 m. See Sec. IV.";
        let parts = sentences(text);
        assert_eq!(parts[0], "As Fig. 5(b), ε = 0.6.");
        assert_eq!(
            parts[1..],
            [
                "It stays!",
                "Does it?",
                "Eq. (10) says 3.5 m.",
                "See Sec. IV."
            ]
        );
    }

    /// All words come in their order, on lines that fit, and nothing but a sentence that has
    /// no room by itself is divided.
    #[test]
    fn turns_are_whole_sentences_or_whole_words() {
        let sizes = [
            (28, 1),
            (38, 1),
            (58, 1),
            (78, 2),
            (98, 2),
            (118, 1),
            (198, 3),
        ];
        for preset in presets() {
            for (theme, (width, rows)) in [UNICODE, ASCII]
                .into_iter()
                .flat_map(|t| sizes.map(|s| (t, s)))
            {
                for text in texts(&preset) {
                    let turns = turns(theme, std::slice::from_ref(&text), width, rows);
                    let spelled = theme.text(&text.sentences).into_owned();
                    let mut left = spelled.split_whitespace().peekable();
                    for (k, turn) in turns.iter().enumerate() {
                        let here = format!("{} {width}x{rows}: {turn:?}", preset.name);
                        assert!(turn.lines.len() <= usize::from(rows), "{here}");
                        assert!(
                            turn.lines.iter().all(|line| columns(line) <= width),
                            "{here}"
                        );
                        let joined = turn.lines.join(" ");
                        let shown = joined
                            .strip_prefix(turn.label.trim_end())
                            .expect("its label");
                        let goes_on = [" …", " ..."].iter().find_map(|m| shown.strip_suffix(m));
                        for word in goes_on.unwrap_or(shown).split_whitespace() {
                            assert_eq!(left.next(), Some(word), "{here}");
                        }
                        let whole = shown.ends_with(['.', '?', '!', ')']);
                        assert!(goes_on.is_some() || whole, "{here}");
                        // What is left of a divided sentence is no tail of a word or two.
                        if goes_on.is_some() && width >= 38 {
                            let next = turns[k + 1].lines.join(" ");
                            assert!(2 * next.len() > joined.len(), "{here}: {next}");
                        }
                    }
                    assert_eq!(left.next(), None, "{}", preset.name);
                }
            }
        }
    }

    #[test]
    fn sentences_are_whole_on_80_by_24() {
        for preset in presets() {
            for turn in turns(UNICODE, &texts(&preset), 78, 2) {
                let last = turn.lines.last().expect("a line");
                assert!(last.ends_with(['.', '?', '!']), "{}: {turn:?}", preset.name);
            }
        }
    }

    /// Every turn stays for as long as its characters take, and all have their turn again.
    #[test]
    fn every_turn_stays_long_enough_to_be_read() {
        let preset = &presets()[0];
        let turns = turns(UNICODE, &texts(preset), 38, 1);
        let all: f64 = turns.iter().map(CaptionPart::seconds).sum();
        let start = Instant::now();
        let mut reading = ReadingTime::default();
        let mut seen = vec![0u32; turns.len()];
        let mut now = start;
        while (now - start).as_secs_f64() <= 2.0 * all {
            reading.go_on(now);
            now += Duration::from_millis(100);
            let due = reading.due(&turns).expect("a turn");
            let index = turns
                .iter()
                .position(|turn| turn == due)
                .expect("one of them");
            seen[index] += 1;
        }
        for (turn, frames) in turns.iter().zip(seen) {
            let characters: usize = turn.lines.iter().map(|l| l.chars().count()).sum();
            let least = 2.0 * (3.0 + characters as f64 / 15.0);
            assert!(f64::from(frames) / 10.0 > least - 0.3, "{turn:?}: {frames}");
        }
    }

    #[test]
    fn what_covers_the_texts_takes_no_reading_time() {
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let mut reading = ReadingTime::default();
        reading.go_on(start);
        reading.go_on(after(1));
        reading.rest();
        reading.go_on(after(9));
        assert_eq!(reading.so_far, Duration::from_secs(1));
    }
}
