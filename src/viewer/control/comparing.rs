//! What commands about A and B change.

use crate::viewer::AbCommand;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::{Against, Other};
use crate::viewer::ab::requests::{ComparisonContext, KEPT, UNSEEN};
use crate::viewer::chrome::messages::Messages;
use crate::viewer::export::saver::Saver;
use crate::viewer::frames::state::Frames;
use crate::viewer::library::state::SceneList;
use crate::viewer::settings::Settings;

/// A and B, and what changes places where they do.
#[derive(Debug)]
pub(in crate::viewer) struct Comparing<'a> {
    pub(in crate::viewer) settings: &'a mut Settings,
    pub(in crate::viewer) messages: &'a mut Messages,
    pub(in crate::viewer) scene_list: &'a mut SceneList,
    pub(in crate::viewer) frames: &'a mut Frames,
    pub(in crate::viewer) ab: &'a mut Comparison,
    pub(in crate::viewer) saver: &'a mut Saver,
}

impl Comparing<'_> {
    pub(in crate::viewer) fn apply(&mut self, command: AbCommand) {
        self.messages.retract(KEPT);
        self.messages.retract(UNSEEN);
        let context = &mut ComparisonContext {
            settings: self.settings,
            messages: self.messages,
        };
        match command {
            AbCommand::Swap => self.swap(),
            AbCommand::Compare(against) => self.ab.compare(against, context),
            AbCommand::Arrange(arrangement) => self.ab.arrange(arrangement, context),
            AbCommand::ToggleArrangement(arrangement) => self.ab.toggle_arrangement(arrangement, context),
            AbCommand::FlipByHand => self.ab.flip_by_hand(context),
            AbCommand::SetWipe(part) => self.ab.set_wipe(part, context),
            AbCommand::SetMeasure(measure) => self.ab.set_measure(measure, context),
            AbCommand::SetGain(gain) => self.ab.set_gain(gain, context),
            AbCommand::StepGain(steps) => self.ab.step_gain(steps, context),
            AbCommand::NextDifference => self.ab.want_next_difference(context),
            AbCommand::Normalize(toggle) => self.ab.normalize(toggle, context),
            AbCommand::SetTruthSpace(space) => self.ab.set_truth_space(space),
        }
    }

    /// A and B change places; without B it becomes a copy of A.
    fn swap(&mut self) {
        match &mut self.ab.other {
            Some(Other::Settings { render, dialect }) => {
                std::mem::swap(&mut self.settings.render, render);
                std::mem::swap(&mut self.settings.dialect, dialect);
                if self.ab.own_dialect_of_b(self.settings).is_some()
                    && let Some(entry) = self.scene_list.current_mut()
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
            None => {
                let mut context = ComparisonContext {
                    settings: self.settings,
                    messages: self.messages,
                };
                self.ab.compare(Against::Settings, &mut context);
            }
        }
    }

    fn swap_frames(&mut self) {
        if let Some(drawing) = &mut self.ab.drawing {
            std::mem::swap(&mut self.frames.drawing, drawing);
        }
        if let Some([a, b]) = &mut self.ab.held {
            std::mem::swap(a, b);
        }
        self.ab.swaps += 1;
        self.ab.touch();
        // The picture that screenshots wait for is another one now.
        self.saver.since = self.frames.drawing.newest_request();
    }
}
