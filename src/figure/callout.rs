//! Insets as figures carry them: a region of a picture magnified in a corner, with its scale, a frame around the region and
//! leader lines between both.
//!
//! All insets of a picture are laid out before one is drawn: none hides a region that is magnified, nor another inset. One
//! that may go anywhere goes where the picture is empty.

use std::fmt;
use std::str::FromStr;

use glam::DVec2;

use super::leaders::leaders;
use super::lines::{Stroke, draw_frame, draw_line};
use super::paint::{copy, fill, inner, outer};
use super::placement::{Corner, along_sides, in_corner};
use super::vacancy::Vacancy;
use super::{Anchor, Inset, PixelRect, TextBlock, TextStyle, add_legends};
use crate::geometry::ViewTransform;
use crate::raster::Framebuffer;
use crate::render::{Legend, Subject};

/// Ground and letters of the scale.
const PLATE_COLOR: u32 = 0xfff4_f4f2;
const INK: u32 = 0xff20_2428;
/// Lines of a scale's text that the picture's shorter side has room for.
const LINES_PER_SIDE: f32 = 24.0;
/// Smallest and largest text of a scale, in pixels.
const TEXT_SIZE: std::ops::RangeInclusive<f32> = 12.0..=48.0;
/// The picture's shorter side over the width of leader lines.
const SIDE_PER_STROKE: f32 = 700.0;

/// An inset as a person asks for it: `X,Y[:REGION@FACTOR[:CORNER]]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InsetSpec {
    /// The pixel in its middle.
    pub at: InsetPlace,
    /// Source pixels along each side, in [`Inset::REGION`].
    pub region: u32,
    /// Pixels along each side of a magnified pixel, in [`Inset::MAGNIFICATION`].
    pub magnification: u32,
    /// Where it goes; `None` is wherever it hides nothing.
    pub corner: Option<Corner>,
}

/// The pixel in the middle of an inset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InsetPlace {
    /// Column and row from 0.
    Pixel([u32; 2]),
    /// The pixel that this point of the scene falls in: it stays there whatever the picture's size.
    User(DVec2),
}

/// Why a picture cannot have an inset.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InsetError {
    /// Its middle lies elsewhere.
    #[error("--inset {spec}: pixel {x}, {y} is outside the picture of {width}x{height} pixels; give a place inside")]
    Outside {
        /// The inset.
        spec: InsetSpec,
        /// Its middle's column.
        x: i64,
        /// Its middle's row.
        y: i64,
        /// The picture's width.
        width: u32,
        /// The picture's height.
        height: u32,
    },
    /// It is too large for the picture, or would hide what is magnified.
    #[error(
        "--inset {spec}: no room: its {width}x{height} pixels would hide {hides} or do not fit; give {}a smaller region{} or a \
         larger picture",
        factor_that_fits(*fits),
        if spec.corner.is_some() { ", another corner" } else { "" }
    )]
    NoRoom {
        /// The inset.
        spec: InsetSpec,
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// What is in the way.
        hides: &'static str,
        /// The largest smaller magnification at which there is room, if there is.
        fits: Option<u32>,
    },
}

/// The first cure of an inset without room.
fn factor_that_fits(fits: Option<u32>) -> String {
    fits.map(|factor| format!("the factor {factor}, which fits, "))
        .unwrap_or_default()
}

impl InsetSpec {
    /// Region, factor and corner where none are given.
    const DEFAULT: Self = Self {
        at: InsetPlace::Pixel([0, 0]),
        region: 16,
        magnification: 8,
        corner: None,
    };

    /// An inset around `at` in whichever corner is free.
    pub const fn around(at: InsetPlace, region: u32, magnification: u32) -> Self {
        Self {
            at,
            region,
            magnification,
            corner: None,
        }
    }

    /// The largest inset up to this one that fits a picture of `size` without hiding itself: first the pixels get smaller, then
    /// there are fewer. `None` where not even the smallest fits.
    pub fn fitted(self, size: [u32; 2], view: &ViewTransform) -> Option<Self> {
        let smaller_pixels = (*Inset::MAGNIFICATION.start()..=self.magnification).rev();
        let smaller = smaller_pixels.map(|magnification| Self { magnification, ..self });
        let fewer = (*Inset::REGION.start()..self.region).rev().map(|region| Self {
            region,
            magnification: *Inset::MAGNIFICATION.start(),
            ..self
        });
        smaller
            .chain(fewer)
            .find(|spec| layout(&[*spec], size, view, None).is_ok())
    }

    /// The largest inset up to this one, and no less than half of it, that hides nothing painted in a picture of `size`; this
    /// one where there is none.
    #[must_use]
    pub fn beside(self, subject: &Subject<'_>, size: [u32; 2]) -> Self {
        let vacancy = Vacancy::of(subject, size);
        let least = self.magnification.div_ceil(2).max(*Inset::MAGNIFICATION.start());
        let smaller = (least..=self.magnification).rev();
        let mut smaller = smaller.map(|magnification| Self { magnification, ..self });
        let hides_nothing = |spec: &Self| {
            let placed = layout(&[*spec], size, subject.view, Some(&vacancy));
            placed.is_ok_and(|placed| placed.iter().all(|placed| vacancy.hidden(&placed.rect) == 0))
        };
        smaller.find(hides_nothing).unwrap_or(self)
    }
}

impl fmt::Display for InsetPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pixel([x, y]) => write!(f, "{x},{y}"),
            Self::User(at) => write!(f, "u{},{}", at.x, at.y),
        }
    }
}

impl InsetPlace {
    /// As a caption names it.
    pub fn words(&self) -> String {
        match self {
            Self::Pixel([x, y]) => format!("pixel ({x}, {y})"),
            Self::User(at) => format!("({}, {}) in canvas units", at.x, at.y),
        }
    }
}

impl fmt::Display for InsetSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let corner = self.corner.map_or("auto", Corner::name);
        write!(f, "{}:{}@{}:{corner}", self.at, self.region, self.magnification)
    }
}

impl FromStr for InsetSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let problem = || {
            let (region, factor) = (Inset::REGION, Inset::MAGNIFICATION);
            format!(
                "an inset is X,Y:REGION@FACTOR:CORNER, such as 300,200:16@8:auto: a pixel, or with u12.5,40 a point of the scene; \
                 {} to {} pixels a side, {} to {} times as large; a corner: auto, top-left, top-right, bottom-left, bottom-right",
                region.start(),
                region.end(),
                factor.start(),
                factor.end()
            )
        };
        let mut parts = text.split(':');
        let at = parts.next().and_then(place).ok_or_else(problem)?;
        let mut spec = Self { at, ..Self::DEFAULT };
        if let Some(size) = parts.next() {
            let (region, factor) = size.split_once('@').ok_or_else(problem)?;
            let number = |text: &str| text.trim().parse::<u32>().map_err(|_| problem());
            (spec.region, spec.magnification) = (number(region)?, number(factor)?);
        }
        if let Some(corner) = parts.next().filter(|corner| *corner != "auto") {
            let named = Corner::ALL.into_iter().find(|known| known.name() == corner);
            spec.corner = Some(named.ok_or_else(problem)?);
        }
        let in_range = Inset::REGION.contains(&spec.region) && Inset::MAGNIFICATION.contains(&spec.magnification);
        (in_range && parts.next().is_none()).then_some(spec).ok_or_else(problem)
    }
}

/// `X,Y` in pixels, or `uX,Y` in canvas units.
fn place(text: &str) -> Option<InsetPlace> {
    let text = text.trim();
    if let Some(user) = text.strip_prefix('u') {
        let (x, y) = user.split_once(',')?;
        let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        return Some(InsetPlace::User(DVec2::new(number(x)?, number(y)?)));
    }
    let (x, y) = text.split_once(',')?;
    Some(InsetPlace::Pixel([x.trim().parse().ok()?, y.trim().parse().ok()?]))
}

/// An inset, and where all of it goes: grid, and below it the plate with the scale.
struct Placed {
    inset: Inset,
    rect: PixelRect,
}

/// How large the words and strokes of a picture are.
pub(super) struct Scale {
    text: f32,
    stroke: f32,
}

impl Scale {
    pub(super) fn of([width, height]: [u32; 2]) -> Self {
        let side = width.min(height) as f32;
        Self {
            text: (side / LINES_PER_SIDE).max(*TEXT_SIZE.start()).min(*TEXT_SIZE.end()),
            stroke: (side / SIDE_PER_STROKE).max(1.0),
        }
    }

    fn label(&self, inset: &Inset) -> TextBlock {
        self.words(&format!("{}\u{d7}", inset.magnification))
    }

    fn words(&self, text: &str) -> TextBlock {
        TextBlock::new(text, TextStyle::new(self.text, INK), None)
    }

    /// Words on the plate of an inset that is so wide: smaller where they would be wider.
    pub(super) fn words_within(&self, text: &str, width: u32) -> TextBlock {
        let words = self.words(text);
        let part = (width as f32 / words.size()[0].max(1) as f32).min(1.0);
        TextBlock::new(text, TextStyle::new(self.text * part, INK), None)
    }

    /// The line around what is magnified, and from there to its inset.
    pub(super) fn stroke(&self) -> Stroke {
        Stroke {
            color: INK,
            halo: 0xd0ff_ffff,
            width: self.stroke,
        }
    }
}

/// Adds to a picture of `subject` what makes it a figure: insets, then legends in corners where they hide
/// neither an inset nor what it magnifies. Gives how many legends there was room for.
///
/// # Errors
/// When an inset lies outside or has no room; the picture is as it was then.
pub fn add_furniture(
    picture: &mut Framebuffer,
    insets: &[InsetSpec],
    subject: &Subject<'_>,
    legends: &[Legend],
) -> Result<usize, InsetError> {
    let chooses = insets.iter().any(|inset| inset.corner.is_none());
    let vacancy = chooses.then(|| Vacancy::of(subject, [picture.width(), picture.height()]));
    let spared = draw_insets(picture, insets, subject.view, vacancy.as_ref())?;
    Ok(add_legends(picture, legends, &spared))
}

/// Draws insets and gives what nothing else may hide.
fn draw_insets(
    picture: &mut Framebuffer,
    specs: &[InsetSpec],
    view: &ViewTransform,
    vacancy: Option<&Vacancy>,
) -> Result<Vec<PixelRect>, InsetError> {
    if specs.is_empty() {
        return Ok(Vec::new());
    }
    let size = [picture.width(), picture.height()];
    let all = layout(specs, size, view, vacancy).map_err(|error| with_factor(error, specs, size, view))?;
    let (source, scale) = (picture.clone(), Scale::of(size));
    let stroke = scale.stroke();
    for placed in &all {
        let region = outer(&placed.inset.source());
        for [from, to] in leaders(&region, &placed.rect) {
            draw_line(picture, from, to, stroke);
        }
    }
    for placed in &all {
        draw_frame(picture, &placed.inset.source(), stroke);
    }
    for placed in &all {
        draw_placed(picture, &source, placed, &scale);
    }
    Ok(all
        .iter()
        .flat_map(|placed| [placed.rect, placed.inset.source()])
        .collect())
}

/// The grid, and its scale on a plate below.
fn draw_placed(picture: &mut Framebuffer, source: &Framebuffer, placed: &Placed, scale: &Scale) {
    let grid = placed.inset.draw(source, &[]);
    draw_plate(picture, &grid, &placed.rect, &scale.label(&placed.inset));
}

/// A grid, and words on the rest of its place, which is below.
pub(super) fn draw_plate(picture: &mut Framebuffer, grid: &Framebuffer, place: &PixelRect, words: &TextBlock) {
    fill(picture, place, INK);
    fill(picture, &inner(place, 2), PLATE_COLOR);
    copy(grid, picture, [place.x, place.y]);
    let top = place.y + i64::from(grid.height());
    words.draw(
        picture,
        [place.x + i64::from(grid.width() / 2), top - 1],
        Anchor::Center,
    );
}

/// Where every inset goes: those with a corner of their own first.
fn layout(
    specs: &[InsetSpec],
    size: [u32; 2],
    view: &ViewTransform,
    vacancy: Option<&Vacancy>,
) -> Result<Vec<Placed>, InsetError> {
    let (area, scale) = (PixelRect::of_size(size), Scale::of(size));
    let insets: Vec<Inset> = specs
        .iter()
        .map(|spec| inset_of(*spec, size, view))
        .collect::<Result<_, _>>()?;
    // With their frames, which are not to be hidden either.
    let sources: Vec<PixelRect> = insets.iter().map(|inset| outer(&outer(&inset.source()))).collect();
    let mut places: Vec<Option<PixelRect>> = vec![None; specs.len()];
    let mut order: Vec<usize> = (0..specs.len()).collect();
    order.sort_by_key(|index| specs[*index].corner.is_none());
    for index in order {
        let (spec, inset) = (specs[index], insets[index]);
        let [grid_width, grid_height] = inset.size();
        let [label_width, label_height] = scale.label(&inset).size();
        let whole = [grid_width.max(label_width + 8), grid_height + label_height];
        let mut hides = "its own subject";
        let mut is_free = |rect: &PixelRect| {
            let covers_subject = sources.iter().any(|source| source.overlaps(rect));
            let covers_inset = places.iter().flatten().any(|other| other.overlaps(rect));
            if covers_inset && !covers_subject {
                hides = "another inset";
            }
            !covers_subject && !covers_inset
        };
        let mut free = candidates(spec, &inset, &area, whole);
        free.retain(|rect| is_free(rect));
        let hidden = |rect: &&PixelRect| vacancy.map_or(0, |vacancy| vacancy.hidden(rect));
        let free = free.iter().min_by_key(hidden).copied();
        let [width, height] = whole;
        places[index] = Some(free.ok_or(InsetError::NoRoom {
            spec,
            width,
            height,
            hides,
            fits: None,
        })?);
    }
    let both = insets.into_iter().zip(places);
    Ok(both
        .filter_map(|(inset, rect)| Some(Placed { inset, rect: rect? }))
        .collect())
}

/// The same error with the factor at which its inset has room among `specs`.
fn with_factor(mut error: InsetError, specs: &[InsetSpec], size: [u32; 2], view: &ViewTransform) -> InsetError {
    if let InsetError::NoRoom { spec: large, fits, .. } = &mut error {
        let has_room = |magnification: &u32| {
            let smaller = InsetSpec {
                magnification: *magnification,
                ..*large
            };
            let specs: Vec<InsetSpec> = specs
                .iter()
                .map(|spec| if spec == large { smaller } else { *spec })
                .collect();
            // Another one without room is the next one's error.
            match layout(&specs, size, view, None) {
                Ok(_) => true,
                Err(InsetError::NoRoom { spec, .. } | InsetError::Outside { spec, .. }) => spec != smaller,
            }
        };
        let smaller = *Inset::MAGNIFICATION.start()..large.magnification;
        *fits = smaller.rev().find(has_room);
    }
    error
}

/// Where an inset of `size` may go, the best places first: corners, where eyes look for it, then all along the sides. Short
/// leader lines cross little of the picture.
fn candidates(spec: InsetSpec, inset: &Inset, area: &PixelRect, size: [u32; 2]) -> Vec<PixelRect> {
    let nearest_first = |mut rects: Vec<PixelRect>| {
        rects.sort_by_key(|rect| distance(rect, inset.center));
        rects
    };
    let corner = |corner| in_corner(area, size, corner);
    if let Some(own) = spec.corner {
        return corner(own).into_iter().collect();
    }
    let mut rects = nearest_first(Corner::ALL.into_iter().filter_map(corner).collect());
    rects.extend(nearest_first(along_sides(area, size).collect()));
    rects
}

/// The square of the distance from a rectangle's middle to a pixel, for comparisons.
fn distance(rect: &PixelRect, [x, y]: [i64; 2]) -> i64 {
    let by = |from: i64, to: i64, at: i64| (i64::midpoint(from, to) - at).pow(2);
    by(rect.x, rect.right(), x) + by(rect.y, rect.bottom(), y)
}

/// The inset of a place in a picture.
fn inset_of(spec: InsetSpec, [width, height]: [u32; 2], view: &ViewTransform) -> Result<Inset, InsetError> {
    let [x, y] = match spec.at {
        InsetPlace::Pixel(pixel) => pixel.map(i64::from),
        #[expect(clippy::cast_possible_truncation, reason = "`as` saturates, which is outside too")]
        InsetPlace::User(at) => view.to_pixels(at).floor().to_array().map(|side| side as i64),
    };
    if !PixelRect::of_size([width, height]).contains([x, y]) {
        return Err(InsetError::Outside {
            spec,
            x,
            y,
            width,
            height,
        });
    }
    Ok(Inset::new([x, y], spec.region, spec.magnification).without_detail())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::View;

    fn view() -> ViewTransform {
        View::Canvas.transform(DVec2::new(100.0, 50.0), [400, 200])
    }

    /// A picture whose every pixel has a colour of its own.
    fn colorful(width: u32, height: u32) -> Framebuffer {
        let mut picture = Framebuffer::new(width, height);
        for (i, pixel) in (1_u32..).zip(picture.pixels_mut()) {
            *pixel = 0xff00_0000 | i.wrapping_mul(2_654_435_761) >> 8;
        }
        picture
    }

    #[test]
    fn inset_specs_are_read_as_they_are_written() {
        for (text, written) in [
            ("300,200:16@8:auto", "300,200:16@8:auto"),
            ("3,4", "3,4:16@8:auto"),
            ("u12.5,-40:9@12:bottom-left", "u12.5,-40:9@12:bottom-left"),
            (" 3 , 4 :8@2", "3,4:8@2:auto"),
        ] {
            let spec: InsetSpec = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(spec.to_string(), written, "{text}");
            assert_eq!(written.parse(), Ok(spec), "and back");
        }
        for text in [
            "",
            "3",
            "3,4,5",
            "-3,4",
            "3,4:16",
            "3,4:16@",
            "3,4:7@8",
            "3,4:65@8",
            "3,4:16@97",
            "3,4:16@8:middle",
            "3,4:16@8:auto:x",
            "unan,3",
            "u1e999,3",
            "1.5,2",
        ] {
            assert!(text.parse::<InsetSpec>().is_err(), "{text:?} is none");
        }
    }

    #[test]
    fn inset_specs_in_user_units_follow_the_size() {
        let spec: InsetSpec = "u50,25".parse().expect("a place");
        let center = |size: [u32; 2]| {
            let view = View::Canvas.transform(DVec2::new(100.0, 50.0), size);
            inset_of(spec, size, &view).expect("inside").center
        };
        assert_eq!(center([400, 200]), [200, 100], "four pixels a unit");
        assert_eq!(center([200, 100]), [100, 50], "two pixels a unit");
        let outside: InsetSpec = "u101,25".parse().expect("a place");
        let error = inset_of(outside, [400, 200], &view())
            .expect_err("beyond the canvas")
            .to_string();
        assert!(
            error.contains("pixel 404, 100 is outside") && error.contains("400x200"),
            "{error}"
        );
    }

    #[test]
    fn insets_hide_no_subject_and_no_other_inset() {
        arbtest::arbtest(|u| {
            let size = [u.int_in_range(1..=500)?, u.int_in_range(1..=500)?];
            let mut specs = Vec::new();
            for _ in 0..u.int_in_range(1..=4)? {
                let at = InsetPlace::Pixel([u.int_in_range(0..=size[0] - 1)?, u.int_in_range(0..=size[1] - 1)?]);
                let corner = if u.arbitrary()? {
                    Some(*u.choose(&Corner::ALL)?)
                } else {
                    None
                };
                specs.push(InsetSpec {
                    corner,
                    ..InsetSpec::around(at, u.int_in_range(8..=20)?, u.int_in_range(2..=8)?)
                });
            }
            if let Ok(placed) = layout(&specs, size, &view(), None) {
                let area = PixelRect::of_size(size);
                for (i, one) in placed.iter().enumerate() {
                    assert_eq!(one.rect.intersection(&area), one.rect, "inside");
                    assert!(
                        placed.iter().all(|other| !other.inset.source().overlaps(&one.rect)),
                        "{specs:?}"
                    );
                    assert!(
                        placed[..i].iter().all(|other| !other.rect.overlaps(&one.rect)),
                        "{specs:?}"
                    );
                }
            }
            let mut picture = Framebuffer::new(size[0], size[1]);
            let _ = draw_insets(&mut picture, &specs, &view(), None);
            Ok(())
        })
        .budget_ms(400);
    }

    #[test]
    fn inset_magnifies_what_was_there_before_lines_were_drawn() {
        let mut picture = colorful(400, 300);
        let before = picture.clone();
        let specs = ["100,150:9@6:top-right", "110,150:9@6"].map(|text| text.parse().expect("a spec"));
        draw_insets(&mut picture, &specs, &view(), None).expect("there is room");
        for placed in layout(&specs, [400, 300], &view(), None).expect("there is room") {
            let block = placed.inset.block(placed.inset.center).expect("the middle");
            let at = [placed.rect.x + block.x + 2, placed.rect.y + block.y + 2]
                .map(|side| u32::try_from(side).expect("inside"));
            let [x, y] = placed.inset.center.map(|side| u32::try_from(side).expect("inside"));
            assert_eq!(picture.rgba(at[0], at[1]), before.rgba(x, y), "{:?}", placed.rect);
        }
        assert_eq!(
            picture.rgba(100, 150),
            before.rgba(100, 150),
            "its subject stays in sight"
        );
        let crowded = ["100,150:9@6:top-right", "110,150:9@6:top-right"].map(|text| text.parse().expect("a spec"));
        let error = draw_insets(&mut picture, &crowded, &view(), None)
            .expect_err("one corner")
            .to_string();
        assert!(error.contains("another inset"), "{error}");
    }

    #[test]
    fn insets_without_room_say_what_fits() {
        let size = [200, 160];
        for (text, cures) in [
            ("100,80:16@8", "a smaller region or a larger picture"),
            (
                "100,80:16@8:top-left",
                "a smaller region, another corner or a larger picture",
            ),
            ("100,80:64@8", "a smaller region or a larger picture"),
        ] {
            let spec: InsetSpec = text.parse().expect("a spec");
            let mut picture = Framebuffer::new(size[0], size[1]);
            let error = draw_insets(&mut picture, &[spec], &view(), None).expect_err("too large");
            let has_room = |magnification: &u32| {
                let smaller = InsetSpec {
                    magnification: *magnification,
                    ..spec
                };
                layout(&[smaller], size, &view(), None).is_ok()
            };
            let factor = (2..8).rev().find(has_room);
            assert_eq!(factor.is_some(), spec.region == 16, "{text}: a small region fits");
            let factor = factor.map(|factor| format!("the factor {factor}, which fits, "));
            let cures = format!("; give {}{cures}", factor.unwrap_or_default());
            assert!(error.to_string().ends_with(&cures), "{text}: {error}");
        }
    }

    #[test]
    fn insets_go_where_the_picture_is_empty() {
        use crate::render::RenderSettings;
        use crate::scene::{DialectChoice, NoResources, ReadOptions, read};
        // Only the lower part of the right margin is free.
        let text = "<svg width='300' height='200'><rect width='200' height='200' fill='#123456'/>\
                    <rect x='200' width='100' height='90' fill='#654321'/></svg>";
        let options = ReadOptions {
            dialect: DialectChoice::Svg,
        };
        let scene = read(text.as_bytes(), "a", options, &NoResources).expect("a good document");
        let size = [300, 200];
        let view = View::Canvas.transform(scene.canvas, size);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &RenderSettings::default(),
        };
        let spec = InsetSpec::around(InsetPlace::Pixel([20, 20]), 8, 14).beside(&subject, size);
        assert!((7..14).contains(&spec.magnification), "small enough: {spec}");
        let vacancy = Vacancy::of(&subject, size);
        let placed = layout(&[spec], size, &view, Some(&vacancy)).expect("there is room");
        let rect = placed[0].rect;
        assert!(rect.x >= 200 && rect.y >= 90, "hides nothing: {rect:?}");
        let near = layout(&[spec], size, &view, None).expect("there is room");
        assert!(near[0].rect.x < 200, "the nearest corner would have hidden much");
    }

    #[test]
    fn inset_specs_shrink_until_they_fit() {
        let spec = InsetSpec::around(InsetPlace::Pixel([32, 24]), 15, 20);
        assert_eq!(spec.fitted([64, 48], &view()), None, "no room at all");
        let fitted = spec.fitted([300, 300], &view()).expect("some room");
        assert!(fitted.magnification < 20 && fitted.region == 15, "{fitted}");
        assert_eq!(spec.fitted([1280, 800], &view()), Some(spec), "as it was");
    }
}
