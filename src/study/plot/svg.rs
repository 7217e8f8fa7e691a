//! A plot as an SVG picture, readable on a slide.

use super::{Bounds, Plot, SeriesStyle};
use std::fmt::Write;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 600.0;
const LEFT: f64 = 110.0;
const RIGHT: f64 = 250.0;
const TOP: f64 = 70.0;
const BOTTOM: f64 = 80.0;

/// Okabe and Ito's colours, which the colour-blind tell apart too.
const COLOURS: [&str; 8] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C7A00",
];

pub(super) fn draw(plot: &Plot) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"18\" fill=\"#000\">\n\
         <title>{title}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{LEFT}\" y=\"38\" font-size=\"21\">{title}</text>\n",
        title = escaped(&plot.title)
    );
    match plot.bounds() {
        Some(bounds) => {
            axes(&mut svg, plot, bounds);
            for k in 0..plot.series.len() {
                series(&mut svg, plot, k, bounds);
            }
            legend(&mut svg, plot);
        }
        None => svg += "<text x=\"480\" y=\"300\">nothing to plot</text>\n",
    }
    svg + "</svg>\n"
}

fn across(part: f64) -> f64 {
    LEFT + part * (WIDTH - LEFT - RIGHT)
}

fn up(part: f64) -> f64 {
    HEIGHT - BOTTOM - part * (HEIGHT - TOP - BOTTOM)
}

fn axes(svg: &mut String, plot: &Plot, (x, y): (Bounds, Bounds)) {
    let (left, right, top, bottom) = (across(0.0), across(1.0), up(1.0), up(0.0));
    for tick in plot.x.ticks(x, 8) {
        let at = across(x.part(tick.place));
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {bottom:.1}V{top:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 26.0,
            tick.label
        );
    }
    for tick in plot.y.ticks(y, 8) {
        let at = up(y.part(tick.place));
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {at:.1}H{right:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            left - 10.0,
            at + 6.0,
            tick.label
        );
    }
    let (middle, centre) = (across(0.5), up(0.5));
    let _ = writeln!(
        svg,
        "<path d=\"M{left:.1} {top:.1}V{bottom:.1}H{right:.1}\" fill=\"none\" stroke=\"#000\" stroke-width=\"1.5\"/>\n\
         <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
         <text transform=\"translate(28 {centre:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        HEIGHT - 22.0,
        escaped(&plot.x.label),
        escaped(&plot.y.label)
    );
}

fn series(svg: &mut String, plot: &Plot, k: usize, (x, y): (Bounds, Bounds)) {
    let series = &plot.series[k];
    let colour = COLOURS[k % COLOURS.len()];
    let places = plot.places(series);
    let points: Vec<_> = places
        .into_iter()
        .map(|(a, b)| (across(x.part(a)), up(y.part(b))))
        .collect();
    let _ = writeln!(svg, "<g><title>{}</title>", escaped(&series.name));
    if series.style != SeriesStyle::Points && points.len() > 1 {
        let line: Vec<_> = points
            .iter()
            .map(|(a, b)| format!("{a:.1},{b:.1}"))
            .collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{}/>",
            line.join(" "),
            dashes(k)
        );
    }
    if series.style != SeriesStyle::Line {
        for point in points {
            marker(svg, k, point);
        }
    }
    svg.push_str("</g>\n");
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

fn legend(svg: &mut String, plot: &Plot) {
    for (k, series) in plot.series.iter().enumerate() {
        let y = TOP + 12.0 + 28.0 * k as f64;
        let x = WIDTH - RIGHT + 24.0;
        let colour = COLOURS[k % COLOURS.len()];
        if series.style != SeriesStyle::Points {
            let _ = writeln!(
                svg,
                "<path d=\"M{:.1} {y:.1}h28\" stroke=\"{colour}\" stroke-width=\"2\"{}/>",
                x - 14.0,
                dashes(k)
            );
        }
        if series.style != SeriesStyle::Line {
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
