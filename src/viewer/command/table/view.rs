//! Commands under "View".

use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::ViewCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;

/// Degrees that one press of a key turns the picture.
const TURN: f64 = 5.0;
/// What one press of a key zooms by.
const ZOOM_STEP: f64 = 1.25;

/// The lines under this heading, in the order of help and menus.
pub(super) static VIEW: &[CommandSpec] = &[
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
        "Makes one canvas unit one pixel",
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
];
