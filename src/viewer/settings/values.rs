//! Values as people type them: names, numbers, colours.

use std::path::{Path, PathBuf};

use glam::DVec2;

use super::Toggle;
use crate::color::Rgba;
use crate::rules::Rules;

/// What stands for a level that nobody fixed, or a radius.
pub(super) const AUTO: &str = "auto";

/// The value of `all` that is called `text`.
pub(in crate::viewer) fn named<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str, text: &str) -> Option<T> {
    all.iter().copied().find(|value| name(*value) == text)
}

/// A finite number.
pub(in crate::viewer) fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| value.is_finite())
}

/// A whole number that is not below zero.
pub(in crate::viewer) fn whole(text: &str) -> Option<u32> {
    text.trim().parse().ok()
}

/// `white`, `transparent` or `#RRGGBB`.
pub(super) fn color(text: &str) -> Option<Rgba> {
    match text {
        "white" => Some(Rgba::WHITE),
        "transparent" => Some(Rgba::TRANSPARENT),
        _ => {
            let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6)?;
            // `from_str_radix` would take a sign.
            if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
                return None;
            }
            let [_, r, g, b] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
            Some(Rgba::from_bytes([r, g, b, 255]))
        }
    }
}

/// The same as text.
pub(super) fn color_name(color: Rgba) -> String {
    if color == Rgba::WHITE {
        return "white".to_owned();
    }
    match color.to_bytes(Rules::Standard) {
        [_, _, _, 0] => "transparent".to_owned(),
        [r, g, b, _] => format!("#{r:02x}{g:02x}{b:02x}"),
    }
}

/// `flip`, `on` or `off`.
pub(in crate::viewer) fn toggle(text: &str) -> Option<Toggle> {
    named(&Toggle::ALL, Toggle::name, text)
}

/// Finite numbers with commas between them.
pub(in crate::viewer) fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(number).collect()
}

/// The values of a list with commas between them; a comma inside double quotes belongs to its value.
pub(super) fn list(text: &str) -> Vec<&str> {
    let mut is_quoted = false;
    text.split(|letter| {
        is_quoted ^= letter == '"';
        letter == ',' && !is_quoted
    })
    .collect()
}

/// A value without the double quotes around it, if there are any.
pub(super) fn unquoted(text: &str) -> &str {
    let inner = text.trim().strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    inner.unwrap_or(text)
}

/// `X,Y`.
pub(in crate::viewer) fn point(text: &str) -> Option<DVec2> {
    match *numbers(text)?.as_slice() {
        [x, y] => Some(DVec2::new(x, y)),
        _ => None,
    }
}

/// `X,Y` in whole pixels.
pub(in crate::viewer) fn pixels(text: &str) -> Option<[i64; 2]> {
    let (x, y) = text.split_once(',')?;
    let whole = |part: &str| part.trim().parse::<i32>().ok().map(i64::from);
    Some([whole(x)?, whole(y)?])
}

/// A path as people type it: `~` at its beginning is the home folder, as in a shell.
pub(in crate::viewer) fn path(text: &str) -> PathBuf {
    path_from(text, std::env::home_dir().as_deref())
}

/// The same where this is the home folder. Another user's, `~name`, is a name like any other.
fn path_from(text: &str, home: Option<&Path>) -> PathBuf {
    match (text.strip_prefix('~'), home) {
        (Some(""), Some(home)) => home.to_owned(),
        (Some(rest), Some(home)) if rest.starts_with(std::path::is_separator) => {
            home.join(rest.trim_start_matches(std::path::is_separator))
        }
        _ => text.into(),
    }
}

/// The value `by` places after `current` in `all`, round and round; before it where `by` is below zero.
pub(in crate::viewer) fn next_of<T: Copy + PartialEq>(all: &[T], current: T, by: f64) -> T {
    let at = all.iter().position(|value| *value == current).unwrap_or(0);
    let next = if by < 0.0 {
        (at + all.len()).checked_sub(1)
    } else {
        at.checked_add(1)
    };
    let next = next.and_then(|next| next.checked_rem(all.len()));
    next.and_then(|next| all.get(next)).copied().unwrap_or(current)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_begin_at_home() {
        let home = Some(Path::new("/home/me"));
        for (typed, path) in [
            ("~", "/home/me"),
            ("~/scenes/a b.svg", "/home/me/scenes/a b.svg"),
            ("~other/a.svg", "~other/a.svg"),
            ("a/~/b.svg", "a/~/b.svg"),
            ("/tmp/~", "/tmp/~"),
        ] {
            assert_eq!(path_from(typed, home), PathBuf::from(path), "{typed}");
        }
        assert_eq!(
            path_from("~/a.svg", None),
            PathBuf::from("~/a.svg"),
            "nobody is at home"
        );
    }

    #[test]
    fn lists_keep_commas_inside_quotes() {
        for (text, values) in [
            ("grid", &["grid"][..]),
            ("grid,own.toml", &["grid", "own.toml"]),
            ("grid,\"my,own.toml\",r2", &["grid", "\"my,own.toml\"", "r2"]),
            ("\"open,to the end", &["\"open,to the end"]),
            ("", &[""]),
        ] {
            assert_eq!(list(text), values, "{text}");
        }
        for (text, value) in [
            ("\"a,b\"", "a,b"),
            (" \"a\" ", "a"),
            (" a", " a"),
            ("\"", "\""),
            ("", ""),
        ] {
            assert_eq!(unquoted(text), value, "{text}");
        }
    }

    #[test]
    fn values_follow_each_other_round_and_round() {
        let all = ["a", "b", "c"];
        assert_eq!(all.map(|value| next_of(&all, value, 1.0)), ["b", "c", "a"], "onwards");
        assert_eq!(all.map(|value| next_of(&all, value, -1.0)), ["c", "a", "b"], "back");
        assert_eq!(next_of(&[], "d", 1.0), "d", "there is no other");
    }

    #[test]
    fn colors_are_read_as_they_are_written() {
        for text in ["white", "transparent", "#ff8000", "#000000"] {
            assert_eq!(color(text).map(color_name).as_deref(), Some(text), "{text}");
        }
        for wrong in ["", "red", "#+12345", "#12345é", "#fff"] {
            assert_eq!(color(wrong), None, "{wrong}");
        }
    }
}
