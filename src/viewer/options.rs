//! Settings by the names of the command line's options, such as `sample-rate 16`: the one grammar for whatever sets them
//! by text besides the command line itself.

use super::Command;
use super::typed::{self, Argument};

/// Every setting of a picture that is neither scene nor view: an option's name without its dashes, and what may follow.
pub(super) static OPTIONS: &[(&str, Argument)] = &[
    ("sample-rate", typed::SAMPLE_RATE),
    ("pattern", typed::PATTERN),
    ("pixel-sampling", typed::PIXEL_SAMPLING),
    ("level-sampling", typed::LEVEL_SAMPLING),
    ("anisotropy", typed::ANISOTROPY),
    ("lod-bias", typed::LOD_BIAS),
    ("lod-level", typed::LOD_LEVEL),
    ("lod-per", typed::LOD_PER),
    ("resolve", typed::RESOLVE),
    ("rules", typed::RULES),
    ("background", typed::BACKGROUND),
    ("dialect", typed::DIALECT),
    ("visualise", typed::VISUALISE),
];

/// What may follow an option's name; `None` where there is no such option.
pub fn option(name: &str) -> Option<&'static Argument> {
    let known = OPTIONS.iter().find(|(known, _)| *known == name);
    known.map(|(_, argument)| argument)
}

/// The options' names, in the order of the command line's help.
pub fn names() -> impl Iterator<Item = &'static str> {
    OPTIONS.iter().map(|(name, _)| *name)
}

/// Whether a text is meant to be settings: it starts with an option's name and a blank.
pub(super) fn are_meant(text: &str) -> bool {
    text.trim_start()
        .split_once(char::is_whitespace)
        .is_some_and(|(name, _)| option(name).is_some())
}

/// The commands of settings such as `sample-rate 16, dialect svg`; `None` where one of them is none.
pub(super) fn parse(text: &str) -> Option<Vec<Command>> {
    let one = |part: &str| {
        let (name, value) = part.trim().split_once(char::is_whitespace)?;
        option(name)?.parse(value).ok()
    };
    text.split(',').map(one).collect()
}
