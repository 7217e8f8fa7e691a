//! What Tab does.

use super::{Note, Prompt};
use crate::scene::parameters::{Kind, Parameter, called};

impl Prompt {
    /// Completes the name or the word before the cursor, as far as only one is meant, of
    /// these parameters and other names; says what there is where more are.
    pub fn complete(&mut self, parameters: &[&'static Parameter], others: &[&'static str]) {
        let head = &self.text[..self.cursor];
        let (parameter, typed) = match (head.split_once('='), self.parameter) {
            (Some((name, value)), _) => (called(name), Some(value.trim_start())),
            (None, Some(parameter)) => (Some(parameter), Some(head.trim_start())),
            (None, None) => (None, None),
        };
        match (typed, parameter) {
            (None, _) => self.complete_name(parameters, others),
            (Some(typed), Some(parameter)) => {
                let typed = typed.len();
                self.complete_value(parameter, typed);
            }
            (Some(_), None) => {}
        }
    }

    fn complete_name(&mut self, parameters: &[&'static Parameter], others: &[&'static str]) {
        let typed = self.text[..self.cursor].trim_start().to_owned();
        let begins = |name: &&'static str| name.starts_with(&typed);
        let names = parameters.iter().map(|parameter| parameter.name);
        let mut found: Vec<&str> = names.chain(others.iter().copied()).filter(begins).collect();
        if found.is_empty() {
            // By a symbol, or another name.
            let meant = parameters
                .iter()
                .filter(|parameter| parameter.names().any(|name| begins(&name)));
            found = meant.map(|parameter| parameter.name).collect();
        }
        match found.as_slice() {
            [] => self.tell("no such parameter here".to_owned()),
            [name] => {
                let given = self.text[self.cursor..].trim_start().starts_with('=');
                let equals = if given { "" } else { "=" };
                self.replace(typed.len(), &format!("{name}{equals}"));
            }
            several => self.extend(&typed, several),
        }
    }

    /// Completes the last `typed` bytes before the cursor to one of the parameter's words.
    fn complete_value(&mut self, parameter: &'static Parameter, typed: usize) {
        let words = match parameter.kind {
            Kind::Choice(words) => words,
            Kind::Flag => &["on", "off"],
            Kind::Number { .. } | Kind::Whole { .. } => {
                self.tell(format!("{}: {}", parameter.name, parameter.allowed()));
                return;
            }
        };
        let word = self.text[self.cursor - typed..self.cursor].to_owned();
        let found: Vec<&str> = words
            .iter()
            .copied()
            .filter(|each| each.starts_with(&word))
            .collect();
        match found.as_slice() {
            [] => self.tell(format!("{}: {}", parameter.name, words.join(" "))),
            [one] => self.replace(typed, one),
            several => self.extend(&word, several),
        }
    }

    /// Types on what all candidates have in common, and shows them where that is nothing.
    fn extend(&mut self, typed: &str, candidates: &[&str]) {
        let first = candidates.first().copied().unwrap_or_default();
        let common = first
            .char_indices()
            .map(|(at, c)| at + c.len_utf8())
            .rfind(|&end| {
                candidates
                    .iter()
                    .all(|each| each.starts_with(&first[..end]))
            })
            .unwrap_or(0);
        if common > typed.len() && first.starts_with(typed) {
            self.replace(typed.len(), &first[..common]);
        } else {
            self.tell(candidates.join("  "));
        }
    }

    /// Puts a word in the place of the last `typed` bytes before the cursor.
    fn replace(&mut self, typed: usize, word: &str) {
        let start = self.cursor - typed;
        self.text.replace_range(start..self.cursor, word);
        self.cursor = start + word.len();
    }

    fn tell(&mut self, text: String) {
        self.note = Some(Note { text, alarm: false });
    }
}
