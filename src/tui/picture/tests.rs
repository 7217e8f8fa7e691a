//! Pictures and numbers of pages against the pages.

use super::*;
use crate::live::History;
use crate::physics::Observation;
use crate::scene::parameters::{Value, find};
use crate::scene::{Preset, Scene};
use crate::tui::model::Lens;
use crate::tui::theme::Theme;

/// A model of more than a page, its beads at heights that no two share.
fn model(name: &str) -> Model {
    let preset = Preset::load(name).expect("an embedded preset");
    let theme = Theme {
        ascii: false,
        colour: false,
    };
    let (mut model, _) = Model::new(preset, None, theme, (80, 24)).expect("a twin");
    draw(&mut model, 1.0);
    model
}

/// Draws on for so long as 1.4 pages take.
#[expect(clippy::cast_possible_truncation, reason = "as what is simulated")]
fn draw(model: &mut Model, size: f64) {
    let sweep = model.page.sweep;
    let end = model.page.now + 1.4 * sweep.span;
    let mut history = History::new(sweep.columns + 1);
    let mut number = sweep.next_sample(model.page.now, 1);
    let scenes = model.bench.scenes();
    while sweep.sample_time(number) <= end {
        let time = sweep.sample_time(number);
        let row = |(side, scene): (usize, &Scene)| {
            let height = |k: usize| size * 1e-5 * (k as f64 + time + 0.3 * side as f64);
            Some(ColumnSample {
                floor: height(0) as f32 - 1e-3,
                reduced: (0..scene.layers()).map(|k| height(k + 1) as f32).collect(),
                kinetic: 1.0 / (1.0 + time),
                relative: 0.1 * time,
                error: None,
            })
        };
        let rows = scenes.iter().enumerate().map(row).collect();
        history.push(Sample { time, rows });
        number += 1;
    }
    model.page.take(end, history, false);
}

/// The numbers of a file, a column name before each row's.
fn read(csv: &str) -> (Vec<String>, Vec<(String, Vec<f64>)>) {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    let split = |line: &str| -> Vec<String> { line.split(',').map(str::to_owned).collect() };
    let header = split(lines.next().expect("a header"));
    let rows = lines.map(|line| {
        let mut cells = split(line).into_iter();
        let name = cells.next().expect("a name");
        let number = |cell: String| cell.parse().expect("a number");
        (name, cells.map(number).collect())
    });
    (header, rows.collect())
}

#[test]
#[expect(
    clippy::cast_possible_truncation,
    reason = "written in single precision"
)]
fn the_numbers_are_those_of_the_page() {
    let mut model = model("fig5b");
    model.keep_ghost();
    draw(&mut model, 2.0);
    let kept = model.page.ghost.clone().expect("a ghost");
    let mut expected: Vec<(String, &Sample, usize)> = Vec::new();
    for (samples, suffix) in [
        (model.page.samples.iter().collect::<Vec<_>>(), ""),
        (kept.samples().collect(), " ghost"),
    ] {
        for sample in samples {
            for side in 0..2 {
                let name = format!("{}{suffix}", model.label(side));
                expected.push((name, sample, side));
            }
        }
    }
    let csv = data(&model).csv();
    let (header, rows) = read(&csv);
    assert_eq!(header[..4], ["column", "time", "floor", "z1"]);
    assert_eq!(header[12..], ["z10", "kinetic", "relative"]);
    // The page, in which the newest sample has taken the place of the oldest.
    let samples = model.page.sweep.columns;
    assert!(rows.len() >= 4 * (samples - 1) && rows.len() <= expected.len());
    for (name, numbers) in &rows {
        let is_it = |(label, sample, _): &&(String, &Sample, usize)| {
            label == name && sample.time.to_bits() == numbers[0].to_bits()
        };
        let (_, sample, side) = expected.iter().find(is_it).expect("a sample");
        let row = sample.rows[*side].as_ref().expect("a row");
        assert_eq!(numbers[1] as f32, row.floor);
        let heights: Vec<f32> = numbers[2..12].iter().map(|&z| z as f32).collect();
        assert_eq!(heights, row.reduced);
        assert_eq!(numbers[12..], [row.kinetic, row.relative]);
    }
    // No more digits than single precision has.
    let digits = |cell: &str| {
        cell.split('e').next().map_or(0, |m| {
            m.trim_start_matches(['-', '0', '.']).replace('.', "").len()
        })
    };
    let last = csv.lines().last().expect("a row");
    assert!(
        last.split(',')
            .skip(2)
            .take(11)
            .all(|cell| digits(cell) <= 9),
        "{last}"
    );
}

/// Every line of the picture is the screen's, through the microscope too.
#[test]
fn the_picture_has_the_lines_of_the_screen() {
    for through_lens in [false, true] {
        let mut model = model("fig5b");
        if through_lens {
            model.page.lens = Some(Lens::new(1e-6));
            draw(&mut model, 1.0);
        }
        let units = Units::of(&model.page);
        for side in 0..2 {
            let plot = plot(&model, side, &units);
            assert_eq!(plot.series.len(), 11, "the floor and ten beads");
            let names: Vec<&str> = plot.series.iter().map(|s| s.name.as_str()).collect();
            assert_eq!(names[..3], ["floor", "beads", "beads"]);
            let mut drawn = 0;
            for (_, sample) in model.page.visible(0.0) {
                let row = sample.rows[side].as_ref().expect("a row");
                let Some(row) = model.page.drawn(side, sample.time, row) else {
                    continue;
                };
                let at = |line: usize| plot.series[line].points[drawn];
                assert!((at(0).0 * units.second - sample.time).abs() < 1e-12);
                assert_eq!(at(0).1, f64::from(row.floor) / units.metre);
                for (k, &z) in row.reduced.iter().enumerate() {
                    assert_eq!(at(k + 1).1, f64::from(z) / units.metre);
                }
                drawn += 1;
            }
            let points = |series: &Series| series.points.len();
            assert!(drawn > 20 && plot.series.iter().map(points).all(|n| n == drawn));
        }
        let svg = svg(&model);
        assert_eq!(svg.matches("<polyline").count(), 22);
        assert_eq!(svg.matches("time (s)").count(), 2);
        assert!(svg.contains("MD  Gear, t_c/100") && svg.contains("ED  hard spheres"));
        assert!(!svg.contains("ghost"));
        model.keep_ghost();
        assert!(super::svg(&model).contains(">ghost</text>"));
    }
}

#[test]
fn rows_of_a_lattice_and_empty_pages_are_written_too() {
    let model = model("fig4");
    let (header, rows) = read(&data(&model).csv());
    let layers = model.bench.scenes()[0].layers();
    assert_eq!(header.len(), layers + 5);
    assert!(rows.iter().any(|row| row.0 == "2D") && rows.iter().any(|row| row.0 == "1D"));
    let preset = Preset::load("fig5b").expect("an embedded preset");
    let empty = Model::new(preset, None, model.theme, (80, 24)).expect("a twin");
    assert!(svg(&empty.0).contains("nothing to plot"));
    assert!(read(&data(&empty.0).csv()).1.is_empty());
}

/// Tall columns have a line for every other bead or fewer, which have their own numbers.
#[test]
fn lines_of_tall_columns_have_the_numbers_of_their_beads() {
    let mut model = model("fig5b");
    let count = find("n").expect("a parameter");
    let value = Value::Whole(130);
    model.bench.set(count, value).expect("it may");
    let heights = Observation {
        reduced: (1u32..=130).map(f64::from).collect(),
        ..Observation::default()
    };
    let row = Some(ColumnSample::of(&heights, None));
    let mut history = History::new(2);
    let time = model.page.now;
    history.push(Sample {
        time,
        rows: vec![row.clone(), row],
    });
    model.page.take(time, history, true);
    let (header, rows) = read(&data(&model).csv());
    assert!(header.contains(&"z130".to_owned()) && header.len() < 70);
    for (name, height) in header[3..].iter().zip(&rows[0].1[2..]) {
        if let Some(bead) = name.strip_prefix('z') {
            assert_eq!(bead.parse(), Ok(*height), "{name}");
        }
    }
}
