//! Samples exactly on an edge of a primitive that covers none of them: whose they are, and why.

use glam::DVec2;

use super::explanation::Question;
use super::model::{Explanation, Missed};
use super::numbers::runs;
use super::tie::{Tie, TieOwner, TieSide};
use crate::geometry::Polygon;
use crate::render::{Explainer, NotOwned};
use crate::rules::Rules;

impl Question<'_> {
    /// The samples at these places in the pixel that lie on an edge of a primitive and are not its own.
    pub(super) fn ties(&self, primitive: u32, explainer: &Explainer<'_>, positions: &[DVec2]) -> Vec<Tie> {
        // What is crisp has no edges but those of pixels, and by the course's rules every edge owns its line.
        let rules = self.subject.settings.rules;
        if rules == Rules::Course || self.polygon(primitive).is_some_and(Polygon::is_crisp) {
            return Vec::new();
        }
        let sides = explainer.not_owned(primitive, positions);
        if sides.iter().all(Option::is_none) {
            return Vec::new();
        }
        let (owner, counts) = match rules {
            Rules::Float => (TieOwner::Nobody, explainer.on_float_edges(primitive, positions.len())),
            Rules::Standard | Rules::Course => (TieOwner::Neighbour, vec![true; positions.len()]),
        };
        let tie = |(sample, (side, counts)): (usize, (Option<NotOwned>, bool))| {
            let side = match side.filter(|_| counts)? {
                NotOwned::Right => TieSide::Right,
                NotOwned::Bottom => TieSide::Bottom,
                NotOwned::Corner => TieSide::Corner,
                NotOwned::Peak => TieSide::Peak,
            };
            Some(Tie { sample, side, owner })
        };
        sides.into_iter().zip(counts).enumerate().filter_map(tie).collect()
    }
}

impl Explanation {
    /// Where samples lie exactly on an edge of what is missed, in words behind that no sample is met; else empty.
    pub(super) fn tie_words(&self, missed: &Missed) -> String {
        let Some(first) = missed.ties.first() else {
            return String::new();
        };
        let samples: Vec<usize> = missed.ties.iter().map(|tie| tie.sample).collect();
        let are_many = samples.len() > 1;
        let who = match (are_many, self.samples.len()) {
            (_, 1) => "the only one lies".to_owned(),
            (false, _) => format!("sample {} lies", runs(&samples)),
            (true, _) => format!("samples {} lie", runs(&samples)),
        };
        let mut sides: Vec<TieSide> = missed.ties.iter().map(|tie| tie.side).collect();
        sides.sort_unstable();
        sides.dedup();
        let sides: Vec<&str> = sides.into_iter().map(TieSide::words).collect();
        let sides = sides.join(" or ");
        let (is, whose) = match (first.owner, are_many) {
            (TieOwner::Nobody, false) => ("is", "nobody's: the float rules have none for ties"),
            (TieOwner::Nobody, true) => ("are", "nobody's: the float rules have none for ties"),
            (TieOwner::Neighbour, false) => ("is", "the neighbour's by the top-left rule"),
            (TieOwner::Neighbour, true) => ("are", "the neighbours' by the top-left rule"),
        };
        format!(": {who} exactly on {sides}, and {is} {whose}")
    }
}
