//! Classes of elements and parts of elements that selectors ask for.

/// What becomes of a selector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    Read,
    /// It selects nothing.
    Nothing,
    /// It has this, which is not understood.
    Unread(String),
}

/// Classes of elements that the reader of styles knows.
const READ: [&str; 8] = [
    "first-child",
    "link",
    "visited",
    "hover",
    "active",
    "focus",
    "root",
    "scope",
];

/// Classes of elements of a drawing that does not change, which are not understood.
const UNREAD: [&str; 8] = [
    "empty",
    "last-child",
    "only-child",
    "first-of-type",
    "last-of-type",
    "only-of-type",
    "any-link",
    "defined",
];
const UNREAD_FUNCTIONS: [&str; 12] = [
    "not",
    "is",
    "where",
    "has",
    "matches",
    "any",
    "-webkit-any",
    "-moz-any",
    "nth-child",
    "nth-last-child",
    "nth-of-type",
    "nth-last-of-type",
];

/// Classes of which no element of a picture is.
const OF_NOTHING: [&str; 38] = [
    "active-view-transition",
    "autofill",
    "blank",
    "buffering",
    "checked",
    "current",
    "default",
    "disabled",
    "enabled",
    "focus-visible",
    "focus-within",
    "fullscreen",
    "future",
    "host",
    "in-range",
    "indeterminate",
    "invalid",
    "local-link",
    "modal",
    "muted",
    "open",
    "optional",
    "out-of-range",
    "past",
    "paused",
    "picture-in-picture",
    "placeholder-shown",
    "playing",
    "popover-open",
    "read-only",
    "read-write",
    "required",
    "target",
    "target-within",
    "user-invalid",
    "user-valid",
    "valid",
    "volume-locked",
];
const FUNCTIONS_OF_NOTHING: [&str; 4] = ["dir", "host", "host-context", "state"];

/// Parts of elements, which a picture has not, and how many of them may be written with one colon.
const OLD_PARTS: usize = 4;
const PARTS: [&str; 19] = [
    "before",
    "after",
    "first-line",
    "first-letter",
    "backdrop",
    "cue",
    "cue-region",
    "details-content",
    "file-selector-button",
    "grammar-error",
    "highlight",
    "marker",
    "part",
    "placeholder",
    "selection",
    "slotted",
    "spelling-error",
    "target-text",
    "view-transition",
];

/// What becomes of a selector with a class; `None` where CSS has none of the name.
pub(super) fn class(name: &str) -> Option<Fate> {
    if READ.contains(&name) {
        Some(Fate::Read)
    } else if UNREAD.contains(&name) {
        Some(unread(name))
    } else {
        (OF_NOTHING.contains(&name) || PARTS[..OLD_PARTS].contains(&name)).then_some(Fate::Nothing)
    }
}

/// The same of a class with something in parentheses.
pub(super) fn function(name: &str) -> Option<Fate> {
    if name == "lang" {
        Some(Fate::Read)
    } else if UNREAD_FUNCTIONS.contains(&name) {
        Some(unread(name))
    } else {
        FUNCTIONS_OF_NOTHING.contains(&name).then_some(Fate::Nothing)
    }
}

/// The same of a part of an element, with two colons. Browsers know others of their own.
pub(super) fn part(name: &str) -> Option<Fate> {
    (PARTS.contains(&name) || name.starts_with('-')).then_some(Fate::Nothing)
}

fn unread(name: &str) -> Fate {
    Fate::Unread(format!(":{name}"))
}
