//! Drawing step by step, with times as the tests would have them: no test depends on how quick the machine is.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};

use glam::DVec2;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::*;
use crate::color::Rgba;
use crate::geometry::View;
use crate::raster::SampleRate;
use crate::render::{RenderSettings, draw};
use crate::scene::{Dialect, Paint, Primitive, PrimitiveKind, Scene, Shape, ShapeId, SourceLocation};

const SIZE: [u32; 2] = [150, 130];
const SLOW_FRAME: Duration = Duration::from_millis(200);

/// Drawing, and the thread's messages.
struct Desk {
    drawing: Drawing,
    messages: Receiver<Drawn>,
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
    fn new() -> Self {
        let (sender, messages) = channel();
        let drawing = Drawing::start(Mailbox::new(sender, Arc::new(|| {})), DrawingId::First).expect("a thread");
        let scene = scene();
        Self {
            drawing,
            messages,
            scene,
        }
    }

    pub(in crate::viewer) fn picture(&self, rate: u32, center: [f64; 2], scale: f64) -> Picture {
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

    fn want(&mut self, picture: &Picture) {
        self.drawing.want(FrameRequest::new(picture.clone(), [20, 30], None));
    }

    /// Whole frames of `picture` are slow from now on, and previews of one sample per pixel are not.
    fn is_slow(&mut self, picture: &Picture) {
        self.drawing.budget.note(picture, None, SLOW_FRAME);
        self.drawing
            .budget
            .note(picture, Some(PreviewQuality::RateOne), Duration::ZERO);
    }

    /// Moving by whole pixels takes no time, however busy the machine is.
    fn moves_quickly(&mut self, picture: &Picture) {
        self.drawing
            .budget
            .note(picture, Some(PreviewQuality::Moved), Duration::ZERO);
    }

    /// Takes in messages until the thread has nothing more to do; the hand does not rest meanwhile, however long it takes.
    fn work(&mut self) {
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

    fn take_in(&mut self, drawn: Drawn) {
        self.drawing.finished(drawn);
    }

    /// Lets the hand rest, and takes in what comes of it.
    fn rest(&mut self) {
        self.work();
        if let Some(wanted) = &mut self.drawing.wanted {
            wanted.since = wanted.since.checked_sub(2 * REST).expect("a clock that runs");
        }
        self.drawing.look();
        self.work();
    }

    fn frame(&self) -> &Frame {
        self.drawing.frame().expect("a frame")
    }

    fn quality(&self) -> Option<PreviewQuality> {
        self.frame().preview.as_ref().map(|preview| preview.quality)
    }

    /// Asserts that the final frame of `picture` is on the screen.
    fn shows_final(&self, picture: &Picture, what: &str) {
        assert!(self.drawing.is_current(), "{what}: nothing is left to do");
        assert_eq!(self.quality(), None, "{what}: no preview");
        assert!(self.frame().pixels == drawn(picture), "{what}: other bytes than draw's");
        assert_eq!(self.drawing.due(), None, "{what}: nothing to wait for");
    }
}

fn drawn(picture: &Picture) -> Framebuffer {
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

/// Threads that have nothing else to do.
fn pool() -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(2).build().expect("threads")
}

/// Pixels to draw onto.
fn surface() -> Vec<u32> {
    vec![0x1234_5678; SIZE[0] as usize * SIZE[1] as usize]
}

impl Desk {
    /// A desk that shows a quick picture and lends its surface, and another picture.
    fn with_surface() -> (Self, Picture) {
        let mut desk = Self::new();
        let (first, second) = (desk.picture(16, [50.0, 50.0], 1.0), desk.picture(16, [50.0, 50.0], 1.3));
        desk.drawing.lend_surface(true);
        desk.want(&first);
        assert!(!desk.drawing.waits_for_surface(), "nobody knows whether it is quick");
        desk.work();
        desk.is_quick(&first);
        (desk, second)
    }

    /// Whole frames of `picture` are quick from now on, however busy the machine is.
    fn is_quick(&mut self, picture: &Picture) {
        self.drawing.budget.note(picture, None, Duration::ZERO);
    }

    /// Draws what waits for the surface.
    fn draw_onto(&mut self, surface: &mut [u32]) {
        let drawn = self.drawing.draw_onto(SIZE, surface, &pool()).expect("a frame waits");
        self.drawing.finished(drawn);
    }
}

#[test]
fn quick_frames_are_drawn_where_they_are_shown() {
    let (mut desk, second) = Desk::with_surface();
    desk.want(&second);
    assert!(desk.drawing.waits_for_surface(), "it is quick");
    let number = desk.drawing.number();
    let mut surface = surface();
    assert!(
        desk.drawing
            .draw_onto([SIZE[1], SIZE[0]], &mut surface, &pool())
            .is_none(),
        "another size"
    );
    desk.draw_onto(&mut surface);
    desk.shows_final(&second, "at once");
    assert!(desk.drawing.number() > number, "another frame");
    assert!(surface == drawn(&second).pixels(), "the surface holds the frame");
    assert!(!desk.drawing.waits_for_surface(), "nothing waits any more");
    desk.is_slow(&second);
    desk.drawing
        .budget
        .note(&second, Some(PreviewQuality::RateOne), SLOW_FRAME);
    let third = desk.picture(16, [50.0, 50.0], 1.7);
    desk.want(&third);
    assert!(!desk.drawing.waits_for_surface(), "slow frames are for the thread");
    desk.rest();
    desk.shows_final(&third, "from the thread");
}

#[test]
fn quick_previews_are_drawn_where_they_are_shown() {
    let (mut desk, second) = Desk::with_surface();
    desk.is_slow(&second);
    let mut surface = surface();
    desk.want(&second);
    assert!(desk.drawing.waits_for_surface(), "a preview at rate 1");
    desk.draw_onto(&mut surface);
    assert_eq!(desk.quality(), Some(PreviewQuality::RateOne), "one sample per pixel");
    assert!(surface == desk.frame().pixels.pixels(), "the surface holds it");
    assert!(desk.frame().final_rgba(20, 30).is_none(), "no number comes from it");
    assert!(!desk.drawing.is_current(), "not what is wanted");
    desk.rest();
    desk.shows_final(&second, "at rest");
    desk.is_slow(&second);
    let third = desk.picture(16, [50.0, 50.0], 1.7);
    let focus = Region {
        x: 40,
        y: 50,
        width: 24,
        height: 24,
    };
    desk.drawing.want(FrameRequest::new(third, [50, 60], Some(focus)));
    assert!(!desk.drawing.waits_for_surface(), "what is inspected is final");
}

#[test]
fn newest_request_waits_for_the_surface() {
    let (mut desk, second) = Desk::with_surface();
    let first = desk.frame().picture.clone();
    desk.want(&second);
    let third = desk.picture(16, [50.0, 50.0], 1.7);
    desk.want(&third);
    let mut surface = surface();
    desk.draw_onto(&mut surface);
    assert!(surface == drawn(&third).pixels(), "the newest");
    desk.shows_final(&third, "nothing is left of the request before");
    desk.is_quick(&third);
    desk.want(&first);
    assert!(desk.drawing.waits_for_surface(), "back");
    desk.want(&third);
    assert!(!desk.drawing.waits_for_surface(), "it is on the screen");
    desk.shows_final(&third, "as before");
    desk.want(&first);
    desk.drawing.clear();
    assert!(!desk.drawing.waits_for_surface(), "nothing is to be seen");
    assert!(desk.drawing.frame().is_none(), "nothing is seen");
}

#[test]
fn nobody_waits_for_a_surface_for_long() {
    let (mut desk, second) = Desk::with_surface();
    let first = desk.frame().picture.clone();
    desk.want(&second);
    let due = desk.drawing.due().expect("it is looked for");
    assert!(due <= Instant::now() + REST, "soon");
    let running = desk.drawing.running.as_mut().expect("a frame that waits");
    running.started = running.started.checked_sub(2 * REST).expect("a clock that runs");
    desk.drawing.look();
    assert!(!desk.drawing.waits_for_surface(), "the thread draws it");
    desk.work();
    desk.shows_final(&second, "nobody came");
    desk.is_quick(&second);
    desk.want(&first);
    desk.drawing.set_hurry(true);
    desk.work();
    desk.shows_final(&first, "somebody waits for it");
    desk.drawing.set_hurry(false);
    desk.is_quick(&first);
    desk.want(&second);
    desk.drawing.lend_surface(false);
    desk.work();
    desk.shows_final(&second, "there is no surface any more");
}

#[test]
fn surface_is_given_up_for_what_takes_too_long() {
    let (mut desk, second) = Desk::with_surface();
    desk.want(&second);
    let job = desk.drawing.take_waiting().expect("a frame waits");
    job.cancel.cancel();
    let drawn = job.draw_onto(&mut surface(), &pool(), Duration::ZERO);
    assert!(matches!(drawn, Drawn::GivenUp), "half-way");
    desk.drawing.running.as_mut().expect("it was drawn").started -= SLOW_FRAME;
    desk.drawing.finished(drawn);
    assert!(!desk.drawing.waits_for_surface(), "it is slow");
    desk.rest();
    desk.shows_final(&second, "from the thread");
}

#[test]
fn surface_does_not_wait_for_other_work() {
    let (mut desk, second) = Desk::with_surface();
    desk.want(&second);
    let start = Instant::now();
    let ended = Arc::new(AtomicBool::new(false));
    for _ in 0..rayon::current_num_threads() {
        let ended = Arc::clone(&ended);
        rayon::spawn(move || {
            while !ended.load(Ordering::Relaxed) && start.elapsed() < Duration::from_secs(10) {
                std::thread::sleep(Duration::from_millis(1));
            }
        });
    }
    desk.draw_onto(&mut surface());
    let took = start.elapsed();
    ended.store(true, Ordering::Relaxed);
    assert!(took < Duration::from_secs(5), "{took:?} for a quick frame");
    desk.rest();
    desk.shows_final(&second, "at last");
}

#[test]
fn any_wishes_end_in_the_same_bytes() {
    arbtest::arbtest(|u| {
        let mut desk = Desk::new();
        let mut center = [50.0, 50.0];
        let (mut scale, mut rate) = (1.0, 4);
        let mut surface = surface();
        for _ in 0..u.int_in_range(1..=12)? {
            desk.drawing.lend_surface(u.ratio(2, 3)?);
            match u.int_in_range(0..=3)? {
                0 => scale = f64::from(u.int_in_range(2..=9)?) / 4.0,
                1 => rate = *u.choose(&[1, 4, 16])?,
                _ => {
                    let mut by = || Ok(f64::from(u.int_in_range(-20..=20)?) / 2.0);
                    center = [center[0] + by()?, center[1] + by()?];
                }
            }
            let picture = desk.picture(rate, center, scale);
            desk.want(&picture);
            match u.int_in_range(0..=6)? {
                0 => desk.rest(),
                1 => desk.work(),
                2 => desk.is_slow(&picture),
                3 | 4 if desk.drawing.waits_for_surface() => {
                    desk.draw_onto(&mut surface);
                    if desk.quality().is_none() {
                        desk.shows_final(&picture, "on the surface");
                    }
                    assert!(surface == desk.frame().pixels.pixels(), "in the surface");
                }
                5 => {
                    while let Ok(message) = desk.messages.try_recv() {
                        desk.take_in(message);
                    }
                }
                _ => {}
            }
        }
        let last = desk.drawing.wanted.as_ref().expect("a request").picture.clone();
        desk.rest();
        desk.shows_final(&last, "in the end");
        Ok(())
    })
    .budget_ms(1500);
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
