//! An edge in numbers: the pixels along a line across it, how wide it is, how far the picture rings beside it.
//!
//! ```text
//!                    .-.            overshoot
//!            - - - -/- -\-.___.__   100 %: the median of the last quarter
//!        90 %      /
//!                 |     width: from 10 % to 90 %, along the line
//!        10 %    /
//!      ___.__   /                   0 %: the median of the first quarter
//!            `-'                    undershoot
//! ```
//!
//! Medians, since a plateau that rings or has grain is still where most of its pixels are. Between two pixels the edge is a
//! straight line, so that one from a pixel to the next is 0.8 pixels wide. Of several rises the first counts, from where the
//! values were last below a tenth. Where they rest on the way, as on a stair, there are two edges, which have no width together.
//! The names are those of pulses (IEEE Std 181: transition duration, overshoot, undershoot), the width is the 10 to 90 % rise
//! distance of cameras (beside ISO 12233).

use super::line::{Line, LinePoint};
use super::luma::luma;
use super::tiles::over_white;
use crate::raster::Framebuffer;

/// Parts of the way between both plateaus where an edge begins and ends.
const REACHED: [f64; 2] = [0.1, 0.9];
/// Parts of the step beyond both plateaus that no filter comes to, which ring by an eighth at most: there is another edge.
const ANOTHER: f64 = 0.25;
/// Plateaus that are nearer to each other, in levels of 255, are no edge.
const LEAST_STEP: f64 = 0.5;
/// Values on the way that differ by no more are alike: in levels of 255, and in parts of the step where that is more.
const ALIKE: [f64; 2] = [2.0, 0.04];
/// As many pixels that are alike, one after another, may be a plateau on the way.
const LEAST_REST: usize = 3;
/// How far the values come beside such a plateau, on both sides within half its length: so steep no ramp is that is as flat as the
/// plateau, however few levels it has. In levels of 255, and in parts of the step where that is more.
const APART: [f64; 2] = [4.0, 0.1];

/// How often these parts of the way between two plateaus come from a quarter of it or less to three quarters or more, and back.
fn swings(parts: &[f64]) -> usize {
    let sides = parts.iter().filter_map(|part| match part {
        part if *part <= 0.25 => Some(false),
        part if *part >= 0.75 => Some(true),
        _ => None,
    });
    let sides: Vec<bool> = sides.collect();
    sides.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Whether values on their way from one plateau to another, all parts of a step of so many levels, rest between two edges: pixels
/// that are alike, with a steep rise before and behind them.
fn rests(way: &[f64], step: f64) -> bool {
    let part = |[levels, part]: [f64; 2]| (levels / step.abs()).max(part);
    let (alike, apart) = (part(ALIKE), part(APART));
    (1..way.len()).any(|start| {
        let [mut low, mut high] = [way[start]; 2];
        let rest = way[start..].iter().take_while(|value| {
            (low, high) = (low.min(**value), high.max(**value));
            high - low <= alike
        });
        let length = rest.count();
        let (last, reach) = (start + length - 1, length.div_ceil(2));
        let before = way[start] - way[start.saturating_sub(reach)];
        let behind = way[(last + reach).min(way.len() - 1)] - way[last];
        length >= LEAST_REST && before.min(behind) >= apart
    })
}

/// What of a colour is plotted and measured, as it looks on white paper, in levels of 0 to 255.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ProfileChannel {
    /// `0.299 R + 0.587 G + 0.114 B` of stored values (ITU-R BT.601), as in structural similarity.
    #[default]
    Luma,
    /// Red.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
}

impl ProfileChannel {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Luma, Self::Red, Self::Green, Self::Blue];

    /// The name used in the interface and in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Luma => "luma",
            Self::Red => "red",
            Self::Green => "green",
            Self::Blue => "blue",
        }
    }

    /// Its value of a straight pixel `0xAARRGGBB`.
    pub fn value(self, pixel: u32) -> f64 {
        let color @ [r, g, b] = over_white(pixel);
        match self {
            Self::Luma => luma(color),
            Self::Red => r.into(),
            Self::Green => g.into(),
            Self::Blue => b.into(),
        }
    }
}

/// The pixels along a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Where they lie, in order.
    points: Vec<LinePoint>,
    /// Their straight colours `0xAARRGGBB`, one for each.
    colors: Vec<u32>,
}

/// What is measured of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The values before and behind it, in levels of 255.
    pub plateaus: [f64; 2],
    /// How far along the line it has come a tenth of the way from one to the other, and nine tenths; in pixels.
    pub rise: [f64; 2],
    /// How far the line's lightest value is above the lighter plateau, in parts of the step.
    pub overshoot: f64,
    /// How far the darkest is below the darker one.
    pub undershoot: f64,
    /// How often the line goes from about one plateau to about the other, there and back.
    pub swings: usize,
    /// Whether there is a third plateau on the way from one to the other, as between two steps of a stair.
    pub rests: bool,
}

impl Edge {
    /// The 10-90 % width, in pixels along the line.
    pub fn width(&self) -> f64 {
        self.rise[1] - self.rise[0]
    }

    /// Whether it seems to be the only one: the line goes from one plateau to the other once and without a rest, and no value is
    /// farther beyond both than filters ring. Else width, overshoot and undershoot are those of no edge.
    pub fn is_alone(&self) -> bool {
        self.more_than_an_edge().is_none()
    }

    /// What the values do that those across a single edge do not, in a few words; `None` where it seems to be the only one.
    pub fn more_than_an_edge(&self) -> Option<&'static str> {
        if self.swings > 1 {
            Some("go back and forth")
        } else if self.rests {
            Some("rest on the way")
        } else if self.overshoot.max(self.undershoot) >= ANOTHER {
            Some("go far beyond both ends")
        } else {
            None
        }
    }
}

impl Profile {
    /// The pixels of `frame` along a line, as far as the frame has them.
    pub fn of(frame: &Framebuffer, line: Line) -> Self {
        let points = line.points([frame.width(), frame.height()]);
        let width = frame.width() as usize;
        let pixel = |point: &LinePoint| {
            let [x, y] = point.at.map(|at| at as usize);
            frame.pixels().get(y * width + x).copied().unwrap_or_default()
        };
        let colors = points.iter().map(pixel).collect();
        Self { points, colors }
    }

    /// Where its pixels lie, in order along the line.
    pub fn points(&self) -> &[LinePoint] {
        &self.points
    }

    /// Their straight colours `0xAARRGGBB`.
    pub fn colors(&self) -> &[u32] {
        &self.colors
    }

    /// Their values, in levels of 255.
    pub fn values(&self, channel: ProfileChannel) -> Vec<f64> {
        self.colors.iter().map(|pixel| channel.value(*pixel)).collect()
    }

    /// Whether the values change between quarters that are alike, so that an edge may lie in one of these, or two between them.
    pub fn changes_within(&self, channel: ProfileChannel) -> bool {
        /// A change in levels of 255 that is seen.
        const SEEN: f64 = 8.0;
        let values = self.values(channel);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        self.edge(channel).is_none() && most - least >= SEEN
    }

    /// How many different colours they have on white paper.
    pub fn shades(&self) -> usize {
        let mut colors: Vec<[u8; 3]> = self.colors.iter().map(|pixel| over_white(*pixel)).collect();
        colors.sort_unstable();
        colors.dedup();
        colors.len()
    }

    /// The edge that the line crosses; `None` where its first and its last quarter are alike.
    pub fn edge(&self, channel: ProfileChannel) -> Option<Edge> {
        let values = self.values(channel);
        if values.len() < 2 {
            return None;
        }
        let quarter = (values.len() / 4).max(1);
        let plateaus @ [from, to] = [&values[..quarter], &values[values.len() - quarter..]].map(median);
        let step = to - from;
        if step.abs() < LEAST_STEP {
            return None;
        }
        let parts: Vec<f64> = values.iter().map(|value| (value - from) / step).collect();
        // The sum has no sign where it is nothing.
        let beyond = |part: f64| part.max(0.0) + 0.0;
        let most = parts.iter().copied().fold(0.0, f64::max) - 1.0;
        let least = -parts.iter().copied().fold(0.0, f64::min);
        // By lightness, so that a line has the same numbers backwards.
        let [overshoot, undershoot] = if step > 0.0 { [most, least] } else { [least, most] }.map(beyond);
        let [start, end] = Self::way(&parts)?;
        Some(Edge {
            plateaus,
            rise: [
                self.crossing(&parts, start, REACHED[0]),
                self.crossing(&parts, end - 1, REACHED[1]),
            ],
            overshoot,
            undershoot,
            swings: swings(&parts),
            rests: rests(&parts[start..=end], step),
        })
    }

    /// The pixel where the values, as parts of the way, are a tenth or less for the last time before nine tenths, and the first
    /// one where they reach these. There are such pixels, since at least half of the first quarter is not above zero and half of
    /// the last not below one.
    fn way(parts: &[f64]) -> Option<[usize; 2]> {
        let [low, high] = REACHED;
        let mut before = None;
        for (i, part) in parts.iter().enumerate() {
            if *part <= low {
                before = Some(i);
            } else if let Some(before) = before.filter(|_| *part >= high) {
                return Some([before, i]);
            }
        }
        None
    }

    /// How far along the line the values come to `level` between pixel `i`, which is not above it, and the next, which is.
    fn crossing(&self, parts: &[f64], i: usize, level: f64) -> f64 {
        let [a, b] = [i, i + 1].map(|i| self.points[i].distance);
        let way = (level - parts[i]) / (parts[i + 1] - parts[i]);
        a + (b - a) * way.clamp(0.0, 1.0)
    }
}

/// The middle one of some values, or the mean of the two in the middle; 0 of none.
fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let half = sorted.len() / 2;
    match sorted.get(half) {
        None => 0.0,
        Some(value) if sorted.len() % 2 == 1 => *value,
        Some(value) => sorted[half - 1].midpoint(*value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of greys, and the line along all of it.
    fn row(grays: &[u8]) -> Profile {
        let width = u32::try_from(grays.len()).expect("few");
        let mut frame = Framebuffer::new(width, 1);
        for (pixel, gray) in frame.pixels_mut().iter_mut().zip(grays) {
            *pixel = u32::from_be_bytes([255, *gray, *gray, *gray]);
        }
        let ends = [[0, 0], [i64::from(width) - 1, 0]];
        Profile::of(&frame, Line { ends })
    }

    fn edge(grays: &[u8]) -> Edge {
        row(grays).edge(ProfileChannel::Luma).expect("an edge")
    }

    fn is(found: f64, expected: f64, what: &str) {
        assert!((found - expected).abs() < 1e-9, "{what}: {found}, not {expected}");
    }

    #[test]
    fn edge_near_an_end_is_told_from_none() {
        let mut grays = [200; 40];
        assert!(!row(&grays).changes_within(ProfileChannel::Luma), "one grey");
        grays[37..].fill(40);
        let profile = row(&grays);
        assert!(
            profile.edge(ProfileChannel::Luma).is_none(),
            "most of the last quarter is as the first"
        );
        assert!(profile.changes_within(ProfileChannel::Luma), "but not all of it");
        assert!(
            !row(&[50, 50, 250, 250]).changes_within(ProfileChannel::Luma),
            "an edge is measured"
        );
    }

    #[test]
    fn step_from_one_pixel_to_the_next_is_four_fifths_of_a_pixel_wide() {
        let grays = [50, 50, 50, 50, 250, 250, 250, 250];
        let found = edge(&grays);
        is(found.width(), 0.8, "width");
        is(found.rise[0], 3.1, "from a tenth of the way between pixels 3 and 4");
        is(found.plateaus[0], 50.0, "before");
        is(found.plateaus[1], 250.0, "behind");
        is(found.overshoot + found.undershoot, 0.0, "nothing beyond");
        assert_eq!(row(&grays).shades(), 2, "shades");
    }

    #[test]
    fn ramp_is_four_fifths_of_its_length_wide() {
        // From 0 to 200 over ten pixels, between plateaus of eight.
        let ramp = (0..=10).map(|i| i * 20);
        let grays: Vec<u8> = [0; 8].into_iter().chain(ramp).chain([200; 8]).collect();
        let found = edge(&grays);
        is(found.width(), 8.0, "width");
        is(found.rise[0], 9.0, "20 of 200 is the second of the ramp");
        assert_eq!(row(&grays).shades(), 11, "shades");
        let down: Vec<u8> = grays.iter().rev().copied().collect();
        is(edge(&down).width(), 8.0, "backwards");
    }

    #[test]
    fn width_is_along_the_line() {
        let mut frame = Framebuffer::new(8, 8);
        for (i, pixel) in frame.pixels_mut().iter_mut().enumerate() {
            *pixel = if i % 8 < 4 { 0xFF00_0000 } else { 0xFFFF_FFFF };
        }
        let line = Line { ends: [[0, 0], [7, 7]] };
        let found = Profile::of(&frame, line).edge(ProfileChannel::Luma).expect("an edge");
        is(found.width(), 0.8 * 2.0_f64.sqrt(), "a diagonal across an upright edge");
    }

    #[test]
    fn overshoot_is_in_parts_of_the_step() {
        // From 100 to 200: 20 below, 10 above.
        let grays = [100, 100, 100, 100, 80, 150, 210, 200, 200, 200, 200, 200];
        let found = edge(&grays);
        is(found.overshoot, 0.1, "above the lighter one");
        is(found.undershoot, 0.2, "below the darker one");
        assert!(found.is_alone(), "as filters ring");
        let below = edge(&[100, 100, 100, 100, 53, 150, 200, 200, 200, 200, 200, 200]);
        assert!(!below.is_alone(), "no filter rings by 47 %: {}", below.undershoot);
        assert!(!edge(&[0, 0, 0, 90, 40, 40, 40, 40]).is_alone(), "up and down again");
        assert!(
            !edge(&[0, 0, 0, 0, 200, 0, 0, 200, 200, 200, 200, 200]).is_alone(),
            "a bar before it, no lighter than what is behind"
        );
        let down: Vec<u8> = grays.iter().rev().copied().collect();
        is(edge(&down).overshoot, 0.1, "backwards, above");
        is(edge(&down).undershoot, 0.2, "backwards, below");
        // Rises from 80, which is below a tenth of the way, through 150 to 210.
        is(found.rise[0], 4.0 + 30.0 / 70.0, "110");
        is(found.rise[1], 5.0 + 40.0 / 60.0, "190");
    }

    #[test]
    fn stairs_are_more_than_one_edge() {
        let stairs =
            |steps: &[(u8, usize)]| -> Vec<u8> { steps.iter().flat_map(|(gray, count)| vec![*gray; *count]).collect() };
        // Two sharp edges, and with grain on what is between them.
        for steps in [
            &[(29, 9), (100, 25), (255, 11)][..],
            &[(255, 9), (100, 25), (29, 11)],
            &[(0, 8), (30, 1), (100, 6), (101, 6), (99, 6), (170, 1), (200, 8)],
            &[(0, 8), (120, 3), (200, 8)],
            &[(10, 8), (15, 8), (20, 8)],
        ] {
            assert!(!edge(&stairs(steps)).is_alone(), "{steps:?}");
        }
        // One edge that the samples of a pixel make: no pixels on the way are plateaus.
        for steps in [
            &[(0, 8), (200, 8)][..],
            &[(0, 8), (100, 1), (200, 8)],
            &[(0, 8), (100, 2), (200, 8)],
            &[(0, 8), (20, 1), (60, 1), (100, 1), (140, 1), (180, 1), (200, 8)],
        ] {
            assert!(edge(&stairs(steps)).is_alone(), "{steps:?}");
        }
    }

    #[test]
    fn wide_ramps_of_few_levels_are_one_edge() {
        for (levels, pixels_of_each) in [(3_u8, 40), (4, 20), (8, 50), (20, 3), (60, 7), (200, 2)] {
            let ramp = (0..=levels).flat_map(|level| vec![level; pixels_of_each]);
            let plateau = vec![0; 60];
            let grays: Vec<u8> = plateau.into_iter().chain(ramp).chain(vec![levels; 60]).collect();
            assert!(
                edge(&grays).is_alone(),
                "{levels} levels, {pixels_of_each} pixels of each"
            );
        }
        // A soft edge: flat at its ends, steepest in its middle.
        let soft = (0..=120_u32).map(|x| 200 * x * x * (360 - 2 * x) / 120_u32.pow(3));
        let grays: Vec<u8> = soft.map(|value| u8::try_from(value).expect("200 at most")).collect();
        assert!(edge(&grays).is_alone(), "a soft edge");
    }

    #[test]
    fn plateaus_are_medians() {
        let grays = [10, 255, 10, 10, 10, 10, 200, 200, 200, 0, 200, 200];
        let found = edge(&grays);
        is(found.plateaus[0], 10.0, "one of three is an outlier");
        is(found.plateaus[1], 200.0, "here, too");
        is(median(&[1.0, 9.0, 3.0, 5.0]), 4.0, "between the two in the middle");
    }

    #[test]
    fn of_several_rises_the_first_counts() {
        let grays = [0, 0, 0, 200, 200, 0, 0, 200, 200, 200, 200, 200];
        let found = edge(&grays);
        is(found.rise[0], 2.1, "the first bar");
        is(found.width(), 0.8, "and not up to the second");
        let hesitant = [0, 0, 0, 100, 0, 0, 100, 200, 200, 200, 200, 200];
        is(edge(&hesitant).rise[0], 5.2, "from where it does not come back");
    }

    #[test]
    fn flat_lines_and_single_pixels_have_no_edge() {
        for grays in [&[7_u8; 9][..], &[7], &[], &[0, 9, 0]] {
            let profile = row(grays);
            assert_eq!(profile.edge(ProfileChannel::Luma), None, "{grays:?}");
            assert!(profile.shades() <= grays.len(), "{grays:?}");
        }
        assert_eq!(row(&[7; 9]).shades(), 1, "one shade");
        let outside = Line {
            ends: [[-9, 0], [-2, 0]],
        };
        let profile = Profile::of(&Framebuffer::new(4, 4), outside);
        assert_eq!(
            (profile.shades(), profile.edge(ProfileChannel::Red)),
            (0, None),
            "outside"
        );
    }

    #[test]
    fn channels_are_read_on_white_paper() {
        let pixel = u32::from_be_bytes([255, 10, 20, 30]);
        is(ProfileChannel::Red.value(pixel), 10.0, "red");
        is(ProfileChannel::Green.value(pixel), 20.0, "green");
        is(ProfileChannel::Blue.value(pixel), 30.0, "blue");
        is(ProfileChannel::Luma.value(pixel), 18.15, "2.99 + 11.74 + 3.42");
        is(ProfileChannel::Red.value(0), 255.0, "what is transparent is the paper");
    }

    #[test]
    fn any_line_has_numbers_that_make_sense() {
        arbtest::arbtest(|u| {
            let mut grays: Vec<u8> = Vec::new();
            for _ in 0..u.int_in_range(0..=40)? {
                grays.push(u.arbitrary()?);
            }
            let profile = row(&grays);
            if let Some(edge) = profile.edge(ProfileChannel::Luma) {
                let length = (grays.len() - 1) as f64;
                assert!(edge.rise[0] >= 0.0 && edge.rise[1] <= length, "{edge:?} of {grays:?}");
                assert!(edge.width() > 0.0, "{edge:?} of {grays:?}");
                assert!(edge.overshoot >= 0.0 && edge.undershoot >= 0.0, "{edge:?} of {grays:?}");
                let lightest = edge.plateaus[0].max(edge.plateaus[1]);
                let step = (edge.plateaus[1] - edge.plateaus[0]).abs();
                let most = f64::from(grays.iter().copied().max().unwrap_or_default());
                is(edge.overshoot, (most - lightest) / step, "above");
            } else if grays.len() > 1 {
                let quarter = (grays.len() / 4).max(1);
                let values = profile.values(ProfileChannel::Luma);
                let ends = [&values[..quarter], &values[values.len() - quarter..]].map(median);
                assert!((ends[0] - ends[1]).abs() < LEAST_STEP, "{grays:?} has an edge");
            }
            Ok(())
        });
    }
}
