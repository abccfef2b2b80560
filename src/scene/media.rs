//! Which media a picture on a screen is (Media Queries 4).

/// Whether a list of media holds a picture on a screen; `None` where that depends on a condition, such as the width of a window.
pub(super) fn applies(list: &str) -> Option<bool> {
    let mut is_open = false;
    let lower = list.trim().to_ascii_lowercase();
    if lower.is_empty() {
        return Some(true);
    }
    for query in outside_parentheses(&lower) {
        match query_applies(query) {
            Some(true) => return Some(true),
            Some(false) => {}
            None => is_open = true,
        }
    }
    (!is_open).then_some(false)
}

/// The queries of a list: commas inside of parentheses divide none.
fn outside_parentheses(list: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_usize;
    list.split(move |c| {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        c == ',' && depth == 0
    })
}

fn query_applies(query: &str) -> Option<bool> {
    let query = query.trim();
    let end = |word: &str| word.find(|c: char| c.is_ascii_whitespace() || c == '(');
    let first = |text: &str| end(text).unwrap_or(text.len());
    let (word, rest) = query.split_at(first(query));
    let (is_not, medium) = match word {
        "not" => (true, rest.trim_start()),
        "only" => (false, rest.trim_start()),
        _ => (false, query),
    };
    if medium.starts_with('(') {
        return None;
    }
    let (medium, conditions) = medium.split_at(first(medium));
    let is_shown = matches!(medium, "all" | "screen");
    // Without the medium no condition matters.
    let holds = match (is_shown, conditions.trim().is_empty()) {
        (true, false) => None,
        (is_shown, _) => Some(is_shown),
    };
    holds.map(|holds| holds != is_not)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_media_hold_a_screen_or_not() {
        for list in [
            "",
            "all",
            "screen",
            " Only SCREEN",
            "print, screen",
            "not print",
            "not print and (color)",
        ] {
            assert_eq!(applies(list), Some(true), "{list}");
        }
        for list in [
            "print",
            "not all",
            "not screen",
            "speech, print and (width)",
            "only",
            "x(y)",
        ] {
            assert_eq!(applies(list), Some(false), "{list}");
        }
        for list in [
            "(min-width: 10px)",
            "screen and (color)",
            "print, (a, b)",
            "not screen and (color)",
            "not (hover)",
            "screen and(color)",
        ] {
            assert_eq!(applies(list), None, "{list}");
        }
    }
}
