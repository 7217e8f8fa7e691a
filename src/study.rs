//! Studies: runs without a screen, many of them, and what they say.
//!
//! A study takes scenes and gives numbers, tables and plots. It prints nothing; who
//! waits for it is told through a callback how far it is, and may stop it.

pub mod accuracy;
pub mod advise;
mod drive;
pub mod export;
pub mod figures;
mod findings;
mod fit;
mod means;
mod measure;
pub mod plot;
pub mod quantity;
mod sensitivity;
pub mod speed;
pub mod stability;
pub mod sweep;
pub mod table;
mod vary;
pub mod verdict;

pub use drive::{Allowance, Drive, RunError, SLICE, Watch, in_time, natural_time};
pub use findings::{Finding, FindingStage, Findings, run, sensitivity};
pub use measure::{Results, measure};
pub use sensitivity::{Sensitivity, work_of_sensitivity};
pub use vary::{PATTERNS, one_ulp_off, vary};

/// Who waits for a study: is told what it is at, and which part of it is done, where that
/// is known.
pub type Tell<'a> = dyn FnMut(&str, Option<f64>) + 'a;
