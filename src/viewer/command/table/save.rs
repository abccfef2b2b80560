//! Commands under "Save and copy".

use crate::viewer::chrome::Dialog;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::ExportCommand;
use crate::viewer::command::parts::SheetCommand;
use crate::viewer::command::parts::WindowCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;
use crate::viewer::key_chords::Modifiers;

/// The lines under this heading, in the order of help and menus.
pub(super) static SAVE: &[CommandSpec] = &[
    spec(
        "screenshot",
        "Save picture",
        "Saves the frame as PNG, with the inspector where it is open",
        Group::Save,
    )
    .keys(&[Chord::char('s')])
    .run(&Command::Export(ExportCommand::Screenshot)),
    spec(
        "save-as",
        "Save picture as",
        "Saves the same in a file of your choice, which must not exist yet",
        Group::Save,
    )
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::SaveAs)))
    .argument(arguments::SAVE_AS),
    spec(
        "open-folder",
        "Open the folder of saved pictures",
        "Shows the folder of what was saved last in the file manager",
        Group::Save,
    )
    .run(&Command::Export(ExportCommand::OpenFolder)),
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
];

const fn shift(key: Key) -> Chord {
    Chord::new(key, Modifiers::SHIFT)
}
