//! What commands do to a comparison.

use crate::compare::{DifferenceStyle, Gain};
use crate::viewer::AbCommand;
use crate::viewer::ab::other::{Against, Arrangement, Other};
use crate::viewer::state::Viewer;
use crate::viewer::view::panes::Moved;

/// The smallest and the largest gain.
const GAINS: [f32; 2] = [1e-6, 1e6];

impl Viewer {
    /// What A is compared with.
    pub fn other(&self) -> Option<&Other> {
        self.comparison.other.as_ref()
    }

    /// How A and B share the window.
    pub fn arrangement(&self) -> Arrangement {
        match self.comparison.other {
            Some(_) => self.comparison.arrangement,
            None => Arrangement::Alone,
        }
    }

    /// How differences are shown.
    pub fn difference_style(&self) -> DifferenceStyle {
        self.comparison.style
    }

    /// Whether B stands where A else does.
    pub fn is_swapped(&self) -> bool {
        self.comparison.swapped
    }

    /// What shown differences are multiplied with; `None` while they are not to be seen.
    pub fn difference_gain(&self) -> Option<f32> {
        Some(self.comparison.paint.as_ref()?.colors.gain())
    }

    /// Carries out a command; what is explained stays in sight.
    pub(in crate::viewer) fn apply_ab(&mut self, command: AbCommand) {
        let panes = self.explains().then(|| self.panes());
        self.change_ab(command);
        if panes.is_some_and(|before| before != self.panes()) {
            self.keep_explained_pin_in_sight();
        }
        self.comparison.touch();
    }

    fn change_ab(&mut self, command: AbCommand) {
        match command {
            AbCommand::Swap => self.swap_ab(),
            AbCommand::Compare(against) => self.compare(against),
            AbCommand::Arrange(arrangement) => self.arrange(arrangement),
            AbCommand::ToggleArrangement(arrangement) => {
                let shown = self.arrangement() == arrangement;
                self.arrange(if shown { Arrangement::Alone } else { arrangement });
            }
            AbCommand::FlipByHand => self.flip_by_hand(),
            AbCommand::SetWipe(part) if !part.is_finite() => {}
            AbCommand::SetGain(gain) if !gain.is_finite() => {}
            AbCommand::SetWipe(part) => {
                self.comparison.wipe = part.clamp(0.0, 1.0);
                self.arrange(Arrangement::Wipe);
            }
            AbCommand::SetMeasure(measure) => {
                self.comparison.style.measure = measure;
                self.arrange(Arrangement::Difference);
            }
            AbCommand::SetGain(gain) => {
                self.comparison.gain = gain.clamp(GAINS[0], GAINS[1]);
                self.comparison.style.gain = Gain::Factor(self.comparison.gain);
                self.arrange(Arrangement::Difference);
            }
            AbCommand::StepGain(steps) => self.step_gain(steps),
            AbCommand::NextDifference => self.next_difference(),
            AbCommand::Normalize(toggle) => {
                let before =
                    self.comparison.style.gain == Gain::Normalize && self.arrangement() == Arrangement::Difference;
                self.comparison.style.gain = if toggle.of(before) {
                    Gain::Normalize
                } else {
                    Gain::Factor(self.comparison.gain)
                };
                self.arrange(Arrangement::Difference);
            }
        }
    }

    /// Closes what both share the window in; true if there was such.
    pub(in crate::viewer) fn escape_arrangement(&mut self) -> bool {
        let shared = self.comparison.shows_both();
        if shared {
            self.arrange(Arrangement::Alone);
            self.comparison.swapped = false;
            self.comparison.touch();
        }
        shared
    }

    /// Forgets B; true if there was one.
    pub(in crate::viewer) fn escape_comparison(&mut self) -> bool {
        let open = self.comparison.other.is_some();
        if open {
            self.compare(Against::Nothing);
            self.comparison.touch();
        }
        open
    }

    fn swap_ab(&mut self) {
        match &mut self.comparison.other {
            Some(Other::Settings { render, dialect }) => {
                std::mem::swap(&mut self.settings.render, render);
                std::mem::swap(&mut self.settings.dialect, dialect);
                if self.own_dialect_of_b().is_some()
                    && let Some(entry) = self.scenes.get_mut(self.current)
                {
                    std::mem::swap(&mut entry.state, &mut entry.other_state);
                }
                self.swap_frames();
            }
            Some(Other::Truth(_) | Other::Picture(_)) => {
                self.comparison.swapped = !self.comparison.swapped;
                self.comparison.swaps += 1;
            }
            // A picture that is being read becomes B.
            None if self.comparison.loading.is_some() => {}
            None => self.compare(Against::Settings),
        }
    }

    pub(in crate::viewer) fn compare(&mut self, against: Against) {
        // The newest request counts.
        self.comparison.loading = None;
        match against {
            Against::Settings => {
                self.set_other(Some(Other::with(&self.settings)));
                self.messages.done(
                    "B keeps these settings; now change A with its keys. R swaps both, W wipes, D shows the difference"
                        .to_owned(),
                );
            }
            Against::Changed(changes) => {
                let mut other = self.settings;
                let remarks = changes.iter().filter_map(|change| change.apply(&mut other));
                remarks.for_each(|remark| self.messages.error(remark));
                self.set_other(Some(Other::with(&other)));
                self.show_somehow();
            }
            Against::Truth(resolve) => {
                self.set_other(Some(Other::Truth(resolve)));
                self.show_somehow();
            }
            Against::File(path) => self.load_picture(path),
            Against::Nothing => {
                self.set_other(None);
                self.comparison.arrangement = Arrangement::Alone;
            }
        }
    }

    pub(in crate::viewer) fn set_other(&mut self, other: Option<Other>) {
        self.comparison.other = other;
        self.comparison.swapped = false;
        self.comparison.held = None;
        self.comparison.moved = Moved::default();
        self.comparison.others += 1;
        self.comparison.measuring.forget();
        self.comparison.touch();
    }

    pub(in crate::viewer) fn arrange(&mut self, arrangement: Arrangement) {
        let is_without = self.comparison.other.is_none() && self.comparison.loading.is_none();
        if arrangement != Arrangement::Alone && is_without {
            self.compare(Against::Settings);
        }
        self.comparison.arrangement = arrangement;
        self.comparison.flip = None;
        self.comparison.held = None;
        self.comparison.drags_line = false;
    }

    fn step_gain(&mut self, steps: i32) {
        // From what is to be seen: a normalised gain, too.
        let gain = self.difference_gain().unwrap_or(self.comparison.gain);
        let gain = gain * 2.0_f32.powi(steps.clamp(-40, 40));
        self.comparison.gain = gain.clamp(GAINS[0], GAINS[1]);
        self.comparison.style.gain = Gain::Factor(self.comparison.gain);
        self.arrange(Arrangement::Difference);
    }
}
