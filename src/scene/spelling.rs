//! Words that are meant where others stand: a slip of the hand or of the case, told as a cure.

/// Longest word that is looked at, in bytes: the names of attributes are shorter.
const LONGEST: usize = 24;
/// Words up to this length may have one slip, and longer ones two.
const SHORT: usize = 4;

/// The candidate that is closest to `word`, where one is it up to a slip or two: a letter too many, missing, wrong or swapped with
/// its neighbour. The case does not count.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let most = if word.len() <= SHORT { 1 } else { 2 };
    let slips = |candidate: &'a str| Some((slips(word, candidate, most)?, candidate));
    let found = candidates.into_iter().filter_map(slips);
    found.min_by_key(|(slips, _)| *slips).map(|(_, candidate)| candidate)
}

/// The optimal string alignment distance of two words, unless it is larger than `most`.
fn slips(a: &str, b: &str, most: usize) -> Option<usize> {
    if a.len().max(b.len()) > LONGEST || a.len().abs_diff(b.len()) > most {
        return None;
    }
    let [a, b] = [a, b].map(|word| word.to_ascii_lowercase().into_bytes());
    // Rows of the table: the one before the last, the last, and the next.
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, of_a) in a.iter().enumerate() {
        let mut next = vec![i + 1];
        for (j, of_b) in b.iter().enumerate() {
            let wrong = last[j] + usize::from(of_a != of_b);
            let mut least = wrong.min(last[j + 1] + 1).min(next[j] + 1);
            let are_swapped = i > 0 && j > 0 && *of_a == b[j - 1] && a[i - 1] == *of_b;
            if are_swapped {
                least = least.min(before[j - 1] + 1);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut last, next);
    }
    last.last().copied().filter(|slips| *slips <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_is_the_word_up_to_a_slip_or_two() {
        for (word, others, expected) in [
            ("points", &["id", "pionts"][..], Some("pionts")),
            ("points", &["Points"], Some("Points")),
            ("points", &["class", "pnts", "point"], Some("point")),
            ("uvs", &["uv"], Some("uv")),
            ("uvs", &["u", "v", "id"], None),
            ("colors", &["colours"], Some("colours")),
            ("texid", &["texId"], Some("texId")),
            ("texid", &["id", "style", "textures"], None),
            ("points", &[], None),
        ] {
            assert_eq!(nearest(word, others.iter().copied()), expected, "{word} of {others:?}");
        }
        let long = "x".repeat(1 << 20);
        assert_eq!(nearest("points", [long.as_str()]), None, "not looked at");
    }
}
