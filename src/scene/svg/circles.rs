//! References that lead in a circle.

use std::collections::HashMap;

use super::styles::By;

/// A reference, or a step to something inside: from, to, and how.
pub(super) type Edge = (usize, usize, By);

/// The references that are part of a circle: where each leads, something leads back. Without them there is no circle.
pub(super) fn closing(edges: &[Edge]) -> Vec<Edge> {
    let edges = on_circles(edges);
    let mut numbers: HashMap<usize, usize> = HashMap::new();
    for (from, to, _) in &edges {
        for end in [from, to] {
            let next = numbers.len();
            numbers.entry(*end).or_insert(next);
        }
    }
    let [mut onward, mut back] = [vec![Vec::new(); numbers.len()], vec![Vec::new(); numbers.len()]];
    for (from, to, _) in &edges {
        onward[numbers[from]].push(numbers[to]);
        back[numbers[to]].push(numbers[from]);
    }
    let groups = groups(&onward, &back);
    let is_closing = |(from, to, by): &Edge| *by != By::Inside && groups[numbers[from]] == groups[numbers[to]];
    edges.into_iter().filter(is_closing).collect()
}

/// The number of each element's group, in which all lead to each other, as Kosaraju and Sharir find them: those that lead to most come
/// first, and each takes all that lead to it and have no group yet.
fn groups(onward: &[Vec<usize>], back: &[Vec<usize>]) -> Vec<usize> {
    let mut left = Vec::with_capacity(onward.len());
    let mut seen = vec![false; onward.len()];
    for start in 0..onward.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut open = vec![(start, 0)];
        while let Some((at, next)) = open.last_mut() {
            let Some(&to) = onward[*at].get(*next) else {
                left.push(*at);
                open.pop();
                continue;
            };
            *next += 1;
            if !std::mem::replace(&mut seen[to], true) {
                open.push((to, 0));
            }
        }
    }
    let mut groups = vec![usize::MAX; onward.len()];
    for &start in left.iter().rev() {
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            if groups[at] == usize::MAX {
                groups[at] = start;
                open.extend(&back[at]);
            }
        }
    }
    groups
}

/// The edges that are left when everything is taken away that leads nowhere, or that nothing leads to: those of circles, and
/// between them.
fn on_circles(edges: &[Edge]) -> Vec<Edge> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_of_circles_are_found_and_no_others() {
        use By::{Fill, Href, Inherited, Inside, Mask, Stroke};
        for (edges, expected, what) in [
            (vec![(0, 1, Inside), (1, 2, Fill)], vec![], "no circle"),
            (vec![(0, 0, Href)], vec![(0, 0, Href)], "itself"),
            (
                vec![(0, 1, Inside), (1, 2, Fill), (2, 3, Inside), (3, 2, Fill)],
                vec![(3, 2, Fill)],
                "a pattern in itself, and a shape that has it",
            ),
            (
                vec![(0, 1, Mask), (1, 2, Mask), (2, 0, Mask)],
                vec![(0, 1, Mask), (1, 2, Mask), (2, 0, Mask)],
                "three masks",
            ),
            (
                vec![(0, 1, Fill), (1, 0, Stroke), (1, 2, Fill), (2, 3, Inside), (3, 2, Mask)],
                vec![(0, 1, Fill), (1, 0, Stroke), (3, 2, Mask)],
                "what leads from circle to circle is on none",
            ),
            (
                vec![(0, 1, Inherited), (1, 0, Inside)],
                vec![(0, 1, Inherited)],
                "by what is around",
            ),
            (
                vec![(0, 1, Inside), (0, 2, Inside), (1, 2, Href), (2, 0, Href)],
                vec![(1, 2, Href), (2, 0, Href)],
                "two ways",
            ),
        ] {
            assert_eq!(closing(&edges), expected, "{what}");
        }
    }

    #[test]
    fn nothing_is_left_of_circles_without_their_references() {
        arbtest::arbtest(|u| {
            let mut edges: Vec<Edge> = (2..9).map(|to| (to / 2, to, By::Inside)).collect();
            for _ in 0..u.int_in_range(0..=12)? {
                edges.push((u.int_in_range(1..=8)?, u.int_in_range(1..=8)?, By::Href));
            }
            let taken = closing(&edges);
            edges.retain(|edge| !taken.contains(edge));
            assert_eq!(on_circles(&edges), []);
            Ok(())
        })
        .budget_ms(200);
    }
}
