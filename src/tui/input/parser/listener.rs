//! The parts of the grammar of control sequences, as keys and receipts.

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use vte::{Params, Perform};

use super::Said;

/// A longer paste is of no use here.
const LONGEST_PASTE: usize = 4096;

/// What the last byte did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum LastByte {
    /// It was taken in.
    #[default]
    Nothing,
    /// It began a sequence of three characters.
    Introducer,
    /// It was a control character.
    Control,
    /// It ended a string.
    String,
    /// It ended an answer.
    Receipt,
    /// It was or ended something else.
    Something,
}

/// Hears the grammar's parts.
#[derive(Default)]
pub(super) struct Listener {
    pub said: Vec<Said>,
    pub last_byte: LastByte,
    /// The text that is being pasted.
    pub paste: Option<String>,
    /// So many characters still belong to a sequence that the grammar does not know.
    pub skip: u32,
    /// The next character is the last of three: Esc O and this.
    pub third: bool,
}

impl Listener {
    fn key(&mut self, code: KeyCode, modifiers: KeyModifiers) {
        let event = Event::Key(KeyEvent::new(code, modifiers));
        self.said.push(Said::Event(event));
    }

    pub fn escape(&mut self) {
        if self.paste.is_none() {
            self.key(KeyCode::Esc, KeyModifiers::NONE);
        }
    }

    pub fn with_alt(&mut self, byte: u8) {
        if self.paste.is_some() {
            return;
        }
        self.character(char::from(byte), KeyModifiers::ALT);
    }

    fn character(&mut self, c: char, mut modifiers: KeyModifiers) {
        if c.is_uppercase() {
            modifiers |= KeyModifiers::SHIFT;
        }
        self.key(KeyCode::Char(c), modifiers);
    }

    pub fn end_paste(&mut self) {
        if let Some(text) = self.paste.take() {
            self.said.push(Said::Event(Event::Paste(text)));
        }
    }

    /// A key by its number in `CSI number ; modifiers ~`.
    fn numbered(&mut self, number: u16, modifiers: KeyModifiers) {
        let code = match number {
            1 | 7 => KeyCode::Home,
            2 => KeyCode::Insert,
            3 => KeyCode::Delete,
            4 | 8 => KeyCode::End,
            5 => KeyCode::PageUp,
            6 => KeyCode::PageDown,
            200 => {
                self.paste = Some(String::new());
                return;
            }
            _ => return,
        };
        self.key(code, modifiers);
    }

    /// A key by its character, after the protocols of kitty and of xterm.
    fn coded(&mut self, code: u16, mut modifiers: KeyModifiers) {
        let Some(mut c) = char::from_u32(code.into()) else {
            return;
        };
        match c {
            '\r' => return self.key(KeyCode::Enter, modifiers),
            '\t' => return self.key(KeyCode::Tab, modifiers),
            '\x1b' => return self.key(KeyCode::Esc, modifiers),
            '\x7f' | '\x08' => return self.key(KeyCode::Backspace, modifiers),
            _ if c.is_control() || ('\u{e000}'..='\u{f8ff}').contains(&c) => return,
            _ => {}
        }
        if modifiers.contains(KeyModifiers::SHIFT) && !c.is_uppercase() {
            c = c.to_ascii_uppercase();
        }
        modifiers.remove(KeyModifiers::SHIFT);
        self.character(c, modifiers);
    }
}

/// Modifiers from their number, 1 and a sum of powers of two.
fn modifiers(number: u16) -> KeyModifiers {
    let bits = number.saturating_sub(1);
    [
        (1, KeyModifiers::SHIFT),
        (2, KeyModifiers::ALT),
        (4, KeyModifiers::CONTROL),
    ]
    .into_iter()
    .filter(|(bit, _)| bits & bit != 0)
    .fold(KeyModifiers::NONE, |all, (_, modifier)| all | modifier)
}

/// The key that the last character of `CSI … letter` and of `Esc O letter` names.
fn lettered(letter: char) -> Option<KeyCode> {
    Some(match letter {
        'A' => KeyCode::Up,
        'B' => KeyCode::Down,
        'C' => KeyCode::Right,
        'D' => KeyCode::Left,
        'F' => KeyCode::End,
        'H' => KeyCode::Home,
        'M' => KeyCode::Enter,
        'Z' => KeyCode::BackTab,
        _ => return None,
    })
}

impl Perform for Listener {
    fn print(&mut self, c: char) {
        self.last_byte = LastByte::Something;
        if let Some(text) = &mut self.paste {
            if text.len() < LONGEST_PASTE {
                text.push(c);
            }
        } else if std::mem::take(&mut self.third) {
            if let Some(code) = lettered(c) {
                self.key(code, KeyModifiers::NONE);
            }
        } else if self.skip > 0 {
            self.skip -= 1;
        } else if c == '\x7f' {
            self.key(KeyCode::Backspace, KeyModifiers::NONE);
        } else if c != char::REPLACEMENT_CHARACTER {
            self.character(c, KeyModifiers::NONE);
        }
    }

    fn execute(&mut self, byte: u8) {
        self.last_byte = LastByte::Control;
        if let Some(text) = &mut self.paste {
            if text.len() < LONGEST_PASTE {
                text.push(char::from(byte));
            }
            return;
        }
        match byte {
            b'\r' | b'\n' => self.key(KeyCode::Enter, KeyModifiers::NONE),
            b'\t' => self.key(KeyCode::Tab, KeyModifiers::NONE),
            8 | 0x7f => self.key(KeyCode::Backspace, KeyModifiers::NONE),
            1..=26 => self.key(
                KeyCode::Char(char::from(b'a' - 1 + byte)),
                KeyModifiers::CONTROL,
            ),
            _ => {}
        }
    }

    fn csi_dispatch(&mut self, params: &Params, intermediates: &[u8], _: bool, last: char) {
        self.last_byte = LastByte::Something;
        let mut params = params.iter();
        let first = params.next().unwrap_or(&[]);
        let number = first.first().copied().unwrap_or(0);
        let second = params.next().unwrap_or(&[1]);
        let held = modifiers(second.first().copied().unwrap_or(1));
        if !intermediates.is_empty() {
            return;
        }
        // 0: ready; 3: a malfunction, but of a terminal that has read so far.
        if last == 'n' && matches!(number, 0 | 3) {
            self.last_byte = LastByte::Receipt;
            self.said.push(Said::Receipt);
            return;
        }
        if self.paste.is_some() {
            if (number, last) == (201, '~') {
                self.end_paste();
            }
            return;
        }
        // Kitty tells of keys that are let go when asked to: third, of the second number.
        let let_go = second.get(1) == Some(&3);
        match last {
            _ if let_go => {}
            '~' if number == 27 => {
                if let Some(&[code]) = params.next() {
                    self.coded(code, held);
                }
            }
            '~' => self.numbered(number, held),
            'u' => self.coded(number, held),
            // Function keys of the Linux console, and the mouse of old terminals, which goes
            // on for three characters.
            '[' => self.skip = 1,
            'M' => self.skip = 3,
            _ => {
                if let Some(code) = lettered(last) {
                    self.key(code, held);
                }
            }
        }
    }

    fn esc_dispatch(&mut self, _: &[u8], _: bool, byte: u8) {
        self.last_byte = LastByte::Something;
        match byte {
            _ if self.paste.is_some() => {}
            b'O' => {
                self.third = true;
                self.last_byte = LastByte::Introducer;
            }
            // The end of a string.
            b'\\' => {}
            _ => self.with_alt(byte),
        }
    }

    fn osc_dispatch(&mut self, _: &[&[u8]], _: bool) {
        self.last_byte = LastByte::String;
    }

    fn unhook(&mut self) {
        self.last_byte = LastByte::String;
    }
}
