//! Words for error messages: what was typed, on one line, and what was meant.

use std::ops::RangeInclusive;

/// How much of a bad value is worth repeating in a message.
const LONGEST_QUOTE: usize = 60;

/// Letters that a slip may have more than what was meant.
const LONGER: usize = 8;

/// Characters that show nothing and that the standard library takes for printable: joiners,
/// fillers, selectors and tags.
const BLANK: [RangeInclusive<char>; 8] = [
    '\u{34f}'..='\u{34f}',
    '\u{115f}'..='\u{1160}',
    '\u{17b4}'..='\u{17b5}',
    '\u{180b}'..='\u{180f}',
    '\u{3164}'..='\u{3164}',
    '\u{fe00}'..='\u{fe0f}',
    '\u{ffa0}'..='\u{ffa0}',
    '\u{e0000}'..='\u{e0fff}',
];

/// `text` on one line, however long, as it may go to a terminal: what is no space and
/// cannot be seen, or moves what can, like `\u{1b}` or `\u{202e}`, is spelled out so.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        for c in word.chars() {
            if is_hidden(c) {
                line.extend(c.escape_unicode());
            } else {
                line.push(c);
            }
        }
    }
    line
}

/// Whether a character is none to be seen; a mark on the letter before it is one.
pub(crate) fn is_hidden(c: char) -> bool {
    if c.is_ascii() {
        return c.is_control();
    }
    let spelled_out = || {
        let after_a_letter = format!("a{c}");
        after_a_letter.escape_debug().nth(1) == Some('\\')
    };
    BLANK.iter().any(|blank| blank.contains(&c)) || spelled_out()
}

/// A text in lines of at most `width` columns, broken between words.
pub(crate) fn wrapped(text: &str, width: u16) -> Vec<String> {
    let width = usize::from(width);
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last_mut().map(|line| (line.chars().count(), line));
        match last {
            Some((0, line)) => line.push_str(word),
            Some((taken, line)) if taken + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// `text` on one line, shortened when it is long.
pub(crate) fn quote(text: &str) -> String {
    let line = one_line(text);
    if line.chars().count() <= LONGEST_QUOTE {
        return line;
    }
    let start: String = line.chars().take(LONGEST_QUOTE).collect();
    format!("{start}...")
}

/// The candidate that `word` is a slip of, if it is near enough to one: at least a letter
/// is right.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let word = word.to_lowercase().replace('-', "_");
    let typed = word.chars().count();
    candidates
        .into_iter()
        // A long word is nobody's slip of a short one; this also bounds the work.
        .filter(|candidate| typed <= candidate.chars().count() + LONGER)
        .map(|candidate| {
            let plain = candidate.to_lowercase().replace('-', "_");
            (strsim::levenshtein(&word, &plain), candidate)
        })
        .filter(|&(distance, candidate)| {
            let letters = candidate.chars().count();
            distance <= 1 + letters / 4 && distance < letters
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// `; did you mean X?`, or nothing.
pub(crate) fn did_you_mean<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> String {
    nearest(word, candidates).map_or_else(String::new, |near| format!("; did you mean {near}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_find_their_word_and_strangers_find_none() {
        let names = ["restitution", "n", "s0", "contact_time"];
        assert_eq!(nearest("restituton", names), Some("restitution"));
        assert_eq!(nearest("contact-time", names), Some("contact_time"));
        assert_eq!(nearest("S0", names), Some("s0"));
        assert_eq!(nearest("N", names), Some("n"));
        assert_eq!(nearest("x", names), None);
        assert_eq!(nearest("colour", names), None);
    }

    #[test]
    fn a_quote_is_one_short_line() {
        assert_eq!(quote("a\n\tb\u{1b}[31m"), "a b\\u{1b}[31m");
        assert_eq!(quote(&"x".repeat(100)).chars().count(), LONGEST_QUOTE + 3);
    }
    #[test]
    fn what_cannot_be_seen_is_spelled_out_and_letters_stay() {
        // Overrides and isolates of direction, zero widths, a BOM, tags, C1 controls, fillers.
        for hidden in
            "\u{202a}\u{202e}\u{2066}\u{2069}\u{200b}\u{200d}\u{200e}\u{61c}\u{feff}\u{ad}\
             \u{2060}\u{e0041}\u{9b}\u{7f}\u{0}\u{3164}\u{fe0f}\u{34f}\u{fff9}\u{e000}"
                .chars()
        {
            let spelled = format!("a\\u{{{:x}}}b", u32::from(hidden));
            assert_eq!(one_line(&format!("a{hidden}b")), spelled);
            assert_eq!(one_line(&spelled), spelled);
        }
        let seen = "Kügelchen ku\u{308}gel σ₀ ≪ 1 玉 กำ नमस्ते עברית \\ ' \" –";
        assert_eq!(one_line(seen), seen);
        assert_eq!(one_line("a\u{2028}b\u{85}c\u{a0} d"), "a b c d");
    }
}
