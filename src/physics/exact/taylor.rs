//! The Taylor series of a cluster in time.
//!
//! Between contact changes the gaps obey a linear system with constant coefficients. So a
//! recurrence gives each coefficient from the two before it.
//!
//! Coefficients are scaled: gap(τ) = Σ b_k s^k with s = τ/h. There is a row of them a power
//! of s. Rows are padded to a multiple of four gaps, so that loops over gaps run in lanes of
//! the processor's vectors.

#![expect(
    clippy::inline_always,
    reason = "loops over gaps run in lanes only where their number is known when compiled"
)]

use super::polynomial::{Polynomial, ROWS};
use crate::physics::spring::Spring;

/// Largest phase ρh of one step, ρ being the fastest rate of the cluster. The first term
/// left out is at most 2²⁵/25! = 2·10⁻¹⁸ of the motion.
pub(super) const PHASE: f64 = 2.0;

/// Largest part of the motion that a term may be and be left out.
pub(super) const NEGLIGIBLE: f64 = 1e-17;

/// What couples the gaps of a cluster, a value a gap, padded with zeros.
#[derive(Debug, Clone, Default)]
pub(super) struct Coupling {
    /// K h², zero where no force acts.
    pub stiffness: Vec<f64>,
    /// c h, zero where no force acts.
    pub dashpot: Vec<f64>,
    /// 1/m of the bead below each gap; zero for the floor.
    pub below: Vec<f64>,
    /// 1/m of the bead above each gap.
    pub above: Vec<f64>,
}

impl Coupling {
    /// Makes it zeros for `lanes` gaps.
    pub fn clear(&mut self, lanes: usize) {
        let rows = [
            &mut self.stiffness,
            &mut self.dashpot,
            &mut self.below,
            &mut self.above,
        ];
        for row in rows {
            row.clear();
            row.resize(lanes, 0.0);
        }
    }
}

/// The number of gaps, padded to a multiple of four.
pub(super) fn lanes(gaps: usize) -> usize {
    gaps.next_multiple_of(4)
}

/// Calls `$f` with the number of lanes, which the compiler knows where it is small.
macro_rules! in_lanes {
    ($lanes:expr, $f:ident ( $($argument:expr),* )) => {
        match $lanes {
            4 => $f(4, $($argument),*),
            8 => $f(8, $($argument),*),
            12 => $f(12, $($argument),*),
            16 => $f(16, $($argument),*),
            lanes => $f(lanes, $($argument),*),
        }
    };
}

/// Fills in the rows from 2 on. Rows 0 and 1 are given: gap, and rate times h.
///
/// `pull` are the Taylor coefficients of what gravity and plate accelerate the cluster's
/// first gap by, times h², where that is the column's lowest. `force`, of length
/// lanes + 2, is a buffer.
pub(super) fn expand(
    b: &mut [f64],
    coupling: &Coupling,
    pull: Option<&Polynomial>,
    force: &mut [f64],
) {
    let lanes = coupling.above.len();
    in_lanes!(lanes, expand_lanes(b, coupling, pull, force));
}

#[inline(always)]
fn expand_lanes(
    lanes: usize,
    b: &mut [f64],
    coupling: &Coupling,
    pull: Option<&Polynomial>,
    force: &mut [f64],
) {
    let stiffness = &coupling.stiffness[..lanes];
    let dashpot = &coupling.dashpot[..lanes];
    let below = &coupling.below[..lanes];
    let above = &coupling.above[..lanes];
    let force = &mut force[..lanes + 2];
    (force[0], force[lanes + 1]) = (0.0, 0.0);
    for k in 0..ROWS - 2 {
        let (done, next) = b.split_at_mut((k + 2) * lanes);
        let (b0, b1) = done[k * lanes..].split_at(lanes);
        let (b0, b1, b2) = (&b0[..lanes], &b1[..lanes], &mut next[..lanes]);
        let power = (k + 1) as f64;
        for j in 0..lanes {
            force[j + 1] = stiffness[j] * b0[j] + dashpot[j] * (power * b1[j]);
        }
        let divisor = 1.0 / (power * (power + 1.0));
        for j in 0..lanes {
            b2[j] = divisor
                * ((force[j] - force[j + 1]) * below[j] + (force[j + 2] - force[j + 1]) * above[j]);
        }
        if let Some(pull) = pull {
            b2[0] += divisor * pull[k];
        }
    }
}

/// The series of a cluster.
#[derive(Clone, Debug)]
pub(super) struct TaylorSeries {
    /// Rows of coefficients.
    b: Vec<f64>,
    lanes: usize,
    /// Unit of time, s.
    pub h: f64,
}

impl TaylorSeries {
    /// The series of `lanes` gaps with these rows of coefficients, in units of `h` s.
    pub fn new(rows: Vec<f64>, lanes: usize, h: f64) -> Self {
        Self { b: rows, lanes, h }
    }

    /// Its rows of coefficients.
    pub fn into_rows(self) -> Vec<f64> {
        self.b
    }

    /// Writes the gaps, m, and their rates, m/s, at `s`.
    pub fn evaluate(&self, s: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let (gaps, rates) = (&mut gaps[..self.lanes], &mut rates[..self.lanes]);
        in_lanes!(self.lanes, evaluate_lanes(&self.b, s, gaps, rates));
        for rate in rates {
            *rate /= self.h;
        }
    }

    /// Gap `j` as a polynomial in s/reach, times `sign`.
    pub fn gap(&self, j: usize, sign: f64, reach: f64) -> Polynomial {
        let mut power = sign;
        std::array::from_fn(|k| {
            let c = power * self.b[k * self.lanes + j];
            power *= reach;
            c
        })
    }

    /// Force of the contact at gap `j` as a polynomial in s/reach, times `sign`.
    pub fn force(&self, j: usize, spring: Spring, sign: f64, reach: f64) -> Polynomial {
        let mut power = -sign;
        let mut force = std::array::from_fn(|k| {
            let slope = match self.b.get((k + 1) * self.lanes + j) {
                Some(next) => (k + 1) as f64 * next / self.h,
                None => 0.0,
            };
            let elastic = spring.stiffness * self.b[k * self.lanes + j];
            let c = power * (elastic + spring.dashpot * slope);
            power *= reach;
            c
        });
        // Spring and dashpot cancel but for rounding: the force is zero, and its slope
        // decides where it goes.
        if force[0].abs() <= 16.0 * f64::EPSILON * (spring.stiffness * self.b[j]).abs() {
            force[0] = 0.0;
        }
        force
    }

    /// Energy ∫ Σ_j c_j w_j² dt that dashpots c_j lose from 0 to `s`, by Gauss-Legendre
    /// quadrature. `rates` and `slopes`, as long as the series, are buffers.
    pub fn dissipation(
        &self,
        s: f64,
        dashpots: &[f64],
        rates: &mut [f64],
        slopes: &mut [f64],
    ) -> f64 {
        // The fewest nodes whose error is below 10⁻¹³: a rate squared has a phase of up to
        // 2·PHASE·s.
        let nodes: &[(f64, f64)] = match s {
            s if s < 0.01 => &GAUSS_3,
            s if s < 0.16 => &GAUSS_5,
            _ => &GAUSS_8,
        };
        let slopes = &mut slopes[..(ROWS - 1) * self.lanes];
        in_lanes!(self.lanes, differentiate(&self.b, slopes));
        let mut sum = 0.0;
        for &(node, weight) in nodes {
            let node = s * node;
            sum += weight * in_lanes!(self.lanes, power_lost(slopes, node, dashpots, rates));
        }
        sum * s / self.h
    }

    /// How far the series may be used, s ≥ 1: its last two terms stay negligible against
    /// the motion of the gaps in which forces act.
    pub fn reach(&self, stiffness: &[f64]) -> f64 {
        let row = |k: usize| &self.b[k * self.lanes..(k + 1) * self.lanes];
        let (mut motion, mut last) = (0.0_f64, 0.0_f64);
        for (j, k) in stiffness.iter().enumerate() {
            if *k != 0.0 {
                let size = row(0)[j].abs() + row(1)[j].abs() + row(2)[j].abs();
                motion = motion.max(size);
            }
            last = last.max(row(ROWS - 1)[j].abs()).max(row(ROWS - 2)[j].abs());
        }
        let most = NEGLIGIBLE * motion;
        let farther = FARTHER.iter().find(|(_, power)| last * power <= most);
        farther.map_or(1.0, |&(reach, _)| reach)
    }

    /// Writes the least partial sum of each gap's series at `reach`, times `sign` (+1 or −1).
    ///
    /// Where it is not below 0 the gap keeps its sign up to `reach`, by Abel's summation
    /// (see [`polynomial`](super::polynomial)). `sums` is a buffer.
    pub fn least_sums(&self, sign: &[f64], reach: f64, sums: &mut [f64], least: &mut [f64]) {
        in_lanes!(
            self.lanes,
            least_sums_lanes(&self.b, sign, reach, sums, least)
        );
    }
}

/// Where a series may end beyond s = 1, and s^24, by which its last term has grown there.
const FARTHER: [(f64, f64); 3] = [(4.0, 2.815e14), (2.5, 3.553e9), (1.6, 79_230.0)];

#[inline(always)]
fn evaluate_lanes(lanes: usize, b: &[f64], s: f64, gaps: &mut [f64], rates: &mut [f64]) {
    let (gaps, rates) = (&mut gaps[..lanes], &mut rates[..lanes]);
    gaps.fill(0.0);
    rates.fill(0.0);
    for row in b[..ROWS * lanes].chunks_exact(lanes).rev() {
        for j in 0..lanes {
            rates[j] = rates[j] * s + gaps[j];
            gaps[j] = gaps[j] * s + row[j];
        }
    }
}

/// Writes the series of the rates times h.
#[inline(always)]
fn differentiate(lanes: usize, b: &[f64], slopes: &mut [f64]) {
    let mut power = 0.0;
    let rows = slopes.chunks_exact_mut(lanes);
    for (slopes, row) in rows.zip(b.chunks_exact(lanes).skip(1)) {
        power += 1.0;
        for j in 0..lanes {
            slopes[j] = power * row[j];
        }
    }
}

/// Σ_j c_j ẇ_j² at `s`, ẇ the rates times h.
#[inline(always)]
fn power_lost(lanes: usize, slopes: &[f64], s: f64, dashpot: &[f64], rates: &mut [f64]) -> f64 {
    let (dashpot, rates) = (&dashpot[..lanes], &mut rates[..lanes]);
    rates.fill(0.0);
    for row in slopes.chunks_exact(lanes).rev() {
        for j in 0..lanes {
            rates[j] = rates[j] * s + row[j];
        }
    }
    dashpot
        .iter()
        .zip(rates.iter())
        .map(|(c, w)| c * w * w)
        .sum()
}

#[inline(always)]
fn least_sums_lanes(
    lanes: usize,
    b: &[f64],
    sign: &[f64],
    reach: f64,
    sums: &mut [f64],
    least: &mut [f64],
) {
    let (sign, sums, least) = (&sign[..lanes], &mut sums[..lanes], &mut least[..lanes]);
    sums.fill(0.0);
    least.fill(0.0);
    let mut power = 1.0;
    for row in b[..ROWS * lanes].chunks_exact(lanes) {
        for j in 0..lanes {
            sums[j] += sign[j] * power * row[j];
            least[j] = if sums[j] < least[j] {
                sums[j]
            } else {
                least[j]
            };
        }
        power *= reach;
    }
}

/// Nodes and weights of the Gauss-Legendre quadrature on [0, 1].
const GAUSS_3: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 0.277_777_777_777_777_8),
    (0.5, 0.444_444_444_444_444_4),
    (0.887_298_334_620_741_7, 0.277_777_777_777_777_8),
];
const GAUSS_5: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];
const GAUSS_8: [(f64, f64); 8] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_63),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_63),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];
