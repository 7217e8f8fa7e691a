//! The presets that the program brings along.

/// Pairs of name and text, one file of `presets/` each.
macro_rules! presets {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../presets/", $name, ".toml")))),*]
    };
}

/// In the order in which they teach.
static PRESETS: &[(&str, &str)] = presets![
    "shaken",
    "fig1a",
    "fig1b",
    "fig1c",
    "fig1d",
    "fig1e",
    "fig1f",
    "fig5a",
    "fig5b",
    "fig6a",
    "fig6b",
    "fig7-md",
    "fig7-ed",
    "steel",
    "aluminium",
    "fig4",
    "fig3-hooke",
    "fig3-hertz",
    "fig3-hkk",
    "single-ball",
    "inelastic-ball",
    "dropped",
    "mixed-sizes",
    "tc-rule",
];

/// Names and TOML texts of the embedded presets, the default first.
pub fn embedded() -> &'static [(&'static str, &'static str)] {
    PRESETS
}

pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PRESETS.iter().map(|&(name, _)| name)
}

pub(super) fn text(name: &str) -> Option<&'static str> {
    PRESETS
        .iter()
        .find(|&&(each, _)| each == name)
        .map(|&(_, text)| text)
}
