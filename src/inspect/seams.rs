//! Why a line may show where two primitives meet: both painted it, nobody did, or each reads another mip level.
//!
//! Said of what was recorded of this pixel's samples only; where neighbours meet as they should there is nothing to say.

use super::model::{Edge, Explanation, Fragment, Interpolated, Paint, Shape, Texture, Verdict, View};
use super::numbers::{number, significant};

/// Gaps wider than this, in pixels, are there to be seen and nobody's mistake.
const WIDEST_GAP: f64 = 0.25;
/// Cosine of the angle between edges that run side by side.
const SIDE_BY_SIDE: f64 = 0.98;

/// What two neighbours share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meeting {
    /// A whole edge.
    Edge,
    /// A part of one.
    Line,
}

impl Explanation {
    /// Where this pixel has a seam, what it comes of. What cures it, if anything does, is for [`super::Truth`] to find out.
    pub(super) fn seams(&self) -> Vec<String> {
        if self.exact {
            // Nothing lies between areas, and no line belongs to both.
            let seams = [self.conflation_words(), self.step_of_levels()];
            return seams.into_iter().flatten().collect();
        }
        let seams = [
            self.painted_twice(),
            self.pinhole_hint(),
            self.left_open(),
            self.step_of_levels(),
        ];
        seams.into_iter().flatten().collect()
    }

    /// A line that belongs to both neighbours by the course's rules, where the upper lets the lower shine through.
    fn painted_twice(&self) -> Option<String> {
        let doubled: Vec<[usize; 2]> = (0..self.samples.len())
            .filter_map(|sample| self.twice_at(sample))
            .collect();
        let [lower, upper] = *doubled.first()?;
        let count = doubled.iter().filter(|pair| **pair == [lower, upper]).count();
        Some(format!(
            "{} exactly on the line between {} and {}. By the course's rules a line belongs to both: both painted it, and \
             what shines through is blended twice, a seam.",
            self.count_words(count),
            self.numbered(lower),
            self.numbered(upper),
        ))
    }

    /// The two neighbours that both own a sample on their line; of several pairs on one line those that share a whole edge.
    fn twice_at(&self, sample: usize) -> Option<[usize; 2]> {
        let stack = &self.samples.get(sample)?.stack;
        let seen = |paint: usize| self.fragment(paint, sample).filter(|fragment| fragment.seen);
        let tied: Vec<usize> = stack
            .iter()
            .copied()
            .filter(|paint| seen(*paint).is_some() && self.is_on_line(*paint, sample))
            .collect();
        let pairs = tied
            .iter()
            .enumerate()
            .flat_map(|(i, upper)| tied[..i].iter().map(move |lower| [*lower, *upper]));
        let shines = |paint: usize| seen(paint).is_some_and(Fragment::shines_through);
        let seams: Vec<[usize; 2]> = pairs.filter(|[_, upper]| shines(*upper)).collect();
        let whole = seams.iter().find(|pair| self.meet_at(**pair, sample, Meeting::Edge));
        // Where a corner of one lies on an edge of the other; an opaque one may lie below both.
        let in_part = || {
            seams
                .iter()
                .find(|pair| shines(pair[0]) && self.meet_at(**pair, sample, Meeting::Line))
        };
        whole.or_else(in_part).copied()
    }

    fn is_on_line(&self, paint: usize, sample: usize) -> bool {
        self.tied_edges(paint, sample).next().is_some()
    }

    /// The edges of a triangle on whose lines a sample lies, each from its first corner on: that one, the next, and the third.
    fn tied_edges(&self, paint: usize, sample: usize) -> impl Iterator<Item = [[f64; 2]; 3]> {
        let both = self.edges(paint, sample).zip(self.corners(paint));
        both.into_iter().flat_map(|(edges, corners)| {
            let tied = (0..3).filter(|i| edges[*i].verdict == Verdict::TieInclusive);
            tied.map(|i| [0, 1, 2].map(|next| corners[(i + next) % 3]))
        })
    }

    /// Whether two triangles lie on both sides of a line on which a sample lies.
    fn meet_at(&self, [a, b]: [usize; 2], sample: usize, meeting: Meeting) -> bool {
        let meet = |[from, to, third]: [[f64; 2]; 3], [start, end, other]: [[f64; 2]; 3]| {
            let on_both_sides = side(from, to, third) * side(from, to, other) < 0.0;
            let meet = match meeting {
                Meeting::Edge => [from, to] == [start, end] || [from, to] == [end, start],
                Meeting::Line => [start, end].into_iter().all(|point| side(from, to, point) == 0.0),
            };
            on_both_sides && meet
        };
        self.tied_edges(a, sample)
            .any(|own| self.tied_edges(b, sample).any(|other| meet(own, other)))
    }

    /// The edges of a triangle that is seen: parts of a mask have none that anybody could see a seam at.
    fn edges(&self, paint: usize, sample: usize) -> Option<&[Edge; 3]> {
        match self
            .paints
            .get(paint)
            .filter(|paint| !paint.in_mask)?
            .views
            .get(sample)?
        {
            View::Triangle { edges, .. } => Some(edges),
            View::Polygon { .. } => None,
        }
    }

    fn corners(&self, paint: usize) -> Option<&[[f64; 2]; 3]> {
        match &self.paints.get(paint)?.shape {
            Shape::Triangle { corners } => Some(corners),
            _ => None,
        }
    }

    /// Whether two triangles share lines or corners at most: an edge of one has the other on its far side.
    fn are_apart(&self, a: usize, b: usize) -> bool {
        let (Some(a), Some(b)) = (self.corners(a), self.corners(b)) else {
            return false;
        };
        let separates = |own: &[[f64; 2]; 3], other: &[[f64; 2]; 3]| {
            (0..3).any(|i| {
                let (from, to) = (own[i], own[(i + 1) % 3]);
                let inside = side(from, to, own[(i + 2) % 3]);
                inside != 0.0 && other.iter().all(|corner| side(from, to, *corner) * inside <= 0.0)
            })
        };
        separates(a, b) || separates(b, a)
    }

    /// A sample between two triangles that nearly meet.
    fn left_open(&self) -> Option<String> {
        let (sample, [a, b], gap) = (0..self.samples.len())
            .filter(|sample| !self.is_pinhole(*sample))
            .find_map(|sample| self.gap_at(sample))?;
        Some(format!(
            "Sample {} lies between {} and {}, outside of both: the document leaves a gap of {} pixels there, and what is \
             below shows. No setting closes it: corners that are to meet need the same coordinates.",
            sample + 1,
            self.numbered(a),
            self.numbered(b),
            significant(gap)
        ))
    }

    fn gap_at(&self, sample: usize) -> Option<(usize, [usize; 2], f64)> {
        let near: Vec<(usize, usize, f64)> = (0..self.paints.len())
            .filter_map(|paint| {
                let (edge, distance) = self.just_outside(paint, sample)?;
                Some((paint, edge, distance))
            })
            .collect();
        let pairs = near
            .iter()
            .enumerate()
            .flat_map(|(i, b)| near[..i].iter().map(move |a| (*a, *b)));
        let mut gaps = pairs.filter_map(|((a, edge_a, from_a), (b, edge_b, from_b))| {
            let gap = from_a + from_b;
            let edges = [(a, edge_a), (b, edge_b)];
            let narrow = gap < WIDEST_GAP && self.widest_between(edges).is_none_or(|widest| widest < WIDEST_GAP);
            let meets = narrow && self.face([a, b], [edge_a, edge_b]) && self.are_apart(a, b);
            (meets && self.shows_below(sample, [a, b])).then_some((sample, [a, b], gap))
        });
        gaps.next()
    }

    /// Whether nothing covers a sample but what lies below two neighbours: a third one of a mesh closes the gap, whether it
    /// was painted before them or after.
    fn shows_below(&self, sample: usize, neighbours: [usize; 2]) -> bool {
        let Some(sample) = self.samples.get(sample) else {
            return false;
        };
        let is_below = |paint: usize| {
            neighbours
                .iter()
                .all(|above| paint < *above && self.overlap(paint, *above))
        };
        let is_layer = |paint: usize| self.paints[paint].shape.is_layer_mark();
        sample.stack.iter().all(|paint| is_layer(*paint) || is_below(*paint))
    }

    /// Whether two paints cover a sample both.
    fn overlap(&self, a: usize, b: usize) -> bool {
        let covered = self.paints[a].samples();
        self.paints[b].samples().iter().any(|sample| covered.contains(sample))
    }

    /// The only edge that keeps a sample out of a triangle that paints others, and how far.
    fn just_outside(&self, paint: usize, sample: usize) -> Option<(usize, f64)> {
        let edges = self.edges(paint, sample)?;
        let mut out = (0..3).filter(|i| !edges[*i].verdict.is_inside());
        let (edge, more) = (out.next()?, out.next());
        let distance = edges[edge].distance.abs();
        (more.is_none() && distance > 0.0 && distance < WIDEST_GAP).then_some((edge, distance))
    }

    /// How far two edges are from each other where they are farthest, in pixels: at the ends of each that lie beside the other.
    /// Where a wedge opens it is part of the drawing, though its tip is narrow.
    fn widest_between(&self, edges: [(usize, usize); 2]) -> Option<f64> {
        let ends = |(paint, edge): (usize, usize)| {
            let corners = self.corners(paint)?;
            Some([corners[edge], corners[(edge + 1) % 3]])
        };
        let (a, b) = ends(edges[0]).zip(ends(edges[1]))?;
        let distances = |[from, to]: [[f64; 2]; 2], ends: [[f64; 2]; 2]| {
            let way = [to[0] - from[0], to[1] - from[1]];
            let length = way[0].hypot(way[1]);
            let beside = move |end: &[f64; 2]| {
                let along = (end[0] - from[0]) * way[0] + (end[1] - from[1]) * way[1];
                (0.0..=length * length).contains(&along)
            };
            ends.into_iter()
                .filter(beside)
                .map(move |end| side(from, to, end).abs() / length)
                .collect::<Vec<_>>()
        };
        let all = distances(a, b).into_iter().chain(distances(b, a));
        all.filter(|distance| distance.is_finite()).reduce(f64::max)
    }

    /// Whether an edge of `a` and one of `b` run side by side.
    fn face(&self, [a, b]: [usize; 2], [edge_a, edge_b]: [usize; 2]) -> bool {
        let direction = |paint: usize, edge: usize| {
            let corners = self.corners(paint)?;
            let [from, to] = [corners[edge], corners[(edge + 1) % 3]];
            let way = [to[0] - from[0], to[1] - from[1]];
            let length = way[0].hypot(way[1]);
            (length > 0.0).then(|| way.map(|part| part / length))
        };
        let both = direction(a, edge_a).zip(direction(b, edge_b));
        both.is_some_and(|(a, b)| (a[0] * b[0] + a[1] * b[1]).abs() > SIDE_BY_SIDE)
    }

    /// Neighbours with one texture whose levels of detail are rounded to different levels.
    fn step_of_levels(&self) -> Option<String> {
        let textured: Vec<(usize, &Texture)> = self
            .paints
            .iter()
            .enumerate()
            .filter(|(_, paint)| is_seen_in_texture(paint))
            .filter_map(|(number, paint)| Some((number, paint.texture.as_ref()?)))
            .collect();
        let level = |texture: &Texture| texture.levels.first().map(|level| level.number);
        let pairs = textured
            .iter()
            .enumerate()
            .flat_map(|(i, b)| textured[..i].iter().map(move |a| (*a, *b)));
        let mut steps = pairs.filter(|((a, own), (b, other))| {
            own.level_sampling == "nearest"
                && own.index == other.index
                && level(own) != level(other)
                && self.share_an_edge(*a, *b)
        });
        let ((a, own), (b, other)) = steps.next()?;
        Some(format!(
            "Along the edge between {} and {} the level of detail changes from {} to {}, because a triangle has one for all of \
             it; level sampling nearest rounds them to levels {} and {}, a step.",
            self.numbered(a),
            self.numbered(b),
            number((own.clamped * 100.0).round() / 100.0),
            number((other.clamped * 100.0).round() / 100.0),
            level(own)?,
            level(other)?,
        ))
    }

    fn share_an_edge(&self, a: usize, b: usize) -> bool {
        let both = self.corners(a).zip(self.corners(b));
        let shared = |a: &[[f64; 2]; 3], b: &[[f64; 2]; 3]| a.iter().filter(|corner| b.contains(corner)).count();
        both.is_some_and(|(a, b)| shared(a, b) == 2)
    }

    /// Such as `2 (polygon, line 7)`, as the report numbers paints.
    pub(super) fn numbered(&self, paint: usize) -> String {
        let name = self.paints.get(paint).map(Paint::name).unwrap_or_default();
        format!("{} ({name})", paint + 1)
    }

    /// Such as `3 of 4 samples lie`.
    pub(super) fn count_words(&self, count: usize) -> String {
        match (count, self.samples.len()) {
            (1, 1) => "Its only sample lies".to_owned(),
            (1, all) => format!("1 of {all} samples lies"),
            (count, all) => format!("{count} of {all} samples lie"),
        }
    }
}

fn is_seen_in_texture(paint: &Paint) -> bool {
    let textured = |fragment: &Fragment| {
        let view = paint.views.get(fragment.sample);
        fragment.seen
            && matches!(
                view,
                Some(View::Triangle {
                    value: Interpolated::Texture { .. },
                    ..
                })
            )
    };
    paint.fragments.iter().any(textured)
}

/// On which side of a line a point lies: below zero, above it, or zero on the line. Corners are multiples of the sub-pixel
/// grid's unit, so that near the frame this is exact.
fn side(from: [f64; 2], to: [f64; 2], point: [f64; 2]) -> f64 {
    (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0])
}
