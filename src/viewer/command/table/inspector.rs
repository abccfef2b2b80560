//! Commands under "Inspector".

use crate::viewer::chrome::Dialog;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::InspectorCommand;
use crate::viewer::command::parts::ProfileCommand;
use crate::viewer::command::parts::SpectrumCommand;
use crate::viewer::command::parts::WindowCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;
use crate::viewer::key_chords::Modifiers;
use crate::viewer::settings::Toggle;

/// Pixels that an arrow moves the pin by with Shift.
const FAR: i64 = 10;

/// The lines under this heading, in the order of help and menus.
pub(super) static INSPECTOR: &[CommandSpec] = &[
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
    .more("While the pointer is elsewhere it is the pixel in the magnifier, or without one that in the middle")
    .keys(&[Chord::named(Key::Enter)])
    .run(&Command::Inspector(InspectorCommand::PinUnderPointer))
    .argument(arguments::PIN),
    spec(
        "pin-edge",
        "Pin an edge",
        "Pins a pixel near the middle that an edge makes wrong, and tells why it has its colour",
        Group::Inspector,
    )
    .run(&Command::Inspector(InspectorCommand::PinEdge)),
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
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::GoToPixel)))
    .argument(arguments::PIN),
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
    spec(
        "profile",
        "Edge profile",
        "Plots the values along a line that is dragged across an edge, of A, B and the truth, with shades, width and overshoot",
        Group::Inspector,
    )
    .more("The truth costs a drawing of the tiles on the line with 256 samples per pixel, beside the picture")
    .run(&Command::Profile(ProfileCommand::Show(Toggle::Flip)))
    .argument(arguments::PROFILE),
    spec(
        "spectrum",
        "Spectrum",
        "Shows the waves that the frame, its difference to the truth, the mip level at the pin or the scene is made of, and which \
         are aliases; pointing at one draws it over the picture",
        Group::Inspector,
    )
    .more("It costs a drawing of at most 512 x 512 pixels with some 100 samples each, and transforms of them, beside the picture")
    .sought_as(&["fourier", "moire", "moir\u{e9}", "aliasing"])
    .run(&Command::Spectrum(SpectrumCommand::Show(Toggle::Flip)))
    .argument(arguments::SPECTRUM),
];

const fn shift(key: Key) -> Chord {
    Chord::new(key, Modifiers::SHIFT)
}
