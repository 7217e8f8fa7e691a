//! Words for error messages: what was typed, on one line, and what was meant.

/// How much of a bad value is worth repeating in a message.
const LONGEST_QUOTE: usize = 60;

/// `text` on one line and free of control characters, however long.
pub(crate) fn one_line(text: &str) -> String {
    let printable: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    printable.split_whitespace().collect::<Vec<_>>().join(" ")
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
    candidates
        .into_iter()
        .map(|candidate| {
            let plain = candidate.to_lowercase().replace('-', "_");
            (edits(&word, &plain), candidate)
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

/// Levenshtein distance: letters to insert, delete or replace.
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    // A long word is nobody's slip of a short one; this also bounds the work.
    if from.chars().count() > to.len() + 8 {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &b) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(a != b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
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
        assert_eq!(quote("a\n\tb\u{1b}[31m"), "a b [31m");
        assert_eq!(quote(&"x".repeat(100)).chars().count(), LONGEST_QUOTE + 3);
    }
}
