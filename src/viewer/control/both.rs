//! A and B as they are at this moment: their frames, which of them belong together, what the window shows of them.

use std::sync::Arc;

use crate::compare::Gain;
use crate::figure::{Anchor, Tag};
use crate::plain;
use crate::raster::Framebuffer;
use crate::render::{ClampedPixels, Legend, RenderSettings, Visualisation};
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::measuring::{Measures, SharedPicture, Which};
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::chrome::Chrome;
use crate::viewer::frames::composite::{Composite, Content};
use crate::viewer::frames::drawing::Drawing;
use crate::viewer::frames::frame::Picture;
use crate::viewer::frames::refining::Refining;
use crate::viewer::frames::state::Frames;
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::Settings;
use crate::viewer::settings::picture::title_words;
use crate::viewer::view::camera::{ViewContext, ViewNumbers};
use crate::viewer::view::layout::WindowLayout;

/// Longest title of the window, in characters.
const MAX_TITLE: usize = 300;

/// A and B at this moment, and where they lie in the window.
#[derive(Clone, Copy, Debug)]
pub struct Both<'a> {
    pub(in crate::viewer) settings: &'a Settings,
    pub(in crate::viewer) scene_list: &'a SceneList,
    pub(in crate::viewer) frames: &'a Frames,
    pub(in crate::viewer) ab: &'a Comparison,
    pub(in crate::viewer) layout: WindowLayout,
}

impl<'a> Both<'a> {
    pub(in crate::viewer) fn new(
        settings: &'a Settings,
        chrome: &Chrome,
        scene_list: &'a SceneList,
        frames: &'a Frames,
        ab: &'a Comparison,
    ) -> Self {
        Self {
            settings,
            scene_list,
            frames,
            ab,
            layout: ab.layout(settings.pixel_zoom, chrome),
        }
    }

    /// Where frames lie in the window.
    pub fn layout(&self) -> WindowLayout {
        self.layout
    }

    /// The numbers of the current view; `None` before the scene was read.
    pub fn view_numbers(&self) -> Option<ViewNumbers> {
        self.scene_list.view_numbers(self.layout.frame_size())
    }

    /// The window's title: scene, settings or what of them differs between A and B, program.
    pub fn title(&self) -> String {
        let name = self.scene_list.current();
        let name = name.map_or("no scene", |entry| entry.label.as_str());
        let scene = self.scene_list.scene();
        let words = self.ab.title(self.settings, scene);
        let words = words.unwrap_or_else(|| title_words(self.settings, scene).join(", "));
        plain::short_line(&format!("{name} - {words} - Rasterscope"), MAX_TITLE)
    }

    /// How far A and B are apart, and whether that is about the pictures of this moment; `None` until it was found out.
    pub fn measures(&self) -> Option<(&'a Measures, bool)> {
        let (which, measures) = self.ab.measuring.found.as_ref()?;
        Some((measures, self.measurable() == Some(*which)))
    }

    /// Where the line of the wipe is, in window pixels from the left; `None` where there is none.
    pub fn wipe_line(&self) -> Option<f64> {
        Some(self.wipe_column()? as f64 * f64::from(self.layout.zoom()))
    }

    /// The same in screen pixels.
    pub(in crate::viewer) fn wipe_column(&self) -> Option<i64> {
        let wipes = self.ab.arrangement() == Arrangement::Wipe;
        let [front, _] = self.pair().filter(|_| wipes)?;
        let column = i64::from(self.ab.wipe_column(front.width(), &self.layout));
        Some(column + self.layout.panes().first.corner[0])
    }

    /// Which picture is whose: the tags of A and B along the upper edge of what shows them, from `within[0]` to `within[1]`.
    /// `line` parts a wipe. All lengths are in the unit of [`Tag`].
    pub fn tags(&self, within: [f32; 2], line: Option<f32>) -> Vec<Tag> {
        /// A tag that stands alone may be as wide as this.
        const LEAST_HALF: f32 = 40.0;
        let Some([a, b]) = self.ab.sides(self.settings) else {
            return Vec::new();
        };
        let [left, right] = within;
        let swapped = self.ab.is_swapped();
        let [front, back] = if swapped { [b, a] } else { [a, b] };
        let half = ((right - left) / 2.0 - 2.0 * Tag::MARGIN).max(LEAST_HALF);
        let tag = |text: String, x: f32| Tag {
            text,
            x: x + Tag::MARGIN,
            anchor: Anchor::Left,
            room: half,
        };
        match self.ab.arrangement() {
            Arrangement::Alone if !swapped => Vec::new(),
            Arrangement::Alone => vec![tag(front, left)],
            Arrangement::Wipe => {
                let Some(line) = line else { return Vec::new() };
                // Each on its own side: where there is little room its words give way, never the side.
                let beside = |room: f32| (room - 2.0 * Tag::MARGIN - 2.0 * Tag::PADDING[0]).min(half);
                let front = Tag {
                    text: front,
                    x: line - Tag::MARGIN,
                    anchor: Anchor::Right,
                    room: beside(line - left),
                };
                let back = Tag {
                    room: beside(right - line),
                    ..tag(back, line)
                };
                vec![front, back]
            }
            Arrangement::SideBySide => vec![tag(front, left), tag(back, left.midpoint(right))],
            Arrangement::Difference => {
                let order = if swapped { "A \u{2212} B" } else { "B \u{2212} A" };
                vec![tag(format!("{order}, {}", self.difference_words()), left)]
            }
            Arrangement::Flip => {
                let seen = if self.ab.shows_b() == swapped { front } else { back };
                vec![tag(seen, left)]
            }
        }
    }

    /// Which difference is shown, and what the ends of its colours stand for: without that nobody knows a faint one from one
    /// that was made brighter.
    fn difference_words(&self) -> String {
        let style = self.ab.difference_style();
        let gain = self.ab.difference_gain();
        let marks = gain.map(|gain| style.measure.marks(gain, style.gain == Gain::Normalize));
        let ends = marks.as_deref().and_then(|marks| marks.first().zip(marks.last()));
        let ends = ends.map(|(first, last)| {
            // The last one says it for both.
            let first = first.split(' ').next().unwrap_or_default();
            format!(": {first} \u{2026} {last}")
        });
        let refining = if self.refining().is_any() { ", refining" } else { "" };
        format!("{}{}{refining}", style.measure.name(), ends.unwrap_or_default())
    }

    /// What the current camera looks at; `None` before the scene was read.
    pub(in crate::viewer) fn view_context(&self) -> Option<ViewContext> {
        self.scene_list.view_context(self.layout.frame_size())
    }

    /// What B shows where A shows `own`; `None` unless B is drawn, and while its scene is being read.
    pub(in crate::viewer) fn other_picture(&self, own: &Picture) -> Option<Picture> {
        let settings = self.ab.other_settings(self.settings)?;
        let scene = match self.ab.own_dialect_of_b(self.settings) {
            None => Arc::clone(&own.scene),
            Some(_) => Arc::clone(self.scene_list.current()?.other_state.scene()?),
        };
        let outline = settings.outline && own.settings.outline;
        Some(Picture {
            settings: RenderSettings { outline, ..settings },
            scene,
            ..own.clone()
        })
    }

    /// Both pictures on the screen, the one in front first; `None` while they cannot be compared.
    pub(in crate::viewer) fn pair(&self) -> Option<[&'a Framebuffer; 2]> {
        let [a, b] = match &self.ab.held {
            Some([a, b]) => [&a.pixels, &b.pixels],
            None => self.pair_in_step()?,
        };
        Some(if self.ab.swapped { [b, a] } else { [a, b] })
    }

    /// A's pixels and B's, where they show the scene from the same place.
    pub(in crate::viewer) fn pair_in_step(&self) -> Option<[&'a Framebuffer; 2]> {
        let a = self.frames.drawing.frame()?;
        if let Some(Other::Picture(picture)) = &self.ab.other {
            let size = [picture.pixels.width(), picture.pixels.height()];
            return (a.picture.size == size).then_some([&a.pixels, &picture.pixels]);
        }
        // Without a window B's drawing is kept as it is, even where nothing is compared any more.
        let b = self.ab.drawn_other()?.frame()?;
        let in_step = match self.ab.own_dialect_of_b(self.settings) {
            None => a.picture.is_seen_as(&b.picture),
            Some(_) => a.picture.shows_document_of(&b.picture),
        };
        in_step.then_some([&a.pixels, &b.pixels])
    }

    /// How far the frames of [`Both::pair`] are from final.
    pub(in crate::viewer) fn refining(&self) -> Refining<'a> {
        let frames = match &self.ab.held {
            Some([a, b]) => [Some(&**a), Some(&**b)],
            None => [
                self.frames.drawing.frame(),
                self.ab.drawn_other().and_then(Drawing::frame),
            ],
        };
        Refining(frames.map(|frame| frame?.preview.as_ref()))
    }

    /// The same for threads.
    pub(in crate::viewer) fn shared_pair(&self) -> Option<[SharedPicture; 2]> {
        self.pair_in_step()?;
        let a = Arc::clone(self.frames.drawing.shared_frame()?) as SharedPicture;
        let b = match self.ab.other.as_ref()? {
            Other::Picture(picture) => Arc::clone(picture) as SharedPicture,
            _ => Arc::clone(self.ab.drawn_other()?.shared_frame()?) as SharedPicture,
        };
        Some([a, b])
    }

    /// Whether `picture` must wait until both frames have come to the last view.
    pub(in crate::viewer) fn lags_behind(&self, picture: &Picture) -> bool {
        let Some(other) = self.ab.drawn_other().filter(|_| self.ab.shows_both()) else {
            return false;
        };
        let wanted = self.frames.drawing.wanted();
        let moves = wanted.is_some_and(|wanted| !wanted.is_seen_as(picture));
        let same_scene =
            wanted.is_some_and(|wanted| Arc::ptr_eq(&wanted.scene, &picture.scene) && wanted.size == picture.size);
        moves && same_scene && !(self.frames.drawing.has_arrived() && other.has_arrived())
    }

    /// Whether nothing is to be found out about A and B any more.
    pub(in crate::viewer) fn is_measured(&self) -> bool {
        let which = self.measurable();
        which.is_none() || which == self.ab.measuring.complete
    }

    /// Both pictures, if they are final and belong together.
    pub(in crate::viewer) fn measurable(&self) -> Option<Which> {
        let settled = self.frames.drawing.is_current() && self.ab.is_current();
        self.pair_in_step().filter(|_| settled)?;
        let number = |drawing: &Drawing| (drawing.id(), drawing.number());
        Some(Which {
            a: number(&self.frames.drawing),
            b: self.ab.drawn_other().map(number),
            other: self.ab.others,
        })
    }

    /// What the window shows below the panels.
    pub(in crate::viewer) fn composite(&self) -> Composite<'a> {
        let Some(frame) = self.frames.frame() else {
            return Composite::default();
        };
        let panes = self.layout.panes();
        let comparison = &self.ab;
        let Some([front, back]) = self.pair().filter(|_| comparison.shows_both()) else {
            return Composite::new(vec![(panes.first, Content::One(&frame.pixels))]);
        };
        let content = match comparison.arrangement {
            Arrangement::Alone | Arrangement::SideBySide => Content::One(front),
            Arrangement::Flip => Content::One(if self.ab.flip_shows_back() { back } else { front }),
            Arrangement::Wipe => Content::Wipe([front, back], comparison.wipe_column(front.width(), &self.layout)),
            Arrangement::Difference => match &comparison.paint {
                Some(paint) => Content::Difference([front, back], &paint.colors, self.refining()),
                None => Content::One(front),
            },
        };
        let second = panes.second.map(|pane| (pane, Content::One(back)));
        Composite::new(std::iter::once((panes.first, content)).chain(second).collect())
    }

    /// What the picture on the screen shows: A, then B where that is seen and shows something else.
    pub(in crate::viewer) fn visualisations(&self) -> Vec<Visualisation> {
        let Some(frame) = self.frames.frame() else {
            return Vec::new();
        };
        let mut shown = vec![frame.picture.settings.visualisation];
        if self.ab.arrangement() == Arrangement::Difference {
            // The difference has colours of its own.
            return Vec::new();
        }
        if self.ab.shows_both() {
            shown.extend(
                self.ab
                    .other_settings(self.settings)
                    .map(|settings| settings.visualisation),
            );
            shown.dedup();
        }
        shown.retain(|shown| *shown != Visualisation::Color);
        shown
    }

    /// How many pixels of A's frame were clamped, where that is what is shown, and nothing else.
    pub(in crate::viewer) fn clamped_pixels(&self) -> Option<ClampedPixels> {
        let frame = self.frames.frame().filter(|_| !self.ab.shows_both())?;
        frame.picture.settings.visualisation.clamped(frame.pixels.pixels())
    }

    /// The legends that a saved picture carries.
    pub(in crate::viewer) fn legends_of_picture(&self) -> Vec<Legend> {
        let Some(frame) = self.frames.frame() else {
            return Vec::new();
        };
        let legends = self.visualisations().into_iter();
        let clamped = self.clamped_pixels();
        let legends = legends.filter_map(|shown| shown.legend_of(&frame.picture.scene, clamped));
        legends.chain(self.difference_legend()).collect()
    }

    /// What the colours of a difference mean, while one is shown.
    pub(in crate::viewer) fn difference_legend(&self) -> Option<Legend> {
        let paint = self.ab.paint.as_ref()?;
        let is_shown = self.ab.arrangement() == Arrangement::Difference;
        is_shown.then(|| paint.colors.legend(paint.style.gain == Gain::Normalize))
    }

    /// Whether A's frame is what the window shows, pixel by pixel.
    pub(in crate::viewer) fn shows_plain_frame(&self) -> bool {
        self.layout.is_plain() && !self.ab.shows_both() && self.settings.render.background.a >= 1.0
    }
}
