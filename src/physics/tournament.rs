//! The smallest of many keys, in a tree of matches: O(log n) a change, O(1) a look.

/// Keys by index; the winner is the smallest, of equal ones the lowest index.
#[derive(Debug, Clone)]
pub(crate) struct Tournament {
    keys: Vec<f64>,
    /// Winner of each match; node 1 is the final, leaves start at `leaves`.
    winners: Vec<u32>,
    leaves: usize,
}

impl Tournament {
    /// `n` keys, all infinite.
    pub fn new(n: usize) -> Self {
        let leaves = n.next_power_of_two();
        let mut winners = vec![0; 2 * leaves];
        for (i, winner) in winners[leaves..].iter_mut().enumerate() {
            *winner = u32::try_from(i).expect("a column has fewer than 2^32 beads");
        }
        let mut tree = Self {
            keys: vec![f64::INFINITY; leaves],
            winners,
            leaves,
        };
        for node in (1..leaves).rev() {
            tree.play(node);
        }
        tree
    }

    fn play(&mut self, node: usize) -> bool {
        let (a, b) = (self.winners[2 * node], self.winners[2 * node + 1]);
        let winner = if self.keys[b as usize] < self.keys[a as usize] {
            b
        } else {
            a
        };
        let changed = self.winners[node] != winner;
        self.winners[node] = winner;
        changed
    }

    /// Sets key `i`.
    pub fn set(&mut self, i: usize, key: f64) {
        if self.keys[i] == key {
            return;
        }
        self.keys[i] = key;
        let i = u32::try_from(i).expect("as in new");
        let mut node = usize::midpoint(self.leaves, i as usize);
        while node > 0 {
            let changed = self.play(node);
            // Above a match that the new key neither won nor wins, nothing changes.
            if !changed && self.winners[node] != i {
                break;
            }
            node /= 2;
        }
    }

    /// Key `i`.
    pub fn get(&self, i: usize) -> f64 {
        self.keys[i]
    }

    /// The winner and its key.
    pub fn first(&self) -> (usize, f64) {
        let winner = self.winners[1] as usize;
        (winner, self.keys[winner])
    }

    /// Subtracts `shift` from every key, which keeps all winners.
    pub fn shift(&mut self, shift: f64) {
        for key in &mut self.keys {
            *key -= shift;
        }
        for node in (1..self.leaves).rev() {
            self.play(node);
        }
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
                keys[i] = key;
                tree.set(i, key);
                let least = keys.iter().copied().fold(f64::INFINITY, f64::min);
                let (winner, found) = tree.first();
                assert!(found == least && keys.get(winner).is_none_or(|&k| k == least));
            }
        }
    }
}
