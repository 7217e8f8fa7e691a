//! Numbers side by side, so that a step is a few passes without a branch or a rest.
//!
//! The floor's gap stands alone; the gaps between beads lie in whole groups. The gaps
//! beyond the last bead are so wide that they never close, whatever they feel. Every
//! operation is one of IEEE 754 on each lane by itself (no fused ones, no estimates),
//! so that the bits are those of a plain loop, on every machine.

use std::ops::{Add, Mul, Sub};

use wide::f64x2;

/// Gaps that are computed side by side.
pub(super) const LANES: usize = 2;

/// One group.
pub(crate) type Lane = f64x2;

/// Width of a gap that there is not: nothing that is added to it in a run changes it.
pub(super) const BEYOND: f64 = 1e300;

/// What contact laws compute with: a number, or one in each lane.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Mul<Output = Self>
{
    /// A thing for each lane.
    type Each<M: Copy + Default + Send>: Copy + Default + Send;
    /// Itself where gap `g` is a contact, elsewhere 0.
    fn where_closed(self, g: Self) -> Self;
    /// Itself where it is above 0, elsewhere 0.
    fn positive(self) -> Self;
    /// What `law` gives for gap, rate and memory, in each lane.
    fn singly<M: Copy + Default + Send>(
        g: Self,
        w: Self,
        memory: &mut Self::Each<M>,
        law: impl Fn(f64, f64, &mut M) -> (f64, f64),
    ) -> (Self, Self);
}

impl Number for f64 {
    type Each<M: Copy + Default + Send> = M;

    #[inline]
    fn where_closed(self, g: Self) -> Self {
        if g <= 0.0 { self } else { 0.0 }
    }

    #[inline]
    fn positive(self) -> Self {
        if self > 0.0 { self } else { 0.0 }
    }

    #[inline]
    fn singly<M: Copy + Default + Send>(
        g: Self,
        w: Self,
        memory: &mut M,
        law: impl Fn(f64, f64, &mut M) -> (f64, f64),
    ) -> (Self, Self) {
        law(g, w, memory)
    }
}

impl Number for Lane {
    type Each<M: Copy + Default + Send> = [M; LANES];

    #[inline]
    fn where_closed(self, g: Self) -> Self {
        self & g.simd_le(Self::ZERO)
    }

    #[inline]
    fn positive(self) -> Self {
        self & self.simd_gt(Self::ZERO)
    }

    #[inline]
    fn singly<M: Copy + Default + Send>(
        g: Self,
        w: Self,
        memory: &mut [M; LANES],
        law: impl Fn(f64, f64, &mut M) -> (f64, f64),
    ) -> (Self, Self) {
        let (g, w) = (g.to_array(), w.to_array());
        let both: [_; LANES] = std::array::from_fn(|l| law(g[l], w[l], &mut memory[l]));
        (
            Self::new(both.map(|(force, _)| force)),
            Self::new(both.map(|(_, power)| power)),
        )
    }
}

/// Which lanes changed between contact and flight, as a mask.
#[inline]
pub(super) fn changed(before: Lane, now: Lane) -> Lane {
    before.simd_le(Lane::ZERO) ^ now.simd_le(Lane::ZERO)
}

/// What all gaps have, without the floor's, in groups filled up with `rest`.
pub(super) fn grouped(values: &[f64], rest: f64) -> Vec<Lane> {
    let group = |chunk: &[f64]| {
        let mut lane = [rest; LANES];
        lane[..chunk.len()].copy_from_slice(chunk);
        Lane::new(lane)
    };
    values[1..].chunks(LANES).map(group).collect()
}

/// The numbers of groups, one by one.
pub(super) fn singly(groups: &[Lane]) -> impl Iterator<Item = f64> {
    groups.iter().flat_map(|group| group.to_array())
}

/// What each gap of a group has below and above it, `under` being the gap below and
/// `over` the group above. Put together from whole groups: a load across two that have
/// just been stored would wait for both.
#[inline]
pub(super) fn neighbours(under: f64, here: Lane, over: Lane) -> (Lane, Lane) {
    let ([a, b], [c, ..]) = (here.to_array(), over.to_array());
    (Lane::new([under, a]), Lane::new([b, c]))
}

/// Sets to zero what is too small to matter to anything (lengths of 10⁻¹⁵⁰ m, whose
/// squares are still normal numbers), and keeps what is not a number.
pub(super) fn flush(row: &mut [Lane]) {
    for x in row {
        *x &= !x.abs().simd_lt(Lane::splat(NEGLIGIBLE));
    }
}

/// The same for one number.
pub(crate) fn flushed(x: f64) -> f64 {
    if x.abs() < NEGLIGIBLE { 0.0 } else { x }
}

const NEGLIGIBLE: f64 = 1e-150;
