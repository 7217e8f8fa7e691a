//! The answer in words.

use super::cost::Cost;
use super::family::Family;
use super::probe::{BEYOND_ERRORS, ERRORS, NAUGHT, Probe};
use super::search::{Search, in_full};
use super::tables::{self, percent};
use super::{Advice, Question, SceneKind, Standing};
use crate::numerals::significant;
use crate::scene::Preset;
use crate::study::accuracy::facts;
use crate::study::verdict;

pub(super) fn advice(
    search: &Search,
    family: &Family,
    preset: &Preset,
    question: Question,
    cost: Option<Vec<Cost>>,
    judged: &verdict::Verdict,
) -> Advice {
    let mut answer = tables::answer(search);
    answer.title = title(search, preset);
    answer.notes = notes(search, family);
    answer.notes.insert(0, on_the_scene(judged, search.kind));
    let mut curve = tables::curve(search);
    curve.notes = vec![format!(
        "off: difference from the limit over the limit; errors: {}; verdict against a tolerance \
         of {}.",
        match search.kind {
            SceneKind::Shaken => "standard errors of means",
            _ => "changes by the last bit of the start",
        },
        question.tolerance
    )];
    let mut cost = tables::cost(&cost.unwrap_or_default(), search);
    for table in [&mut answer, &mut curve, &mut cost] {
        table.facts = facts(&preset.scene, &preset.name);
        let more = [
            ("against", search.against()),
            ("tolerance", question.tolerance.to_string()),
            ("scene_verdict", word(judged).to_owned()),
        ];
        table
            .facts
            .extend(more.map(|(name, value)| (name.to_owned(), value)));
    }
    Advice {
        contact_time: search.longest().and_then(|probe| probe.contact_time),
        standing: search.standing(),
        answer,
        cost,
        curve,
        plot: tables::plot(search),
    }
}

/// The verdict on the scene as it is, against hard spheres.
fn on_the_scene(judged: &verdict::Verdict, kind: SceneKind) -> String {
    let of_what = match kind {
        SceneKind::Falling => " That is a judgement of how the column comes to rest, not of h_cm.",
        SceneKind::Launched | SceneKind::Shaken => "",
    };
    let word = word(judged);
    format!("The scene as it is: {word}: {}.{of_what}", judged.because)
}

fn word(judged: &verdict::Verdict) -> &'static str {
    judged.word.map_or("no verdict", verdict::Word::as_str)
}

/// The names of what is judged.
fn judged(kind: SceneKind) -> String {
    let names = kind.observables().iter().filter(|o| o.judged);
    let names: Vec<&str> = names.map(|o| o.heading).collect();
    names.join(" and ")
}

fn time(probe: Option<&Probe>) -> String {
    probe
        .and_then(|probe| probe.contact_time)
        .map_or_else(String::new, in_full)
}

/// The answer in one line.
fn title(search: &Search, preset: &Preset) -> String {
    let (name, what) = (&preset.name, judged(search.kind));
    let (part, limit) = (percent(search.question.tolerance), search.against());
    match search.standing() {
        Standing::Found => format!(
            "{name}: t_c up to {} s keeps {what} within {part} of {limit}",
            time(search.longest())
        ),
        Standing::Any => format!(
            "{name}: any t_c up to {} s keeps {what} within {part} of {limit}",
            time(search.longest())
        ),
        Standing::None => format!("{name}: no t_c keeps {what} within {part} of {limit}"),
        Standing::Open => match search.longest() {
            Some(probe) => format!(
                "{name}: t_c up to {} s, perhaps more, keeps {what} within {part} of {limit}",
                time(Some(probe))
            ),
            None => {
                format!("{name}: not decided whether a t_c keeps {what} within {part} of {limit}")
            }
        },
    }
}

fn notes(search: &Search, family: &Family) -> Vec<String> {
    let mut notes: Vec<String> = family
        .indifference()
        .map(str::to_owned)
        .into_iter()
        .collect();
    notes.push(standing(search));
    notes.extend(collapse(search));
    if search.returns() {
        notes.push(
            "The curve is not monotone: longer contact times come within the tolerance again, by \
             crossing the limit, which is nothing to build on."
                .to_owned(),
        );
    }
    notes.push(tolerance(search));
    notes.extend(unseen(search));
    notes
}

/// What the bracket is.
fn standing(search: &Search) -> String {
    let count = search.probes.len();
    let ends = [search.probes.first(), search.probes.last()].map(time);
    let looked = format!(
        "{count} contact times from {} to {} s were looked at",
        ends[0], ends[1]
    );
    match search.standing() {
        Standing::Found => format!(
            "{looked}: all up to {} s are within, {} s is not. Between two of them the curve may \
             do anything.",
            time(search.longest()),
            time(search.beyond())
        ),
        Standing::Any => format!("{looked}, and all are within; longer ones were not."),
        Standing::None => format!(
            "{looked}, and even the shortest is beyond: soft contacts will not do here; use hard \
             spheres (--method ed) or allow more (--tolerance)."
        ),
        Standing::Open => {
            let from = match search.longest() {
                Some(probe) => format!("all up to {} s are within", time(Some(probe))),
                None => "the shortest is not decided".to_owned(),
            };
            let beyond = match search.beyond() {
                Some(probe) => format!("{} s is beyond", time(Some(probe))),
                None => "none is beyond".to_owned(),
            };
            format!(
                "{looked}: {from}, {beyond}, and between them errors cross the tolerance: not \
                 decided.{}",
                match search.kind {
                    SceneKind::Shaken => " --budget gives more time.",
                    _ => "",
                }
            )
        }
    }
}

/// Why nothing is within, where it is a collapse.
fn collapse(search: &Search) -> Option<String> {
    if search.longest().is_some() || search.limit.contact_time.is_some() {
        return None;
    }
    let scene = &search.limit.scene;
    let loss = scene.n as f64 * (1.0 - scene.restitution);
    let collapsed = search.limit.readings().first()?.value < NAUGHT;
    let (what, so) = match search.kind {
        SceneKind::Launched => (
            "bring the column to rest at the floor",
            "Soft ones come near that only where sigma_0 is large beyond reason, and there the \
             last bit of the start decides what is left",
        ),
        _ => (
            "keep the column together",
            "A column that is together has sigma = 0 at any t_c, so a shorter one hardly helps",
        ),
    };
    collapsed.then(|| {
        let loss = significant(loss, 2);
        format!("Hard spheres {what}, N(1 - eps) being {loss}: inelastic collapse. {so}.")
    })
}

/// What is compared with what.
fn tolerance(search: &Search) -> String {
    let readings = search.limit.readings().iter();
    let observables = search.kind.observables().iter().filter(|o| o.judged);
    let naught: Vec<&str> = observables
        .zip(readings)
        .filter(|(observable, limit)| observable.is_naught(**limit))
        .map(|(observable, _)| observable.heading)
        .collect();
    let part = percent(search.question.tolerance);
    let mut text = format!("Tolerance: {part} of the limit (--tolerance).");
    if !naught.is_empty() {
        text = format!(
            "Tolerance: {part} of the limit (--tolerance); of {}, whose limit is (nearly) 0, the \
             difference itself is at most {}.",
            naught.join(" and "),
            search.question.tolerance
        );
    }
    text + &match search.kind {
        SceneKind::Shaken => format!(
            " Means of at least {} periods; within: by {ERRORS} standard errors, beyond: by \
             {BEYOND_ERRORS}. E_r/E is a mean over a mean, h_cm the height of run's h_cm_mean.",
            search.probes.iter().map(Probe::periods).min().unwrap_or(0)
        ),
        SceneKind::Launched => {
            " E_r/E_f is shown, not judged. off: the difference over the limit.".to_owned()
        }
        SceneKind::Falling => " h_cm is the mean height of run's h_cm_mean.".to_owned(),
    }
}

/// What could not be looked at.
fn unseen(search: &Search) -> Option<String> {
    let first = search.silent.first()?;
    let why = first.failure().unwrap_or_default();
    Some(format!(
        "{} more gave nothing and are left out, the shortest at {} s: {why}.",
        search.silent.len(),
        time(Some(first))
    ))
}
