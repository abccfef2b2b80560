//! References that lead in a circle, told apart by whether usvg gets out of it.
//!
//! usvg takes out one reference of a circle of one or two, if both are of one kind. Anything larger it would follow for ever.

use std::collections::HashMap;

use super::styles::By;

/// A reference, or a step to something inside: from, to, and how.
pub(super) type Edge = (usize, usize, By);

/// An element of a circle that usvg does not get out of, if there is one.
pub(super) fn endless(edges: &[Edge]) -> Option<usize> {
    let left = on_circles(edges);
    let mut groups: HashMap<usize, usize> = HashMap::new();
    for &(from, to, _) in &left {
        let (one, other) = (group(&mut groups, from), group(&mut groups, to));
        groups.insert(one, other);
    }
    // What is referred to in each group, and how: one or two of one kind are what usvg finds.
    let mut targets: HashMap<usize, Vec<(usize, By)>> = HashMap::new();
    for &(from, to, by) in left.iter().filter(|(_, _, by)| is_reference(*by)) {
        let of_group = targets.entry(group(&mut groups, from)).or_default();
        if !of_group.contains(&(to, by)) {
            of_group.push((to, by));
        }
        let is_found = match of_group.as_slice() {
            _ if matches!(by, By::Picture | By::Inherited) => false,
            [_] => true,
            [(_, first), (_, second)] => first == second && *first != By::Filter,
            _ => false,
        };
        if !is_found {
            return Some(to);
        }
    }
    None
}

/// A `use` is no danger: usvg counts its way.
fn is_reference(by: By) -> bool {
    !matches!(by, By::Inside | By::Href)
}

/// The edges that are left when everything is taken away that leads nowhere, or that nothing leads to: those of circles, and
/// between them.
pub(super) fn on_circles(edges: &[Edge]) -> Vec<Edge> {
    let flipped = |edges: Vec<Edge>| {
        edges
            .into_iter()
            .map(|(from, to, by)| (to, from, by))
            .collect::<Vec<_>>()
    };
    let reached = without_sources(edges);
    flipped(without_sources(&flipped(reached)))
}

/// The edges that do not start where nothing leads to, nor where only such edges do.
fn without_sources(edges: &[Edge]) -> Vec<Edge> {
    let mut incoming: HashMap<usize, usize> = HashMap::new();
    let mut outgoing: HashMap<usize, Vec<usize>> = HashMap::new();
    for &(from, to, _) in edges {
        incoming.entry(from).or_default();
        *incoming.entry(to).or_default() += 1;
        outgoing.entry(from).or_default().push(to);
    }
    let mut sources: Vec<usize> = incoming
        .iter()
        .filter(|(_, count)| **count == 0)
        .map(|(node, _)| *node)
        .collect();
    while let Some(source) = sources.pop() {
        for to in outgoing.remove(&source).unwrap_or_default() {
            let left = incoming.entry(to).or_default();
            *left = left.saturating_sub(1);
            if *left == 0 {
                sources.push(to);
            }
        }
    }
    edges
        .iter()
        .copied()
        .filter(|(from, _, _)| outgoing.contains_key(from))
        .collect()
}

/// Which group an element belongs to; groups that were joined are one.
fn group(groups: &mut HashMap<usize, usize>, of: usize) -> usize {
    let mut at = of;
    while let Some(&next) = groups.get(&at).filter(|next| **next != at) {
        at = next;
    }
    // Straight to the end the next time.
    groups.insert(of, at);
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_of_one_or_two_of_a_kind_are_left_to_usvg() {
        use By::{Clip, Fill, Href, Inherited, Inside, Mask, Stroke};
        for (edges, expected, what) in [
            (vec![(0, 1, Inside), (1, 2, Fill)], false, "no circle"),
            (
                vec![(0, 1, Inside), (1, 2, Fill), (2, 3, Inside), (3, 2, Fill)],
                false,
                "a pattern in itself",
            ),
            (vec![(0, 1, Mask), (1, 0, Mask)], false, "two masks"),
            (vec![(0, 1, Mask), (1, 2, Mask), (2, 0, Mask)], true, "three masks"),
            (vec![(0, 1, Fill), (1, 0, Stroke)], true, "two kinds"),
            (vec![(0, 1, Inherited), (1, 0, Inside)], true, "by what is around"),
            (vec![(0, 1, Href), (1, 2, Inside), (2, 0, Href)], false, "use alone"),
            (
                vec![(0, 1, Clip), (1, 0, Clip), (2, 3, Mask), (3, 2, Mask)],
                false,
                "two circles apart",
            ),
            (
                vec![(1, 0, Fill), (0, 1, Fill), (1, 2, Fill), (2, 0, Fill)],
                true,
                "a short circle hides a long one",
            ),
        ] {
            assert_eq!(endless(&edges).is_some(), expected, "{what}");
        }
    }
}
