//! What a user asks of a comparison: another B, another arrangement, other colours of differences.

use std::time::{Duration, Instant};

use crate::color::ResolveSpace;
use crate::compare::{Gain, Measure};
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::{Against, Arrangement, Other};
use crate::viewer::chrome::messages::Messages;
use crate::viewer::settings::{Settings, Toggle, picture};
use crate::viewer::view::panes::Moved;

/// How what is said of a B of A's settings begins. Whoever does one of the things that it names has read it.
pub(in crate::viewer) const KEPT: &str = "B keeps these settings";

/// How what is said begins where A changed and B is all there is to be seen.
pub(in crate::viewer) const UNSEEN: &str = "A changed, and B is what you see";

/// Said where B is needed and a copy of A would be no answer.
const NOTHING_TO_COMPARE: &str =
    "there is no B yet to differ from: the menu \"A against B\" compares with other settings, the truth or a picture";

/// The smallest and the largest gain.
const GAINS: [f32; 2] = [1e-6, 1e6];

/// How long each of both is to be seen while they flip.
const FLIP: Duration = Duration::from_millis(700);

/// What a comparison needs of the parts around it: A's settings, which B may be a copy of, and a way to tell the user.
#[derive(Debug)]
pub(in crate::viewer) struct ComparisonContext<'a> {
    pub(in crate::viewer) settings: &'a Settings,
    pub(in crate::viewer) messages: &'a mut Messages,
}

impl Comparison {
    /// Compares A with this.
    pub(in crate::viewer) fn compare(&mut self, against: Against, context: &mut ComparisonContext<'_>) {
        // The newest request counts.
        self.loading = None;
        context.messages.retract(KEPT);
        context.messages.retract(NOTHING_TO_COMPARE);
        match against {
            Against::Settings => {
                self.set_other(Some(Other::with(context.settings)));
                context.messages.done(format!(
                    "{KEPT}; change a setting, and A shows it. Wipe (W) and difference (D) compare both"
                ));
            }
            Against::Changed(changes) => {
                let mut other = *context.settings;
                if let Some(remark) = picture::apply_all(&changes, &mut other) {
                    context.messages.error(remark);
                }
                self.set_other(Some(Other::with(&other)));
                self.show_somehow(context);
            }
            Against::Truth(resolve) => {
                self.set_other(Some(Other::Truth(resolve)));
                self.show_somehow(context);
            }
            Against::File(path) => self.load_picture(path, context.messages),
            Against::Nothing => {
                self.set_other(None);
                self.arrangement = Arrangement::Alone;
            }
        }
    }

    /// Compares with this, and shows it at once.
    pub(in crate::viewer) fn compare_from_the_start(&mut self, against: Against, context: &mut ComparisonContext<'_>) {
        let settings = against == Against::Settings;
        self.compare(against, context);
        // A picture is shown when it was read.
        if settings {
            self.show_somehow(context);
        }
    }

    /// Shows A and B so; without B it becomes a copy of A.
    pub(in crate::viewer) fn arrange(&mut self, arrangement: Arrangement, context: &mut ComparisonContext<'_>) {
        let is_without = self.other.is_none() && self.loading.is_none();
        if arrangement != Arrangement::Alone && is_without {
            self.compare(Against::Settings, context);
        }
        self.arrangement = arrangement;
        self.flip = None;
        self.held = None;
        self.drags_line = false;
    }

    /// The same, or A alone where both share the window so already.
    pub(in crate::viewer) fn toggle_arrangement(
        &mut self,
        arrangement: Arrangement,
        context: &mut ComparisonContext<'_>,
    ) {
        let shown = self.arrangement() == arrangement;
        self.arrange(if shown { Arrangement::Alone } else { arrangement }, context);
    }

    /// Puts the line of the wipe there, in parts of the frame's width.
    pub(in crate::viewer) fn set_wipe(&mut self, part: f64, context: &mut ComparisonContext<'_>) {
        if part.is_finite() {
            self.wipe = Some(part.clamp(0.0, 1.0));
            self.arrange(Arrangement::Wipe, context);
        }
    }

    /// Shows this difference.
    pub(in crate::viewer) fn set_measure(&mut self, measure: Measure, context: &mut ComparisonContext<'_>) {
        self.style.measure = measure;
        self.arrange(Arrangement::Difference, context);
    }

    /// Shows differences times this, kept above zero.
    pub(in crate::viewer) fn set_gain(&mut self, gain: f32, context: &mut ComparisonContext<'_>) {
        if gain.is_finite() {
            self.take_gain(gain, context);
        }
    }

    fn take_gain(&mut self, gain: f32, context: &mut ComparisonContext<'_>) {
        self.gain = gain.clamp(GAINS[0], GAINS[1]);
        self.style.gain = Gain::Factor(self.gain);
        self.arrange(Arrangement::Difference, context);
    }

    /// Doubles the gain this many times, or halves it.
    pub(in crate::viewer) fn step_gain(&mut self, steps: i32, context: &mut ComparisonContext<'_>) {
        // From what is to be seen: a normalised gain, too.
        let gain = self.difference_gain().unwrap_or(self.gain);
        self.take_gain(gain * 2.0_f32.powi(steps.clamp(-40, 40)), context);
    }

    /// Whether the largest difference takes the last colour.
    pub(in crate::viewer) fn normalize(&mut self, toggle: Toggle, context: &mut ComparisonContext<'_>) {
        let before = self.style.gain == Gain::Normalize && self.arrangement() == Arrangement::Difference;
        self.style.gain = if toggle.of(before) {
            Gain::Normalize
        } else {
            Gain::Factor(self.gain)
        };
        self.arrange(Arrangement::Difference, context);
    }

    /// Shows the other of both, until it is asked for again.
    pub(in crate::viewer) fn flip_by_hand(&mut self, context: &mut ComparisonContext<'_>) {
        let shows_back = self.flip_shows_back();
        let is_without = self.other.is_none() && self.loading.is_none();
        if self.arrangement() != Arrangement::Flip {
            self.arrange(Arrangement::Flip, context);
        }
        if is_without {
            context.messages.retract(KEPT);
            context.messages.done(format!(
                "{KEPT}, and is what you see; B again shows A, which changes with the settings"
            ));
        }
        self.flip = Some((None, !shows_back));
    }

    /// Flips if it is time to.
    pub(in crate::viewer) fn flip_when_due(&mut self) {
        let flips = self.arrangement() == Arrangement::Flip;
        let now = Instant::now();
        let next = now.checked_add(FLIP);
        match self.flip {
            _ if !flips => self.flip = None,
            None => self.flip = Some((next, false)),
            Some((Some(due), shows_back)) if due <= now => {
                self.flip = Some((next, !shows_back));
                self.touch();
            }
            Some(_) => {}
        }
    }

    /// The truth is averaged in these values, or in those of A; what was said with an earlier truth counts no more.
    pub(in crate::viewer) fn set_truth_space(&mut self, space: Option<ResolveSpace>) {
        self.truth_space = space;
        if let Some(Other::Truth(own)) = &mut self.other {
            *own = None;
        }
    }

    /// The pixel that differs most is to be pinned, or from there the next, as soon as it is known.
    pub(in crate::viewer) fn want_next_difference(&mut self, context: &mut ComparisonContext<'_>) {
        if self.other.is_none() && self.loading.is_none() {
            context.messages.error(NOTHING_TO_COMPARE.to_owned());
        } else {
            self.measuring.jumps = true;
        }
    }

    /// Shows A alone; true if both shared the window.
    pub(in crate::viewer) fn escape_arrangement(&mut self, context: &mut ComparisonContext<'_>) -> bool {
        let shared = self.shows_both();
        if shared {
            self.arrange(Arrangement::Alone, context);
            self.swapped = false;
            self.touch();
        }
        shared
    }

    /// Forgets B; true if there was one.
    pub(in crate::viewer) fn escape(&mut self, context: &mut ComparisonContext<'_>) -> bool {
        let open = self.other.is_some();
        if open {
            self.compare(Against::Nothing, context);
            self.touch();
        }
        open
    }

    pub(in crate::viewer) fn set_other(&mut self, other: Option<Other>) {
        self.other = other;
        self.swapped = false;
        self.held = None;
        self.moved = Moved::default();
        self.others += 1;
        self.measuring.forget();
        self.touch();
    }

    /// What was asked for is to be seen at once: as a wipe, unless both share the window already.
    pub(in crate::viewer) fn show_somehow(&mut self, context: &mut ComparisonContext<'_>) {
        if self.arrangement == Arrangement::Alone {
            self.arrange(Arrangement::Wipe, context);
        }
    }
}
