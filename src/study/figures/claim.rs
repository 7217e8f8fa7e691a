//! What the paper says, or theory gives, set beside what comes out.

use super::{Figure, Sheet};
use crate::numerals::shortest;
use crate::study::table::{Cell, Column, Digits, Table};

/// A number of the paper or of theory, or a sentence with a number in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// What it is about; at most 32 characters.
    pub what: String,
    /// What the paper says; at most 15 characters.
    pub paper: String,
    /// What comes out here.
    pub here: f64,
    /// What is allowed; at most 10 characters.
    pub allowed: String,
    /// Whether it is within that.
    pub within: bool,
    /// Why not, where that is known.
    pub reason: Option<String>,
}

impl Claim {
    /// A number that must come out, to a part of itself.
    pub fn near(what: impl Into<String>, paper: f64, here: f64, part: f64) -> Self {
        Self {
            what: what.into(),
            paper: printed(paper),
            here,
            allowed: format!("{} %", (1e4 * part).round() / 1e2),
            within: (here - paper).abs() <= part * paper.abs(),
            reason: None,
        }
    }

    /// A number that must come out, to so much.
    pub fn off(what: impl Into<String>, paper: f64, here: f64, by: f64) -> Self {
        Self {
            what: what.into(),
            paper: printed(paper),
            here,
            allowed: format!("+-{}", printed(by)),
            within: (here - paper).abs() <= by,
            reason: None,
        }
    }

    /// A number that must be at most so much, as the paper says in its words.
    pub fn most(what: impl Into<String>, paper: impl Into<String>, here: f64, most: f64) -> Self {
        Self {
            what: what.into(),
            paper: paper.into(),
            here,
            allowed: format!("<= {}", printed(most)),
            within: here <= most,
            reason: None,
        }
    }

    /// A number that must be at least so much, as the paper says in its words.
    pub fn least(what: impl Into<String>, paper: impl Into<String>, here: f64, least: f64) -> Self {
        Self {
            what: what.into(),
            paper: paper.into(),
            here,
            allowed: format!(">= {}", printed(least)),
            within: here >= least,
            reason: None,
        }
    }

    /// A number that must lie between two, as the paper says in its words.
    pub fn between(
        what: impl Into<String>,
        paper: impl Into<String>,
        here: f64,
        (low, high): (f64, f64),
    ) -> Self {
        Self {
            what: what.into(),
            paper: paper.into(),
            here,
            allowed: format!("{} to {}", printed(low), printed(high)),
            within: (low..=high).contains(&here),
            reason: None,
        }
    }

    /// The same, if the number it must be is no word of the paper but what theory gives.
    #[must_use]
    pub fn by_theory(mut self) -> Self {
        self.paper.insert_str(0, "theory: ");
        self
    }

    /// The same with the reason why it is not within.
    #[must_use]
    pub fn because(mut self, reason: impl Into<String>) -> Self {
        self.reason = Some(reason.into());
        self
    }

    fn verdict(&self) -> &'static str {
        if self.within { "yes" } else { "NO" }
    }

    /// The reason, where it is needed.
    fn excuse(&self) -> Option<String> {
        match (&self.reason, self.within) {
            (Some(reason), false) => Some(format!("{}: {reason}", self.what)),
            _ => None,
        }
    }
}

/// A number as a person would write it; −0 is 0.
fn printed(x: f64) -> String {
    shortest(x + 0.0, f64::INFINITY)
}

fn columns(figure: &'static str, allowed: &'static str) -> Vec<Column> {
    vec![
        Column::new("figure", figure, ""),
        Column::new("what", "what", ""),
        Column::new("paper", "the paper says", ""),
        Column::new("beadlab", "beadlab", "").with(Digits::Significant(4)),
        Column::new("allowed", allowed, ""),
        Column::new("within", "within", ""),
    ]
}

fn row(figure: &Figure, claim: &Claim) -> Vec<Cell> {
    vec![
        figure.name.into(),
        claim.what.as_str().into(),
        claim.paper.as_str().into(),
        claim.here.into(),
        claim.allowed.as_str().into(),
        claim.verdict().into(),
    ]
}

/// The claims of a figure.
pub fn claims(figure: &Figure, sheet: &Sheet) -> Table {
    let mut table = Table::new(
        format!("claims-{}", figure.name),
        figure.title,
        columns("", "allowed"),
    );
    for claim in &sheet.claims {
        table.push(row(figure, claim));
    }
    table.notes = sheet.claims.iter().filter_map(Claim::excuse).collect();
    table.notes.extend(sheet.notes.iter().cloned());
    table
}

/// All claims of all figures.
pub fn summary(sheets: &[(&Figure, Sheet)]) -> Table {
    let all = || sheets.iter().flat_map(|(_, sheet)| &sheet.claims);
    let within = all().filter(|claim| claim.within).count();
    let mut table = Table::new(
        "summary",
        format!(
            "Summary: {within} of {} statements come out as the paper, or theory, has them",
            all().count()
        ),
        columns("figure", ""),
    );
    for (figure, sheet) in sheets {
        for claim in &sheet.claims {
            table.push(row(figure, claim));
        }
    }
    table.notes = all().filter_map(Claim::excuse).collect();
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_within_nothing() {
        let claims = |x: f64| {
            [
                Claim::near("", 1.0, x, 0.5),
                Claim::off("", 1.0, x, 0.5),
                Claim::most("", "", x, 2.0),
                Claim::least("", "", x, 0.5),
                Claim::between("", "", x, (0.5, 2.0)),
            ]
        };
        assert!(claims(1.0).iter().all(|claim| claim.within));
        assert!(claims(f64::NAN).iter().all(|claim| !claim.within));
        let [near, off, most, least, between] = claims(3.0).map(|claim| claim.within);
        assert!(!near && !off && !most && least && !between);
        assert!(!claims(0.1)[4].within);
    }
}
