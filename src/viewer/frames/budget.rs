//! How long frames take, and what to draw first while the view moves: from measured times alone, without a clock.
//!
//! Times are kept for one scene at a time, per pixel: the whole frame under each settings, each step of the ladder of
//! coarser drawings, and a frame moved by whole pixels.

use std::sync::{Arc, Weak};
use std::time::Duration;

use crate::raster::SampleRate;
use crate::render::RenderSettings;
use crate::scene::Scene;
use crate::viewer::frames::frame::{Picture, PreviewQuality};

/// What a frame may take while the view moves.
pub(in crate::viewer) const BUDGET: Duration = Duration::from_millis(16);

/// A whole frame that takes no longer is drawn even where the one before could be moved, and by whoever shows it if he can.
pub(in crate::viewer) const QUICK: Duration = Duration::from_millis(8);

/// Settings whose times are remembered.
const REMEMBERED: usize = 16;

/// A coarser step must be that much quicker than a finer one to be worth its looks, when both are too slow.
const WORTH: f64 = 0.7;

/// The ladder: from one sample per pixel down.
const STEPS: [PreviewQuality; 3] = [
    PreviewQuality::RateOne,
    PreviewQuality::Coarse(2),
    PreviewQuality::Coarse(4),
];

/// Measured times of one scene.
#[derive(Debug, Default)]
pub(in crate::viewer) struct FrameBudget {
    scene: Weak<Scene>,
    /// Seconds per pixel of whole frames, the latest settings last.
    whole: Vec<(RenderSettings, f64)>,
    /// Seconds per pixel of the frame (not of the coarse pixels), for each of [`STEPS`].
    steps: [Option<f64>; STEPS.len()],
    /// Seconds per pixel of a moved frame.
    moved: Option<f64>,
}

impl FrameBudget {
    /// Takes in how long a drawing of `picture` took; `quality` is `None` for a whole frame.
    pub(in crate::viewer) fn note(&mut self, picture: &Picture, quality: Option<PreviewQuality>, took: Duration) {
        self.follow(&picture.scene);
        let cost = took.as_secs_f64() / pixels(picture);
        match quality {
            // One frame that was held up by others does not make a scene slow.
            None => self.set_whole(
                picture,
                self.whole_cost(picture)
                    .map_or(cost, |known| cost.min(f64::midpoint(known, cost))),
            ),
            Some(PreviewQuality::Moved) => self.moved = Some(cost),
            Some(quality) => self.note_step(quality, cost),
        }
    }

    fn set_whole(&mut self, picture: &Picture, cost: f64) {
        self.whole.retain(|(settings, _)| *settings != picture.settings);
        if self.whole.len() >= REMEMBERED {
            self.whole.remove(0);
        }
        self.whole.push((picture.settings, cost));
    }

    fn note_step(&mut self, quality: PreviewQuality, cost: f64) {
        let Some(at) = STEPS.iter().position(|step| *step == quality) else {
            return;
        };
        self.steps[at] = Some(cost);
        // A finer step has at most four times the pixels, so it takes at most four times as long: where the view became
        // simpler, this leads back up the ladder. While steps are drawn, moving may become quick again, too.
        let mut bound = cost;
        for finer in self.steps[..at].iter_mut().rev() {
            bound *= 4.0;
            *finer = finer.map(|cost| cost.min(bound));
        }
        self.moved = self.moved.map(|cost| cost * WORTH);
    }

    /// A whole frame of `picture` was given up after this time.
    pub(in crate::viewer) fn note_given_up(&mut self, picture: &Picture, after: Duration) {
        let known = self.whole_frame(picture).unwrap_or_default();
        if after > known.max(BUDGET) {
            self.follow(&picture.scene);
            self.set_whole(picture, after.as_secs_f64() / pixels(picture));
        }
    }

    /// What a whole frame is expected to take; `None` where nothing like it was drawn.
    pub(in crate::viewer) fn whole_frame(&self, picture: &Picture) -> Option<Duration> {
        Some(seconds(self.whole_cost(picture)? * pixels(picture)))
    }

    /// Seconds per pixel of a whole frame.
    fn whole_cost(&self, picture: &Picture) -> Option<f64> {
        let known = self.knows(&picture.scene).then_some(&self.whole)?;
        let found = known.iter().find(|(settings, _)| *settings == picture.settings);
        found.map(|(_, cost)| *cost)
    }

    /// Whether a frame moved by whole pixels is the way to show `picture` at once.
    pub(in crate::viewer) fn moves(&self, picture: &Picture) -> bool {
        let whole = self.whole_frame(picture).unwrap_or(Duration::MAX);
        let moved = self.moved.filter(|_| self.knows(&picture.scene)).unwrap_or(0.0) * pixels(picture);
        let moved = seconds(moved);
        let step = self.step_cost(picture, self.step(picture));
        whole > QUICK && (moved <= BUDGET || step.is_some_and(|step| moved <= step))
    }

    /// The finest step of the ladder that fits the budget; where none does, the finest that costs little more than the
    /// quickest.
    pub(in crate::viewer) fn step(&self, picture: &Picture) -> PreviewQuality {
        let is_as_quick = picture.settings.sample_rate == SampleRate::ONE
            && picture.settings.filter().is_plain()
            && !picture.settings.covers_areas();
        let first = usize::from(is_as_quick);
        let ladder = &STEPS[first..];
        let cost = |quality| {
            self.step_cost(picture, quality)
                .unwrap_or_else(|| self.least(picture, quality))
        };
        let fits = |quality: &&PreviewQuality| cost(**quality) <= BUDGET;
        if let Some(step) = ladder.iter().find(fits) {
            return *step;
        }
        let costs = ladder.iter().filter_map(|step| self.step_cost(picture, *step));
        let least = costs.min().unwrap_or_default().as_secs_f64();
        let near = |quality: &&PreviewQuality| {
            let cost = self.step_cost(picture, **quality);
            cost.is_some_and(|cost| cost.as_secs_f64() * WORTH <= least)
        };
        ladder.iter().find(near).copied().unwrap_or(STEPS[STEPS.len() - 1])
    }

    /// What a step takes at least: its samples are a part of those of the whole frame.
    fn least(&self, picture: &Picture, quality: PreviewQuality) -> Duration {
        let whole = self.whole_frame(picture).unwrap_or_default();
        let side = if let PreviewQuality::Coarse(side) = quality {
            side
        } else {
            1
        };
        whole / (picture.settings.sample_rate.samples() * side * side).max(1)
    }

    /// How long a step of the ladder took for this number of pixels; `None` where it was not drawn yet.
    pub(in crate::viewer) fn step_cost(&self, picture: &Picture, quality: PreviewQuality) -> Option<Duration> {
        let at = STEPS.iter().position(|step| *step == quality)?;
        let cost = self.steps[at].filter(|_| self.knows(&picture.scene))?;
        Some(seconds(cost * pixels(picture)))
    }

    fn knows(&self, scene: &Arc<Scene>) -> bool {
        std::ptr::eq(self.scene.as_ptr(), Arc::as_ptr(scene))
    }

    fn follow(&mut self, scene: &Arc<Scene>) {
        if !self.knows(scene) {
            *self = Self {
                scene: Arc::downgrade(scene),
                ..Self::default()
            };
        }
    }
}

fn pixels(picture: &Picture) -> f64 {
    let [width, height] = picture.size.map(f64::from);
    (width * height).max(1.0)
}

fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::View;
    use crate::scene::Dialect;

    pub(in crate::viewer) fn picture(rate: u32) -> Picture {
        let scene = Arc::new(Scene::empty(DVec2::splat(100.0), Dialect::Svg));
        let settings = RenderSettings {
            sample_rate: SampleRate::new(rate).expect("a square number"),
            ..RenderSettings::default()
        };
        let size = [100, 100];
        let view = View::Default.transform(scene.canvas, size);
        Picture {
            scene,
            document: 0,
            view,
            settings,
            size,
        }
    }

    fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[test]
    fn pace_goes_down_the_ladder_and_up_again() {
        let (mut budget, picture) = (FrameBudget::default(), picture(16));
        assert_eq!(budget.whole_frame(&picture), None, "nothing is known");
        budget.note(&picture, None, ms(200));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::RateOne,
            "the finest, as nothing is known of it"
        );
        budget.note(&picture, Some(PreviewQuality::RateOne), ms(40));
        assert_eq!(budget.step(&picture), PreviewQuality::Coarse(2), "rate 1 is too slow");
        budget.note(&picture, Some(PreviewQuality::Coarse(2)), ms(20));
        assert_eq!(budget.step(&picture), PreviewQuality::Coarse(4), "so is half the size");
        budget.note(&picture, Some(PreviewQuality::Coarse(4)), ms(2));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::Coarse(2),
            "a quarter in 2 ms is a half in at most 8"
        );
        budget.note(&picture, Some(PreviewQuality::Coarse(2)), ms(3));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::RateOne,
            "and at most 12 for rate 1"
        );
    }

    #[test]
    fn pace_does_not_coarsen_for_nothing() {
        let (mut budget, picture) = (FrameBudget::default(), picture(1));
        budget.note(&picture, None, ms(100));
        for (quality, time) in [(PreviewQuality::Coarse(4), 60), (PreviewQuality::Coarse(2), 70)] {
            budget.note(&picture, Some(quality), ms(time));
        }
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::Coarse(2),
            "a quarter would be as slow"
        );
    }

    #[test]
    fn pace_does_not_try_what_cannot_be_quick() {
        let (mut budget, picture) = (FrameBudget::default(), picture(16));
        budget.note(&picture, None, ms(400));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::Coarse(2),
            "rate 1 would take 25 ms"
        );
        budget.note(&picture, None, ms(2000));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::Coarse(4),
            "half the size would take 31 ms"
        );
        budget.note(&picture, None, ms(20_000));
        assert_eq!(
            budget.step(&picture),
            PreviewQuality::Coarse(4),
            "there is no quicker one"
        );
    }

    #[test]
    fn pace_scales_with_the_frame_and_forgets_other_scenes() {
        let (mut budget, mut small) = (FrameBudget::default(), picture(4));
        budget.note(&small, None, ms(10));
        assert_eq!(budget.whole_frame(&small), Some(ms(10)), "as measured");
        small.size = [200, 100];
        assert_eq!(budget.whole_frame(&small), Some(ms(20)), "twice the pixels");
        budget.note_given_up(&small, ms(18));
        assert_eq!(budget.whole_frame(&small), Some(ms(20)), "given up early tells nothing");
        budget.note_given_up(&small, ms(50));
        assert_eq!(budget.whole_frame(&small), Some(ms(50)), "at least so long");
        let other = picture(4);
        assert_eq!(budget.whole_frame(&other), None, "another scene");
        budget.note(&other, None, ms(1));
        assert_eq!(budget.whole_frame(&small), None, "one scene at a time");
    }

    #[test]
    fn pace_believes_the_second_slow_frame() {
        let (mut budget, picture) = (FrameBudget::default(), picture(16));
        budget.note(&picture, None, ms(2));
        budget.note(&picture, None, ms(12));
        assert_eq!(budget.whole_frame(&picture), Some(ms(7)), "half of what is new");
        budget.note(&picture, None, ms(12));
        assert!(budget.whole_frame(&picture) > Some(QUICK), "it is slow");
        budget.note(&picture, None, ms(3));
        assert_eq!(
            budget.whole_frame(&picture),
            Some(ms(3)),
            "nothing makes a frame quicker than it is"
        );
    }

    #[test]
    fn pace_moves_where_it_pays() {
        let (mut budget, picture) = (FrameBudget::default(), picture(16));
        budget.note(&picture, None, ms(5));
        assert!(!budget.moves(&picture), "a quick frame is drawn");
        budget.note(&picture, None, ms(100));
        assert!(budget.moves(&picture), "a slow one is moved");
        budget.note(&picture, Some(PreviewQuality::Moved), ms(50));
        assert!(
            !budget.moves(&picture),
            "unless that is slow too, and nothing is known of steps"
        );
        for quality in [
            PreviewQuality::Coarse(4),
            PreviewQuality::Coarse(2),
            PreviewQuality::RateOne,
        ] {
            budget.note(&picture, Some(quality), ms(60));
        }
        assert!(budget.moves(&picture), "or every step is slower");
    }
}
