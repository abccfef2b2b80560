//! The board: several settings of one region, beside one truth, measured as `diff` measures.

use glam::dvec2;
use rasterscope::color::ResolveSpace;
use rasterscope::compare::Pair;
use rasterscope::figure::{Record, TableFormat};
use rasterscope::raster::{Framebuffer, Region};
use rasterscope::render::{CancelToken, RenderSettings, draw};
use rasterscope::scene::{DialectChoice, load};
use rasterscope::viewer::script::{Script, ViewerStage, play};
use rasterscope::viewer::{
    AbCommand, Against, Axis, BoardCommand, BoardNumbers, BoardSort, Command, Effect, InspectorCommand, MessageKind,
    ProfileCommand, SpectrumCommand, Toggle, ViewCommand, ViewNumbers, WindowCommand,
};

use crate::support::session::{SQUARE, Session, TRIANGLES, set};

/// A window in which a canvas unit is a pixel.
fn session() -> Session {
    let mut session = Session::open(&[TRIANGLES, SQUARE], [200, 100]);
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(100.0, 50.0),
        scale: 1.0,
        rotation: 0.0,
    })));
    session
}

fn board(command: BoardCommand) -> Command {
    Command::Board(command)
}

fn vary(name: &str, values: &str) -> Command {
    board(BoardCommand::Vary(Axis::of(name, values).unwrap()))
}

/// Captions and numbers, in the order that is shown.
fn shown(session: &Session) -> Vec<(String, BoardNumbers)> {
    let tiles = session.viewer.board().tiles();
    let tile = |tile: &rasterscope::viewer::ShownTile<'_>| {
        assert!(!tile.is_stale, "{} is of this moment", tile.caption);
        (tile.caption.clone(), tile.tile.unwrap().numbers)
    };
    tiles.iter().map(tile).collect()
}

fn captions(session: &Session) -> Vec<String> {
    shown(session).into_iter().map(|(caption, _)| caption).collect()
}

/// What the library says of a frame's region under the settings of now but for `change`, against this truth.
fn expected(session: &Session, change: impl Fn(&mut RenderSettings), truth: RenderSettings, at: Region) -> [f64; 2] {
    let scene = load(&session.folder.path().join("1.svg"), DialectChoice::Auto).unwrap();
    let view = session.viewer.frames().frame().unwrap().picture.view;
    let part = |settings: RenderSettings| {
        let mut frame = Framebuffer::new(200, 100);
        draw(&scene, &view, &settings, &mut frame);
        let mut part = Framebuffer::new(at.width, at.height);
        for y in 0..at.height {
            for x in 0..at.width {
                let from = (at.y + y) as usize * 200 + (at.x + x) as usize;
                part.pixels_mut()[(y * at.width + x) as usize] = frame.pixels()[from];
            }
        }
        part
    };
    let mut own = session.viewer.settings().render;
    change(&mut own);
    let (own, truth) = (part(own), part(truth));
    let pair = Pair::new(&truth, &own).unwrap();
    [pair.levels().rmse(), pair.flip(&CancelToken::default()).unwrap()]
}

fn assert_near(numbers: &BoardNumbers, [rmse, flip]: [f64; 2], what: &str) {
    assert!(
        (numbers.rmse - rmse).abs() < 1e-9,
        "RMSE, {what}: {numbers:?}, not {rmse}"
    );
    assert!(
        (numbers.flip - flip).abs() < 1e-9,
        "FLIP, {what}: {numbers:?}, not {flip}"
    );
}

const AROUND_PIN: Region = Region {
    x: 34,
    y: 18,
    width: 32,
    height: 32,
};

/// Their cards would lie on each other.
#[test]
fn board_profile_and_spectrum_close_each_other() {
    let mut session = session();
    let commands = [
        board(BoardCommand::Show(Toggle::On)),
        Command::Profile(ProfileCommand::Show(Toggle::On)),
        Command::Spectrum(SpectrumCommand::Show(Toggle::On)),
    ];
    // Each after each of the others.
    for index in [0, 1, 2, 0, 2, 1, 0] {
        session.run(commands[index].clone());
        let viewer = &session.viewer;
        let open = [
            viewer.board().is_open(),
            viewer.profile().is_open(),
            viewer.spectrum().is_open(),
        ];
        assert_eq!(
            open,
            [0, 1, 2].map(|other| other == index),
            "after {:?}",
            commands[index]
        );
    }
}

#[test]
fn board_measures_the_region_around_the_pin_against_the_truth() {
    let mut session = session();
    session.run(Command::Inspector(InspectorCommand::Pin([50, 34])));
    session.run(board(BoardCommand::SetSide(32)));
    session.run(vary("sample-rate", "1,4,16"));
    let found = shown(&session);
    assert_eq!(
        captions(&session),
        ["sample rate 16", "sample rate 4", "sample rate 1"],
        "the best first"
    );
    let truth = session.viewer.settings().render.truth();
    for (caption, numbers) in &found {
        let rate = caption.rsplit(' ').next().unwrap().parse().unwrap();
        let rate = rasterscope::raster::SampleRate::new(rate).unwrap();
        let expected = expected(&session, |own| own.sample_rate = rate, truth, AROUND_PIN);
        assert!(expected[0] > 0.1, "the region has an edge");
        assert_near(numbers, expected, caption);
        assert!(!numbers.time.is_zero(), "a frame takes some time");
    }
    let (pixels, _) = session.viewer.board().truth().unwrap();
    assert_eq!([pixels.width(), pixels.height()], [32, 32], "the truth of that region");
}

#[test]
fn board_truth_is_averaged_as_a_is_or_as_was_chosen() {
    let mut session = session();
    session.run(Command::Inspector(InspectorCommand::Pin([50, 34])));
    session.run(board(BoardCommand::SetSide(32)));
    session.run(vary("sample-rate", "4"));
    let render = session.viewer.settings().render;
    let check = |session: &mut Session, space: ResolveSpace, words: &str| {
        let truth = RenderSettings {
            resolve: space,
            ..render.truth()
        };
        let four = rasterscope::raster::SampleRate::new(4).unwrap();
        let stored = |own: &mut RenderSettings| {
            own.sample_rate = four;
            own.resolve = ResolveSpace::Stored;
        };
        let expected = expected(session, stored, truth, AROUND_PIN);
        assert_near(&shown(session)[0].1, expected, words);
        let [_, told] = session.viewer.board().words().unwrap();
        assert_eq!(told, words, "the panel says which");
    };
    check(&mut session, ResolveSpace::Stored, "256 samples in stored values");
    session.run(set("resolve", "linear"));
    check(&mut session, ResolveSpace::Linear, "256 samples in linear light");
    session.run(Command::Ab(AbCommand::SetTruthSpace(Some(ResolveSpace::Stored))));
    check(&mut session, ResolveSpace::Stored, "256 samples in stored values");
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    let sides = session.viewer.ab().sides(session.viewer.settings()).unwrap();
    assert_eq!(
        sides[1], "B: the truth, 256 samples in stored values, pattern hammersley",
        "of B as well"
    );
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(Some(
        ResolveSpace::Linear,
    )))));
    check(&mut session, ResolveSpace::Linear, "256 samples in linear light");
    session.run(Command::Ab(AbCommand::SetTruthSpace(None)));
    session.run(set("resolve", "stored"));
    check(&mut session, ResolveSpace::Stored, "256 samples in stored values");
}

#[test]
fn board_holds_nine_different_settings() {
    let mut session = session();
    session.run(board(BoardCommand::AddA));
    session.run(board(BoardCommand::AddA));
    let problem = |session: &Session| {
        let messages = session.viewer.chrome().messages();
        let last = messages.iter().rfind(|message| message.kind == MessageKind::Error);
        last.map(|message| message.text.clone()).unwrap_or_default()
    };
    assert!(problem(&session).contains("already"), "{}", problem(&session));
    assert_eq!(session.viewer.board().tiles().len(), 1, "once");
    for rate in ["4", "9", "16", "25", "36", "49", "64", "81", "100"] {
        session.run(set("sample-rate", rate));
        session.run(board(BoardCommand::AddA));
    }
    assert_eq!(session.viewer.board().tiles().len(), 9, "no tenth");
    assert!(problem(&session).contains("holds 9"), "{}", problem(&session));
    session.run(board(BoardCommand::Vary(Axis::first(
        rasterscope::viewer::picture::find("pattern").unwrap(),
    ))));
    assert_eq!(session.viewer.board().tiles().len(), 9, "the first nine of twelve");
    let told = session
        .viewer
        .chrome()
        .messages()
        .iter()
        .any(|message| message.text.contains("first 9 of 12"));
    assert!(told, "and that is said");
    let said = session.viewer.chrome().messages().len();
    session.run(vary("sample-rate", "1,4"));
    assert_eq!(session.viewer.chrome().messages().len(), said, "as asked");
    session.run(vary("sample-rate", "1,5"));
    let rates = captions(&session).join(" ");
    assert!(rates.contains("sample rate 4"), "the nearest: {rates}");
    assert!(problem(&session).contains('5'), "which is said: {}", problem(&session));
    session.run(board(BoardCommand::Vary(Axis::first(
        rasterscope::viewer::picture::find("pattern").unwrap(),
    ))));
    session.run(board(BoardCommand::Remove(8)));
    session.run(board(BoardCommand::Remove(77)));
    assert_eq!(session.viewer.board().tiles().len(), 8, "one is gone");
    session.run(board(BoardCommand::Clear));
    assert!(session.viewer.board().tiles().is_empty(), "all are");
}

#[test]
fn board_gives_a_the_settings_of_a_tile() {
    let mut session = session();
    session.run(vary("sample-rate", "1,16"));
    assert!(session.viewer.board().tiles()[1].is_a, "A has one sample");
    session.run(board(BoardCommand::MakeA(0)));
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        16,
        "the first tile's"
    );
    assert!(session.viewer.board().tiles()[0].is_a, "it is told");
    session.run(board(BoardCommand::MakeA(5)));
    assert_eq!(
        session.viewer.settings().render.sample_rate.samples(),
        16,
        "no such tile"
    );
}

#[test]
fn board_follows_view_scene_and_window() {
    let mut session = session();
    session.run(vary("sample-rate", "1,4"));
    let before = session.viewer.board().words();
    let numbers = shown(&session);
    session.run(Command::View(ViewCommand::PanBy { by: dvec2(13.0, 4.0) }));
    assert_eq!(session.viewer.board().words(), before, "the middle of the picture");
    assert!(
        shown(&session)[0].1.rmse.to_bits() != numbers[0].1.rmse.to_bits(),
        "of the new view"
    );
    session.run(Command::Window(WindowCommand::Resize([40, 30])));
    assert_eq!(captions(&session).len(), 2, "a frame smaller than the region");
    let (pixels, _) = session.viewer.board().truth().unwrap();
    assert_eq!([pixels.width(), pixels.height()], [40, 30], "all of it");
    session.keys(&["2"]);
    assert_eq!(captions(&session).len(), 2, "another scene");
    session.keys(&["Escape"]);
    assert!(!session.viewer.board().is_open(), "Esc closes it");
    session.keys(&["Shift+b"]);
    assert!(session.viewer.board().is_open(), "and the key opens it again");
    assert_eq!(captions(&session).len(), 2, "with what it had");
}

#[test]
fn board_is_sorted_and_copied() {
    let mut session = session();
    session.run(vary("sample-rate", "1,16"));
    let copied = |effects: Vec<Effect>| match effects.as_slice() {
        [Effect::CopyText(text)] => text.clone(),
        other => panic!("{other:?}"),
    };
    let csv = copied(session.run(board(BoardCommand::Copy(TableFormat::Csv))));
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "sample_rate,rmse,flip,time_ms", "names and units");
    assert!(lines[1].starts_with("16,") && lines[2].starts_with("1,"), "{csv}");
    let rmse: f64 = lines[2].split(',').nth(1).unwrap().parse().unwrap();
    assert!((rmse - shown(&session)[1].1.rmse).abs() < 1e-4, "as it is shown: {csv}");
    let markdown = copied(session.run(board(BoardCommand::Copy(TableFormat::Markdown))));
    assert!(
        markdown.starts_with("| sample_rate | rmse | flip | time_ms |\n|---|---|---|---|\n| 16 |"),
        "{markdown}"
    );
    assert!(
        markdown.contains("64 \u{d7} 64 pixels") && markdown.contains("stored values"),
        "{markdown}"
    );
    session.run(board(BoardCommand::Sort(BoardSort::Time)));
    let times: Vec<_> = shown(&session).into_iter().map(|(_, numbers)| numbers.time).collect();
    assert!(times.is_sorted(), "{times:?}");
    session.run(board(BoardCommand::Clear));
    assert!(
        session.run(board(BoardCommand::Copy(TableFormat::Csv))).is_empty(),
        "nothing to copy"
    );
}

#[test]
fn board_is_saved_with_its_command_line() {
    let mut session = session();
    session.run(set("resolve-filter", "mitchell"));
    session.run(vary("sample-rate", "1,16"));
    session.run(board(BoardCommand::Save));
    let saved = std::fs::read_dir(session.folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let saved = saved.filter(|path| path.extension().is_some_and(|ending| ending == "png"));
    let file = saved.last().expect("a picture");
    let record = Record::of_file(&file).unwrap().expect("a record");
    let line = record.command_line;
    for words in [
        "rasterscope board",
        "--resolve-filter mitchell",
        "--with A",
        "--with 'sample-rate 16'",
        "--region=68,18,64,64",
        "--sort=rmse",
    ] {
        assert!(line.contains(words), "{words} in {line}");
    }
    assert!(record.differs.is_some(), "times differ from run to run");
    let picture = image::open(&file).unwrap();
    assert!(
        picture.width() > 3 * 256 && picture.height() > 256,
        "three tiles of 64 pixels, four times"
    );
}

#[test]
fn board_plays_in_scripts() {
    let mut session = session();
    let script = Script::parse(
        "board-vary pattern grid,r2,sobol; board-add sample-rate 16, pattern sobol; board-region 32; board-sort flip; \
         truth-space linear; board-remove 4; board-a 1",
        "s",
    )
    .expect("a script");
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).expect("it plays");
    let sorted: Vec<f64> = shown(&session).iter().map(|(_, numbers)| numbers.flip).collect();
    assert!(sorted.len() == 3 && sorted.is_sorted(), "{sorted:?}");
    assert_eq!(
        session.viewer.board().truth_space(),
        Some(ResolveSpace::Linear),
        "chosen"
    );
    assert!(session.viewer.board().tiles()[0].is_a, "A is the best");
    for wrong in [
        "board-vary nothing",
        "board-vary sample-rate 1,x",
        "board-add foo 1",
        "board-remove 0",
        "board-region 8",
        "board-region 257",
        "board-sort ssim",
        "board-copy html",
        "truth-space gamma",
        "board-a one",
    ] {
        let problem = Script::parse(wrong, "s").expect_err(wrong);
        assert!(!problem.to_string().contains('\n'), "{wrong}: {problem}");
    }
    let mut hidden = session;
    hidden.run(Command::Window(WindowCommand::HideEverything(Toggle::On)));
    assert!(!hidden.viewer.board().is_open(), "hidden with all else");
}
