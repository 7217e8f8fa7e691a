//! The answer, the costs and the curve as tables and as a picture.

use super::cost::Cost;
use super::probe::{ERRORS, Observable, Probe, Reading, Suitability};
use super::search::{Search, in_full};
use super::{SceneKind, Standing};
use crate::numerals::{rounded, significant};
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Cell, Column, Digits, Table};

/// The least error that a plot shows, over the tolerance.
const PLOTTED: f64 = 1e-4;

/// A part as a percentage.
pub(super) fn percent(part: f64) -> String {
    // Twelve digits: 0.07 is 7 %, whatever its last bit.
    format!("{} %", rounded(100.0 * part, 12))
}

/// The limit, the bracket and the scene itself, a row each.
pub(super) fn answer(search: &Search) -> Table {
    let four = Digits::Significant(4);
    let sigma = match search.kind {
        SceneKind::Launched => "sigma_0",
        _ => "",
    };
    let mut columns = vec![
        Column::new("what", "", ""),
        Column::new("row", "what", ""),
        Column::new("contact_time", "t_c", "s").with(four),
        Column::new("sigma0", sigma, ""),
    ];
    for observable in search.kind.observables() {
        let [name, error, off, _] = observable.names;
        columns.push(Column::new(name, observable.heading, observable.unit).with(four));
        if search.kind == SceneKind::Shaken {
            columns.push(Column::new(error, "+-", observable.unit).with(Digits::Significant(2)));
        } else {
            columns.push(Column::new(error, "", observable.unit));
        }
        columns.push(Column::new(off, "off", "").with(Digits::Significant(2)));
    }
    columns.push(Column::new("verdict", "verdict", ""));
    let mut table = Table::new("advise", "", columns);
    let mut push = |what: &str, words: String, probe: &Probe, verdict: Option<Suitability>| {
        let mut cells: Vec<Cell> = vec![
            what.into(),
            words.into(),
            probe.contact_time.into(),
            probe.scene.sigma0().into(),
        ];
        for triple in triples(search, probe) {
            let [value, error, off, _] = triple;
            let off = if verdict.is_none() { None } else { off };
            cells.extend([value.into(), error.into(), off.into()]);
        }
        cells.push(verdict.map(Suitability::word).into());
        table.push(cells);
    };
    push("limit", search.against(), &search.limit, None);
    if let Some(longest) = search.longest() {
        push(
            "longest",
            "longest within".to_owned(),
            longest,
            Some(Suitability::Within),
        );
    }
    if let Some(open) = open(search) {
        push(
            "undecided",
            "not decided".to_owned(),
            open,
            Some(Suitability::Undecided),
        );
    }
    let shortest = match search.standing() {
        Standing::None => search.probes.first(),
        _ => search.beyond(),
    };
    if let Some(beyond) = shortest {
        push(
            "beyond",
            "shortest beyond".to_owned(),
            beyond,
            Some(Suitability::Beyond),
        );
    }
    if let Some((probe, verdict)) = search.own() {
        push("scene", "this scene".to_owned(), probe, Some(verdict));
    }
    table
}

/// The first contact time that is not decided, if the answer hangs on it.
fn open<'a>(search: &'a Search) -> Option<&'a Probe> {
    let verdicts = search.verdicts();
    let k = verdicts.iter().position(|v| *v != Suitability::Within)?;
    (verdicts[k] == Suitability::Undecided).then(|| &search.probes[k])
}

/// Value, error, difference and its error of every observable.
fn triples(search: &Search, probe: &Probe) -> Vec<[Option<f64>; 4]> {
    let observables = search.kind.observables().iter().enumerate();
    let limit = search.limit.readings();
    let of = |(k, observable): (usize, &Observable)| {
        let Some(here) = probe.readings().get(k) else {
            return [None; 4];
        };
        let off = limit.get(k).map(|limit| observable.off(*here, *limit));
        [
            Some(here.value),
            Some(here.error),
            off.map(|o| o.value),
            off.map(|o| o.error),
        ]
    };
    observables.map(of).collect()
}

/// Everything that was looked at.
pub(super) fn curve(search: &Search) -> Table {
    let mut columns = vec![
        Column::new("contact_time", "", "s"),
        Column::new("sigma0", "", ""),
    ];
    for observable in search.kind.observables() {
        let [name, error, off, off_error] = observable.names;
        columns.extend([
            Column::new(name, "", observable.unit),
            Column::new(error, "", observable.unit),
            Column::new(off, "", ""),
            Column::new(off_error, "", ""),
        ]);
    }
    columns.extend([
        Column::new("periods", "", ""),
        Column::new("verdict", "", ""),
        Column::new("note", "", ""),
    ]);
    let mut table = Table::new(
        "advise-curve",
        "All contact times that were looked at",
        columns,
    );
    let verdicts = search.verdicts().into_iter().map(Some);
    let silent = search.silent.iter().map(|probe| (probe, None));
    for (probe, verdict) in search.probes.iter().zip(verdicts).chain(silent) {
        let mut cells: Vec<Cell> = vec![probe.contact_time.into(), probe.scene.sigma0().into()];
        let values = triples(search, probe).into_iter().flatten();
        cells.extend(values.map(Cell::from));
        let periods = (search.kind == SceneKind::Shaken).then(|| probe.periods() as u64);
        cells.extend([
            periods.into(),
            verdict.map(Suitability::word).into(),
            probe.failure().into(),
        ]);
        table.push(cells);
    }
    table
}

/// What the methods cost at the answer.
pub(super) fn cost(costs: &[Cost], search: &Search) -> Table {
    let launched = search.kind == SceneKind::Launched;
    let (work, run_time) = if launched {
        ("steps", "run time")
    } else {
        ("steps/s", "run time/s")
    };
    let two = Digits::Significant(2);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("steps_per_contact", "t_c/step", "").with(two),
        Column::new("step", "step", "s"),
        Column::new("largest_stable_step", "stable to", "s"),
        Column::new("work", work, ""),
        Column::new("run_time", run_time, "s").with(two),
        Column::new("eps_eff", if launched { "eps_eff" } else { "" }, "")
            .with(Digits::Significant(4)),
        Column::new("eps_eff_off", if launched { "off" } else { "" }, "").with(two),
        Column::new("failure", "", ""),
    ];
    let longest = search.longest().and_then(|probe| probe.contact_time);
    let at = longest.map_or_else(String::new, in_full);
    let mut table = Table::new(
        "advise-cost",
        format!("What it costs at t_c = {at} s"),
        columns,
    );
    let observable = &search.kind.observables()[0];
    let limit = search.limit.readings().first().copied();
    let off = |cost: &Cost| {
        let (value, limit) = cost.eps_eff.zip(limit)?;
        Some(observable.off(Reading { value, error: 0.0 }, limit).value)
    };
    for cost in costs {
        table.push([
            cost.method.as_str().into(),
            cost.steps_per_contact.into(),
            cost.step.into(),
            cost.stable.into(),
            cost.work.into(),
            cost.run_time.into(),
            cost.eps_eff.into(),
            off(cost).into(),
            cost.failure.clone().into(),
        ]);
    }
    let of = if launched {
        "one floor collision"
    } else {
        "a simulated second"
    };
    table.notes.push(format!(
        "For {of}; of ed, hard spheres, steps are collisions. stable to: the largest step on a \
         closed column, from its spectrum; a step at that edge is stable, not right (`beadlab \
         accuracy` tells how right). Run times are of this machine, one core, the methods by \
         turns."
    ));
    let beyond = |cost: &&Cost| off(cost).is_some_and(|off| off > search.question.tolerance);
    let grids = costs
        .iter()
        .filter(|cost| cost.step.is_some())
        .filter(beyond);
    let grids: Vec<&str> = grids.map(|cost| cost.method.as_str()).collect();
    if !grids.is_empty() {
        table.notes.push(format!(
            "With {} the grid's own error comes on top, and is too much: more steps_per_contact, \
             or a shorter t_c.",
            grids.join(" and ")
        ));
    }
    table.notes.extend(costs.iter().filter_map(|cost| {
        let failure = cost.failure.as_ref()?;
        Some(format!("{}: {failure}.", cost.method.as_str()))
    }));
    table
}

/// The errors over the contact time, the tolerance, and the answer.
pub(super) fn plot(search: &Search) -> Plot {
    let tolerance = search.question.tolerance;
    let least = PLOTTED * tolerance;
    let points = |k: usize, errors: f64| -> Vec<(f64, f64)> {
        let seen = search.probes.iter().filter_map(|probe| {
            let [_, _, off, error] = triples(search, probe)[k];
            Some((probe.contact_time?, off? + errors * error?))
        });
        seen.filter(|point| point.1.is_finite())
            .map(|(t, off)| (t, off.max(least)))
            .collect()
    };
    let mut series = Vec::new();
    let judged = search
        .kind
        .observables()
        .iter()
        .enumerate()
        .filter(|(_, o)| o.judged);
    for (k, observable) in judged {
        let here = points(k, 0.0);
        if search.kind == SceneKind::Shaken && here.iter().all(|point| point.1 <= least) {
            // A single bead has no relative motion.
            continue;
        }
        series.push(Series::new(observable.heading, here));
        if search.kind == SceneKind::Shaken {
            let name = format!("{} + {ERRORS} errors", observable.heading);
            series.push(Series::new(name, points(k, ERRORS)).with(SeriesStyle::Points));
        }
    }
    let times = || search.probes.iter().filter_map(|probe| probe.contact_time);
    let ends = [times().next(), times().next_back()].into_iter().flatten();
    let across = ends.map(|t| (t, tolerance)).collect();
    let name = format!("tolerance {}", significant(tolerance, 2));
    series.push(Series::new(name, across).with(SeriesStyle::Line));
    if let Some(longest) = search.longest().and_then(|probe| probe.contact_time) {
        let name = format!("t_c = {} s", in_full(longest));
        let up = vec![(longest, least), (longest, tolerance)];
        series.push(Series::new(name, up).with(SeriesStyle::Line));
    }
    Plot {
        name: "advise".to_owned(),
        title: format!("How far soft contacts are from {}", search.against()),
        x: Axis::log("t_c, s"),
        y: Axis::log("difference over the limit"),
        series,
    }
}
