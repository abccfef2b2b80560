//! Commands under "Scenes".

use crate::viewer::chrome::Dialog;
use crate::viewer::command::Command;
use crate::viewer::command::arguments;
use crate::viewer::command::parts::LessonCommand;
use crate::viewer::command::parts::SceneCommand;
use crate::viewer::command::parts::WindowCommand;
use crate::viewer::command::spec::CommandSpec;
use crate::viewer::command::spec::Group;
use crate::viewer::command::spec::spec;
use crate::viewer::key_chords::Chord;
use crate::viewer::key_chords::Key;
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::settings::Toggle;

/// The lines under this heading, in the order of help and menus.
pub(super) static SCENES: &[CommandSpec] = &[
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
        "all-scenes",
        "All scenes",
        "Shows all scenes as large pictures, by folder; a part of a name finds one",
        Group::Scenes,
    )
    .keys(&[Chord::char('g')])
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Scenes))),
    spec(
        "open",
        "Open",
        "Opens a file, or every scene in a folder",
        Group::Scenes,
    )
    .keys(&[Chord::ctrl('o')])
    .run(&Command::Window(WindowCommand::ToggleDialog(Dialog::Open)))
    .argument(arguments::OPEN),
    spec(
        "about",
        "About the scene",
        "Shows or hides the scene's own words: what to look at in it",
        Group::Scenes,
    )
    .keys(&[Chord::char('i')])
    .run(&Command::Window(WindowCommand::About(Toggle::Flip)))
    .argument(arguments::ABOUT),
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
        "lesson-patterns",
        "Lesson: patterns",
        "Opens the lesson on sample patterns and their spectra",
        Group::Scenes,
    )
    .more("PageDown goes to its next step, Esc closes it")
    .run(&Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(2)))),
    spec(
        "lesson-thin-ray",
        "Lesson: a thin ray",
        "Opens the lesson on supersampling, multisampling, analytic coverage and SMAA",
        Group::Scenes,
    )
    .more("PageDown goes to its next step, Esc closes it")
    .run(&Command::Lesson(LessonCommand::Open(LessonSource::BuiltIn(3)))),
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
        "Brings back the scenes, settings, comparison and pin from before the lesson",
        Group::Scenes,
    )
    .more("A file that was opened meanwhile stays")
    .run(&Command::Lesson(LessonCommand::Close)),
    spec("reload", "Reload", "Reads the scene again", Group::Scenes)
        .keys(&[Chord::ctrl('r'), Chord::named(Key::F(5))])
        .run(&Command::Scenes(SceneCommand::Reload)),
    spec(
        "give-up-reading",
        "Give up reading",
        "Reads a scene no further that takes long; so does Esc",
        Group::Scenes,
    )
    .run(&Command::Scenes(SceneCommand::GiveUpReading)),
    spec(
        "follow-files",
        "Follow files",
        "Reads scenes, textures and lessons again when another program saves them, or no more",
        Group::Scenes,
    )
    .run(&Command::Scenes(SceneCommand::FollowFiles(Toggle::Flip)))
    .argument(arguments::FOLLOW_FILES),
    spec(
        "other-reading",
        "Read in the other dialect",
        "Reads the scene, and those of its folder, as course instead of svg, or the other way",
        Group::Scenes,
    )
    .run(&Command::Scenes(SceneCommand::OtherReading)),
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
