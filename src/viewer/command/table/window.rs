//! Commands under "Window".

use crate::viewer::chrome::Dialog;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::WindowCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;
use crate::viewer::key_chords::Modifiers;
use crate::viewer::settings::Toggle;

/// The lines under this heading, in the order of help and menus.
pub(super) static WINDOW: &[CommandSpec] = &[
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
        "next-panel",
        "Next panel",
        "Gives the keyboard to the next panel, where Tab goes from control to control; Esc gives it back to the picture",
        Group::Window,
    )
    .keys(&[Chord::named(Key::F(6))])
    .run(&Command::Window(WindowCommand::FocusPanel { back: false })),
    spec(
        "previous-panel",
        "Previous panel",
        "Gives the keyboard to the panel before this one",
        Group::Window,
    )
    .keys(&[Chord::new(Key::F(6), Modifiers::SHIFT)])
    .run(&Command::Window(WindowCommand::FocusPanel { back: true })),
    spec(
        "theme",
        "Theme",
        "Switches between the dark and the light theme",
        Group::Window,
    )
    .run(&Command::Window(WindowCommand::NextTheme))
    .argument(arguments::THEME),
    spec(
        "interface-larger",
        "Larger interface",
        "Makes panels and letters larger, not the picture; one that fills what panels leave free makes room for them",
        Group::Window,
    )
    .keys(&[Chord::ctrl('='), Chord::ctrl('+')])
    .run(&Command::Window(WindowCommand::StepInterfaceScale { up: true })),
    spec(
        "interface-smaller",
        "Smaller interface",
        "Makes panels and letters smaller, not the picture; one that fills what panels leave free takes their room",
        Group::Window,
    )
    .keys(&[Chord::ctrl('-')])
    .run(&Command::Window(WindowCommand::StepInterfaceScale { up: false })),
    spec(
        "interface-scale",
        "Interface at 100 %",
        "Panels and letters as large as the monitor has them, or by a percentage",
        Group::Window,
    )
    .run(&Command::Window(WindowCommand::SetInterfaceScale(
        InterfaceScale::ORIGINAL,
    )))
    .argument(arguments::INTERFACE_SCALE),
    spec(
        "presenter",
        "Presenter look",
        "Larger letters, a thick ring around the pin and more contrast, to be read from the back row",
        Group::Window,
    )
    .run(&Command::Window(WindowCommand::Presenter(Toggle::Flip)))
    .argument(arguments::PRESENTER),
    spec(
        "start-card",
        "Start card",
        "Shows what this is for, and ways on for newcomers",
        Group::Window,
    )
    .run(&Command::Window(WindowCommand::StartCard(Toggle::Flip)))
    .argument(arguments::START_CARD),
    spec("help", "Help", "Shows all keys", Group::Window)
        .keys(&[Chord::shifted('?', '/'), Chord::named(Key::F(1))])
        .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Help))),
    spec(
        "palette",
        "Command palette",
        "Finds a command, a value of a setting or a scene by its name",
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
