//! The room of a small window: when the side panel folds by itself, and when it makes way for an explanation.

use super::Session;
use crate::app::interface::Interface;
use crate::viewer::{Arrangement, Command, MessageKind, NO_ROOM, PointerButton, Toggle};
use crate::viewer::{InspectorCommand, PointerCommand, WindowCommand};

/// What the session does to the side panel by itself.
#[expect(
    clippy::struct_excessive_bools,
    reason = "three things that are so or not, each on its own"
)]
#[derive(Clone, Copy, Debug)]
pub(super) struct PanelRoom {
    /// The panel folds by itself until the user says what he wants.
    follows: bool,
    /// It made way for an explanation and comes back after that.
    gave_way: bool,
    /// Before the last command, the panel left no room for an explanation that is not closed.
    hid_explanation: bool,
}

/// The least window in points that panels make sense in: a larger interface stops there. Lists of the menu, three of which may
/// be open, lie beside each other in it.
const LEAST_WINDOW: [f32; 2] = [520.0, 390.0];
/// What is said where the text of a lesson has no room.
const NO_LESSON: &str = "no room here for the text of the lesson: make the window wider";
/// What is said where the pixel inspector is hidden between panels.
const NO_INSPECTOR: &str = "no room here for the pixel inspector: close the panel, or make the window wider";
/// What is said where the panel of a comparison has no room.
const NO_NUMBERS: &str = "no room here for numbers and colours of the difference: make the window wider";

/// What a command asks to be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    Panel,
    Explanation,
    Neither,
}

/// What a command asks for by hand that may have no room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asks {
    /// Why a pixel has its colour.
    Why,
    /// The text of a lesson.
    Lesson,
    /// A size of the interface.
    Size,
    /// A difference with its numbers.
    Difference,
    Nothing,
}

impl Default for PanelRoom {
    fn default() -> Self {
        Self {
            follows: true,
            gave_way: false,
            hid_explanation: false,
        }
    }
}

impl PanelRoom {
    /// Whether the user wants a panel that is `open` or made way; `None` while it folds by itself.
    pub(super) fn choice(self, open: bool) -> Option<bool> {
        (!self.follows).then_some(open || self.gave_way)
    }
}

impl Wanted {
    /// Jumps to another pixel do not ask why it has its colour: who steps through differences wants the panel to stay.
    fn of(command: &Command) -> Self {
        match command {
            Command::Window(WindowCommand::Panel(_)) => Self::Panel,
            Command::Inspector(
                InspectorCommand::PinUnderPointer
                | InspectorCommand::PinEdge
                | InspectorCommand::Pin(_)
                | InspectorCommand::Explanation(_),
            )
            | Command::Pointer(PointerCommand::Pressed(PointerButton::Secondary)) => Self::Explanation,
            _ => Self::Neither,
        }
    }
}

impl Session {
    /// Folds the side panel where it would reach into the default view's canvas, and while a lesson is open, which has what
    /// is needed in its text; until the user decides.
    pub(super) fn fold_panel(&mut self) {
        let size = self
            .viewer
            .chrome()
            .window_size()
            .map(|side| side as f32 / self.scale());
        let fits = Interface::panel_fits(size) && self.viewer.lesson().is_none();
        // Whoever opened the panel did so for a picture: beside a lesson there would be next to none of it.
        let is_crowded = self.interface.lesson_crowds_panel(&self.viewer, size[0]);
        if (self.room.follows && fits != self.viewer.chrome().panel()) || (is_crowded && self.viewer.chrome().panel()) {
            let to = if fits && !is_crowded { Toggle::On } else { Toggle::Off };
            self.apply(Command::Window(WindowCommand::Panel(to)));
        }
    }

    /// What a command asks for, and the command that shows it: one that goes by what is to be seen takes an explanation
    /// that the panel or the text of a lesson hides for closed.
    pub(super) fn wanted(&mut self, command: Command) -> (Wanted, Command) {
        let wanted = Wanted::of(&command);
        self.room.follows &= wanted != Wanted::Panel;
        let is_hidden = self.viewer.chrome().panel() && self.viewer.pixels().has_explanation_open() && self.is_narrow();
        self.room.hid_explanation = is_hidden;
        let is_unseen = is_hidden || self.is_page_not_turned();
        match command {
            Command::Inspector(InspectorCommand::Explanation(Toggle::Flip)) if is_unseen => {
                (wanted, Command::Inspector(InspectorCommand::Explanation(Toggle::On)))
            }
            command => (wanted, command),
        }
    }

    /// Lets the side panel and the explanation make way for each other where both have no room: what was wanted last is
    /// to be seen. A panel that made way comes back, unless it would cover the pinned pixel.
    pub(super) fn share_room(&mut self, wanted: Wanted) {
        let (panel, explains) = (
            self.viewer.chrome().panel(),
            self.viewer.pixels().has_explanation_open(),
        );
        let is_narrow = self.is_narrow();
        match wanted {
            Wanted::Panel => {
                self.room.gave_way = false;
                // Who closes the panel wants the picture, not what the panel hid.
                if is_narrow && explains && (panel || self.room.hid_explanation) {
                    self.apply(Command::Inspector(InspectorCommand::Explanation(Toggle::Off)));
                }
            }
            Wanted::Explanation if is_narrow && panel && explains => {
                self.room.gave_way = true;
                self.apply(Command::Window(WindowCommand::Panel(Toggle::Off)));
            }
            _ if self.room.gave_way
                && !self.viewer.pixels().is_dragging()
                && !self.viewer.chrome().everything_hidden() =>
            {
                let width = self.viewer.chrome().window_size()[0] as f32 / self.scale();
                let is_free = !explains && self.interface.panel_leaves_pin(&self.viewer, width, self.scale());
                if is_free || !is_narrow {
                    self.room.gave_way = false;
                    self.apply(Command::Window(WindowCommand::Panel(Toggle::On)));
                }
            }
            _ => {}
        }
    }

    /// Device pixels per point as the user wants them.
    pub(super) fn wanted_scale(&self) -> f32 {
        self.native_scale * self.viewer.chrome().interface_factor()
    }

    /// As many as the window has room for.
    pub(super) fn largest_scale(&self) -> f32 {
        let [width, height] = self.viewer.chrome().window_size().map(|side| side as f32);
        let largest = (width / LEAST_WINDOW[0]).min(height / LEAST_WINDOW[1]);
        largest.max(self.native_scale)
    }

    /// Takes back what was said about missing room for something that has room now, or is no longer wanted.
    pub(super) fn take_back_missing_room(&mut self) {
        if self.viewer.chrome().messages().is_empty() {
            return;
        }
        let (viewer, interface) = (&self.viewer, &self.interface);
        let width = viewer.chrome().window_size()[0] as f32 / self.scale();
        let explains = viewer.pixels().has_explanation_open();
        let compares = viewer.ab().other().is_some() && viewer.ab().arrangement() == Arrangement::Difference;
        let is_settled = [
            (
                NO_LESSON,
                viewer.lesson().is_none() || interface.has_room_for_lesson(viewer, width),
            ),
            (NO_NUMBERS, !compares || interface.has_room_to_compare(viewer, width)),
            (NO_INSPECTOR, !viewer.inspector().lacks_room()),
            (NO_ROOM, !explains || interface.has_room_to_explain(viewer, width)),
        ];
        for (words, _) in is_settled.into_iter().filter(|(_, is_settled)| *is_settled) {
            let is_told = |message: &crate::viewer::Message| message.text == words;
            if self.viewer.chrome().messages().iter().any(is_told) {
                self.viewer.retract(words);
            }
        }
    }

    /// Tells that the pixel inspector hides now: it had room before.
    pub(super) fn tell_no_inspector(&mut self) {
        if self.viewer.inspector().lacks_room() {
            self.viewer.tell(MessageKind::Done, NO_INSPECTOR.to_owned());
        }
    }

    /// Tells whoever asked for something that there is no room for it.
    pub(super) fn tell_missing_room(&mut self, asks: Asks, wanted: Wanted) {
        match asks {
            Asks::Why => self.tell_no_room(wanted),
            Asks::Lesson => self.tell_no_lesson(),
            Asks::Size => self.tell_largest(),
            Asks::Difference => self.tell_no_numbers(),
            Asks::Nothing => {}
        }
    }

    /// Tells whoever asked why a pixel has its colour that there is no room for the answer.
    fn tell_no_room(&mut self, wanted: Wanted) {
        let width = self.viewer.chrome().window_size()[0] as f32 / self.scale();
        let asks = wanted == Wanted::Explanation && self.viewer.pixels().has_explanation_open();
        if asks && !self.interface.has_room_to_explain(&self.viewer, width) {
            self.viewer.tell(MessageKind::Done, NO_ROOM.to_owned());
        }
    }

    /// Tells whoever looks at a difference beside the open panel that there is no room for its numbers and colours.
    fn tell_no_numbers(&mut self) {
        let (viewer, width) = (
            &self.viewer,
            self.viewer.chrome().window_size()[0] as f32 / self.scale(),
        );
        let is_seen = viewer.ab().other().is_some() && viewer.ab().arrangement() == Arrangement::Difference;
        let has_panel = viewer.chrome().panel() && !viewer.chrome().everything_hidden();
        if is_seen && has_panel && !self.interface.has_room_to_compare(viewer, width) {
            self.viewer.tell(MessageKind::Done, NO_NUMBERS.to_owned());
        }
    }

    /// Tells whoever wants a larger interface than the window has room for how large it is.
    fn tell_largest(&mut self) {
        if self.wanted_scale() > self.largest_scale() {
            let [wanted, is] =
                [self.wanted_scale(), self.largest_scale()].map(|scale| 100.0 * scale / self.native_scale);
            let words = format!("interface at {is:.0} %, not {wanted:.0} %: this window has room for no more");
            self.viewer.tell(MessageKind::Done, words);
        }
    }

    /// Tells whoever goes on in a lesson that there is no room for its text.
    fn tell_no_lesson(&mut self) {
        let width = self.viewer.chrome().window_size()[0] as f32 / self.scale();
        if self.viewer.lesson().is_some() && !self.interface.has_room_for_lesson(&self.viewer, width) {
            self.viewer.tell(MessageKind::Done, NO_LESSON.to_owned());
        }
    }

    /// Whether a lesson's text is open where the explanation is the other page of its panel.
    fn is_page_not_turned(&self) -> bool {
        let width = self.viewer.chrome().window_size()[0] as f32 / self.scale();
        let is_shared = self.interface.lesson_shares_panel(&self.viewer, width);
        is_shared && self.viewer.pixels().has_explanation_open() && !self.viewer.inspector().asks_about_pixel()
    }

    /// Whether the window has room for the explanation only without the side panel.
    fn is_narrow(&self) -> bool {
        let [width, _] = self.viewer.chrome().window_size();
        self.interface
            .explanation_needs_panel(&self.viewer, width as f32 / self.scale())
    }
}
