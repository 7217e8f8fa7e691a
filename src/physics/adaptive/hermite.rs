//! Where a function first falls to zero within a step, from its value, slope and curvature at
//! both ends.

/// A function over a step of unit length, as its Hermite interpolation of fifth degree.
#[derive(Debug, Clone, Copy)]
pub(super) struct HermiteQuintic {
    /// Bernstein coefficients. The quintic lies within their range, so it is positive where all
    /// of them are.
    bernstein: [f64; 6],
    /// Roughly how far the quintic may be off the function.
    doubt: f64,
}

/// Value, slope and curvature, in units of the step.
pub(super) type Jet = [f64; 3];

/// Whether a function falls to zero in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Crossing {
    /// It stays above zero.
    Never,
    /// It comes so near to zero that only a shorter step can tell.
    Perhaps,
    /// It falls to zero at this part of the step.
    At(f64),
}

impl HermiteQuintic {
    pub fn new(start: Jet, end: Jet) -> Self {
        let ([f, df, ddf], [g, dg, ddg]) = (start, end);
        let bernstein = [
            f,
            f + df / 5.0,
            f + 2.0 * df / 5.0 + ddf / 20.0,
            g - 2.0 * dg / 5.0 + ddg / 20.0,
            g - dg / 5.0,
            g,
        ];
        // The Hermite cubic needs no curvatures. How far its own are from those given says how
        // smooth the function is. They differ in the middle by at most a 64th of that; the
        // quintic is taken to be off by a tenth of it.
        let cubic_start = 6.0 * (g - f) - 4.0 * df - 2.0 * dg;
        let cubic_end = -6.0 * (g - f) + 2.0 * df + 4.0 * dg;
        let doubt = ((ddf - cubic_start).abs() + (ddg - cubic_end).abs()) / 640.0;
        Self { bernstein, doubt }
    }

    /// Its first fall to zero; it starts above.
    pub fn fall(&self) -> Crossing {
        if let Some(at) = first_root(self.bernstein, 0.0, 1.0, 0) {
            return Crossing::At(at);
        }
        let raised = self.bernstein.map(|b| b - self.doubt);
        // The ends are known without doubt.
        let ends = self.bernstein[0].min(self.bernstein[5]);
        if ends > self.doubt && first_root(raised, 0.0, 1.0, 0).is_some() {
            Crossing::Perhaps
        } else {
            Crossing::Never
        }
    }
}

/// Bisections after which a place in the step is known to rounding.
const DEEPEST: u32 = 50;

/// The first root of the quintic with Bernstein coefficients `b` on this piece of the step, by
/// bisection.
fn first_root(b: [f64; 6], from: f64, to: f64, depth: u32) -> Option<f64> {
    if b.iter().all(|&b| b > 0.0) {
        return None;
    }
    if depth == DEEPEST {
        return Some(to);
    }
    let (left, right) = halves(b);
    let middle = 0.5 * (from + to);
    first_root(left, from, middle, depth + 1).or_else(|| first_root(right, middle, to, depth + 1))
}

/// The Bernstein coefficients of both halves, by de Casteljau's algorithm.
fn halves(mut b: [f64; 6]) -> ([f64; 6], [f64; 6]) {
    let (mut left, mut right) = (b, b);
    for k in 1..6 {
        for i in 0..6 - k {
            b[i] = 0.5 * (b[i] + b[i + 1]);
        }
        left[k] = b[0];
        right[5 - k] = b[5 - k];
    }
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quintic Σ c_k x^k.
    fn quintic(c: [f64; 6]) -> HermiteQuintic {
        let jet = |x: f64| -> Jet {
            let mut jet = [0.0; 3];
            for (k, c) in c.iter().enumerate() {
                let k = i32::try_from(k).expect("small");
                jet[0] += c * x.powi(k);
                if k > 0 {
                    jet[1] += c * f64::from(k) * x.powi(k - 1);
                }
                if k > 1 {
                    jet[2] += c * f64::from(k * (k - 1)) * x.powi(k - 2);
                }
            }
            jet
        };
        HermiteQuintic::new(jet(0.0), jet(1.0))
    }

    #[test]
    fn the_first_of_several_roots() {
        // (x − 0.3)(x − 0.6)(x − 0.9), negated: above zero at 0.
        let found = quintic([0.162, -0.99, 1.8, -1.0, 0.0, 0.0]).fall();
        let Crossing::At(at) = found else {
            panic!("{found:?}")
        };
        // The coefficients are rounded.
        assert!((at - 0.3).abs() < 1e-14, "{at}");
    }

    #[test]
    fn a_dip_between_two_ends_far_above_is_seen() {
        // 25 (x − ½)⁴ + 0.1 (x − ½)² − 10⁻⁹.
        let dip = |below: f64| {
            let (a, b) = (25.0, 0.1);
            quintic([
                a / 16.0 + b / 4.0 - below,
                -a / 2.0 - b,
                1.5 * a + b,
                -2.0 * a,
                a,
                0.0,
            ])
            .fall()
        };
        assert!(matches!(dip(1e-9), Crossing::At(at) if (0.49..0.5).contains(&at)));
        assert_eq!(dip(-1e-9), Crossing::Perhaps);
        assert_eq!(dip(-1.0), Crossing::Never);
    }
}
