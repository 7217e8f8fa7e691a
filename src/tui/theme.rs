//! What the terminal can show: its characters and its colours.

use std::borrow::Cow;

use ratatui::style::{Color, Modifier, Style};

/// The characters and colours in use.
///
/// The colours are of the sixteen that every terminal lets its user choose, and
/// neither white nor black nor yellow, so that they are seen on dark and on light
/// backgrounds. No meaning hangs on a colour alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// Write no byte beyond ASCII.
    pub ascii: bool,
    /// Write colours; without, weight and labels have to do.
    pub colour: bool,
}

impl Theme {
    /// The theme for the environment: `variable` looks a variable up, `TERM` being what the
    /// terminal itself is.
    pub fn detect(force_ascii: bool, variable: impl Fn(&str) -> Option<String>) -> Theme {
        let set = |name: &str| variable(name).filter(|value| !value.is_empty());
        let term = set("TERM").unwrap_or_default();
        let locale = ["LC_ALL", "LC_CTYPE", "LANG"]
            .into_iter()
            .find_map(set)
            .unwrap_or_default();
        let locale = locale.to_ascii_lowercase();
        let unicode = locale.contains("utf-8") || locale.contains("utf8");
        Theme {
            ascii: force_ascii || !unicode || matches!(term.as_str(), "dumb" | "linux"),
            colour: set("NO_COLOR").is_none() && term != "dumb",
        }
    }

    /// Text as this terminal can show it.
    pub fn text(self, text: &str) -> Cow<'_, str> {
        if !self.ascii || text.is_ascii() {
            return Cow::Borrowed(text);
        }
        Cow::Owned(text.chars().map(spelled_out).collect())
    }

    /// One of a pair of symbols: with and without Unicode.
    pub fn symbol<'a>(self, unicode: &'a str, ascii: &'a str) -> &'a str {
        if self.ascii { ascii } else { unicode }
    }

    fn coloured(self, colour: Color, otherwise: Modifier) -> Style {
        if self.colour {
            Style::new().fg(colour)
        } else {
            Style::new().add_modifier(otherwise)
        }
    }

    /// The left column (0) or the right one (1).
    pub fn side(self, index: usize) -> Style {
        match index {
            0 => self.coloured(Color::Cyan, Modifier::empty()),
            _ => self.coloured(Color::Magenta, Modifier::empty()),
        }
    }

    /// The plate.
    pub fn plate(self) -> Style {
        self.coloured(Color::Blue, Modifier::DIM)
    }

    /// Rules, axes, units and what is said in passing.
    pub fn quiet(self) -> Style {
        Style::new().fg(Color::Reset).add_modifier(Modifier::DIM)
    }

    /// Titles, and keys to press.
    pub fn strong(self) -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    /// What must not be trusted or has gone wrong.
    pub fn alarm(self) -> Style {
        self.coloured(Color::Red, Modifier::UNDERLINED)
            .add_modifier(Modifier::BOLD)
    }

    /// The mark of a contact.
    pub fn contact(self) -> Style {
        self.coloured(Color::Red, Modifier::BOLD)
    }

    /// What may be trusted.
    pub fn good(self) -> Style {
        self.coloured(Color::Green, Modifier::empty())
    }

    /// The selected row.
    pub fn selected(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }
}

fn spelled_out(c: char) -> Cow<'static, str> {
    Cow::Borrowed(match c {
        ' '..='~' => return Cow::Owned(c.to_string()),
        'ε' => "eps",
        'σ' => "sigma",
        'α' => "alpha",
        'β' => "beta",
        'γ' => "gamma",
        'ω' => "omega",
        'φ' => "phi",
        'π' => "pi",
        'Δ' => "d",
        'µ' | 'μ' | 'ü' => "u",
        '∞' => "inf",
        '²' => "^2",
        '³' => "^3",
        '₀' => "0",
        '₁' => "1",
        '×' => "x",
        '·' | '•' => "*",
        '≪' => "<<",
        '≫' => ">>",
        '≤' => "<=",
        '≥' => ">=",
        '≈' => "~",
        '√' => "sqrt",
        '½' => "1/2",
        '¼' => "1/4",
        '°' => " deg",
        '…' => "...",
        '–' | '—' | '−' | '─' => "-",
        '←' => "<-",
        '→' => "->",
        '↑' => "up",
        '↓' => "down",
        '‘' | '’' => "'",
        '“' | '”' => "\"",
        'é' => "e",
        _ => "?",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn detect(pairs: &[(&str, &str)]) -> Theme {
        Theme::detect(false, |name| {
            pairs
                .iter()
                .find(|(key, _)| *key == name)
                .map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn a_utf8_terminal_gets_braille_and_colours() {
        let theme = detect(&[("TERM", "xterm"), ("LANG", "de_DE.UTF-8")]);
        assert_eq!(
            theme,
            Theme {
                ascii: false,
                colour: true
            }
        );
    }

    #[test]
    fn dumb_linux_and_plain_locales_get_ascii() {
        assert!(detect(&[("TERM", "dumb"), ("LANG", "C.UTF-8")]).ascii);
        assert!(detect(&[("TERM", "linux"), ("LANG", "C.UTF-8")]).ascii);
        assert!(detect(&[("TERM", "xterm"), ("LANG", "C.UTF-8"), ("LC_ALL", "C")]).ascii);
        assert!(detect(&[]).ascii);
    }

    #[test]
    fn no_color_counts_when_it_is_not_empty() {
        assert!(!detect(&[("LANG", "C.UTF-8"), ("NO_COLOR", "1")]).colour);
        assert!(detect(&[("LANG", "C.UTF-8"), ("NO_COLOR", "")]).colour);
    }

    #[test]
    fn every_character_has_a_spelling() {
        let theme = Theme {
            ascii: true,
            colour: false,
        };
        assert!(theme.text("σ ≪ 1, ε = 0.6, 7.0 µs – ▶ é").is_ascii());
    }
}
