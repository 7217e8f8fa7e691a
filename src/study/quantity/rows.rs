//! The rows of the table, in the order in which they are written.

use super::{Meaning, Quantity, Seen, Source, number};
use crate::physics::{self, Observation};
use crate::scene::{Arrangement, MethodName, PowerLaw, Preset, Scene};
use crate::study::measure::{Results, rounding};
use crate::study::sensitivity::{Measured, Sensitivity};
use crate::study::table::Cell;
use crate::study::verdict::{Verdict, Word};

/// What is known of a floor collision's energies at most: it counts as over when no more
/// than this part of them can still change.
const AT_THE_END: f64 = 1e-12;

/// What is shown of a σ that nobody has measured the sensitivity of.
const CHAOTIC: f64 = 5e-3;

pub(super) static ROWS: [Quantity; 42] = [
    named("preset", |preset| preset.name.as_str().into()),
    fact("method", "", "", |scene| {
        scene.method.name().as_str().into()
    })
    .meaning_by(|scene| scene.method.name().meaning()),
    fact("law", "", "", |scene| {
        scene.law().map(|law| law.name().as_str()).into()
    })
    .meaning_by(|scene| scene.law().map_or("", |law| law.name().meaning())),
    fact("beta", "", "elastic force x^(1+beta)", |scene| {
        number(power(scene).map(|law| law.exponents.beta()))
    }),
    fact("gamma", "", "dissipative force x^gamma dx/dt", |scene| {
        number(power(scene).map(|law| law.exponents.gamma()))
    }),
    fact(
        "stiffness",
        "SI",
        "K/m, m being the reduced mass of two beads",
        |scene| number(power(scene).map(|law| law.stiffness)),
    ),
    fact("damping", "SI", "D_n", |scene| {
        number(power(scene).map(|law| law.damping))
    }),
    fact("n", "", "beads", |scene| Cell::Count(scene.n as u64)),
    // Under a power law these depend on the speed.
    fact("restitution", "", "of two beads", |scene| {
        Cell::Number(scene.restitution)
    })
    .under_power_laws("of two beads at the scene's own speed"),
    fact("floor_restitution", "", "of a bead on the floor", |scene| {
        Cell::Number(physics::floor_restitution(scene))
    })
    .under_power_laws("of a bead on the floor at that speed"),
    fact(
        "restitution_min",
        "",
        "least of two neighbours, which share one spring",
        |scene| number(physics::restitution_range(scene).map(|(least, _)| least)),
    ),
    fact("restitution_max", "", "the largest", |scene| {
        number(physics::restitution_range(scene).map(|(_, most)| most))
    }),
    fact("contact_time", "s", "of two beads", |scene| {
        number(scene.contact_time())
    })
    .under_power_laws("of two beads at that speed, undamped"),
    fact("v0", "m/s", "velocity at the start", |scene| {
        number(scene.launch().map(|launch| launch.v0))
    }),
    fact("s0", "m", "separation at the start", |scene| {
        number(scene.launch().map(|launch| launch.s0))
    }),
    fact("sigma0", "", "s0/(|v0| contact_time)", |scene| {
        number(scene.sigma0())
    }),
    of_lattices("rows", "", "of the lattice", |scene| {
        scene.sites().map(|sites| sites.rows as u64).into()
    }),
    of_lattices("columns", "", "beads in a row", |scene| {
        scene.sites().map(|sites| sites.columns as u64).into()
    }),
    of_lattices(
        "tangential_damping",
        "1/s",
        "D_t, across contacts",
        |scene| match scene.arrangement {
            Arrangement::Lattice { tangential, .. } => Cell::Number(tangential),
            Arrangement::Column => Cell::Empty,
        },
    ),
    result("eps_eff", "", "sqrt(E_f/E_0)", |run| run.eps_eff).at_best(|_, _| AT_THE_END),
    result(
        "er_over_ef",
        "",
        "share of E_f that is relative motion",
        |run| run.er_over_ef,
    )
    .at_best(|scene, run| match run.er_over_ef {
        // A square of differences of velocities has twice their error.
        Some(share) if share > 0.0 => AT_THE_END.max(2.0 * rounding(scene.n) / share.sqrt()),
        _ => AT_THE_END,
    }),
    result(
        "contact_duration",
        "s",
        "the floor's, from first touch to last",
        |run| run.contact_duration,
    )
    .seen("t_k", 6, |seen| number(seen.floor_contact())),
    result(
        "h_cm_mean",
        "m",
        "height of the centre of mass, mean of the last 90 %",
        |run| run.h_cm_mean,
    )
    .at_best(|_, run| of_mean(run.h_cm_error, run.h_cm_mean))
    .seen("h_cm", 0, |seen| Cell::Number(seen.centre)),
    rough("h_cm_error", "m", "its error", |run| run.h_cm_error),
    result(
        "er_over_e_mean",
        "",
        "mean E_r over mean E, of the last 90 %",
        |run| run.er_over_e_mean,
    )
    .at_best(|_, run| of_mean(run.er_over_e_error, run.er_over_e_mean)),
    rough("er_over_e_error", "", "its error", |run| {
        run.er_over_e_error
    }),
    result("sigma", "", "mean free flight over contact_time", |run| {
        run.sigma
    })
    // Under gravity it is that of the last period of a chaotic motion.
    .unmeasured(|scene| scene.gravity.map_or(0.0, |_| CHAOTIC)),
    rough(
        "overlap_max",
        "",
        "deepest overlap seen, over the diameter",
        |run| run.overlap_max,
    ),
    rough(
        "energy_drift",
        "",
        "what the ledger misses: no error of results",
        |run| Some(run.energy_drift),
    )
    .seen("drift", 1, |seen| Cell::Number(seen.energy.drift)),
    change("step_error", "of the main result, by other steps", |of| {
        of.step
    }),
    change("sensitivity", "", Sensitivity::main).meaning_by(by_what),
    change("er_over_ef_sensitivity", "that of er_over_ef", |of| {
        of.change("er_over_ef")
    }),
    change(
        "contact_duration_sensitivity",
        "that of contact_duration",
        |of| of.change("contact_duration"),
    ),
    change(
        "er_over_e_mean_sensitivity",
        "that of er_over_e_mean",
        |of| of.change("er_over_e_mean"),
    ),
    change("sigma_sensitivity", "that of sigma", |of| {
        of.change("sigma")
    }),
    count("events", "collisions", |scene, run| {
        (!scene.is_md()).then_some(run.events)
    }),
    count("steps", "time steps", |scene, run| {
        scene.is_md().then_some(run.steps)
    }),
    row(
        "sim_time",
        "s",
        "simulated",
        Source::Time(|run| run.sim_time),
    ),
    row("wall_time", "s", "taken", Source::Machine(|_, taken| taken)),
    row(
        "speed",
        "",
        "sim_time/wall_time",
        Source::Machine(|run, taken| run.sim_time / taken),
    ),
    judged(
        "verdict",
        "on soft contacts, against hard spheres",
        |verdict| verdict.word.map(Word::as_str).into(),
    ),
    judged("verdict_why", "", |verdict| verdict.because.as_str().into()),
];

/// The law of soft contacts, where it is a power law.
fn power(scene: &Scene) -> Option<PowerLaw> {
    scene.law()?.power().copied()
}

/// The part of a mean that is its error.
fn of_mean(error: Option<f64>, mean: Option<f64>) -> f64 {
    let part = error.zip(mean).map(|(error, mean)| (error / mean).abs());
    part.filter(|part| part.is_finite()).unwrap_or(0.0)
}

/// What the results of a scene are sensitive to.
fn by_what(scene: &Scene) -> &'static str {
    match scene.method.name() {
        MethodName::Gear | MethodName::Verlet => "relative change by other steps, or a last bit",
        MethodName::Exact if scene.tolerance().is_some() => {
            "relative change by the tolerance, or a last bit"
        }
        MethodName::Exact | MethodName::Ed => "relative change by a last bit of the start",
    }
}

const fn row(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    source: Source,
) -> Quantity {
    Quantity {
        name,
        unit,
        seen: None,
        meaning: Meaning::Always(meaning),
        source,
    }
}

const fn named(name: &'static str, get: fn(&Preset) -> Cell) -> Quantity {
    row(name, "", "", Source::Preset(get))
}

const fn fact(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    get: fn(&Scene) -> Cell,
) -> Quantity {
    row(name, unit, meaning, Source::Scene(get))
}

const fn of_lattices(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    get: fn(&Scene) -> Cell,
) -> Quantity {
    row(name, unit, meaning, Source::Lattice(get))
}

const fn result(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    get: fn(&Results) -> Option<f64>,
) -> Quantity {
    let measured = Measured {
        get,
        at_best: |_, _| 0.0,
        unmeasured: |_| 0.0,
    };
    row(name, unit, meaning, Source::Result(measured))
}

const fn rough(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    get: fn(&Results) -> Option<f64>,
) -> Quantity {
    row(name, unit, meaning, Source::Rough(get))
}

const fn change(
    name: &'static str,
    meaning: &'static str,
    get: fn(&Sensitivity) -> Option<f64>,
) -> Quantity {
    row(name, "", meaning, Source::Change(get))
}

const fn count(
    name: &'static str,
    meaning: &'static str,
    get: fn(&Scene, &Results) -> Option<u64>,
) -> Quantity {
    row(name, "", meaning, Source::Count(get))
}

const fn judged(name: &'static str, meaning: &'static str, get: fn(&Verdict) -> Cell) -> Quantity {
    row(name, "", meaning, Source::Verdict(get))
}

impl Quantity {
    /// The same with a meaning that depends on the scene.
    const fn meaning_by(mut self, words: fn(&Scene) -> &'static str) -> Self {
        self.meaning = Meaning::Of(words);
        self
    }

    /// The same with another meaning under power laws.
    const fn under_power_laws(mut self, words: &'static str) -> Self {
        if let Meaning::Always(linear) = self.meaning {
            self.meaning = Meaning::ByLaw(linear, words);
        }
        self
    }

    /// The same, which the explorer shows of every scene.
    const fn seen(mut self, symbol: &'static str, rank: u8, now: fn(&Observation) -> Cell) -> Self {
        self.seen = Some(Seen {
            symbol,
            rank,
            of: |_| true,
            now,
        });
        self
    }

    /// The same, known to no less than this part of itself.
    const fn at_best(mut self, part: fn(&Scene, &Results) -> f64) -> Self {
        if let Source::Result(mut measured) = self.source {
            measured.at_best = part;
            self.source = Source::Result(measured);
        }
        self
    }

    /// The same, known to this part of itself where nobody has measured its sensitivity.
    const fn unmeasured(mut self, part: fn(&Scene) -> f64) -> Self {
        if let Source::Result(mut measured) = self.source {
            measured.unmeasured = part;
            self.source = Source::Result(measured);
        }
        self
    }
}
