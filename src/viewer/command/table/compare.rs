//! Commands under "A against B".

use crate::figure::TableFormat;
use crate::viewer::ab::other::Against;
use crate::viewer::ab::other::Arrangement;
use crate::viewer::board::numbers::BoardSort;
use crate::viewer::chrome::Dialog;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::AbCommand;
use crate::viewer::command::parts::BoardCommand;
use crate::viewer::command::parts::WindowCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;
use crate::viewer::key_chords::Modifiers;
use crate::viewer::settings::Toggle;

/// The lines under this heading, in the order of help and menus.
pub(super) static COMPARE: &[CommandSpec] = &[
    spec(
        "swap",
        "Swap A and B",
        "Swaps A, the settings that keys change, with B",
        Group::Compare,
    )
    .more("The first press keeps the settings of now as B")
    .sought_as(&["keep"])
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
    .more(
        "They lie as hammersley has them, each is shaded by itself and reads textures at level zero, no pixel is smoothed \
         afterwards, and standard rules stand in for float ones; all else is A's, and so are the values that are averaged",
    )
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
    spec(
        "truth-space",
        "Truth averaged in",
        "Sets in which values the samples of the truth are averaged: in those of A, as stored, or as light",
        Group::Compare,
    )
    .more("It costs another drawing of the truth, wherever that is shown or measured against")
    .argument(arguments::TRUTH_SPACE),
    spec(
        "board",
        "Board",
        "Shows up to nine settings side by side: the same region of each beside the truth, sorted by what was measured",
        Group::Compare,
    )
    .more("Each costs some drawings of the frame for its time, and the truth one of the region with 256 samples, beside the picture")
    .keys(&[Chord::new(Key::Char('b'), Modifiers::SHIFT)])
    .run(&Command::Board(BoardCommand::Show(Toggle::Flip)))
    .argument(arguments::BOARD),
    spec(
        "board-add",
        "Add to the board",
        "Puts the settings of A on the board, or those with some changes",
        Group::Compare,
    )
    .more("The board holds nine; what is measured of the others stays")
    .run(&Command::Board(BoardCommand::AddA))
    .argument(arguments::BOARD_ADD),
    spec(
        "board-vary",
        "Vary on the board",
        "Fills the board with one entry for each value of a setting, all else as A",
        Group::Compare,
    )
    .more("It takes the place of what is there, and the first nine values of more")
    .argument(arguments::BOARD_VARY),
    spec(
        "board-remove",
        "Remove from the board",
        "Removes a tile from the board",
        Group::Compare,
    )
    .argument(arguments::BOARD_REMOVE),
    spec("board-clear", "Clear the board", "Removes all tiles from the board", Group::Compare)
        .more("The picture and its settings stay, and the message about it brings the tiles back")
        .run(&Command::Board(BoardCommand::Clear)),
    spec(
        "board-sort",
        "Sort the board",
        "Sorts the tiles of the board by their distance from the truth, or by their time",
        Group::Compare,
    )
    .more("RMSE counts levels, FLIP what people see; the least comes first, and nothing is measured again")
    .run(&Command::Board(BoardCommand::Sort(BoardSort::Rmse)))
    .argument(arguments::BOARD_SORT),
    spec(
        "board-a",
        "Take settings from the board",
        "Gives A the settings of a tile",
        Group::Compare,
    )
    .more("It costs a redraw, and where rules, filter or resolve space change also another truth")
    .argument(arguments::BOARD_A),
    spec(
        "board-region",
        "Region of the board",
        "Sets how many pixels across the board shows and compares: 16 to 256",
        Group::Compare,
    )
    .more("Larger ones say more of the whole picture, and are magnified less")
    .argument(arguments::BOARD_REGION),
    spec(
        "board-copy",
        "Copy the board",
        "Copies the table of the board as Markdown, or as CSV for spreadsheets",
        Group::Compare,
    )
    .run(&Command::Board(BoardCommand::Copy(TableFormat::Markdown)))
    .argument(arguments::BOARD_COPY),
    spec(
        "save-board",
        "Save the board",
        "Saves the truth and all tiles of the board as one PNG, with their numbers",
        Group::Compare,
    )
    .run(&Command::Board(BoardCommand::Save)),
];
