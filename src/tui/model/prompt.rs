//! A line to type into, and what keys do to it.

mod complete;

use crate::scene::parameters::Parameter;
use crate::scene::words::is_hidden;

/// A line to type into.
#[derive(Debug, Default)]
pub struct Prompt {
    /// The parameter that the value is for; none where a name is typed too.
    pub parameter: Option<&'static Parameter>,
    /// What there is to say of the line, until the next key.
    pub note: Option<Note>,
    text: String,
    /// Where typing goes on, in bytes.
    cursor: usize,
    /// The earlier line that is shown, and what was typed before it.
    recalled: Option<(usize, String)>,
}

/// Something to say of the line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What it says.
    pub text: String,
    /// Whether the line is wrong.
    pub alarm: bool,
}

/// Where to go in the line, or up to where to delete.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A character to the left.
    Left,
    /// A character to the right.
    Right,
    /// The start of the word on the left.
    Word,
    /// The start of the line.
    Start,
    /// Its end.
    End,
}

impl Prompt {
    /// The longest line that makes sense.
    const LONGEST: usize = 60;

    /// An empty line: for a value of the parameter, or for a name and a value.
    pub fn new(parameter: Option<&'static Parameter>) -> Self {
        Self {
            parameter,
            ..Self::default()
        }
    }

    /// What has been typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where typing goes on, in bytes from the start.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// Types a character; the line stays one printable line.
    pub fn insert(&mut self, c: char) {
        if !is_hidden(c) && self.text.chars().count() < Self::LONGEST {
            self.text.insert(self.cursor, c);
            self.cursor += c.len_utf8();
        }
    }

    /// Moves on to a place.
    pub fn go(&mut self, to: Place) {
        self.cursor = self.find(to);
    }

    /// Deletes what lies between here and a place.
    pub fn delete(&mut self, to: Place) {
        let to = self.find(to);
        let (start, end) = (self.cursor.min(to), self.cursor.max(to));
        self.text.replace_range(start..end, "");
        self.cursor = start;
    }

    /// Says what is wrong at a place of the line, in bytes, and goes there.
    pub fn refuse(&mut self, why: String, at: usize) {
        let places = self.text.char_indices().map(|(place, _)| place);
        self.cursor = places.take_while(|&place| place <= at).last().unwrap_or(0);
        if at >= self.text.len() {
            self.cursor = self.text.len();
        }
        self.note = Some(Note {
            text: why,
            alarm: true,
        });
    }

    /// Shows the line before the one shown, of those entered so far, or the one after; past
    /// the last is what was typed here.
    pub fn recall(&mut self, entered: &[String], back: bool) {
        let at = self.recalled.as_ref().map_or(entered.len(), |(at, _)| *at);
        let to = if back {
            at.checked_sub(1)
        } else {
            Some(at + 1)
        };
        let Some(to) = to.filter(|&to| to <= entered.len()) else {
            return;
        };
        let typed = match self.recalled.take() {
            Some((_, typed)) => typed,
            None => std::mem::take(&mut self.text),
        };
        match entered.get(to) {
            Some(line) => {
                self.text.clone_from(line);
                self.recalled = Some((to, typed));
            }
            None => self.text = typed,
        }
        self.cursor = self.text.len();
    }

    fn find(&self, place: Place) -> usize {
        let (before, after) = self.text.split_at(self.cursor);
        match place {
            Place::Left => self.cursor - before.chars().next_back().map_or(0, char::len_utf8),
            Place::Right => self.cursor + after.chars().next().map_or(0, char::len_utf8),
            Place::Word => {
                let apart = |c: char| c == '=' || c.is_whitespace();
                let word = before.trim_end_matches(apart);
                word.trim_end_matches(|c| !apart(c)).len()
            }
            Place::Start => 0,
            Place::End => self.text.len(),
        }
    }
}

#[cfg(test)]
mod tests;
