//! A against B through real keys and a real pointer: the window then shows what the viewer makes of the same commands.

use glam::dvec2;
use rasterscope::viewer::{AbCommand, PointerCommand, WindowCommand};
use rasterscope::viewer::{Arrangement, Command, PointerButton, Toggle};

use super::desktop::keysym;
use super::program::{Program, SIZE, flat, viewed};

#[test]
fn compare_by_keys() {
    let path = flat();
    let program = Program::start_bare(&path);
    program.shows(&viewed(&path, &[]), "the first picture");
    let cases = [
        ('r', &[][..], Command::Ab(AbCommand::Swap)),
        ('=', &[], Command::step("sample-rate", 1.0).expect("a setting")),
        ('r', &[], Command::Ab(AbCommand::Swap)),
        (
            'd',
            &[],
            Command::Ab(AbCommand::ToggleArrangement(Arrangement::Difference)),
        ),
        ('D', &[], Command::Ab(AbCommand::Normalize(Toggle::Flip))),
        ('w', &[], Command::Ab(AbCommand::ToggleArrangement(Arrangement::Wipe))),
    ];
    // Everything but the picture is hidden, with its free area.
    let mut played = vec![Command::Window(WindowCommand::HideEverything(Toggle::On))];
    for (key, held, command) in cases {
        program.desktop.type_char(key, held);
        played.push(command.clone());
        program.shows(&viewed(&path, &played), &format!("{command:?} after {key}"));
    }
    // The line of the wipe is in the middle: the pointer takes it to the left.
    let middle = SIZE.map(|side| i16::try_from(side / 2).unwrap());
    program.desktop.point(middle[0], middle[1]);
    std::thread::sleep(std::time::Duration::from_millis(100));
    program.desktop.button(1, true);
    program.desktop.point(100, middle[1]);
    program.desktop.button(1, false);
    played.extend([
        Command::Pointer(PointerCommand::Moved {
            at: dvec2(middle[0].into(), middle[1].into()),
        }),
        Command::Pointer(PointerCommand::Pressed(PointerButton::Primary)),
        Command::Pointer(PointerCommand::Moved {
            at: dvec2(100.0, middle[1].into()),
        }),
        Command::Pointer(PointerCommand::Released(PointerButton::Primary)),
    ]);
    program.shows(&viewed(&path, &played), "the line, dragged");
    program.desktop.press(keysym::TAB, &[]);
    program.desktop.press(keysym::ESCAPE, &[]);
    program.desktop.press(keysym::TAB, &[]);
    program.shows(
        &viewed(&path, &[]),
        "Esc left the wipe; B's settings are on the screen since they were swapped",
    );
}
