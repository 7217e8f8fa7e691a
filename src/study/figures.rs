//! The paper's figures, tables and sentences, computed anew and set beside what it says,
//! and where they lead beyond it.
//!
//! Every figure gives claims (what the paper says, what comes out here, whether that is
//! within what is allowed), plots, and the numbers behind them.

mod claim;
mod columns;
mod fig1;
mod fig2a;
mod fig3;
mod fig4a;
mod fig4b;
mod fig7;
mod landings;
mod limits;
mod pair;
mod plateau;
mod pool;
mod runs;
mod shaken;
mod table1;
mod touching;

pub use claim::{Claim, claims, summary};

use super::plot::Plot;
use super::table::Table;
use super::{RunError, Tell};
use crate::scene::SceneError;
use crate::scene::preset::PresetError;
use crate::scene::words::{did_you_mean, quote};
use pool::RunPool;

/// What a figure gives.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sheet {
    /// What the paper says, and what comes out.
    pub claims: Vec<Claim>,
    /// What a reader must know besides.
    pub notes: Vec<String>,
    /// The numbers behind the plots, in full.
    pub data: Vec<Table>,
    /// The plots.
    pub plots: Vec<Plot>,
}

/// A figure, table or section of the paper.
#[derive(Debug)]
pub struct Figure {
    /// As it is typed.
    pub name: &'static str,
    /// What it is, in one line.
    pub title: &'static str,
    make: fn(&mut RunPool) -> Result<Sheet, FigureError>,
}

/// Why there is no figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FigureError {
    /// There is none of that name.
    #[error("figure {name}: there is none{hint}; there are {}, all", names().join(", "))]
    Unknown {
        /// What was asked for.
        name: String,
        /// What may have been meant.
        hint: String,
    },
    /// A scene of it cannot be.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A preset of it cannot be read.
    #[error(transparent)]
    Preset(#[from] PresetError),
    /// A run of it failed.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// How a figure is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pains {
    /// Fewer points and shorter runs.
    pub quick: bool,
    /// Threads; the results do not depend on them.
    pub threads: usize,
}

/// Name of all figures together.
pub const ALL: &str = "all";

static FIGURES: &[Figure] = &[
    Figure {
        name: "1a",
        title: "Fig. 1(a): MD, no gaps",
        make: |pool| fig1::sheet('a', pool),
    },
    Figure {
        name: "1b",
        title: "Fig. 1(b): MD, gaps of 1e-6 m",
        make: |pool| fig1::sheet('b', pool),
    },
    Figure {
        name: "1c",
        title: "Fig. 1(c): MD, gaps of 1e-5 m",
        make: |pool| fig1::sheet('c', pool),
    },
    Figure {
        name: "1d",
        title: "Fig. 1(d): ED, no gaps",
        make: |pool| fig1::sheet('d', pool),
    },
    Figure {
        name: "1e",
        title: "Fig. 1(e): ED, gaps of 1e-6 m",
        make: |pool| fig1::sheet('e', pool),
    },
    Figure {
        name: "1f",
        title: "Fig. 1(f): ED, gaps of 1e-5 m",
        make: |pool| fig1::sheet('f', pool),
    },
    Figure {
        name: "2a",
        title: "Fig. 2(a): effective restitution over sigma",
        make: fig2a::sheet,
    },
    Figure {
        name: "2b",
        title: "Fig. 2(b): 1 - eps_eff over N, without gaps",
        make: columns::fig2b,
    },
    Figure {
        name: "2c",
        title: "Fig. 2(c): E_r/E_f over N, without gaps",
        make: columns::fig2c,
    },
    Figure {
        name: "sec4a",
        title: "The sentences of Sec. IV A",
        make: columns::sentences,
    },
    Figure {
        name: "3",
        title: "Fig. 3: other laws of contact",
        make: fig3::sheet,
    },
    Figure {
        name: "4a",
        title: "Fig. 4(a): a lattice in a plane, over sigma",
        make: fig4a::sheet,
    },
    Figure {
        name: "4b",
        title: "Fig. 4(b): 1 - eps_eff over the height of a lattice",
        make: fig4b::sheet,
    },
    Figure {
        name: "5a",
        title: "Fig. 5(a): MD with t_c = 0.7e-3 s",
        make: |pool| shaken::sheet("fig5a", pool),
    },
    Figure {
        name: "5b",
        title: "Fig. 5(b): MD with t_c = 0.7e-5 s",
        make: |pool| shaken::sheet("fig5b", pool),
    },
    Figure {
        name: "plateau",
        title: "Fig. 5(b) with ever shorter contacts: E_r/E tends to a constant",
        make: plateau::sheet,
    },
    Figure {
        name: "6a",
        title: "Fig. 6(a): aluminium beads, as ED",
        make: |pool| shaken::sheet("fig6a", pool),
    },
    Figure {
        name: "6b",
        title: "Fig. 6(b): aluminium beads, MD",
        make: |pool| shaken::sheet("fig6b", pool),
    },
    Figure {
        name: "7",
        title: "Fig. 7: strong shaking",
        make: fig7::sheet,
    },
    Figure {
        name: "table1",
        title: "Table I, the appendix, and the materials of Sec. III",
        make: table1::sheet,
    },
];

fn names() -> Vec<&'static str> {
    FIGURES.iter().map(|figure| figure.name).collect()
}

/// The figure of that name, or all of them.
///
/// # Errors
/// When there is none, with what may have been meant.
pub fn named(name: &str) -> Result<&'static [Figure], FigureError> {
    let bare = name.to_lowercase();
    let bare = bare.strip_prefix("fig").unwrap_or(&bare);
    if bare == ALL {
        return Ok(FIGURES);
    }
    let at = FIGURES.iter().position(|figure| figure.name == bare);
    at.map(|at| &FIGURES[at..=at])
        .ok_or_else(|| FigureError::Unknown {
            name: quote(name),
            hint: did_you_mean(bare, names().into_iter().chain([ALL])),
        })
}

impl Figure {
    /// Runs what it takes.
    ///
    /// # Errors
    /// When a run fails.
    pub fn make(&self, pains: Pains, tell: &mut Tell) -> Result<Sheet, FigureError> {
        tell(self.title, None);
        (self.make)(&mut RunPool::new(self.title, pains, tell))
    }
}
