//! Where the user looks: the default view until a hand moves it, then a free one. Each scene has its own.
//!
//! Kept in frame pixels, so that what stands here is what `--view` takes.

use glam::{DVec2, dvec2};

use crate::geometry::{View, ViewTransform};
use crate::viewer::settings::values;

/// `scale * distance` that a view may reach, in pixels. Beyond it neighbouring pixels would share a coordinate:
/// a user-space number has 53 bits, of which this leaves 8 below the pixel.
const REACH: f64 = (1_u64 << 45) as f64;

/// What the scale of the default view may be multiplied with, so that the canvas lies in a part of the frame.
const LEAST_FOLLOWED: f64 = 0.6;

/// Smallest size of the canvas, in pixels: far below it nothing could be seen, and numbers stay finite.
const SMALLEST_CANVAS: f64 = 1.0 / (1_u64 << 30) as f64;

/// A view of one scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Camera {
    view: View,
    /// Whether the view only brings the canvas to where panels leave room for it.
    is_fitted: bool,
}

/// What a camera looks at and through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewContext {
    /// The canvas in canvas units.
    pub canvas: DVec2,
    /// The frame in pixels.
    pub frame: [u32; 2],
}

/// The numbers of a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewNumbers {
    /// The user-space point in the middle of the frame.
    pub center: DVec2,
    /// Frame pixels per canvas unit.
    pub scale: f64,
    /// Clockwise, in degrees, above -180 and up to 180.
    pub rotation: f64,
}

impl ViewContext {
    /// The frame as a vector; a frame without pixels counts as one pixel, so that no view divides by zero.
    fn size(&self) -> DVec2 {
        let [width, height] = self.frame.map(|side| f64::from(side.max(1)));
        dvec2(width, height)
    }
}

impl ViewNumbers {
    /// How people write a view.
    pub(in crate::viewer) const FORM: &str = "default, or X,Y,SCALE[,DEGREES]";

    /// Reads `X,Y,SCALE[,DEGREES]`; the scale is above zero.
    pub(in crate::viewer) fn parse(text: &str) -> Option<Self> {
        let values = values::numbers(text)?;
        let (x, y, scale, rotation) = match *values.as_slice() {
            [x, y, scale] => (x, y, scale, 0.0),
            [x, y, scale, rotation] => (x, y, scale, rotation),
            _ => return None,
        };
        let center = DVec2::new(x, y);
        (scale > 0.0).then_some(Self {
            center,
            scale,
            rotation,
        })
    }
}

impl Camera {
    /// A camera with this view.
    pub fn new(view: View) -> Self {
        Self { view, is_fitted: false }
    }

    /// The view, as `--view` would take it.
    pub fn view(&self) -> View {
        self.view
    }

    /// Whether no hand has moved the default view.
    pub fn is_default(&self) -> bool {
        self.view == View::Default
    }

    /// Whether no hand has moved the view since it was the default one: at most it was brought to where there is room.
    pub fn is_untouched(&self) -> bool {
        self.is_default() || self.is_fitted
    }

    /// The map from user space to frame pixels.
    pub fn transform(&self, context: &ViewContext) -> ViewTransform {
        self.view
            .transform(context.canvas, context.frame.map(|side| side.max(1)))
    }

    /// The view's numbers.
    pub fn numbers(&self, context: &ViewContext) -> ViewNumbers {
        match self.view {
            View::At {
                center,
                scale,
                rotation,
            } => ViewNumbers {
                center,
                scale,
                rotation,
            },
            View::Default => ViewNumbers {
                center: context.canvas / 2.0,
                scale: View::default_scale(context.canvas, context.frame.map(|side| side.max(1))),
                rotation: 0.0,
            },
            View::Canvas => ViewNumbers {
                center: context.canvas / 2.0,
                scale: (context.size() / context.canvas).min_element(),
                rotation: 0.0,
            },
        }
    }

    /// What is to be said where the numbers of a view are not those that it takes: which are possible.
    pub(in crate::viewer) fn remark(numbers: ViewNumbers, context: &ViewContext) -> Option<String> {
        let ViewNumbers {
            center,
            scale,
            rotation,
        } = numbers;
        let [lowest, highest] = scales(context);
        let farthest = REACH / scale.clamp(lowest, highest);
        if !(lowest..=highest).contains(&scale) {
            let [lowest, highest] = [lowest, highest].map(few_digits);
            Some(format!(
                "the scale of the view: from {lowest} to {highest} pixels per unit are possible"
            ))
        } else if !rotation.is_finite() {
            Some("the rotation of the view: any number of degrees is possible".to_owned())
        } else if !center.is_finite() || center.abs().max_element() > farthest {
            let farthest = few_digits(farthest);
            Some(format!(
                "the centre of the view: at this scale up to {farthest} units from 0 are possible"
            ))
        } else {
            None
        }
    }

    /// The view with these numbers, brought into the range where pixels can be told apart.
    pub fn set(&mut self, numbers: ViewNumbers, context: &ViewContext) {
        let all = [numbers.center.x, numbers.center.y, numbers.scale, numbers.rotation];
        if !all.into_iter().all(f64::is_finite) || numbers.scale <= 0.0 {
            return;
        }
        let [lowest, highest] = scales(context);
        let scale = numbers.scale.clamp(lowest, highest);
        let limit = DVec2::splat(REACH / scale);
        self.is_fitted = false;
        self.view = View::At {
            center: numbers.center.clamp(-limit, limit),
            scale,
            rotation: half_turn(numbers.rotation),
        };
    }

    /// Moves the picture by frame pixels.
    pub fn pan(&mut self, by: DVec2, context: &ViewContext) {
        let numbers = self.numbers(context);
        let moved = unturned(by, numbers.rotation) / numbers.scale;
        let center = numbers.center - moved;
        self.set(ViewNumbers { center, ..numbers }, context);
    }

    /// Scales by `factor`; the user-space point at the frame position `at` stays there.
    pub fn zoom(&mut self, at: DVec2, factor: f64, context: &ViewContext) {
        if !(factor > 0.0 && factor.is_finite() && at.is_finite()) {
            return;
        }
        let before = self.numbers(context);
        let arm = unturned(at - context.size() / 2.0, before.rotation);
        let fixed = before.center + arm / before.scale;
        // The limit depends on how far out the view lies: ask for the scale first, then place the centre.
        let reach = REACH / fixed.abs().max_element().max(context.canvas.max_element());
        let scale = (before.scale * factor).min(reach.max(before.scale));
        let lowest = SMALLEST_CANVAS / context.canvas.max_element();
        let scale = scale.max(lowest.min(before.scale));
        let center = fixed - arm / scale;
        self.set(
            ViewNumbers {
                center,
                scale,
                ..before
            },
            context,
        );
    }

    /// Turns clockwise about the middle of the frame.
    pub fn rotate(&mut self, degrees: f64, context: &ViewContext) {
        let numbers = self.numbers(context);
        let rotation = numbers.rotation + degrees;
        self.set(ViewNumbers { rotation, ..numbers }, context);
    }

    /// The largest view that shows the whole canvas in a part of the frame, given by its corner and size in frame
    /// pixels; the rotation stays.
    pub fn fit(&mut self, [corner, size]: [DVec2; 2], context: &ViewContext) {
        let numbers = self.numbers(context);
        let (sin, cos) = numbers.rotation.to_radians().sin_cos();
        let (sin, cos) = (sin.abs(), cos.abs());
        let canvas = context.canvas;
        let turned = dvec2(canvas.x * cos + canvas.y * sin, canvas.x * sin + canvas.y * cos);
        let scale = (size.max(DVec2::ONE) / turned).min_element();
        let aside = unturned(corner + size / 2.0 - context.size() / 2.0, numbers.rotation) / scale;
        let fitted = ViewNumbers {
            center: canvas / 2.0 - aside,
            scale,
            ..numbers
        };
        self.set(fitted, context);
    }

    /// Whether the canvas and a part of the frame, given by its corner and size in frame pixels, have a point in common: two
    /// rectangles, one of them turned, have none if a side of either parts them.
    pub fn sees_canvas(&self, [corner, size]: [DVec2; 2], context: &ViewContext) -> bool {
        let map = self.transform(context);
        let corners = |low: DVec2, high: DVec2| [low, high, dvec2(low.x, high.y), dvec2(high.x, low.y)];
        let meet = |points: [DVec2; 4], low: DVec2, high: DVec2| {
            let least = points.into_iter().fold(DVec2::MAX, DVec2::min);
            let most = points.into_iter().fold(DVec2::MIN, DVec2::max);
            least.cmple(high).all() && most.cmpge(low).all()
        };
        let canvas = corners(DVec2::ZERO, context.canvas).map(|point| map.to_pixels(point));
        let part = corners(corner, corner + size).map(|pixel| map.to_scene(pixel));
        meet(canvas, corner, corner + size) && meet(part, DVec2::ZERO, context.canvas)
    }

    /// If some of the canvas lies outside of a part of the frame, given by its corner and size in frame pixels: the whole
    /// canvas in the middle of that part, upright, with the margin of the default view.
    pub fn show_canvas(&mut self, [corner, size]: [DVec2; 2], context: &ViewContext) {
        let to_pixels = self.transform(context);
        let is_inside = [DVec2::ZERO, context.canvas].into_iter().all(|end| {
            let end = to_pixels.to_pixels(end);
            end.cmpge(corner).all() && end.cmple(corner + size).all()
        });
        if is_inside {
            return;
        }
        let scale = View::default_scale(context.canvas, [size.x, size.y].map(whole));
        let aside = (corner + size / 2.0 - context.size() / 2.0) / scale;
        let shown = ViewNumbers {
            center: context.canvas / 2.0 - aside,
            scale,
            rotation: 0.0,
        };
        let was_default = self.is_default();
        self.set(shown, context);
        self.is_fitted = was_default;
    }

    /// A view that no hand has moved: the default one, or where some of the canvas would lie outside of a part of the frame,
    /// the like in that part, unless that is so small that little of the scene would be left to look at.
    pub fn follow(&mut self, part: [DVec2; 2], context: &ViewContext) {
        if !self.is_untouched() {
            return;
        }
        let first = Self::default();
        *self = first;
        self.show_canvas(part, context);
        if self.numbers(context).scale < first.numbers(context).scale * LEAST_FOLLOWED {
            *self = first;
        }
    }

    /// One canvas unit is one frame pixel; the middle of the frame stays.
    pub fn actual_size(&mut self, context: &ViewContext) {
        let numbers = self.numbers(context);
        self.set(ViewNumbers { scale: 1.0, ..numbers }, context);
    }

    /// The same part of the scene when frame pixels become `factor` times as many along each side.
    pub fn rescale(&mut self, factor: f64, context: &ViewContext) {
        if !self.is_untouched() {
            let numbers = self.numbers(context);
            let scale = numbers.scale * factor;
            self.set(ViewNumbers { scale, ..numbers }, context);
        }
    }
}

/// The least and the largest scale of a view, in pixels per canvas unit.
fn scales(context: &ViewContext) -> [f64; 2] {
    [SMALLEST_CANVAS, REACH].map(|side| side / context.canvas.max_element())
}

/// A number of any size for people.
fn few_digits(number: f64) -> String {
    format!("{number:.1e}")
}

/// A screen-space vector turned back by a view's rotation.
fn unturned(vector: DVec2, rotation: f64) -> DVec2 {
    DVec2::from_angle(-rotation.to_radians()).rotate(vector)
}

/// An angle in degrees brought above -180 and up to 180.
fn half_turn(degrees: f64) -> f64 {
    let turned = degrees.rem_euclid(360.0);
    if turned > 180.0 { turned - 360.0 } else { turned }
}

/// Whole pixels of a length, at least one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a frame's sides are far smaller, and what is no number becomes 1"
)]
fn whole(length: f64) -> u32 {
    length.max(1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIGHT: ViewContext = ViewContext {
        canvas: DVec2::new(200.0, 100.0),
        frame: [640, 480],
    };

    /// Any finite view near the canvas, from a stream of bytes.
    fn arbitrary_camera(u: &mut arbtest::arbitrary::Unstructured<'_>) -> arbtest::arbitrary::Result<Camera> {
        let mut camera = Camera::default();
        let part = |n: u16| f64::from(n) / 65536.0;
        let numbers = ViewNumbers {
            center: dvec2(part(u.arbitrary()?) * 300.0 - 50.0, part(u.arbitrary()?) * 200.0 - 50.0),
            scale: 2_f64.powf(part(u.arbitrary()?) * 40.0 - 20.0),
            rotation: part(u.arbitrary()?) * 720.0 - 360.0,
        };
        camera.set(numbers, &SIGHT);
        Ok(camera)
    }

    #[test]
    fn zoom_fixes_the_point_under_the_cursor() {
        arbtest::arbtest(|u| {
            let mut camera = arbitrary_camera(u)?;
            let at = dvec2(f64::from(u.int_in_range(0..=640)?), f64::from(u.int_in_range(0..=480)?));
            let factor = 2_f64.powf(f64::from(u.int_in_range(-80..=80)?) / 8.0);
            let before = camera.transform(&SIGHT).to_scene(at);
            camera.zoom(at, factor, &SIGHT);
            let after = camera.transform(&SIGHT).to_pixels(before);
            // Coordinates up to 300 units at scales below 2^31: an ulp of the product is 2^-13 of a pixel.
            assert!(
                after.abs_diff_eq(at, 1e-2),
                "{at} went to {after} by {factor}, {camera:?}"
            );
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn canvas_is_seen_where_its_points_are() {
        arbtest::arbtest(|u| {
            let camera = arbitrary_camera(u)?;
            let part = [dvec2(0.0, 0.0), SIGHT.size() / 2.0];
            let map = camera.transform(&SIGHT);
            let inside = |pixel: DVec2| pixel.cmpge(part[0]).all() && pixel.cmple(part[1]).all();
            let steps = (0..=20).flat_map(|y| (0..=20).map(move |x| dvec2(f64::from(x), f64::from(y)) / 20.0));
            let hit = steps.into_iter().any(|at| inside(map.to_pixels(at * SIGHT.canvas)));
            assert!(!hit || camera.sees_canvas(part, &SIGHT), "{:?}", camera.numbers(&SIGHT));
            Ok(())
        });
        let look_at = |center: DVec2, rotation: f64| {
            let mut camera = Camera::default();
            let numbers = ViewNumbers {
                center,
                scale: 1.0,
                rotation,
            };
            camera.set(numbers, &SIGHT);
            camera.sees_canvas([DVec2::ZERO, SIGHT.size()], &SIGHT)
        };
        assert!(look_at(SIGHT.canvas / 2.0, 30.0), "in the middle");
        assert!(!look_at(SIGHT.canvas * 40.0, 30.0), "far off");
        let beside = SIGHT.canvas + SIGHT.size() * 0.45;
        assert!(look_at(beside, 0.0), "a corner of both");
        assert!(!look_at(beside, 45.0), "parted by a slanted side");
    }

    #[test]
    fn show_canvas_moves_it_only_where_it_is_covered() {
        let context = ViewContext {
            canvas: dvec2(400.0, 200.0),
            frame: [800, 600],
        };
        let mut camera = Camera::default();
        camera.show_canvas([DVec2::ZERO, dvec2(800.0, 600.0)], &context);
        assert!(camera.is_default(), "nothing covers it");
        let (corner, size) = (dvec2(0.0, 20.0), dvec2(500.0, 560.0));
        camera.show_canvas([corner, size], &context);
        let view = camera.transform(&context);
        let [low, high] = [DVec2::ZERO, context.canvas].map(|end| view.to_pixels(end));
        assert!(
            low.cmpge(corner).all() && high.cmple(corner + size).all(),
            "{low} {high}"
        );
        assert!(
            ((low + high) / 2.0).distance(corner + size / 2.0) < 1e-9,
            "in the middle"
        );
        assert!(high.x - low.x > 400.0, "as large as there");
        let found = camera;
        camera.show_canvas([corner, size], &context);
        assert_eq!(camera, found, "and there it stays");
    }

    #[test]
    fn pan_is_one_to_one() {
        arbtest::arbtest(|u| {
            let mut camera = arbitrary_camera(u)?;
            let by = dvec2(
                f64::from(u.int_in_range(-999..=999)?),
                f64::from(u.int_in_range(-999..=999)?),
            );
            let point = camera.transform(&SIGHT).to_scene(DVec2::ZERO);
            camera.pan(by, &SIGHT);
            let after = camera.transform(&SIGHT).to_pixels(point);
            assert!(
                after.abs_diff_eq(by, 1e-3),
                "moved by {after} instead of {by}, {camera:?}"
            );
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn zoom_has_no_end_but_numbers() {
        let mut camera = Camera::default();
        for _ in 0..10_000 {
            camera.zoom(dvec2(3.0, 4.0), 1e3, &SIGHT);
        }
        assert!(camera.numbers(&SIGHT).scale > 1e11, "{camera:?}");
        for _ in 0..10_000 {
            camera.zoom(dvec2(3.0, 4.0), 1e-3, &SIGHT);
        }
        let numbers = camera.numbers(&SIGHT);
        assert!(numbers.scale > 0.0 && numbers.center.is_finite(), "{numbers:?}");
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let before = camera;
            camera.zoom(DVec2::ZERO, wrong, &SIGHT);
            assert_eq!(camera, before, "{wrong} is no factor");
            camera.set(
                ViewNumbers {
                    scale: wrong,
                    ..numbers
                },
                &SIGHT,
            );
            assert_eq!(camera, before, "{wrong} is no scale");
        }
    }

    #[test]
    fn fit_touches_the_frame() {
        let mut camera = Camera::default();
        let whole = [DVec2::ZERO, SIGHT.size()];
        camera.fit(whole, &SIGHT);
        let scale = camera.numbers(&SIGHT).scale;
        assert!((scale - 3.2).abs() < 1e-12, "640 px for 200 units: {scale}");
        camera.rotate(90.0, &SIGHT);
        camera.fit(whole, &SIGHT);
        let numbers = camera.numbers(&SIGHT);
        assert!((numbers.scale - 2.4).abs() < 1e-9, "480 px for 200 units: {numbers:?}");
        assert!((numbers.rotation - 90.0).abs() < 1e-12, "the rotation stays");
        let part = [dvec2(40.0, 30.0), dvec2(400.0, 400.0)];
        camera.fit(part, &SIGHT);
        let middle = camera.transform(&SIGHT).to_pixels(SIGHT.canvas / 2.0);
        assert!(
            middle.abs_diff_eq(dvec2(240.0, 230.0), 1e-9),
            "in the middle of the part: {middle}"
        );
        assert!(
            (camera.numbers(&SIGHT).scale - 2.0).abs() < 1e-9,
            "400 px for 200 units"
        );
    }

    #[test]
    fn rotation_stays_in_half_turns() {
        for (given, kept) in [
            (180.0, 180.0),
            (-180.0, 180.0),
            (190.0, -170.0),
            (720.0, 0.0),
            (-5.0, -5.0),
        ] {
            let turned = half_turn(given);
            assert!((turned - kept).abs() < 1e-12, "{given} degrees became {turned}");
        }
    }

    #[test]
    fn follow_moves_only_what_no_hand_has_moved() {
        let context = ViewContext {
            canvas: dvec2(400.0, 200.0),
            frame: [800, 600],
        };
        let whole = [DVec2::ZERO, dvec2(800.0, 600.0)];
        let [left, right] = [0.0, 300.0].map(|x| [dvec2(x, 0.0), dvec2(500.0, 600.0)]);
        let mut camera = Camera::default();
        camera.follow(left, &context);
        let first = camera;
        assert!(!camera.is_default() && camera.is_untouched(), "it made room");
        camera.follow(right, &context);
        let by = camera.numbers(&context).center.x - first.numbers(&context).center.x;
        assert!(
            by < 0.0,
            "the canvas moved to the right: its middle of the frame by {by}"
        );
        camera.follow(whole, &context);
        assert!(camera.is_default(), "all is free again");
        camera.follow([DVec2::ZERO, dvec2(200.0, 600.0)], &context);
        assert!(camera.is_default(), "nothing could be seen in so little room");
        camera.follow(left, &context);
        camera.pan(DVec2::ONE, &context);
        let moved = camera;
        camera.follow(whole, &context);
        assert_eq!(camera, moved, "a hand moved it");
        assert!(!camera.is_untouched());
    }
}
