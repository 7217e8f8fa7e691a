//! Results as comma-separated values, of the scene, not of the machine: one header, one
//! row; what the scene does not have is an empty cell.

use super::{Format, series};
use crate::study::findings::Finding;

pub(super) const FORMAT: Format = Format {
    name: "csv",
    meaning: "Comma-separated values",
    for_people: false,
    results: Some(results),
    motion: Some(series::begin),
};

fn results(_title: &str, all: &[Finding]) -> String {
    let of_the_scene = || {
        all.iter()
            .filter(|finding| !finding.quantity.is_of_the_machine())
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header: Vec<_> = of_the_scene()
        .map(|finding| finding.quantity.name)
        .collect();
    let cells: Vec<_> = of_the_scene().map(|finding| &finding.cell).collect();
    let bytes = writer
        .write_record(header)
        .and_then(|()| writer.serialize(cells))
        .ok()
        .and_then(|()| writer.into_inner().ok())
        .expect("memory takes whatever is written");
    String::from_utf8(bytes).expect("the cells were text")
}
