//! How a command stands now, for menus: whether what it switches is on, and why it would do nothing.

use crate::compare::Gain;
use crate::viewer::{
    AbCommand, Arrangement, BoardCommand, Command, CommandSpec, ExportCommand, InspectorCommand, LessonCommand, Other,
    SceneCommand, SceneEntry, ViewCommand, Viewer, WindowCommand, picture,
};

/// Why commands about lessons would do nothing.
const NO_LESSON: &str = "No lesson is open";

/// How a command stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Standing {
    /// Whether what it switches is on.
    pub(super) is_on: bool,
    /// Why it would change nothing; `None` where it would.
    pub(super) idle: Option<&'static str>,
}

/// That of a command in the state of `viewer`.
pub(super) fn of(viewer: &Viewer, command: &Command) -> Standing {
    Standing {
        is_on: is_on(viewer, command),
        idle: idle(viewer, command),
    }
}

/// That of a command that asks for its argument first.
pub(super) fn of_asking(viewer: &Viewer, spec: &CommandSpec) -> Standing {
    let needs_lesson = spec.id == "lesson-step";
    Standing {
        is_on: false,
        idle: (needs_lesson && viewer.lesson().is_none()).then_some(NO_LESSON),
    }
}

fn is_on(viewer: &Viewer, command: &Command) -> bool {
    let (chrome, ab) = (viewer.chrome(), viewer.ab());
    match command {
        Command::Ab(command) => match command {
            AbCommand::ToggleArrangement(arrangement) => ab.arrangement() == *arrangement,
            AbCommand::FlipByHand => ab.shows_b(),
            AbCommand::Normalize(_) => ab.difference_style().gain == Gain::Normalize,
            AbCommand::Compare(_) => matches!(ab.other(), Some(Other::Truth(_))),
            _ => false,
        },
        Command::View(ViewCommand::Progressive(_)) => viewer.settings().progressive,
        Command::Inspector(InspectorCommand::Show(_)) => viewer.inspector().magnifier().open,
        Command::Inspector(InspectorCommand::Explanation(_)) => viewer.pixels().has_explanation_open(),
        Command::Profile(_) => viewer.profile().is_open(),
        Command::Board(BoardCommand::Show(_)) => viewer.board().is_open(),
        Command::Spectrum(_) => viewer.spectrum().is_open(),
        Command::Scenes(SceneCommand::FollowFiles(_)) => viewer.scene_list().follows_files(),
        Command::Window(command) => match command {
            WindowCommand::OverlayText(_) => chrome.overlay_text(),
            WindowCommand::HideEverything(_) => chrome.everything_hidden(),
            WindowCommand::Panel(_) => chrome.panel(),
            WindowCommand::About(_) => chrome.about(),
            WindowCommand::StartCard(_) => chrome.start_card(),
            WindowCommand::Presenter(_) => chrome.presenter(),
            WindowCommand::SetInterfaceScale(scale) => chrome.interface_scale() == *scale,
            _ => false,
        },
        _ => false,
    }
}

fn idle(viewer: &Viewer, command: &Command) -> Option<&'static str> {
    let ab = viewer.ab();
    let (is_idle, why) = match command {
        Command::Ab(AbCommand::NextDifference) => (ab.other().is_none(), "There is no B yet"),
        Command::Ab(AbCommand::StepGain(_)) => (
            ab.arrangement() != Arrangement::Difference,
            "The difference is not shown",
        ),
        Command::Lesson(LessonCommand::Close) => (viewer.lesson().is_none(), NO_LESSON),
        Command::Scenes(SceneCommand::Next) => match viewer.lesson() {
            Some((lesson, at)) => (at + 1 == lesson.steps.len(), "This is the last step"),
            None => (viewer.scene_list().scenes().len() < 2, "There is no other scene"),
        },
        Command::Scenes(SceneCommand::Previous) => match viewer.lesson() {
            Some((_, at)) => (at == 0, "This is the first step"),
            None => (viewer.scene_list().scenes().len() < 2, "There is no other scene"),
        },
        Command::SetDefaults => (
            picture::are_defaults(viewer.settings()),
            "Every setting has its default",
        ),
        Command::Scenes(SceneCommand::GiveUpReading) => {
            let reading = viewer.scene_list().current().and_then(SceneEntry::long_reading);
            (reading.is_none(), "Nothing is read that takes long")
        }
        Command::Inspector(InspectorCommand::Unpin) => (viewer.pixels().pinned().is_none(), "No pixel is pinned"),
        Command::Inspector(InspectorCommand::StepMagnification(_))
        | Command::Export(ExportCommand::CopyExplanation) => {
            (!viewer.inspector().magnifier().open, "The pixel inspector is closed")
        }
        Command::Window(WindowCommand::About(_)) => (
            viewer.scene_list().words().is_none(),
            "This scene says nothing about itself",
        ),
        Command::Window(WindowCommand::StepInterfaceScale { up }) => {
            let now = viewer.chrome().interface_scale();
            (now.step(*up) == now, "There is no such size")
        }
        _ => (false, ""),
    };
    is_idle.then_some(why)
}
