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
}

impl Series {
    /// A series with markers joined by a line.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self {
            name: name.into(),
            points,
            style: SeriesStyle::Both,
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

    /// The spans that hold all points; none when there is no point.
    fn bounds(&self) -> Option<(Bounds, Bounds)> {
        let places: Vec<_> = self.series.iter().flat_map(|s| self.places(s)).collect();
        let x = self.x.bounds(places.iter().map(|p| p.0))?;
        let y = self.y.bounds(places.iter().map(|p| p.1))?;
        Some((x, y))
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
