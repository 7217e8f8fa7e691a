//! Tables and plots of studies.

use beadlab::numerals::significant;
use beadlab::study::plot::{Axis, Plot, Series, SeriesStyle};
use beadlab::study::table::{Cell, Column, Digits, Table};

fn table() -> Table {
    let columns = [
        Column::new("method", "method", ""),
        Column::new("time", "time", "s"),
        Column::new("steps", "steps", ""),
        Column::new("hidden", "", "m").with(Digits::Fixed(2)),
    ];
    let mut table = Table::new("test", "A title", columns);
    table.facts.push(("seed".into(), "1".into()));
    table.notes.push("A note.".into());
    table.push([
        "gear, \"fifth\"".into(),
        Cell::from(1.0 / 3.0),
        12_u64.into(),
        1e-9.into(),
    ]);
    table.push(["ed".into(), f64::NAN.into(), Cell::Empty, 0.25.into()]);
    table
}

#[test]
fn csv_gives_every_bit_back() {
    let text = table().csv();
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").clone();
    assert_eq!(header, vec!["method", "time", "steps", "hidden"]);
    let rows: Vec<_> = reader.records().map(|r| r.expect("a record")).collect();
    assert_eq!(&rows[0][0], "gear, \"fifth\"");
    assert_eq!(rows[0][1].parse::<f64>(), Ok(1.0 / 3.0));
    assert_eq!(rows[0][3].parse::<f64>(), Ok(1e-9));
    // What is not finite is not a result.
    assert_eq!(&rows[1][1], "");
    for line in [
        "# A title",
        "# seed = 1",
        "# units: time s, hidden m",
        "# A note.",
    ] {
        assert!(text.lines().any(|l| l == line), "{line} in\n{text}");
    }
}

#[test]
fn text_is_aligned_and_leaves_out_what_has_no_heading() {
    let text = table().text(80);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[2],
        "method         time  steps".replace("time", " time")
    );
    assert!(lines[5].ends_with("0.333     12"), "{text}");
    assert!(!text.contains("NaN") && !text.contains("0.25"), "{text}");
}

#[test]
fn json_leaves_out_what_a_row_does_not_have() {
    let json = serde_json::to_value(table()).expect("words and finite numbers");
    assert_eq!(json["rows"][0]["time"], 1.0 / 3.0);
    assert!(json["rows"][1].get("time").is_none());
    assert_eq!(json["units"]["time"], "s");
    assert_eq!(json["scene"]["seed"], "1");
}

#[test]
fn significant_digits() {
    for (x, count, text) in [
        (0.0, 3, "0"),
        (1.0 / 3.0, 3, "0.333"),
        (0.000_123_4, 2, "1.2e-4"),
        (99.96, 3, "100"),
        (12_345.0, 3, "1.23e4"),
        (-2.5, 2, "-2.5"),
    ] {
        assert_eq!(significant(x, count), text);
    }
}

fn plot(points: &[(f64, f64)], log: bool) -> Plot {
    let axis = |label: &str| {
        if log {
            Axis::log(label)
        } else {
            Axis::linear(label)
        }
    };
    Plot {
        name: "p".into(),
        title: "Title < & \"".into(),
        x: axis("run time, s"),
        y: axis("error"),
        series: vec![
            Series::new("gear", points.to_vec()),
            Series::new("line", points.to_vec()).with(SeriesStyle::Line),
        ],
    }
}

#[test]
fn plots_draw_whatever_they_are_given() {
    let sets: [&[(f64, f64)]; 8] = [
        &[],
        &[(1.0, 1.0)],
        &[(0.0, 0.0), (-1.0, 5.0)],
        &[(f64::NAN, 1.0), (1.0, f64::INFINITY), (2.0, 3.0)],
        &[(1e-300, 1e300), (1e300, 1e-300)],
        &[(f64::MAX, f64::MIN), (f64::MIN, f64::MAX)],
        &[(1.0, 2.0), (1.0 + 1e-15, 2.0)],
        &[(5e-324, 5e-324), (1e-310, 1.0)],
    ];
    for points in sets {
        for log in [false, true] {
            let plot = plot(points, log);
            let svg = plot.svg();
            assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf"));
            assert!(svg.contains("Title &lt; &amp; &quot;"));
            for (width, height) in [(80, 24), (20, 10), (3, 2), (0, 0), (200, 60)] {
                for ascii in [false, true] {
                    let text = plot.terminal(width, height, ascii);
                    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
                    assert!(!ascii || text.is_ascii(), "{text}");
                    if width >= 80 {
                        let longest = text.lines().map(|l| l.chars().count()).max();
                        let longest = longest.expect("a title at least");
                        assert!(longest <= width, "{text}");
                        assert!(text.lines().count() <= height, "{text}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_point_is_where_the_axes_say() {
    let text = plot(&[(1e-3, 1e-6), (1.0, 1.0)], true).terminal(80, 20, true);
    let lines: Vec<&str> = text.lines().collect();
    let row = |label: &str| {
        let found = lines.iter().find(|l| l.trim_start().starts_with(label));
        *found.unwrap_or_else(|| panic!("{label} in\n{text}"))
    };
    // The markers of a line alone lie over those of the other series.
    assert!(row("1 +").trim_end().ends_with('x'), "{text}");
    assert!(row("1e-6 +").contains('x'), "{text}");
}
