//! Which collisions lose energy.

/// Whether a collision loses energy.
pub(super) trait Rule: Clone + Send + 'static {
    /// Whether a collision of beads `below` (None for the floor) and `above` at `t` is elastic.
    /// It is noted as their last one.
    fn elastic(&mut self, below: Option<usize>, above: usize, t: f64) -> bool;
    /// Moves the epoch on by so many units of time.
    fn shift(&mut self, shift: f64);
}

/// Every collision loses energy.
#[derive(Clone)]
pub(super) struct Always;

impl Rule for Always {
    fn elastic(&mut self, _: Option<usize>, _: usize, _: f64) -> bool {
        false
    }
    fn shift(&mut self, _: f64) {}
}

/// The TC model of Luding & McNamara (1998): a collision is elastic if either bead's last one
/// was less than t_c ago.
#[derive(Clone)]
pub(super) struct LastCollisions {
    contact_time: f64,
    last: Vec<f64>,
}

impl LastCollisions {
    pub fn new(n: usize, contact_time: f64) -> Self {
        Self {
            contact_time,
            last: vec![f64::NEG_INFINITY; n],
        }
    }
}

impl Rule for LastCollisions {
    fn elastic(&mut self, below: Option<usize>, above: usize, t: f64) -> bool {
        let mut elastic = false;
        for bead in below.into_iter().chain([above]) {
            elastic |= t - self.last[bead] < self.contact_time;
            self.last[bead] = t;
        }
        elastic
    }

    fn shift(&mut self, shift: f64) {
        for last in &mut self.last {
            *last -= shift;
        }
    }
}
