//! Settings by the names of the command line's options, such as `sample-rate 16`: the one grammar for whatever sets them
//! by text besides the command line itself.

use super::typed::{self, Argument};
use super::{Axis, Command};

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

/// The values of an option where they can be counted; none elsewhere.
pub fn values(name: &str) -> Vec<&'static str> {
    let Some(argument) = option(name) else {
        return Vec::new();
    };
    let parts: Vec<&'static str> = argument.usage.split('|').collect();
    let counted = parts.len() > 1 && parts.iter().all(|part| argument.parse(part).is_ok());
    if counted { parts } else { Vec::new() }
}

/// An axis of a sheet: a setting with values such as `1, 4, 16`.
///
/// # Errors
/// One line when there is no such setting, or a value is none of it.
pub fn axis(name: &str, text: &str) -> Result<Axis, String> {
    let option = option(name).ok_or_else(|| format!("there is no setting {name}"))?;
    let axis = Axis::parse(name, text)?;
    axis.values.iter().try_for_each(|value| option.parse(value).map(drop))?;
    Ok(axis)
}

/// An axis to begin with: every value where they can be counted.
pub fn first_axis(name: &str) -> Option<Axis> {
    let counted = values(name).join(",");
    let text = match name {
        _ if !counted.is_empty() => counted.as_str(),
        "sample-rate" | "anisotropy" => "1,4,16",
        "lod-bias" => "-1,0,1",
        "lod-level" => "0,1,2",
        "background" => "white,#808080",
        _ => return None,
    };
    axis(name, text).ok()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_can_be_an_axis() {
        for name in names() {
            let first = first_axis(name).expect(name);
            assert!(first.values.len() > 1, "{name} differs");
        }
        assert!(axis("sample-rate", "1, many").is_err(), "no number");
        assert!(axis("colour", "red, blue").is_err(), "no setting");
    }

    #[test]
    fn values_that_can_be_counted() {
        assert_eq!(values("rules"), ["standard", "course", "float"], "in their order");
        assert_eq!(values("visualise").len(), 10, "every one");
        for name in ["sample-rate", "background", "lod-level", "no-such"] {
            assert!(values(name).is_empty(), "{name}");
        }
    }
}
