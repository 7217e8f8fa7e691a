//! Results as one JSON object, in their order; what the scene does not have is left out.

use super::Format;
use crate::study::findings::Finding;
use crate::study::table::Cell;
use serde::ser::{Serialize, SerializeMap, Serializer};

pub(super) const FORMAT: Format = Format {
    name: "json",
    meaning: "JSON",
    for_people: false,
    results: Some(results),
    motion: None,
};

fn results(_title: &str, all: &[Finding]) -> String {
    let object = serde_json::to_string_pretty(&Object(all));
    object.expect("words and finite numbers can be written") + "\n"
}

struct Object<'a>(&'a [Finding]);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        for finding in self.0 {
            if finding.cell != Cell::Empty {
                object.serialize_entry(finding.quantity.name, &finding.cell)?;
            }
        }
        object.end()
    }
}
