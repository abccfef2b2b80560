//! One step back: what a single press took away comes back by the button of its message.

use crate::viewer::chrome::messages::MessageKind;
use crate::viewer::settings::picture;
use crate::viewer::state::{TakenAway, Viewer};

/// What is said of settings that a press set back.
const DEFAULTS: &str = "every setting of sampling and textures has its default";
/// What is said of a board that a press cleared.
const CLEARED: &str = "the board is cleared";

impl Viewer {
    /// Brings every setting of sampling and textures back to its default.
    pub(in crate::viewer) fn set_defaults(&mut self) {
        if !picture::are_defaults(&self.settings) {
            let before = self.settings.render;
            picture::reset(&mut self.settings);
            self.offer_back(TakenAway::Settings(before), DEFAULTS);
        }
    }

    /// Removes all tiles from the board.
    pub(in crate::viewer) fn clear_board(&mut self) {
        let before = std::mem::take(&mut self.board.entries);
        if !before.is_empty() {
            self.offer_back(TakenAway::Board(before), CLEARED);
        }
    }

    /// There is one step back: messages about others go.
    fn offer_back(&mut self, taken: TakenAway, words: &str) {
        self.retract_offer();
        self.chrome.messages.add(MessageKind::TakenAway, words.to_owned());
        self.taken_away = Some(taken);
    }

    fn retract_offer(&mut self) {
        for words in [DEFAULTS, CLEARED] {
            self.chrome.messages.retract(words);
        }
    }

    /// Brings back what was taken away last, where it was not brought back already.
    pub(in crate::viewer) fn bring_back(&mut self) {
        match self.taken_away.take() {
            Some(TakenAway::Settings(before)) => self.settings.render = before,
            Some(TakenAway::Board(before)) => {
                let newer = std::mem::replace(&mut self.board.entries, before);
                // One that is there already, or has no room, was added after the board had been cleared.
                for entry in newer {
                    let _ = self.board.add(entry);
                }
            }
            None => {}
        }
        self.retract_offer();
    }
}
