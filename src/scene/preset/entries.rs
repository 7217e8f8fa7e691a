//! The entries of a flat TOML file, with their places.

use super::PresetError;
use crate::scene::words::{one_line, quote};
use toml::de::{DeTable, DeValue};

/// One `key = value` of the file.
pub(super) struct Entry<'a> {
    pub key: String,
    pub value: DeValue<'a>,
    /// Where the key starts, in bytes.
    pub key_at: usize,
    /// Where the value starts, in bytes.
    pub value_at: usize,
    /// The value as it is written, on one line.
    pub written: String,
}

/// The entries of the file in their order.
pub(super) struct Entries<'a> {
    origin: &'a str,
    text: &'a str,
    list: Vec<Entry<'a>>,
}

impl<'a> Entries<'a> {
    pub fn read(text: &'a str, origin: &'a str) -> Result<Self, PresetError> {
        let mut entries = Self {
            origin,
            text,
            list: Vec::new(),
        };
        let table = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(text.len(), |span| span.start);
            entries.at(at, one_line(error.message()))
        })?;
        for (key, value) in table.into_inner() {
            let span = value.span();
            entries.list.push(Entry {
                key: key.get_ref().to_string(),
                key_at: key.span().start,
                value_at: span.start,
                written: quote(text.get(span).unwrap_or_default()),
                value: value.into_inner(),
            });
        }
        entries.list.sort_by_key(|entry| entry.key_at);
        Ok(entries)
    }

    pub fn iter(&self) -> impl Iterator<Item = &Entry<'a>> {
        self.list.iter()
    }

    pub fn find(&self, key: &str) -> Option<&Entry<'a>> {
        self.list.iter().find(|entry| entry.key == key)
    }

    /// An error at a place in the text.
    pub fn at(&self, byte: usize, what: String) -> PresetError {
        let before = self.text.get(..byte).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        PresetError::Line {
            origin: one_line(self.origin),
            line: 1 + before.matches('\n').count(),
            column: 1 + before[line_start..].chars().count(),
            what,
        }
    }

    /// An error at the entry of that key, or of the whole file if it has none.
    pub fn about(&self, key: &str, what: String) -> PresetError {
        match self.find(key) {
            Some(entry) => self.at(entry.value_at, what),
            None => PresetError::Whole {
                origin: one_line(self.origin),
                what,
            },
        }
    }
}
