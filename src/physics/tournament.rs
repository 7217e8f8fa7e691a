//! The smallest of many keys, in a tree of matches: O(log n) a change, O(1) a look.

/// A key and whose it is, in one number: the smaller key wins, of equal ones the lower
/// index, without a branch that nobody could predict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Player(u128);

impl Player {
    fn new(key: f64, index: usize) -> Self {
        // Zero has one sign; the bits of negative numbers fall as the numbers rise.
        let bits = (key + 0.0).to_bits();
        let ordered = if bits >> 63 == 0 {
            bits | 1 << 63
        } else {
            !bits
        };
        Self(u128::from(ordered) << 64 | index as u128)
    }

    fn key(self) -> f64 {
        let ordered = (self.0 >> 64) as u64;
        f64::from_bits(if ordered >> 63 == 1 {
            ordered & !(1 << 63)
        } else {
            !ordered
        })
    }

    fn index(self) -> usize {
        self.0 as usize
    }
}

/// Keys by index; the winner is the smallest, of equal ones the lowest index.
#[derive(Debug, Clone)]
pub(crate) struct Tournament {
    /// Winner of each match; 1 is the final, and the keys themselves start at `leaves`.
    nodes: Vec<Player>,
    leaves: usize,
}

impl Tournament {
    /// `n` keys, all infinite.
    pub fn new(n: usize) -> Self {
        let leaves = n.next_power_of_two();
        let player = |i: usize| Player::new(f64::INFINITY, i.saturating_sub(leaves));
        let mut tree = Self {
            nodes: (0..2 * leaves).map(player).collect(),
            leaves,
        };
        tree.play_all();
        tree
    }

    fn play(&mut self, node: usize) {
        self.nodes[node] = self.nodes[2 * node].min(self.nodes[2 * node + 1]);
    }

    fn play_all(&mut self) {
        for node in (1..self.leaves).rev() {
            self.play(node);
        }
    }

    /// Sets key `i`.
    pub fn set(&mut self, i: usize, key: f64) {
        self.write(i, key);
        self.play_again(i, i);
    }

    /// Sets key `i`, whose matches are to be played by [`Self::play_again`]. That of
    /// neighbours costs hardly more than that of one: most of their matches are the same.
    pub fn write(&mut self, i: usize, key: f64) {
        self.nodes[self.leaves + i] = Player::new(key, i);
    }

    /// Plays the matches of the keys from `low` to `high` again.
    pub fn play_again(&mut self, low: usize, high: usize) {
        let (mut low, mut high) = (self.leaves + low, self.leaves + high);
        while low < high {
            (low, high) = (low / 2, high / 2);
            for node in low..=high {
                self.play(node);
            }
        }
        let mut winner = self.nodes[low];
        while low > 1 {
            winner = winner.min(self.nodes[low ^ 1]);
            low /= 2;
            self.nodes[low] = winner;
        }
    }

    /// Key `i`.
    pub fn get(&self, i: usize) -> f64 {
        self.nodes[self.leaves + i].key()
    }

    /// The winner and its key.
    pub fn first(&self) -> (usize, f64) {
        (self.nodes[1].index(), self.nodes[1].key())
    }

    /// Subtracts `shift` from every key, which keeps all winners but of keys that become
    /// equal.
    pub fn shift(&mut self, shift: f64) {
        for player in &mut self.nodes[self.leaves..] {
            *player = Player::new(player.key() - shift, player.index());
        }
        self.play_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_a_linear_search() {
        for n in [1, 2, 3, 12, 100] {
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
                let least = keys.iter().copied().fold(f64::INFINITY, f64::min);
                let (winner, found) = tree.first();
                assert!(found == least && keys.iter().position(|&k| k == least) == Some(winner));
            }
        }
    }
}
