//! What commands do to a comparison.

use super::super::{Command, Viewer};
use super::{Against, Arrangement, Comparison, Measuring, Moved, Other};
use crate::compare::{DifferenceStyle, Gain};
use crate::viewer::background::Mailbox;
use crate::viewer::state::Finished;

/// The smallest and the largest gain.
const GAINS: [f32; 2] = [1e-6, 1e6];
/// Window pixels on either side of the line of a wipe where a press takes hold of it, at a pixel zoom of 1.
const GRIP: f64 = 6.0;

impl Comparison {
    pub(in super::super) fn new(mailbox: Mailbox<Finished>) -> Self {
        Self {
            other: None,
            arrangement: Arrangement::Alone,
            style: DifferenceStyle::default(),
            gain: 1.0,
            wipe: 0.5,
            drags_line: false,
            flip: None,
            mailbox,
            drawing: None,
            held: None,
            paint: None,
            swapped: false,
            postponed: None,
            loading: None,
            moved: Moved::default(),
            others: 0,
            swaps: 0,
            measuring: Measuring::default(),
            number: 0,
        }
    }
}

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

    /// Commands about comparing; the others come back. What is explained stays in sight.
    pub(in super::super) fn change_comparison(&mut self, command: Command) -> Option<Command> {
        let panes = self.explains().then(|| self.panes());
        if let Some(command) = self.change_ab(command) {
            return Some(command);
        }
        if panes.is_some_and(|before| before != self.panes()) {
            self.keep_explained_pin_in_sight();
        }
        self.comparison.touch();
        None
    }

    fn change_ab(&mut self, command: Command) -> Option<Command> {
        match command {
            Command::SwapAb => self.swap_ab(),
            Command::Compare(against) => self.compare(against),
            Command::Arrange(arrangement) => self.arrange(arrangement),
            Command::ToggleArrangement(arrangement) => {
                let shown = self.arrangement() == arrangement;
                self.arrange(if shown { Arrangement::Alone } else { arrangement });
            }
            Command::FlipByHand => self.flip_by_hand(),
            Command::SetWipe(part) if part.is_finite() => {
                self.comparison.wipe = part.clamp(0.0, 1.0);
                self.arrange(Arrangement::Wipe);
            }
            Command::SetMeasure(measure) => {
                self.comparison.style.measure = measure;
                self.arrange(Arrangement::Difference);
            }
            Command::SetGain(gain) if gain.is_finite() => {
                self.comparison.gain = gain.clamp(GAINS[0], GAINS[1]);
                self.comparison.style.gain = Gain::Factor(self.comparison.gain);
                self.arrange(Arrangement::Difference);
            }
            Command::StepGain(steps) => self.step_gain(steps),
            Command::NextDifference => self.next_difference(),
            Command::Normalize(toggle) => {
                let before =
                    self.comparison.style.gain == Gain::Normalize && self.arrangement() == Arrangement::Difference;
                self.comparison.style.gain = if toggle.of(before) {
                    Gain::Normalize
                } else {
                    Gain::Factor(self.comparison.gain)
                };
                self.arrange(Arrangement::Difference);
            }
            command => return Some(command),
        }
        None
    }

    /// Closes what both share the window in; true if there was such.
    pub(in super::super) fn escape_arrangement(&mut self) -> bool {
        let shared = self.comparison.shows_both();
        if shared {
            self.arrange(Arrangement::Alone);
            self.comparison.swapped = false;
            self.comparison.touch();
        }
        shared
    }

    /// Forgets B; true if there was one.
    pub(in super::super) fn escape_comparison(&mut self) -> bool {
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

    pub(in super::super) fn compare(&mut self, against: Against) {
        // The newest wish counts.
        self.comparison.loading = None;
        match against {
            Against::Settings => {
                self.set_other(Some(self.settings_as_other()));
                self.messages.done(
                    "B keeps these settings; now change A with its keys. R swaps both, W wipes, D shows the difference"
                        .to_owned(),
                );
            }
            Against::Changed(changes) => {
                let own = self.settings;
                for change in changes {
                    self.change_sampling(change);
                }
                let other = self.settings_as_other();
                self.settings = own;
                self.set_other(Some(other));
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

    /// A's settings, for B.
    fn settings_as_other(&self) -> Other {
        Other::Settings {
            render: self.settings.render,
            dialect: self.settings.dialect,
        }
    }

    pub(super) fn set_other(&mut self, other: Option<Other>) {
        self.comparison.other = other;
        self.comparison.swapped = false;
        self.comparison.held = None;
        self.comparison.moved = Moved::default();
        self.comparison.others += 1;
        self.comparison.measuring.forget();
        self.comparison.touch();
    }

    pub(in super::super) fn arrange(&mut self, arrangement: Arrangement) {
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

    /// Takes hold of the line of the wipe where the pointer is on it.
    pub(in super::super) fn take_line(&mut self) -> bool {
        self.comparison.drags_line = self.pointer_over_line();
        self.comparison.drags_line
    }

    /// Whether the pointer is on the line of the wipe, or drags it.
    pub fn pointer_over_line(&self) -> bool {
        let near = |(line, at): (f64, glam::DVec2)| (at.x - line).abs() <= GRIP;
        let over = self.wipe_line().zip(self.pointer.at).is_some_and(near);
        self.comparison.drags_line || (over && !self.pointer_over_inset())
    }

    /// The line follows the pointer at `x`, in window pixels from the left.
    pub(in super::super) fn drag_line(&mut self, x: f64) {
        let x = self.in_sight_of_line(x);
        let zoom = f64::from(self.settings.pixel_zoom.factor());
        let panes = self.panes();
        let corner = panes.first.corner[0] as f64;
        let part = (x / zoom - corner) / f64::from(panes.frame[0].max(1));
        self.comparison.wipe = part.clamp(0.0, 1.0);
        self.comparison.touch();
    }
}
