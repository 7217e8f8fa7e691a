//! Plots: points and lines over axes, for a terminal and as SVG.
//!
//! Only finite points within ordered bounds are drawn: of the others a log axis has
//! no place.

mod axis;
mod svg;
mod terminal;

pub use axis::{Axis, AxisScale};

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesStyle {
    /// Markers joined by a thin line.
    Both,
    /// A line without markers, for many points.
    Line,
    /// Markers alone.
    Points,
    /// A thin grey line behind all others, for what they are held against.
    Behind,
}

impl SeriesStyle {
    /// Whether points are joined, and have no markers.
    fn is_line(self) -> bool {
        matches!(self, Self::Line | Self::Behind)
    }
}

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// The points, in the order in which they are joined.
    pub points: Vec<(f64, f64)>,
    /// How they are drawn.
    pub style: SeriesStyle,
    /// Whether they look like the series before, whose name in the legend is theirs too.
    pub alike: bool,
}

impl Series {
    /// A series with markers joined by a line.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.into(),
            points,
            style: SeriesStyle::Both,
            alike: false,
        }
    }

    /// A series that looks like the one before it, and shares its name.
    pub fn like(before: &Series, points: Vec<(f64, f64)>) -> Self {
        Self {
            points,
            alike: true,
            ..before.clone()
        }
    }

    /// The same, drawn in another way.
    #[must_use]
    pub fn with(mut self, style: SeriesStyle) -> Self {
        self.style = style;
        self
    }
}

/// A plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Name of its file, without an ending.
    pub name: String,
    /// What it shows, in one line.
    pub title: String,
    /// The axis to the right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
}

/// A span of an axis that is drawn, in the coordinates of its scale.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bounds {
    low: f64,
    high: f64,
}

impl Bounds {
    /// Where in the span a place is, from 0 to 1.
    fn part(self, place: f64) -> f64 {
        (place - self.low) / (self.high - self.low)
    }
}

impl Plot {
    /// The points of a series that can be drawn, in the coordinates of the scales.
    fn places(&self, series: &Series) -> Vec<(f64, f64)> {
        let place = |&(x, y): &(f64, f64)| Some((self.x.place(x)?, self.y.place(y)?));
        series.points.iter().filter_map(place).collect()
    }

    /// The number of a series among those that look different.
    fn look(&self, k: usize) -> usize {
        let looks = self.series[..=k].iter().filter(|series| !series.alike);
        looks.count().saturating_sub(1)
    }

    /// The series of the legend.
    fn named(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(|series| !series.alike)
    }

    /// As text of `width` columns and `height` lines, legend and labels included.
    pub fn terminal(&self, width: usize, height: usize, ascii: bool) -> String {
        terminal::draw(self, width, height, ascii)
    }

    /// As an SVG picture.
    pub fn svg(&self) -> String {
        svg::draw(self)
    }
}

/// Plots of one kind side by side, over common axes and with one legend, as an SVG picture.
pub fn svg_row(title: &str, plots: &[Plot]) -> String {
    svg::row(title, plots)
}

/// The spans that hold all points of plots over the same axes; none when there is no point.
fn bounds(plots: &[&Plot]) -> Option<(Bounds, Bounds)> {
    let places = |plot: &&Plot| -> Vec<_> {
        let each = plot.series.iter();
        each.flat_map(|series| plot.places(series)).collect()
    };
    let places: Vec<_> = plots.iter().flat_map(places).collect();
    let axes = plots.first()?;
    let x = axes.x.bounds(places.iter().map(|p| p.0))?;
    let y = axes.y.bounds(places.iter().map(|p| p.1))?;
    Some((x, y))
}
