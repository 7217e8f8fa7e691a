//! Which beads may touch soon: pairs that are nearer than a skin. A grid of cells finds them in
//! a time linear in the number of beads. They are found anew only when a bead has moved by half
//! the skin.

use crate::scene::lattice::{Offset, Sites};

/// Skin in diameters: below the distance of second neighbours, √3 − 1.
const SKIN: f64 = 0.3;

/// A pair that may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bond {
    pub i: u32,
    pub j: u32,
    /// Whether it touches.
    pub closed: bool,
    /// Whether it did when last written down.
    pub noted: bool,
    /// How the site of `j` lies to that of `i`.
    pub offset: Offset,
}

/// A bead that may touch the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    pub i: u32,
    /// Whether it touches.
    pub closed: bool,
    /// Whether it did when last written down.
    pub noted: bool,
    /// The floor's gap at its site, m.
    pub gap: f64,
}

/// The pairs that may touch.
#[derive(Clone, Debug, Default)]
pub(super) struct List {
    pub bonds: Vec<Bond>,
    pub feet: Vec<Foot>,
    /// Displacements at which it was made.
    made_at: Vec<f64>,
    /// Half the skin, m.
    slack: f64,
    cells: CellList,
    /// The pairs and beads that touched in the last list, in its order.
    touching: (Vec<[u32; 2]>, Vec<u32>),
}

/// Beads by the cell of a grid that they are in.
#[derive(Clone, Debug, Default)]
struct CellList {
    across: usize,
    up: usize,
    /// First place in `beads` of each cell, and one more.
    first: Vec<usize>,
    beads: Vec<u32>,
    /// Cell of each bead.
    of: Vec<usize>,
}

impl List {
    pub fn new(sites: &Sites, places: &[f64]) -> Self {
        let skin = (SKIN * sites.diameter).max(sites.separation);
        let mut list = Self {
            slack: 0.5 * skin,
            ..Self::default()
        };
        list.make(sites, places);
        list
    }

    /// How far, m, a bead may move before the list has to be made anew.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// Whether a bead has moved so far that a pair may be missing.
    pub fn is_stale(&self, places: &[f64]) -> bool {
        self.moved_squared(places) > self.slack * self.slack
    }

    /// How far, m, the bead that moved furthest has moved since the list was made.
    pub fn moved(&self, places: &[f64]) -> f64 {
        self.moved_squared(places).sqrt()
    }

    /// The square of that, m²; places that are no numbers have not moved.
    fn moved_squared(&self, places: &[f64]) -> f64 {
        let n = places.len() / 2;
        let (x, y) = places.split_at(n);
        let (x0, y0) = self.made_at.split_at(n);
        let mut most = 0.0;
        for (((x, y), x0), y0) in x.iter().zip(y).zip(x0).zip(y0) {
            let (dx, dy) = (x - x0, y - y0);
            let moved = dx * dx + dy * dy;
            most = if moved > most { moved } else { most };
        }
        most
    }

    /// Its beads that may touch the floor, each as a pair with itself, and its pairs, in order.
    pub fn contacts(&self) -> [Vec<[u32; 2]>; 2] {
        let feet = self.feet.iter().map(|foot| [foot.i, foot.i]);
        let bonds = self.bonds.iter().map(|bond| [bond.i, bond.j]);
        [feet.collect(), bonds.collect()]
    }

    /// Makes the list anew.
    pub fn make(&mut self, sites: &Sites, places: &[f64]) {
        places.clone_into(&mut self.made_at);
        let n = sites.count();
        let reach = sites.diameter + 2.0 * self.slack;
        self.cells.fill(sites, places, reach);
        self.remember();
        let (bonds, feet) = (&mut self.bonds, &mut self.feet);
        let (mut pairs, mut beads) = (&self.touching.0[..], &self.touching.1[..]);
        for i in 0..n {
            let gap = sites.floor_gap(i);
            if gap + places[n + i] < 2.0 * self.slack {
                let closed = !of_bead(&mut beads, |&bead| bead as usize, i).is_empty();
                feet.push(Foot {
                    i: index(i),
                    closed,
                    noted: closed,
                    gap,
                });
            }
            let own = of_bead(&mut pairs, |pair| pair[0] as usize, i);
            self.cells.around(i, |j| {
                if let Some(mut bond) = bond(sites, places, (i, j), reach) {
                    bond.closed = own.contains(&[bond.i, bond.j]);
                    bond.noted = bond.closed;
                    bonds.push(bond);
                }
            });
        }
    }

    /// Empties the list, but for what touches.
    fn remember(&mut self) {
        let (pairs, beads) = &mut self.touching;
        pairs.clear();
        beads.clear();
        let closed = self.bonds.drain(..).filter(|bond| bond.closed);
        pairs.extend(closed.map(|bond| [bond.i, bond.j]));
        let closed = self.feet.drain(..).filter(|foot| foot.closed);
        beads.extend(closed.map(|foot| foot.i));
    }
}

/// What belongs to bead `i`, off the front of a row that is ordered by beads.
fn of_bead<'a, T>(row: &mut &'a [T], bead: impl Fn(&T) -> usize, i: usize) -> &'a [T] {
    let skipped = row.iter().take_while(|x| bead(x) < i).count();
    let count = row[skipped..].iter().take_while(|x| bead(x) == i).count();
    let (own, rest) = row[skipped..].split_at(count);
    *row = rest;
    own
}

/// The pair of beads, open, if it is nearer than `reach` and `j` comes after `i`.
fn bond(sites: &Sites, places: &[f64], (i, j): (usize, usize), reach: f64) -> Option<Bond> {
    if j <= i {
        return None;
    }
    let n = sites.count();
    let (dx, dy) = (places[j] - places[i], places[n + j] - places[n + i]);
    let across = sites.x(j) - sites.x(i) + dx;
    let offset = sites.offset(i, j, turns(-across / sites.period()));
    let excess = offset.excess_when_moved(dx, dy);
    let beyond = reach * reach - sites.diameter * sites.diameter;
    (excess < beyond).then(|| Bond {
        i: index(i),
        j: index(j),
        closed: false,
        noted: false,
        offset,
    })
}

/// The nearest whole number.
fn turns(x: f64) -> i64 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "as saturates, and NaN becomes 0"
    )]
    let turns = x.round() as i64;
    // So far away nothing is counted exactly any more.
    turns.clamp(-(1 << 40), 1 << 40)
}

/// Scenes have at most a million beads.
fn index(i: usize) -> u32 {
    u32::try_from(i).expect("a bead's number fits")
}

impl CellList {
    fn fill(&mut self, sites: &Sites, places: &[f64], reach: f64) {
        let n = sites.count();
        let (period, height) = (sites.period(), |i: usize| {
            sites.floor_gap(i) + places[n + i]
        });
        let (low, high) = (0..n)
            .map(height)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
                (low.min(y), high.max(y))
            });
        // No more cells than beads in either direction, however far they have flown.
        self.across = whole(period / reach).clamp(1, n);
        self.up = whole((high - low) / reach).clamp(1, n);
        while self.across > 1 && self.across.saturating_mul(self.up) > 4 * n + 16 {
            self.across = self.across.div_ceil(2);
        }
        let (width, tall) = (
            period / self.across as f64,
            ((high - low) / self.up as f64).max(reach),
        );
        self.of.clear();
        self.first.clear();
        self.first.resize(self.across * self.up + 1, 0);
        for i in 0..n {
            let x = (sites.x(i) + places[i]).rem_euclid(period);
            let column = whole(x / width).min(self.across - 1);
            let row = whole((height(i) - low) / tall).min(self.up - 1);
            let cell = row * self.across + column;
            self.of.push(cell);
            self.first[cell + 1] += 1;
        }
        for cell in 1..self.first.len() {
            self.first[cell] += self.first[cell - 1];
        }
        self.beads.clear();
        self.beads.resize(n, 0);
        // From the last bead to the first, each at the end of what is left of its cell.
        for i in (0..n).rev() {
            let end = &mut self.first[self.of[i] + 1];
            *end -= 1;
            self.beads[*end] = index(i);
        }
        // Now each entry is where its cell begins, one cell too late.
        self.first.remove(0);
        self.first.push(n);
    }

    /// Calls `each` with every bead in the cell of bead `i` and the cells around it.
    fn around(&self, i: usize, mut each: impl FnMut(usize)) {
        let (row, column) = (self.of[i] / self.across, self.of[i] % self.across);
        let rows = row.saturating_sub(1)..(row + 2).min(self.up);
        // Periodic: fewer than three cells across are all there are.
        let columns = self.across.min(3);
        for row in rows {
            for k in 0..columns {
                let beside = (column + self.across + k - 1) % self.across;
                let cell = row * self.across + beside;
                for &j in &self.beads[self.first[cell]..self.first[cell + 1]] {
                    each(j as usize);
                }
            }
        }
    }
}

/// The whole part of a number that is not negative; of NaN 0.
fn whole(x: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "as saturates, and NaN becomes 0"
    )]
    let whole = x as usize;
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    /// Displacements of up to `far` in either direction.
    fn scattered(n: usize, far: f64, seed: u64) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = || f64::from(rng.next_u32()) / f64::from(u32::MAX) - 0.5;
        (0..2 * n).map(|_| 2.0 * far * draw()).collect()
    }

    /// All pairs nearer than the list's reach, each image tried.
    fn by_force(sites: &Sites, places: &[f64], reach: f64) -> Vec<[u32; 2]> {
        let n = sites.count();
        let mut near = Vec::new();
        for i in 0..n {
            for j in i + 1..n {
                let y = (sites.floor_gap(j) + places[n + j]) - (sites.floor_gap(i) + places[n + i]);
                let x = (sites.x(j) + places[j]) - (sites.x(i) + places[i]);
                let images = (-60..=60).map(|k| x + f64::from(k) * sites.period());
                if images.into_iter().any(|x| x.hypot(y) < reach) {
                    near.push([index(i), index(j)]);
                }
            }
        }
        near
    }

    #[test]
    fn cells_find_what_all_pairs_find() {
        let d = 1e-3;
        for (columns, rows) in [(3, 1), (3, 7), (4, 4), (5, 2), (13, 10)] {
            for separation in [0.0, 1e-6, 4e-4, 3e-3] {
                for (seed, far) in [(1, 1e-7), (2, 0.4 * d), (3, 3.0 * d), (4, 40.0 * d)] {
                    let sites = Sites {
                        columns,
                        rows,
                        diameter: d,
                        separation,
                    };
                    let places = scattered(sites.count(), far, seed);
                    let list = List::new(&sites, &places);
                    let reach = d + 2.0 * list.slack();
                    let mut found: Vec<_> = list.bonds.iter().map(|b| [b.i, b.j]).collect();
                    found.sort_unstable();
                    let case = format!("{columns} × {rows}, s0 {separation}, far {far}");
                    assert_eq!(found, by_force(&sites, &places, reach), "{case}");
                    let n = sites.count();
                    let low = |i: &usize| sites.floor_gap(*i) + places[n + i] < 2.0 * list.slack();
                    let feet: Vec<_> = list.feet.iter().map(|f| f.i as usize).collect();
                    assert_eq!(feet, (0..n).filter(low).collect::<Vec<_>>(), "{case}");
                }
            }
        }
    }

    #[test]
    fn a_new_list_remembers_what_touches() {
        let sites = Sites {
            columns: 5,
            rows: 4,
            diameter: 1e-3,
            separation: 0.0,
        };
        let places = vec![0.0; 40];
        let mut list = List::new(&sites, &places);
        let ends = [0, 7, list.bonds.len() - 1];
        for k in ends {
            list.bonds[k].closed = true;
        }
        list.feet[3].closed = true;
        let pairs = ends.map(|k| [list.bonds[k].i, list.bonds[k].j]);
        // Other places, another order: what touches is known by its beads.
        let moved = scattered(20, 1e-4, 5);
        list.make(&sites, &moved);
        let closed: Vec<_> = list.bonds.iter().filter(|b| b.closed && b.noted).collect();
        let mut closed: Vec<_> = closed.iter().map(|b| [b.i, b.j]).collect();
        closed.sort_unstable();
        let mut pairs = pairs.to_vec();
        pairs.sort_unstable();
        assert_eq!(closed, pairs);
        let feet: Vec<_> = list.feet.iter().filter(|f| f.closed).map(|f| f.i).collect();
        assert_eq!(feet, [3]);
    }
}
