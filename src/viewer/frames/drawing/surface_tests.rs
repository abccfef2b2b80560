//! Frames that are drawn where they are shown: who waits for the surface, and for how long.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::tests::{Desk, SIZE, SLOW_FRAME, drawn};
use super::*;

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
    pub(super) fn is_quick(&mut self, picture: &Picture) {
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
