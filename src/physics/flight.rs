//! Flights of gaps that nothing acts on, in closed form.
//!
//! All times are in seconds from the engine's epoch.

/// A gap as it was at a time of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// Its width, m; an overlap is negative.
    pub g: f64,
    /// Its rate, m/s.
    pub w: f64,
    /// That time, s from the epoch.
    pub t: f64,
}

/// When a gap of constant rate closes, which was `g` at `t0`; infinite if never.
pub(crate) fn closing(t0: f64, g: f64, w: f64) -> f64 {
    std::hint::select_unpredictable(w >= 0.0, f64::INFINITY, t0 - g.max(0.0) / w)
}
