//! The line of the moment.

use std::time::{Duration, Instant};

use super::Model;

/// A message stays for this long, or until a key.
const MESSAGE: Duration = Duration::from_secs(8);

/// A line for the person at the keyboard.
#[derive(Debug, Clone)]
pub struct Message {
    /// What it says.
    pub text: String,
    /// Whether something has gone wrong.
    pub alarm: bool,
    /// Whether it only repeats an edit.
    pub echo: bool,
    since: Instant,
}

impl Model {
    /// Shows a line for a while.
    pub(in crate::tui) fn say(&mut self, text: impl Into<String>, alarm: bool, now: Instant) {
        self.message = Some(Message {
            text: text.into(),
            alarm,
            echo: false,
            since: now,
        });
    }

    /// Repeats an edit in a line, to which what comes of the edit is added.
    pub(in crate::tui) fn echo(&mut self, text: impl Into<String>, now: Instant) {
        self.say(text, false, now);
        if let Some(message) = &mut self.message {
            message.echo = true;
        }
    }

    /// Shows what comes of an edit, behind the line that repeats the edit if both have room.
    pub(super) fn say_after_echo(&mut self, text: String, alarm: bool, now: Instant) {
        let echo = self.message.as_ref().filter(|message| message.echo);
        let both = echo.map(|message| format!("{}; {text}", message.text));
        let room = usize::from(self.size.0.saturating_sub(2));
        let both = both.filter(|both| both.chars().count() <= room);
        self.say(both.unwrap_or(text), alarm, now);
    }

    pub(super) fn expire_message(&mut self, now: Instant) {
        if self
            .message
            .as_ref()
            .is_some_and(|message| now.duration_since(message.since) > MESSAGE)
        {
            self.message = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Preset;
    use crate::tui::theme::Theme;

    #[test]
    fn what_comes_of_an_edit_follows_it_where_both_have_room() {
        let preset = Preset::load("shaken").expect("an embedded preset");
        let theme = Theme {
            ascii: false,
            colour: false,
        };
        let now = Instant::now();
        for (width, shown) in [(80, "ε 0.60 → 0.61; 3 overlaps"), (20, "3 overlaps")] {
            let made = Model::new(preset.clone(), None, theme, (width, 24));
            let (mut model, _) = made.expect("a twin");
            model.echo("ε 0.60 → 0.61", now);
            model.say_after_echo("3 overlaps".to_owned(), false, now);
            assert_eq!(model.message.as_ref().map(|m| m.text.as_str()), Some(shown));
            // Only what was typed last is repeated, and once.
            model.say_after_echo("2 overlaps".to_owned(), false, now);
            assert_eq!(
                model.message.as_ref().map(|m| m.text.as_str()),
                Some("2 overlaps")
            );
        }
    }
}
