//! Straight lines, medians and standard errors.

use crate::math;

/// Slope of the line of least squares through the points; none through fewer than
/// two places.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let over: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let under: f64 = points.iter().map(|p| math::powi(p.0 - x, 2)).sum();
    (points.len() >= 2 && under > 0.0).then(|| over / under)
}

/// The value in the middle; NaN of none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// Fewest blocks whose scatter says something.
const FEWEST_BLOCKS: usize = 8;

/// Standard error of the mean of values that may depend on their neighbours: the
/// largest over blocks of 1, 2, 4, .. of them (Flyvbjerg and Petersen 1989). None of
/// fewer than 8 values.
pub fn standard_error(values: &[f64]) -> Option<f64> {
    let mut blocks = values.to_vec();
    let mut largest: Option<f64> = None;
    while blocks.len() >= FEWEST_BLOCKS {
        let n = blocks.len() as f64;
        let mean = blocks.iter().sum::<f64>() / n;
        let scatter: f64 = blocks.iter().map(|x| math::powi(x - mean, 2)).sum();
        let error = (scatter / (n * (n - 1.0))).sqrt();
        largest = Some(largest.map_or(error, |most| most.max(error)));
        blocks = blocks
            .chunks_exact(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .collect();
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_its_slope() {
        let points: Vec<_> = (0..5)
            .map(|k| (f64::from(k), 3.0 - 2.0 * f64::from(k)))
            .collect();
        assert_eq!(slope(&points), Some(-2.0));
        assert_eq!(slope(&points[..1]), None);
        assert_eq!(slope(&[(1.0, 2.0), (1.0, 3.0)]), None);
    }

    #[test]
    fn medians() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn blocks_see_that_neighbours_are_alike() {
        // 64 values in 8 groups of 8 alike are 8 values.
        let groups = [0.3, -1.2, 0.8, 0.1, -0.4, 1.9, -0.7, -0.8];
        let values: Vec<f64> = groups.iter().flat_map(|&g| [g; 8]).collect();
        let of_groups = standard_error(&groups).expect("8 values");
        let of_values = standard_error(&values).expect("64 values");
        assert!((of_values - of_groups).abs() < 1e-15);
        assert_eq!(standard_error(&groups[..7]), None);
    }
}
