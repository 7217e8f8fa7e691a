//! The smallest of many keys, in a tree of matches: O(log n) a change, O(log n) a look.
//!
//! Sixteen meet in a match, two beside each other, without a branch that nobody could
//! predict; up to sixteen keys need no tree at all.

use wide::f64x2;

/// Who meet in one match.
const WIDE: usize = 16;
const PAIRS: usize = WIDE / 2;

/// Keys, or winners of the matches below.
type Match = [f64; WIDE];

fn pairs(keys: &Match) -> [f64x2; PAIRS] {
    std::array::from_fn(|k| f64x2::new([keys[2 * k], keys[2 * k + 1]]))
}

/// The smallest key of a match.
#[inline]
fn least(keys: &Match) -> f64 {
    let [a, b, c, d, e, f, g, h] = pairs(keys);
    let low = a.fast_min(b).fast_min(c.fast_min(d));
    let high = e.fast_min(f).fast_min(g.fast_min(h));
    let [x, y] = low.fast_min(high).to_array();
    if x < y { x } else { y }
}

/// The first seat of a match that has the key `least`, which is one of them.
#[inline]
fn seat(keys: &Match, least: f64) -> usize {
    let least = f64x2::splat(least);
    let here = pairs(keys).map(|pair| pair.simd_eq(least).to_bitmask());
    let seats = (0..PAIRS).fold(0, |seats, k| seats | here[k] << (2 * k));
    seats.trailing_zeros() as usize % WIDE
}

/// Keys by index; the winner is the smallest, of equal ones the lowest index.
#[derive(Debug, Clone)]
pub(crate) struct Tournament {
    /// The final, the matches below it, and so on; last come those of the keys.
    matches: Vec<Match>,
    /// How many matches are between winners: the keys' come after them.
    leaves: usize,
    /// Where the keys start.
    keys: usize,
}

impl Tournament {
    /// `n` keys, all infinite.
    pub fn new(n: usize) -> Self {
        let needed = n.div_ceil(WIDE).max(1);
        let (mut leaves, mut level) = (0, 1);
        while level < needed {
            leaves += level;
            level *= WIDE;
        }
        Self {
            matches: vec![[f64::INFINITY; WIDE]; leaves + needed],
            leaves,
            keys: leaves * WIDE,
        }
    }

    /// Sets key `i`.
    pub fn set(&mut self, i: usize, key: f64) {
        self.write(i, key);
        self.play_again(i, i);
    }

    /// Sets key `i`, whose matches are to be played by [`Self::play_again`]. That of
    /// neighbours costs hardly more than that of one: most of their matches are the
    /// same. What is not a number comes first, so that somebody looks at it.
    #[inline]
    pub fn write(&mut self, i: usize, key: f64) {
        let first = f64::NEG_INFINITY;
        let i = self.keys + i;
        self.matches.as_flattened_mut()[i] = if key > first { key } else { first };
    }

    /// Plays the matches of the keys from `low` to `high` again.
    #[inline]
    pub fn play_again(&mut self, low: usize, high: usize) {
        let (mut low, mut high) = (self.leaves + low / WIDE, self.leaves + high / WIDE);
        while low > 0 {
            let mut changed = false;
            for i in low..=high {
                let least = least(&self.matches[i]);
                let seat = &mut self.matches.as_flattened_mut()[i - 1];
                changed |= *seat != least;
                *seat = least;
            }
            if !changed {
                return;
            }
            (low, high) = ((low - 1) / WIDE, (high - 1) / WIDE);
        }
    }

    /// Key `i`.
    pub fn get(&self, i: usize) -> f64 {
        self.matches.as_flattened()[self.keys + i]
    }

    /// The winner and its key.
    #[inline]
    pub fn first(&self) -> (usize, f64) {
        let least = least(&self.matches[0]);
        let mut i = 0;
        loop {
            let seat = seat(&self.matches[i], least);
            if i >= self.leaves {
                return ((i - self.leaves) * WIDE + seat, least);
            }
            i = i * WIDE + 1 + seat;
        }
    }

    /// Subtracts `shift` from every key. Rounding keeps their order, so that no match has
    /// to be played again.
    pub fn shift(&mut self, shift: f64) {
        for key in self.matches.as_flattened_mut() {
            *key -= shift;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_a_linear_search() {
        for n in [1, 2, 3, 12, 17, 100, 257, 5000] {
            let mut tree = Tournament::new(n);
            let mut keys = vec![f64::INFINITY; n];
            let mut random = 12345_u64;
            for _ in 0..2000 {
                random = random
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                let i = (random >> 33) as usize % n;
                let key = if random.is_multiple_of(7) {
                    f64::INFINITY
                } else {
                    ((random >> 20) % 50) as f64
                };
                // One key, or two neighbours at once.
                let j = (i + usize::from(random.is_multiple_of(3))).min(n - 1);
                for k in i..=j {
                    keys[k] = key;
                    tree.write(k, key);
                }
                tree.play_again(i, j);
                if random.is_multiple_of(11) {
                    tree.shift(0.1);
                    for key in &mut keys {
                        *key -= 0.1;
                    }
                }
                let least = keys.iter().copied().fold(f64::INFINITY, f64::min);
                let (winner, found) = tree.first();
                assert!(found == least && keys.iter().position(|&k| k == least) == Some(winner));
            }
        }
    }

    #[test]
    fn what_is_not_a_number_comes_first() {
        let mut tree = Tournament::new(40);
        tree.set(7, -1e300);
        tree.set(33, f64::NAN);
        assert_eq!(tree.first(), (33, f64::NEG_INFINITY));
    }
}
