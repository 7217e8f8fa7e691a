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
            let hint = in_quotes(text, at);
            entries.at(at, one_line(error.message()) + &hint)
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

    /// Gives keys the names by which the program knows them.
    ///
    /// # Errors
    /// When two keys come to mean the same.
    pub fn rename(
        &mut self,
        name: impl Fn(&str) -> Option<&'static str>,
    ) -> Result<(), PresetError> {
        for k in 0..self.list.len() {
            let entry = &self.list[k];
            let (at, written) = (entry.key_at, quote(&entry.key));
            if let Some(name) = name(&entry.key) {
                name.clone_into(&mut self.list[k].key);
            }
            let key = &self.list[k].key;
            if self.list[..k].iter().any(|before| before.key == *key) {
                return Err(self.at(at, format!("{written}: {key} is given twice")));
            }
        }
        Ok(())
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

/// What TOML wants in quotes and people write without, at a place where it is no TOML: a
/// Greek key, or a number with a unit; as the end of a sentence.
fn in_quotes(text: &str, at: usize) -> String {
    let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
    let before = before.rsplit('\n').next().unwrap_or_default();
    let line = before.to_owned() + after.split('\n').next().unwrap_or_default();
    let Some((key, value)) = line.split_once('=') else {
        return String::new();
    };
    let (key, value) = (
        key.trim(),
        value.split('#').next().unwrap_or_default().trim(),
    );
    let bare = |text: &str| !text.contains(['"', '\'']);
    if bare(key) && !key.is_ascii() {
        return format!("; write \"{}\", in quotes", quote(key));
    }
    let number = value.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    if number && bare(value) && value.ends_with(['s', 'm', 'z']) {
        return format!("; write \"{}\", in quotes", quote(value));
    }
    String::new()
}
