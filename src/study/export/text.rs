//! Results to read: a line each, those that the scene has.

use super::Format;
use crate::numerals::rounded;
use crate::scene::parameters::Value;
use crate::study::findings::Finding;
use crate::study::table::Cell;

pub(super) const FORMAT: Format = Format {
    name: "text",
    meaning: "A table to read",
    for_people: true,
    results: Some(results),
    motion: None,
};

/// Ten digits are more than a person reads.
const MOST_DIGITS: usize = 10;

/// Columns that a name takes at least, and a value with its unit.
const NAME: usize = 18;
const VALUE: usize = 20;

fn results(title: &str, all: &[Finding]) -> String {
    let mut text = format!("{title}\n\n");
    let shown = || {
        all.iter()
            .filter(|finding| !finding.quantity.is_of_the_machine() && finding.cell != Cell::Empty)
    };
    let width = shown()
        .map(|finding| finding.quantity.name.len())
        .fold(NAME, usize::max);
    for finding in shown() {
        let quantity = finding.quantity;
        let value = format!("{} {}", readable(finding), quantity.unit);
        let (name, value, meaning) = (quantity.name, value.trim_end(), finding.meaning);
        let line = format!("{name:<width$} {value:<VALUE$} {meaning}");
        text += line.trim_end();
        text.push('\n');
    }
    text
}

fn readable(finding: &Finding) -> String {
    match &finding.cell {
        Cell::Empty => String::new(),
        Cell::Word(word) => word.clone(),
        Cell::Count(count) => count.to_string(),
        Cell::Number(x) => {
            let most = finding.digits.unwrap_or(MOST_DIGITS).min(MOST_DIGITS);
            Value::Number(rounded(*x, most)).to_string()
        }
    }
}
