//! The lines of the command table, in the order of help and menus.

use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::chrome::Dialog;
use crate::viewer::command::arguments::Argument;
use crate::viewer::command::spec::{Action, CommandSpec, Group};
use crate::viewer::command::{Command, arguments};
use crate::viewer::keys::{Chord, Key, Modifiers};
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::settings::Toggle;
use crate::viewer::{
    AbCommand, ExportCommand, InspectorCommand, LessonCommand, SceneCommand, SheetCommand, ViewCommand, WindowCommand,
};

/// Degrees that one press of a key turns the picture.
const TURN: f64 = 5.0;

/// What one press of a key zooms by.
const ZOOM_STEP: f64 = 1.25;

/// Pixels that an arrow moves the pin by with Shift.
const FAR: i64 = 10;

/// Every command that a key, the palette or a script can name.
pub(in crate::viewer) static TABLE: &[CommandSpec] = &[
    // View.
    spec(
        "reset-view",
        "Reset view",
        "Shows the whole canvas, upright, with a margin",
        Group::View,
    )
    .keys(&[Chord::named(Key::Space)])
    .run(&Command::View(ViewCommand::Reset)),
    spec(
        "fit",
        "Fit",
        "Makes the canvas as large as the window allows",
        Group::View,
    )
    .keys(&[Chord::char('f')])
    .run(&Command::View(ViewCommand::Fit)),
    spec(
        "actual-size",
        "Actual size",
        "Makes one user unit one pixel",
        Group::View,
    )
    .keys(&[Chord::ctrl('0')])
    .run(&Command::View(ViewCommand::ActualSize)),
    spec(
        "rotate-left",
        "Rotate left",
        "Turns the picture left by 5 degrees",
        Group::View,
    )
    .keys(&[Chord::char('[')])
    .run(&Command::View(ViewCommand::RotateBy { degrees: -TURN })),
    spec(
        "rotate-right",
        "Rotate right",
        "Turns the picture right by 5 degrees",
        Group::View,
    )
    .keys(&[Chord::char(']')])
    .run(&Command::View(ViewCommand::RotateBy { degrees: TURN })),
    spec(
        "rotate",
        "Rotate by",
        "Turns the picture clockwise by so many degrees",
        Group::View,
    )
    .argument(arguments::ROTATE),
    spec(
        "zoom-in",
        "Zoom in",
        "Enlarges the picture about the middle of the window",
        Group::View,
    )
    .run(&Command::View(ViewCommand::ZoomAt {
        at: None,
        factor: ZOOM_STEP,
    })),
    spec(
        "zoom-out",
        "Zoom out",
        "Shrinks the picture about the middle of the window",
        Group::View,
    )
    .run(&Command::View(ViewCommand::ZoomAt {
        at: None,
        factor: 1.0 / ZOOM_STEP,
    })),
    spec(
        "zoom",
        "Zoom by",
        "Scales the picture by a factor, about the middle or a window pixel",
        Group::View,
    )
    .argument(arguments::ZOOM),
    spec("pan", "Pan by", "Moves the picture by window pixels", Group::View).argument(arguments::PAN),
    spec(
        "view",
        "Set view",
        "Sets centre, pixels per unit and rotation",
        Group::View,
    )
    .argument(arguments::VIEW),
    spec(
        "pixel-zoom",
        "Pixel zoom",
        "Shows every frame pixel as a square of 1, 2, 3 ... window pixels",
        Group::View,
    )
    .run(&Command::View(ViewCommand::NextPixelZoom))
    .argument(arguments::PIXEL_ZOOM),
    // Sampling: after the picture settings.
    spec(
        "progressive",
        "Progressive drawing",
        "Draws coarsely while the view moves and refines the picture when it rests",
        Group::Sampling,
    )
    .run(&Command::View(ViewCommand::Progressive(Toggle::Flip)))
    .argument(arguments::PROGRESSIVE),
    // A against B.
    spec(
        "swap",
        "Swap A and B",
        "Swaps A, the settings that keys change, with B",
        Group::Compare,
    )
    .more("The first press keeps the settings of now as B")
    .keys(&[Chord::char('r')])
    .run(&Command::Ab(AbCommand::Swap)),
    spec(
        "wipe",
        "Wipe",
        "Shows A on the left of a line and B on its right",
        Group::Compare,
    )
    .more("Drag the line to move it")
    .keys(&[Chord::char('w')])
    .run(&Command::Ab(AbCommand::ToggleArrangement(Arrangement::Wipe)))
    .argument(arguments::WIPE),
    spec(
        "difference",
        "Difference",
        "Shows in colours how far A and B are apart",
        Group::Compare,
    )
    .more("Every pixel has the number of its channel that differs most")
    .keys(&[Chord::char('d')])
    .run(&Command::Ab(AbCommand::ToggleArrangement(Arrangement::Difference)))
    .argument(arguments::DIFFERENCE),
    spec(
        "normalize",
        "Normalise difference",
        "Gives the largest difference the last colour",
        Group::Compare,
    )
    .more("Else colours stand for the same numbers in every picture")
    .keys(&[Chord::new(Key::Char('d'), Modifiers::SHIFT)])
    .run(&Command::Ab(AbCommand::Normalize(Toggle::Flip)))
    .argument(arguments::NORMALIZE),
    spec(
        "next-difference",
        "Next difference",
        "Pins the pixel where A and B differ most; again, the next",
        Group::Compare,
    )
    .more("One pixel of each block of 16 x 16 pixels counts, up to 64 of them")
    .keys(&[Chord::char('n')])
    .run(&Command::Ab(AbCommand::NextDifference)),
    spec(
        "gain",
        "Difference gain",
        "Multiplies the difference that is shown",
        Group::Compare,
    )
    .more("A gain of 8 gives an eighth of full scale the last colour")
    .argument(arguments::GAIN),
    spec(
        "stronger-difference",
        "Stronger difference",
        "Doubles the gain of the difference",
        Group::Compare,
    )
    .more("Small differences come to light, large ones all take the last colour")
    .run(&Command::Ab(AbCommand::StepGain(1))),
    spec(
        "weaker-difference",
        "Weaker difference",
        "Halves the gain of the difference",
        Group::Compare,
    )
    .more("Large differences can be told apart again")
    .run(&Command::Ab(AbCommand::StepGain(-1))),
    spec(
        "side",
        "Side by side",
        "Shows A in the left half of the window and B in the right",
        Group::Compare,
    )
    .more("Panning and zooming move both")
    .run(&Command::Ab(AbCommand::ToggleArrangement(Arrangement::SideBySide))),
    spec("flip", "Flip", "Shows A and B in turn", Group::Compare)
        .more("What differs then jumps to the eye")
        .run(&Command::Ab(AbCommand::ToggleArrangement(Arrangement::Flip))),
    spec(
        "flip-by-hand",
        "Flip by hand",
        "Shows B in place of A; again, A",
        Group::Compare,
    )
    .more("Look at one place while you press it")
    .keys(&[Chord::char('b')])
    .run(&Command::Ab(AbCommand::FlipByHand)),
    spec(
        "truth",
        "Compare with the truth",
        "Compares A with the same scene at 256 samples per pixel",
        Group::Compare,
    )
    .more("Each of them reads textures at level zero; all else is A's, and so are the values that are averaged")
    .run(&Command::Ab(AbCommand::Compare(Against::Truth(None))))
    .argument(arguments::TRUTH),
    spec(
        "compare-picture",
        "Compare with a picture",
        "Asks for a PNG or JPEG to compare A with, such as another renderer's",
        Group::Compare,
    )
    .more("A is then drawn with its size; a picture can also be dropped on the window")
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::ComparePicture))),
    spec(
        "arrange",
        "Arrange A and B",
        "Sets how A and B share the window",
        Group::Compare,
    )
    .more("Alone: A fills it, and B stays in the back")
    .argument(arguments::ARRANGE),
    spec(
        "against",
        "Compare with",
        "Sets what A is compared with: a copy of its settings, the truth, a picture's file, or none",
        Group::Compare,
    )
    .more("None closes the comparison")
    .argument(arguments::AGAINST),
    // Scenes.
    spec("scene", "Scene", "Shows the scene with this number", Group::Scenes)
        .keys(&DIGITS)
        .per_key(&[
            Command::Scenes(SceneCommand::Show(0)),
            Command::Scenes(SceneCommand::Show(1)),
            Command::Scenes(SceneCommand::Show(2)),
            Command::Scenes(SceneCommand::Show(3)),
            Command::Scenes(SceneCommand::Show(4)),
            Command::Scenes(SceneCommand::Show(5)),
            Command::Scenes(SceneCommand::Show(6)),
            Command::Scenes(SceneCommand::Show(7)),
            Command::Scenes(SceneCommand::Show(8)),
        ])
        .argument(arguments::SCENE),
    spec(
        "previous-scene",
        "Previous scene",
        "Shows the scene before this one; in a lesson the step before",
        Group::Scenes,
    )
    .keys(&[Chord::named(Key::PageUp)])
    .run(&Command::Scenes(SceneCommand::Previous)),
    spec(
        "next-scene",
        "Next scene",
        "Shows the scene after this one; in a lesson its next step",
        Group::Scenes,
    )
    .keys(&[Chord::named(Key::PageDown)])
    .run(&Command::Scenes(SceneCommand::Next)),
    spec(
        "open",
        "Open",
        "Opens a file, or every scene in a folder",
        Group::Scenes,
    )
    .argument(arguments::OPEN),
    spec(
        "gallery",
        "Built-in gallery",
        "Opens the scenes that come with the program",
        Group::Scenes,
    )
    .run(&Command::Scenes(SceneCommand::OpenGallery)),
    spec(
        "six-tasks",
        "Lesson: six tasks",
        "Opens the lesson on triangles, samples, groups, colours, texels and mip levels",
        Group::Scenes,
    )
    .more("PageDown goes to its next step, Esc closes it")
    .run(&Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(0)))),
    spec(
        "lesson-anisotropy",
        "Lesson: anisotropy",
        "Opens the lesson on footprints that are longer than wide",
        Group::Scenes,
    )
    .more("PageDown goes to its next step, Esc closes it")
    .run(&Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(1)))),
    spec(
        "lesson",
        "Lesson",
        "Opens a lesson: a TOML file of steps with text",
        Group::Scenes,
    )
    .more("It can be dropped on the window, too")
    .argument(arguments::LESSON),
    spec(
        "lesson-step",
        "Step of the lesson",
        "Goes to the step with this number",
        Group::Scenes,
    )
    .argument(arguments::LESSON_STEP),
    spec(
        "close-lesson",
        "Close the lesson",
        "Brings back what was open before the lesson",
        Group::Scenes,
    )
    .run(&Command::Lesson(LessonCommand::Close)),
    spec("reload", "Reload", "Reads the scene again", Group::Scenes)
        .keys(&[Chord::ctrl('r'), Chord::named(Key::F(5))])
        .run(&Command::Scenes(SceneCommand::Reload)),
    spec(
        "other-reading",
        "Read in the other dialect",
        "Reads the scene, and those of its folder, as course instead of svg, or the other way",
        Group::Scenes,
    )
    .run(&Command::Scenes(SceneCommand::OtherReading)),
    // Inspector.
    spec(
        "inspector",
        "Pixel inspector",
        "Opens or closes the pixel inspector",
        Group::Inspector,
    )
    .keys(&[Chord::char('z')])
    .run(&Command::Inspector(InspectorCommand::Show(Toggle::Flip)))
    .argument(arguments::INSPECTOR),
    spec(
        "pin",
        "Pin pixel",
        "Pins the pixel under the pointer and tells why it has its colour; again, unpins it",
        Group::Inspector,
    )
    .keys(&[Chord::named(Key::Enter)])
    .run(&Command::Inspector(InspectorCommand::PinUnderPointer))
    .argument(arguments::PIN),
    spec(
        "unpin",
        "Unpin",
        "Lets the inspector follow the pointer again",
        Group::Inspector,
    )
    .run(&Command::Inspector(InspectorCommand::Unpin)),
    spec("nudge", "Nudge pin", "Moves the pin by one pixel", Group::Inspector)
        .keys(&[
            Chord::named(Key::Left),
            Chord::named(Key::Right),
            Chord::named(Key::Up),
            Chord::named(Key::Down),
        ])
        .per_key(&[
            Command::Inspector(InspectorCommand::Nudge([-1, 0])),
            Command::Inspector(InspectorCommand::Nudge([1, 0])),
            Command::Inspector(InspectorCommand::Nudge([0, -1])),
            Command::Inspector(InspectorCommand::Nudge([0, 1])),
        ])
        .argument(arguments::NUDGE),
    spec(
        "nudge-far",
        "Nudge pin far",
        "Moves the pin by ten pixels",
        Group::Inspector,
    )
    .keys(&[shift(Key::Left), shift(Key::Right), shift(Key::Up), shift(Key::Down)])
    .per_key(&[
        Command::Inspector(InspectorCommand::Nudge([-FAR, 0])),
        Command::Inspector(InspectorCommand::Nudge([FAR, 0])),
        Command::Inspector(InspectorCommand::Nudge([0, -FAR])),
        Command::Inspector(InspectorCommand::Nudge([0, FAR])),
    ]),
    spec(
        "go-to-pixel",
        "Go to pixel",
        "Asks for a pixel and pins it",
        Group::Inspector,
    )
    .keys(&[Chord::ctrl('g')])
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::GoToPixel))),
    spec(
        "explanation",
        "Explanation",
        "Shows or hides why the pinned pixel has its colour; where none is pinned, pins one",
        Group::Inspector,
    )
    .more("Samples, primitives, edges, weights and texels, from the sum back to the line of the document")
    .keys(&[Chord::char('e')])
    .run(&Command::Inspector(InspectorCommand::Explanation(Toggle::Flip)))
    .argument(arguments::EXPLANATION),
    spec(
        "magnify-more",
        "Magnify more",
        "Shows fewer pixels larger in the inspector",
        Group::Inspector,
    )
    .run(&Command::Inspector(InspectorCommand::StepMagnification(1))),
    spec(
        "magnify-less",
        "Magnify less",
        "Shows more pixels smaller in the inspector",
        Group::Inspector,
    )
    .run(&Command::Inspector(InspectorCommand::StepMagnification(-1))),
    spec(
        "magnification",
        "Magnification",
        "Sets how large the inspector shows a pixel",
        Group::Inspector,
    )
    .argument(arguments::MAGNIFICATION),
    spec(
        "region",
        "Inspected region",
        "Sets how many pixels the inspector shows across: 8 to 64",
        Group::Inspector,
    )
    .argument(arguments::REGION),
    // Save and copy.
    spec(
        "screenshot",
        "Save picture",
        "Saves the frame as PNG, with the inspector where it is open",
        Group::Save,
    )
    .keys(&[Chord::char('s')])
    .run(&Command::Export(ExportCommand::Screenshot)),
    spec(
        "window-screenshot",
        "Save window",
        "Saves the whole window as PNG, panels included",
        Group::Save,
    )
    .keys(&[Chord::ctrl_shift('s')])
    .run(&Command::Export(ExportCommand::WindowScreenshot)),
    spec(
        "sheet",
        "Sheet",
        "Puts a sheet together: the picture once for each combination of settings, in a labelled grid",
        Group::Save,
    )
    .more("With a preview of what is saved; every other setting, the view and the pin are those of the picture")
    .keys(&[shift(Key::Char('s'))])
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Sheet))),
    spec(
        "sheet-columns",
        "Columns of the sheet",
        "Sets what differs from left to right on the sheet",
        Group::Save,
    )
    .argument(arguments::SHEET_COLUMNS),
    spec(
        "sheet-rows",
        "Rows of the sheet",
        "Sets what differs from top to bottom on the sheet",
        Group::Save,
    )
    .argument(arguments::SHEET_ROWS),
    spec(
        "sheet-inset",
        "Inset of the sheet",
        "Magnifies the pinned pixel in every panel of the sheet",
        Group::Save,
    )
    .argument(arguments::SHEET_INSET),
    spec(
        "sheet-panels",
        "Panels of the sheet",
        "Sets the pixels of each panel: those of the window, as many as fit a page, or so many",
        Group::Save,
    )
    .argument(arguments::SHEET_PANELS),
    spec(
        "sheet-theme",
        "Ground of the sheet",
        "Sets dark ink on white for print, or light ink on black for slides",
        Group::Save,
    )
    .argument(arguments::SHEET_THEME),
    spec(
        "sheet-note",
        "Note of the sheet",
        "Sets the sentence that the caption of the sheet ends with",
        Group::Save,
    )
    .argument(arguments::SHEET_NOTE),
    spec(
        "save-sheet",
        "Save sheet",
        "Saves the sheet as PNG, and beside it a folder with its panels and snippets for documents",
        Group::Save,
    )
    .run(&Command::Sheet(SheetCommand::Save)),
    spec(
        "copy-sheet-command-line",
        "Copy the sheet's command line",
        "Copies the command line that makes the sheet",
        Group::Save,
    )
    .run(&Command::Sheet(SheetCommand::CopyCommandLine)),
    spec(
        "copy",
        "Copy",
        "Copies place and colour of the inspected pixel, or the picture while no pixel is inspected",
        Group::Save,
    )
    .keys(&[Chord::ctrl('c')])
    .run(&Command::Export(ExportCommand::Copy)),
    spec(
        "copy-pixel",
        "Copy pixel",
        "Copies place and colour of the inspected pixel",
        Group::Save,
    )
    .run(&Command::Export(ExportCommand::CopyPixel)),
    spec(
        "copy-picture",
        "Copy picture",
        "Copies the picture as a screenshot shows it",
        Group::Save,
    )
    .run(&Command::Export(ExportCommand::CopyPicture)),
    spec(
        "copy-explanation",
        "Copy explanation",
        "Copies why the inspected pixel has its colour, as Markdown",
        Group::Save,
    )
    .run(&Command::Export(ExportCommand::CopyExplanation)),
    spec(
        "copy-command-line",
        "Copy command line",
        "Copies the command line that makes this picture",
        Group::Save,
    )
    .keys(&[Chord::ctrl_shift('c')])
    .run(&Command::Export(ExportCommand::CopyCommandLine)),
    // Window.
    spec(
        "overlay",
        "Overlay text",
        "Shows or hides the text over the picture",
        Group::Window,
    )
    .keys(&[Chord::char('`')])
    .run(&Command::Window(WindowCommand::OverlayText(Toggle::Flip)))
    .argument(arguments::OVERLAY),
    spec(
        "hide",
        "Only the picture",
        "Hides everything but the picture",
        Group::Window,
    )
    .keys(&[Chord::named(Key::Tab)])
    .run(&Command::Window(WindowCommand::HideEverything(Toggle::Flip)))
    .argument(arguments::HIDE),
    spec("panel", "Side panel", "Shows or hides the side panel", Group::Window)
        .run(&Command::Window(WindowCommand::Panel(Toggle::Flip)))
        .argument(arguments::PANEL),
    spec(
        "theme",
        "Theme",
        "Switches between the dark and the light theme",
        Group::Window,
    )
    .run(&Command::Window(WindowCommand::NextTheme))
    .argument(arguments::THEME),
    spec("help", "Help", "Shows all keys", Group::Window)
        .keys(&[Chord::shifted('?', '/'), Chord::named(Key::F(1))])
        .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Help))),
    spec(
        "palette",
        "Command palette",
        "Finds a command by its name",
        Group::Window,
    )
    .keys(&[Chord::ctrl_shift('p')])
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Palette))),
    spec(
        "escape",
        "Close",
        "Closes or unpins what is open; when nothing is, pressed twice ends the program",
        Group::Window,
    )
    .keys(&[Chord::named(Key::Escape)])
    .run(&Command::Window(WindowCommand::Escape)),
    spec("quit", "Quit", "Ends the program at once", Group::Window)
        .keys(&[Chord::ctrl('q')])
        .run(&Command::Window(WindowCommand::Quit)),
];

/// `1` to `9`.
static DIGITS: [Chord; 9] = [
    Chord::char('1'),
    Chord::char('2'),
    Chord::char('3'),
    Chord::char('4'),
    Chord::char('5'),
    Chord::char('6'),
    Chord::char('7'),
    Chord::char('8'),
    Chord::char('9'),
];

const fn shift(key: Key) -> Chord {
    Chord::new(key, Modifiers::SHIFT)
}

const fn spec(id: &'static str, name: &'static str, help: &'static str, group: Group) -> CommandSpec {
    CommandSpec {
        id,
        name,
        help,
        more: "",
        group,
        keys: &[],
        action: Action::NeedsArgument,
        argument: None,
    }
}

impl CommandSpec {
    const fn keys(self, keys: &'static [Chord]) -> Self {
        Self { keys, ..self }
    }

    const fn more(self, more: &'static str) -> Self {
        Self { more, ..self }
    }

    const fn run(self, command: &'static Command) -> Self {
        Self {
            action: Action::Run(command),
            ..self
        }
    }

    const fn per_key(self, commands: &'static [Command]) -> Self {
        Self {
            action: Action::PerKey(commands),
            ..self
        }
    }

    const fn argument(self, argument: Argument) -> Self {
        Self {
            argument: Some(argument),
            ..self
        }
    }
}
