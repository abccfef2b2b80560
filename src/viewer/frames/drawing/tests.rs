//! Drawing step by step, with times as the tests would have them: no test depends on how quick the machine is.

use std::sync::mpsc::{Receiver, channel};

use glam::DVec2;

use super::*;
use crate::color::Rgba;
use crate::geometry::View;
use crate::raster::SampleRate;
use crate::render::{RenderSettings, draw};
use crate::scene::{Dialect, Paint, Primitive, PrimitiveKind, Scene, Shape, ShapeId, SourceLocation};

pub(super) const SIZE: [u32; 2] = [150, 130];

pub(super) const SLOW_FRAME: Duration = Duration::from_millis(200);

/// Drawing, and the thread's messages.
pub(in crate::viewer::frames) struct Desk {
    pub(in crate::viewer::frames) drawing: Drawing,
    pub(super) messages: Receiver<Drawn>,
    scene: Arc<Scene>,
}

/// A few triangles that overlap.
fn scene() -> Arc<Scene> {
    let mut scene = Scene::empty(DVec2::splat(100.0), Dialect::Svg);
    scene.shapes = vec![Shape {
        element: "polygon".into(),
        id: None,
        location: SourceLocation { line: 1, column: 1 },
        used: None,
    }];
    let corners = [[5.0, 8.0], [92.0, 20.0], [40.0, 97.0], [80.0, 88.0], [11.0, 60.0]];
    scene.primitives = (0..corners.len())
        .map(|i| {
            let points = [0, 1, 2].map(|k| DVec2::from(corners[(i + k) % corners.len()]));
            let paint = Paint::Solid(Rgba {
                a: 0.7,
                ..Rgba::from_bytes([40 * u8::try_from(i).expect("few"), 90, 200, 255])
            });
            let kind = PrimitiveKind::Triangle { points, paint };
            Primitive {
                shape: ShapeId(0),
                kind,
            }
        })
        .collect();
    Arc::new(scene)
}

/// A triangle around all of the canvas, with another colour at each corner.
fn shaded() -> Arc<Scene> {
    let mut scene = (*scene()).clone();
    let points = [[-300.0, -300.0], [600.0, -300.0], [0.0, 900.0]].map(DVec2::from);
    let colors = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]].map(Rgba::from_bytes);
    scene.primitives = vec![Primitive {
        shape: ShapeId(0),
        kind: PrimitiveKind::Triangle {
            points,
            paint: Paint::Vertex(colors),
        },
    }];
    Arc::new(scene)
}

impl Desk {
    pub(in crate::viewer::frames) fn new() -> Self {
        let (sender, messages) = channel();
        let drawing = Drawing::start(Mailbox::new(sender, Arc::new(|| {})), DrawingId::First).expect("a thread");
        let scene = scene();
        Self {
            drawing,
            messages,
            scene,
        }
    }

    pub(in crate::viewer::frames) fn picture(&self, rate: u32, center: [f64; 2], scale: f64) -> Picture {
        let view = View::At {
            center: center.into(),
            scale,
            rotation: 0.0,
        };
        Picture {
            scene: Arc::clone(&self.scene),
            document: 0,
            view: view.transform(self.scene.canvas, SIZE),
            settings: RenderSettings {
                sample_rate: SampleRate::new(rate).expect("a square number"),
                ..RenderSettings::default()
            },
            size: SIZE,
        }
    }

    pub(in crate::viewer::frames) fn want(&mut self, picture: &Picture) {
        self.drawing.want(FrameRequest::new(picture.clone(), [20, 30], None));
    }

    /// Whole frames of `picture` are slow from now on, and previews of one sample per pixel are not.
    pub(super) fn is_slow(&mut self, picture: &Picture) {
        self.drawing.budget.note(picture, None, SLOW_FRAME);
        self.drawing
            .budget
            .note(picture, Some(PreviewQuality::RateOne), Duration::ZERO);
    }

    /// Moving by whole pixels takes no time, however busy the machine is.
    pub(super) fn moves_quickly(&mut self, picture: &Picture) {
        self.drawing
            .budget
            .note(picture, Some(PreviewQuality::Moved), Duration::ZERO);
    }

    /// Takes in messages until the thread has nothing more to do; the hand does not rest meanwhile, however long it takes.
    pub(in crate::viewer::frames) fn work(&mut self) {
        while self.drawing.running.is_some() {
            // Nobody draws on surfaces meanwhile.
            self.drawing.wait_no_longer();
            let message = self.messages.recv().expect("the thread answers");
            if let Some(wanted) = &mut self.drawing.wanted {
                wanted.since = Instant::now();
            }
            self.take_in(message);
        }
    }

    pub(super) fn take_in(&mut self, drawn: Drawn) {
        self.drawing.finished(drawn);
    }

    /// Wants the same picture of another scene, as if that had been twice [`SLOW_FRAME`] ago.
    pub(in crate::viewer::frames) fn want_another_scene(&mut self) {
        let picture = Picture {
            scene: scene(),
            ..self.picture(4, [50.0, 50.0], 1.0)
        };
        self.want(&picture);
        let wanted = self.drawing.wanted.as_mut().expect("a wish");
        wanted.since = wanted.since.checked_sub(SLOW_FRAME * 2).expect("a clock that runs");
    }

    /// Lets the hand rest, and takes in what comes of it.
    pub(super) fn rest(&mut self) {
        self.work();
        if let Some(wanted) = &mut self.drawing.wanted {
            wanted.since = wanted.since.checked_sub(2 * REST).expect("a clock that runs");
        }
        self.drawing.look();
        self.work();
    }

    pub(super) fn frame(&self) -> &Frame {
        self.drawing.frame().expect("a frame")
    }

    pub(super) fn quality(&self) -> Option<PreviewQuality> {
        self.frame().preview.as_ref().map(|preview| preview.quality)
    }

    /// Asserts that the final frame of `picture` is on the screen.
    pub(super) fn shows_final(&self, picture: &Picture, what: &str) {
        assert!(self.drawing.is_current(), "{what}: nothing is left to do");
        assert_eq!(self.quality(), None, "{what}: no preview");
        assert!(self.frame().pixels == drawn(picture), "{what}: other bytes than draw's");
        assert_eq!(self.drawing.due(), None, "{what}: nothing to wait for");
    }
}

pub(super) fn drawn(picture: &Picture) -> Framebuffer {
    let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
    draw(&picture.scene, &picture.view, &picture.settings, &mut frame);
    frame
}

#[test]
fn first_picture_comes_final() {
    let mut desk = Desk::new();
    let picture = desk.picture(16, [50.0, 50.0], 1.0);
    desk.want(&picture);
    desk.work();
    desk.shows_final(&picture, "without rest");
}

#[test]
fn scene_is_awaited_until_something_of_it_is_seen() {
    let mut desk = Desk::new();
    let first = desk.picture(4, [50.0, 50.0], 1.0);
    assert_eq!(desk.drawing.awaited_since(), None, "nothing is wanted");
    desk.want(&first);
    assert!(desk.drawing.awaited_since().is_some(), "there is no picture");
    desk.work();
    assert_eq!(desk.drawing.awaited_since(), None, "it is seen");
    let settings = RenderSettings {
        sample_rate: SampleRate::new(9).expect("a rate"),
        ..first.settings
    };
    desk.want(&Picture {
        settings,
        ..first.clone()
    });
    assert_eq!(desk.drawing.awaited_since(), None, "the same scene with other settings");
    desk.want_another_scene();
    assert!(desk.drawing.awaited_since().is_some(), "another scene");
    desk.work();
    assert_eq!(desk.drawing.awaited_since(), None, "it is seen, too");
}

#[test]
fn zooming_previews_and_resting_refines() {
    let mut desk = Desk::new();
    let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
    desk.want(&first);
    desk.work();
    desk.is_slow(&first);
    desk.want(&second);
    desk.work();
    assert_eq!(desk.quality(), Some(PreviewQuality::RateOne), "the finest step");
    let coarse = Picture {
        settings: RenderSettings {
            sample_rate: SampleRate::ONE,
            ..second.settings
        },
        ..second.clone()
    };
    assert!(desk.frame().pixels == drawn(&coarse), "the picture at rate 1");
    assert!(!desk.drawing.is_current(), "not what is wanted");
    assert!(desk.drawing.due().is_some(), "to be looked at again");
    assert!(
        desk.frame().final_rgba(20, 30).is_none(),
        "no number comes from a preview"
    );
    desk.rest();
    desk.shows_final(&second, "at rest");
}

#[test]
fn slow_steps_become_coarser() {
    let mut desk = Desk::new();
    let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
    desk.want(&first);
    desk.work();
    desk.is_slow(&first);
    desk.drawing
        .budget
        .note(&first, Some(PreviewQuality::RateOne), SLOW_FRAME);
    desk.want(&second);
    desk.work();
    assert_eq!(desk.quality(), Some(PreviewQuality::Coarse(2)), "squares of 2x2 pixels");
    let pixels = &desk.frame().pixels;
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            assert_eq!(pixels.rgba(x, y), pixels.rgba(x / 2 * 2, y / 2 * 2), "{x}, {y}");
        }
    }
    desk.rest();
    desk.shows_final(&second, "at rest");
}

#[test]
fn panning_moves_what_is_there() {
    let mut desk = Desk::new();
    let first = desk.picture(16, [50.0, 50.0], 1.0);
    desk.want(&first);
    desk.work();
    desk.is_slow(&first);
    let mut center = [50.0, 50.0];
    for by in [[7.0, 0.0], [0.0, -5.0], [-40.0, 31.0], [120.0, 100.0]] {
        desk.moves_quickly(&first);
        center = [center[0] - by[0], center[1] - by[1]];
        let moved = desk.picture(16, center, 1.0);
        desk.want(&moved);
        desk.work();
        assert_eq!(desk.quality(), Some(PreviewQuality::Moved), "by {by:?}");
        assert!(
            desk.frame().pixels == drawn(&moved),
            "whole pixels move the picture by {by:?}"
        );
    }
    let last = desk.picture(16, center, 1.0);
    desk.rest();
    desk.shows_final(&last, "at rest");
    let half = desk.picture(16, [center[0] - 0.5, center[1]], 1.0);
    desk.is_slow(&last);
    desk.want(&half);
    desk.work();
    assert_eq!(
        desk.quality(),
        Some(PreviewQuality::RateOne),
        "half a pixel is another picture"
    );
}

#[test]
fn panning_shades_only_what_comes_into_view() {
    let mut desk = Desk::new();
    desk.scene = shaded();
    let first = desk.picture(16, [50.0, 50.0], 2.0);
    desk.want(&first);
    desk.work();
    let all = desk.frame().stats.counters.samples_shaded;
    assert!(all >= 19_500, "a triangle over all of it: {all}");
    desk.is_slow(&first);
    for step in 1..10 {
        desk.moves_quickly(&first);
        let center = [50.0 - f64::from(step), 50.0 - 0.5 * f64::from(step)];
        desk.want(&desk.picture(16, center, 2.0));
        desk.work();
        assert_eq!(desk.quality(), Some(PreviewQuality::Moved), "step {step}");
        // Two columns and a row at most; blocks of samples may reach a little farther.
        let samples = desk.frame().stats.counters.samples_shaded;
        assert!(samples * 25 < all, "{samples} of {all} samples in step {step}");
    }
}

#[test]
fn settings_refine_without_rest() {
    let mut desk = Desk::new();
    let (one, sixteen) = (desk.picture(1, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.0));
    desk.want(&one);
    desk.work();
    desk.want(&sixteen);
    desk.work();
    desk.shows_final(&sixteen, "another rate");
}

#[test]
fn inspected_pixels_are_final_in_previews() {
    let mut desk = Desk::new();
    let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
    desk.want(&first);
    desk.work();
    desk.is_slow(&first);
    let focus = Region {
        x: 40,
        y: 50,
        width: 24,
        height: 24,
    };
    desk.drawing
        .want(FrameRequest::new(second.clone(), [50, 60], Some(focus)));
    desk.work();
    assert_eq!(desk.quality(), Some(PreviewQuality::RateOne), "a preview");
    let expected = drawn(&second);
    let final_pixels = (40..64).flat_map(|x| (56..72).map(move |y| (x, y)));
    for (x, y) in final_pixels {
        assert_eq!(desk.frame().final_rgba(x, y), expected.rgba(x, y), "{x}, {y}");
    }
    desk.rest();
    desk.shows_final(&second, "at rest");
}

#[test]
fn newer_wish_ends_a_refinement() {
    let mut desk = Desk::new();
    let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
    desk.want(&first);
    let running = desk.drawing.running.as_ref().expect("it is being drawn");
    assert_eq!(running.stage, Stage::Fine, "tile by tile");
    let cancel = Arc::clone(&running.cancel);
    desk.want(&second);
    assert!(cancel.is_cancelled(), "at once");
    desk.work();
    desk.rest();
    desk.shows_final(&second, "the newest");
}

#[test]
fn whoever_waits_gets_final_frames() {
    let mut desk = Desk::new();
    let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
    desk.want(&first);
    desk.work();
    desk.is_slow(&first);
    desk.drawing.set_hurry(true);
    desk.want(&second);
    desk.work();
    desk.shows_final(&second, "in a hurry");
    desk.drawing.set_hurry(false);
    desk.is_slow(&first);
    desk.want(&first);
    desk.work();
    assert!(desk.quality().is_some(), "a preview again");
    desk.drawing.set_progressive(false);
    desk.work();
    desk.shows_final(&first, "previews turned off");
}

#[test]
fn drag_always_shows_something() {
    let ms = Duration::from_millis;
    assert!(
        !is_too_slow(ms(30), ms(0)),
        "a quick frame is left to finish, or a drag would show nothing"
    );
    assert!(is_too_slow(ms(900), ms(100)), "a slow one makes room for the newest");
    assert!(!is_too_slow(ms(900), ms(2500)), "but the window must not seem dead");
}
