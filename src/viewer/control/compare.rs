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
        self.ab.other.as_ref()
    }

    /// How A and B share the window.
    pub fn arrangement(&self) -> Arrangement {
        match self.ab.other {
            Some(_) => self.ab.arrangement,
            None => Arrangement::Alone,
        }
    }

    /// How differences are shown.
    pub fn difference_style(&self) -> DifferenceStyle {
        self.ab.style
    }

    /// Whether B stands where A else does.
    pub fn is_swapped(&self) -> bool {
        self.ab.swapped
    }

    /// What shown differences are multiplied with; `None` while they are not to be seen.
    pub fn difference_gain(&self) -> Option<f32> {
        Some(self.ab.paint.as_ref()?.colors.gain())
    }

    /// Carries out a command; what is explained stays in sight.
    pub(in crate::viewer) fn apply_ab(&mut self, command: AbCommand) {
        let panes = self.explains().then(|| self.panes());
        self.change_ab(command);
        if panes.is_some_and(|before| before != self.panes()) {
            self.keep_explained_pin_in_sight();
        }
        self.ab.touch();
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
                self.ab.wipe = Some(part.clamp(0.0, 1.0));
                self.arrange(Arrangement::Wipe);
            }
            AbCommand::SetMeasure(measure) => {
                self.ab.style.measure = measure;
                self.arrange(Arrangement::Difference);
            }
            AbCommand::SetGain(gain) => {
                self.ab.gain = gain.clamp(GAINS[0], GAINS[1]);
                self.ab.style.gain = Gain::Factor(self.ab.gain);
                self.arrange(Arrangement::Difference);
            }
            AbCommand::StepGain(steps) => self.step_gain(steps),
            AbCommand::NextDifference => self.next_difference(),
            AbCommand::Normalize(toggle) => {
                let before = self.ab.style.gain == Gain::Normalize && self.arrangement() == Arrangement::Difference;
                self.ab.style.gain = if toggle.of(before) {
                    Gain::Normalize
                } else {
                    Gain::Factor(self.ab.gain)
                };
                self.arrange(Arrangement::Difference);
            }
        }
    }

    /// Closes what both share the window in; true if there was such.
    pub(in crate::viewer) fn escape_arrangement(&mut self) -> bool {
        let shared = self.ab.shows_both();
        if shared {
            self.arrange(Arrangement::Alone);
            self.ab.swapped = false;
            self.ab.touch();
        }
        shared
    }

    /// Forgets B; true if there was one.
    pub(in crate::viewer) fn escape_comparison(&mut self) -> bool {
        let open = self.ab.other.is_some();
        if open {
            self.compare(Against::Nothing);
            self.ab.touch();
        }
        open
    }

    fn swap_ab(&mut self) {
        match &mut self.ab.other {
            Some(Other::Settings { render, dialect }) => {
                std::mem::swap(&mut self.settings.render, render);
                std::mem::swap(&mut self.settings.dialect, dialect);
                if self.own_dialect_of_b().is_some()
                    && let Some(entry) = self.scene_list.scenes.get_mut(self.scene_list.current)
                {
                    std::mem::swap(&mut entry.state, &mut entry.other_state);
                }
                self.swap_frames();
            }
            Some(Other::Truth(_) | Other::Picture(_)) => {
                self.ab.swapped = !self.ab.swapped;
                self.ab.swaps += 1;
            }
            // A picture that is being read becomes B.
            None if self.ab.loading.is_some() => {}
            None => self.compare(Against::Settings),
        }
    }

    pub(in crate::viewer) fn compare(&mut self, against: Against) {
        // The newest request counts.
        self.ab.loading = None;
        match against {
            Against::Settings => {
                self.set_other(Some(Other::with(&self.settings)));
                self.chrome.messages.done(
                    "B keeps these settings; now change A with its keys. R swaps both, W wipes, D shows the difference"
                        .to_owned(),
                );
            }
            Against::Changed(changes) => {
                let mut other = self.settings;
                let remarks = changes.iter().filter_map(|change| change.apply(&mut other));
                remarks.for_each(|remark| self.chrome.messages.error(remark));
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
                self.ab.arrangement = Arrangement::Alone;
            }
        }
    }

    pub(in crate::viewer) fn set_other(&mut self, other: Option<Other>) {
        self.ab.other = other;
        self.ab.swapped = false;
        self.ab.held = None;
        self.ab.moved = Moved::default();
        self.ab.others += 1;
        self.ab.measuring.forget();
        self.ab.touch();
    }

    pub(in crate::viewer) fn arrange(&mut self, arrangement: Arrangement) {
        let is_without = self.ab.other.is_none() && self.ab.loading.is_none();
        if arrangement != Arrangement::Alone && is_without {
            self.compare(Against::Settings);
        }
        self.ab.arrangement = arrangement;
        self.ab.flip = None;
        self.ab.held = None;
        self.ab.drags_line = false;
    }

    fn step_gain(&mut self, steps: i32) {
        // From what is to be seen: a normalised gain, too.
        let gain = self.difference_gain().unwrap_or(self.ab.gain);
        let gain = gain * 2.0_f32.powi(steps.clamp(-40, 40));
        self.ab.gain = gain.clamp(GAINS[0], GAINS[1]);
        self.ab.style.gain = Gain::Factor(self.ab.gain);
        self.arrange(Arrangement::Difference);
    }
}
