//! A plot as an SVG picture, readable on a slide.

use super::{Bounds, Plot, Series, SeriesStyle, bounds};
use std::fmt::Write;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 600.0;
const LEFT: f64 = 110.0;
const RIGHT: f64 = 250.0;
const TOP: f64 = 70.0;
const BOTTOM: f64 = 80.0;

/// Of plots side by side: how wide each is, how far apart they are, and where they begin
/// below their titles.
const PANEL: f64 = 480.0;
const APART: f64 = 40.0;
const BELOW_TITLES: f64 = 100.0;

/// Okabe and Ito's colours, which the colour-blind tell apart too.
const COLOURS: [&str; 8] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C7A00",
];

/// Where a plot stands in the picture.
struct PlacedPlot<'a> {
    plot: &'a Plot,
    left: f64,
    width: f64,
    top: f64,
    /// Ticks that its x axis has room for.
    ticks: usize,
}

impl PlacedPlot<'_> {
    fn across(&self, part: f64) -> f64 {
        self.left + part * self.width
    }

    fn up(&self, part: f64) -> f64 {
        HEIGHT - BOTTOM - part * (HEIGHT - self.top - BOTTOM)
    }
}

pub(super) fn draw(plot: &Plot) -> String {
    let panel = PlacedPlot {
        plot,
        left: LEFT,
        width: WIDTH - LEFT - RIGHT,
        top: TOP,
        ticks: 8,
    };
    picture(&plot.title, &[panel])
}

pub(super) fn row(title: &str, plots: &[Plot]) -> String {
    let panel = |(k, plot)| PlacedPlot {
        plot,
        left: LEFT + k as f64 * (PANEL + APART),
        width: PANEL,
        top: BELOW_TITLES,
        ticks: 6,
    };
    let panels: Vec<_> = plots.iter().enumerate().map(panel).collect();
    picture(title, &panels)
}

fn picture(title: &str, panels: &[PlacedPlot]) -> String {
    let right = panels.last().map_or(WIDTH - RIGHT, |last| last.across(1.0));
    let width = right + RIGHT;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {HEIGHT}\" \
         width=\"{width}\" height=\"{HEIGHT}\" role=\"img\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"18\" fill=\"#000\">\n\
         <title>{title}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"38\" font-size=\"21\">{title}</text>\n",
        title = escaped(title)
    );
    let plots: Vec<_> = panels.iter().map(|panel| panel.plot).collect();
    match bounds(&plots) {
        Some(bounds) => {
            for (k, panel) in panels.iter().enumerate() {
                axes(&mut svg, panel, bounds, k == 0);
                if panels.len() > 1 || panel.plot.title != title {
                    heading(&mut svg, panel);
                }
                all_series(&mut svg, panel, bounds);
            }
            if let Some(first) = plots.first() {
                legend(&mut svg, first, right, panels[0].top);
            }
        }
        None => svg += "<text x=\"480\" y=\"300\">nothing to plot</text>\n",
    }
    svg + "</svg>\n"
}

fn heading(svg: &mut String, panel: &PlacedPlot) {
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        panel.left,
        panel.top - 14.0,
        escaped(&panel.plot.title)
    );
}

/// The axes; the numbers of the one upwards where the panel is the `first`.
fn axes(svg: &mut String, panel: &PlacedPlot, (x, y): (Bounds, Bounds), first: bool) {
    let plot = panel.plot;
    let (left, right) = (panel.across(0.0), panel.across(1.0));
    let (top, bottom) = (panel.up(1.0), panel.up(0.0));
    for tick in plot.x.ticks(x, panel.ticks) {
        let at = panel.across(x.part(tick.place));
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {bottom:.1}V{top:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 26.0,
            tick.label
        );
    }
    for tick in plot.y.ticks(y, 8) {
        let at = panel.up(y.part(tick.place));
        let label = if first { tick.label.as_str() } else { "" };
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {at:.1}H{right:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
            left - 10.0,
            at + 6.0,
        );
    }
    let (middle, centre) = (panel.across(0.5), panel.up(0.5));
    let y_label = if first {
        escaped(&plot.y.label)
    } else {
        String::new()
    };
    let _ = writeln!(
        svg,
        "<path d=\"M{left:.1} {top:.1}V{bottom:.1}H{right:.1}\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.5\"/>\n\
         <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
         <text transform=\"translate(28 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{y_label}</text>",
        HEIGHT - 22.0,
        escaped(&plot.x.label)
    );
}

/// All series, those first that stand behind the others.
fn all_series(svg: &mut String, panel: &PlacedPlot, bounds: (Bounds, Bounds)) {
    let each = || panel.plot.series.iter().enumerate();
    let behind = |series: &Series| series.style == SeriesStyle::Behind;
    for (k, _) in each().filter(|(_, series)| behind(series)) {
        series(svg, panel, k, bounds);
    }
    for (k, _) in each().filter(|(_, series)| !behind(series)) {
        series(svg, panel, k, bounds);
    }
}

fn series(svg: &mut String, panel: &PlacedPlot, k: usize, (x, y): (Bounds, Bounds)) {
    let plot = panel.plot;
    let series = &plot.series[k];
    let look = plot.look(k);
    let places = plot.places(series);
    let points: Vec<_> = places
        .into_iter()
        .map(|(a, b)| (panel.across(x.part(a)), panel.up(y.part(b))))
        .collect();
    let _ = writeln!(svg, "<g><title>{}</title>", escaped(&series.name));
    if series.style != SeriesStyle::Points && points.len() > 1 {
        let line: Vec<_> = points
            .iter()
            .map(|(a, b)| format!("{a:.1},{b:.1}"))
            .collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" {}/>",
            line.join(" "),
            stroke(series.style, look)
        );
    }
    if !series.style.is_line() {
        for point in points {
            marker(svg, look, point);
        }
    }
    svg.push_str("</g>\n");
}

/// How a line of that look is drawn.
fn stroke(style: SeriesStyle, look: usize) -> String {
    if style == SeriesStyle::Behind {
        return "stroke=\"#777\" stroke-width=\"1\" stroke-dasharray=\"3 2\"".to_owned();
    }
    let colour = COLOURS[look % COLOURS.len()];
    format!("stroke=\"{colour}\" stroke-width=\"2\"{}", dashes(look))
}

/// Lines whose colour was there before are dashed.
fn dashes(k: usize) -> &'static str {
    match k / COLOURS.len() {
        0 => "",
        1 => " stroke-dasharray=\"9 4\"",
        _ => " stroke-dasharray=\"2 4\"",
    }
}

/// A marker that differs in shape and colour from its neighbours in the legend.
fn marker(svg: &mut String, k: usize, (x, y): (f64, f64)) {
    let shape = match k % 6 {
        0 => "M-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0Z",
        1 => "M-5.5 -5.5H5.5V5.5H-5.5Z",
        2 => "M0 -7L6.5 5H-6.5Z",
        3 => "M0 -7.5L7.5 0L0 7.5L-7.5 0Z",
        4 => "M-6 -6L6 6M-6 6L6 -6",
        _ => "M0 7L6.5 -5H-6.5Z",
    };
    let colour = COLOURS[k % COLOURS.len()];
    let fill = if k % 6 == 4 { "none" } else { colour };
    let _ = writeln!(
        svg,
        "<path transform=\"translate({x:.1} {y:.1})\" d=\"{shape}\" fill=\"{fill}\" fill-opacity=\"0.4\" stroke=\"{colour}\" stroke-width=\"2\"/>"
    );
}

fn legend(svg: &mut String, plot: &Plot, right: f64, top: f64) {
    for (k, series) in plot.named().enumerate() {
        let y = top + 12.0 + 28.0 * k as f64;
        let x = right + 24.0;
        if series.style != SeriesStyle::Points {
            let _ = writeln!(
                svg,
                "<path d=\"M{:.1} {y:.1}h28\" {}/>",
                x - 14.0,
                stroke(series.style, k)
            );
        }
        if !series.style.is_line() {
            marker(svg, k, (x, y));
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"16\">{}</text>",
            x + 22.0,
            y + 6.0,
            escaped(&series.name)
        );
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
