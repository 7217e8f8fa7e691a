//! The lattice of Sec. IV C: where the beads of a plane belong, and where they start.

use super::start::uniform;
use super::{Arrangement, Facts, Scene, SceneError};

/// Stream of the scene's seed that shifts the beads of a lattice.
const SHIFTS: u64 = 2;

/// Draws after which a bead that always overlaps another stays on its site.
const TRIES: usize = 100;

/// √3/2: distance of two rows in lattice constants.
const ROW: f64 = 0.866_025_403_784_438_6;

/// The sites of a triangular lattice of constant a = d + s₀ that is periodic across.
/// Bead i stands in row i / columns; odd rows are shifted by a/2 to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sites {
    /// Beads in a row.
    pub columns: usize,
    /// Number of rows h.
    pub rows: usize,
    /// Diameter d of the beads, m.
    pub diameter: f64,
    /// Separation s₀ of neighbours, and of the lowest row from the floor, m.
    pub separation: f64,
}

/// How two sites lie to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    /// Across, m.
    pub x: f64,
    /// Upwards, m.
    pub y: f64,
    /// |R|² − d², m², from whole numbers: nothing of a small separation is lost.
    pub excess: f64,
}

impl Facts {
    /// The sites of a scene whose beads are arranged as a lattice.
    pub fn sites(&self) -> Option<Sites> {
        let Arrangement::Lattice { columns, .. } = self.arrangement else {
            return None;
        };
        let separation = self.launch().map_or(0.0, |launch| launch.s0);
        Some(Sites {
            columns,
            rows: self.n / columns,
            diameter: self.diameter,
            separation,
        })
    }
}

impl Scene {
    /// The column that is as high as the lattice, all else being alike: what Fig. 4 shows
    /// beside it. None beside columns.
    ///
    /// # Errors
    /// When there can be no such column.
    pub fn column_as_high(&self) -> Option<Result<Scene, SceneError>> {
        let rows = self.sites()?.rows;
        Some(Scene::new(Facts {
            arrangement: Arrangement::Column,
            n: rows,
            ..self.facts().clone()
        }))
    }
}

impl Sites {
    /// Number of beads.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Lattice constant a, m.
    pub fn constant(&self) -> f64 {
        self.diameter + self.separation
    }

    /// Width L in which everything repeats, m.
    pub fn period(&self) -> f64 {
        self.columns as f64 * self.constant()
    }

    /// Half lattice constants from the left edge to a site.
    fn halves(&self, bead: usize) -> i64 {
        let (row, column) = (bead / self.columns, bead % self.columns);
        whole(2 * column + row % 2)
    }

    /// Place of a site across, m.
    pub fn x(&self, bead: usize) -> f64 {
        0.5 * self.halves(bead) as f64 * self.constant()
    }

    /// Height of a site's bead over the floor: that of its lowest point, m.
    pub fn floor_gap(&self, bead: usize) -> f64 {
        self.separation + (bead / self.columns) as f64 * (ROW * self.constant())
    }

    /// Reduced height of a site, m: zero for every bead of a lattice that just touches.
    pub fn reduced(&self, bead: usize) -> f64 {
        self.separation + (bead / self.columns) as f64 * (ROW * self.separation)
    }

    /// How site `to`, `turns` periods to the right, lies to site `from`.
    pub fn offset(&self, from: usize, to: usize, turns: i64) -> Offset {
        let across = self.halves(to) - self.halves(from) + turns * whole(2 * self.columns);
        let up = whole(to / self.columns) - whole(from / self.columns);
        let constant = self.constant();
        // |R|² = (p² + 3q²) a²/4, and a² − d² = s₀ (2d + s₀).
        let beyond = (across * across + 3 * up * up - 4) as f64;
        let touching = self.separation * (2.0 * self.diameter + self.separation);
        Offset {
            x: 0.5 * across as f64 * constant,
            y: ROW * up as f64 * constant,
            excess: touching + 0.25 * beyond * (constant * constant),
        }
    }

    /// The neighbours of a bead in the lattice that come after it: to the right, and the
    /// two above; each with the periods to go to the right.
    pub fn neighbours(&self, bead: usize) -> impl Iterator<Item = (usize, i64)> {
        let (row, column) = (bead / self.columns, bead % self.columns);
        let (columns, rows) = (self.columns, self.rows);
        let left_above = whole(row % 2) - 1;
        let beside = [(0, 1), (1, left_above), (1, left_above + 1)];
        beside.into_iter().filter_map(move |(up, right)| {
            let target = whole(column) + right;
            let turns = target.div_euclid(whole(columns));
            let column = usize::try_from(target.rem_euclid(whole(columns))).ok()?;
            (row + up < rows).then_some(((row + up) * columns + column, turns))
        })
    }

    /// Displacements of the beads from their sites at the start, m: all across, then all
    /// up. With jitter each bead is shifted at random by up to ±s₀/2 across and up, and
    /// drawn anew for as long as it overlaps a bead before it.
    pub(crate) fn shifts(&self, facts: &Facts) -> Vec<f64> {
        let n = self.count();
        let mut places = vec![0.0; 2 * n];
        if !facts.launch().is_some_and(|launch| launch.jitter) {
            return places;
        }
        let before = self.earlier_neighbours();
        let mut random = uniform(facts.seed, SHIFTS);
        let mut draw = || self.separation * (random.next().unwrap_or(0.5) - 0.5);
        for bead in 0..n {
            for _ in 0..TRIES {
                (places[bead], places[n + bead]) = (draw(), draw());
                let free = |&(other, offset): &(usize, Offset)| {
                    let x = places[bead] - places[other];
                    let y = places[n + bead] - places[n + other];
                    offset.excess_when_moved(x, y) > 0.0
                };
                if before[bead].iter().all(free) {
                    break;
                }
                // A bead on its site is free of all that are shifted by at most s₀/2.
                (places[bead], places[n + bead]) = (0.0, 0.0);
            }
        }
        places
    }

    /// For each bead its lattice neighbours of lower number, and how it lies to them.
    fn earlier_neighbours(&self) -> Vec<Vec<(usize, Offset)>> {
        let mut before = vec![Vec::new(); self.count()];
        for bead in 0..self.count() {
            for (other, turns) in self.neighbours(bead) {
                if other > bead {
                    before[other].push((bead, self.offset(bead, other, turns)));
                } else {
                    before[bead].push((other, self.offset(other, bead, -turns)));
                }
            }
        }
        before
    }
}

impl Offset {
    /// r² − d² of two beads displaced by (x, y) relative to each other, m².
    #[inline]
    pub fn excess_when_moved(&self, x: f64, y: f64) -> f64 {
        self.excess + x * (2.0 * self.x + x) + y * (2.0 * self.y + y)
    }
}

/// Numbers of beads are far below 2⁶³.
fn whole(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(separation: f64) -> Sites {
        Sites {
            columns: 5,
            rows: 4,
            diameter: 1e-3,
            separation,
        }
    }

    #[test]
    fn every_bond_has_the_lattice_constant_and_inner_beads_have_six() {
        let lattice = sites(1e-9);
        let mut bonds = vec![0; lattice.count()];
        for bead in 0..lattice.count() {
            for (other, turns) in lattice.neighbours(bead) {
                let offset = lattice.offset(bead, other, turns);
                let length = offset.x.hypot(offset.y);
                assert!((length / lattice.constant() - 1.0).abs() < 1e-14);
                assert_eq!(offset.excess, 1e-9 * (2e-3 + 1e-9));
                bonds[bead] += 1;
                bonds[other] += 1;
            }
        }
        assert!(bonds[..5].iter().chain(&bonds[15..]).all(|&k| k == 4));
        assert!(bonds[5..15].iter().all(|&k| k == 6));
    }

    #[test]
    fn a_lattice_without_separation_touches_exactly() {
        let lattice = sites(0.0);
        for bead in 0..lattice.count() {
            for (other, turns) in lattice.neighbours(bead) {
                assert_eq!(lattice.offset(bead, other, turns).excess, 0.0);
            }
            assert_eq!(lattice.reduced(bead), 0.0);
        }
        assert_eq!(lattice.floor_gap(0), 0.0);
    }
}
