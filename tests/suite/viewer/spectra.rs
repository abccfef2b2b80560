//! The spectrum: it follows settings, view and pin, one card is open at a time, and Esc closes it.

use glam::dvec2;
use rasterscope::compare::{SpectrumOf, SpectrumReading};
use rasterscope::raster::Region;
use rasterscope::viewer::script::{Script, ViewerStage, play};
use rasterscope::viewer::{AbCommand, Against, Arrangement, BoardCommand, BoardSort};
use rasterscope::viewer::{Command, SpectrumPart, Toggle, ViewNumbers};
use rasterscope::viewer::{InspectorCommand, ProfileCommand, SpectrumCommand, ViewCommand, WindowCommand};

use crate::support::session::{Session, TRIANGLES, set};

/// Upright stripes of a triangle wave, 0.7 periods in a unit.
const STRIPES: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="160" height="160">
  <linearGradient id="g" gradientUnits="userSpaceOnUse" x1="0" x2="0.7142857" spreadMethod="reflect">
    <stop offset="0" stop-color="#000"/><stop offset="1" stop-color="#fff"/>
  </linearGradient>
  <rect x="-900" y="-900" width="2000" height="2000" fill="url(#g)"/>
</svg>"##;

fn spectrum(command: SpectrumCommand) -> Command {
    Command::Spectrum(command)
}

/// A window in which a canvas unit is a pixel.
fn session() -> Session {
    let mut session = Session::open(&[STRIPES], [200, 160]);
    at_scale(&mut session, 1.0);
    session
}

fn at_scale(session: &mut Session, scale: f64) {
    session.run(Command::View(ViewCommand::Set(ViewNumbers {
        center: dvec2(80.0, 80.0),
        scale,
        rotation: 0.0,
    })));
}

/// The strongest wave.
fn strongest(session: &Session) -> SpectrumReading {
    let spectrum = session.viewer.spectrum();
    assert!(spectrum.is_current(), "the picture is finished");
    spectrum.found().unwrap().analysis.peaks(1)[0]
}

fn assert_near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() < 0.006, "{what}: {found} for {expected}");
}

#[test]
fn spectrum_follows_view_and_settings() {
    let mut session = session();
    assert!(
        session.viewer.spectrum().found().is_none(),
        "nothing is found out for nobody"
    );
    session.run(spectrum(SpectrumCommand::Show(Toggle::Flip)));
    let alias = strongest(&session);
    assert_near(alias.wave.frequency[0], 0.3, "an alias");
    assert!(alias.alias().unwrap().1 > 0.9, "of finer waves: {alias:?}");
    at_scale(&mut session, 2.0);
    let own = strongest(&session);
    assert_near(own.wave.frequency[0], 0.35, "twice as large: coarse enough");
    assert!(own.source.is_none_or(|(_, part)| part < 0.1), "its own: {own:?}");
    assert!(own.alias().is_none(), "and so told to be none: {own:?}");
    at_scale(&mut session, 1.0);
    let before = strongest(&session).wave.amplitude;
    session.run(set("sample-rate", "256"));
    let after = strongest(&session).wave.amplitude;
    // Sinc of 0.7, but for the alias of harmonics in what is sampled once.
    assert!(
        (after / before - 0.368).abs() < 0.02,
        "the box takes the rest: {after} of {before}"
    );
    session.run(set("pattern", "hammersley"));
    session.run(spectrum(SpectrumCommand::Of(SpectrumOf::Difference)));
    let none = session.viewer.spectrum().found().unwrap().analysis.peaks(3);
    assert!(none.is_empty(), "the truth has no difference to itself: {none:?}");
    session.run(spectrum(SpectrumCommand::Of(SpectrumOf::Scene)));
    assert_near(strongest(&session).wave.frequency[0], 0.7, "before sampling");
    session.run(spectrum(SpectrumCommand::Of(SpectrumOf::Texture)));
    assert!(session.viewer.spectrum().found().is_none(), "a gradient is no texture");
}

#[test]
fn spectrum_is_of_what_is_around_the_pin() {
    let mut session = session();
    session.run(spectrum(SpectrumCommand::Part(SpectrumPart::Pin)));
    let region = |session: &Session| session.viewer.spectrum().found().unwrap().analysis.region();
    let square = |x, y| Region {
        x,
        y,
        width: 128,
        height: 128,
    };
    assert_eq!(region(&session), square(36, 16), "the middle, while none is pinned");
    session.run(Command::Inspector(InspectorCommand::Pin([190, 70])));
    assert_eq!(region(&session), square(72, 6), "around it, within the frame");
    let places = session.viewer.spectrum().panes();
    assert_eq!(places[0].corner, dvec2(72.0, 6.0), "there it lies in the window");
    session.run(spectrum(SpectrumCommand::Part(SpectrumPart::Whole)));
    assert_eq!(region(&session), Region::of_size([200, 160]), "all");
}

#[test]
fn spectrum_lies_over_the_picture_that_it_is_of() {
    let mut session = session();
    session.run(spectrum(SpectrumCommand::Show(Toggle::On)));
    session.run(Command::Ab(AbCommand::Compare(Against::Truth(None))));
    let areas = |session: &Session| -> Vec<[f64; 2]> {
        let panes = session.viewer.spectrum().panes().into_iter();
        panes
            .map(|pane| [pane.area.x as f64, pane.area.right() as f64])
            .collect()
    };
    session.run(Command::Ab(AbCommand::SetWipe(0.25)));
    let line = session.viewer.both().wipe_line().unwrap();
    assert_eq!(areas(&session), [[0.0, line]], "on A's side of the line");
    session.run(Command::Ab(AbCommand::Swap));
    assert_eq!(areas(&session), [[line, 200.0]], "which may be the right one");
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::SideBySide)));
    assert!(areas(&session)[0][0] > 0.0, "in A's half: {:?}", areas(&session));
    session.run(Command::Ab(AbCommand::Swap));
    session.run(Command::Ab(AbCommand::Arrange(Arrangement::Difference)));
    assert_eq!(areas(&session), [[0.0; 2]; 0], "a difference is no picture of A");
    session.run(Command::Ab(AbCommand::FlipByHand));
    assert_eq!(areas(&session), [[0.0; 2]; 0], "nor is B");
    session.run(Command::Ab(AbCommand::FlipByHand));
    assert_eq!(areas(&session).len(), 1, "A");
}

#[test]
fn spectrum_is_one_card_that_esc_closes() {
    let mut session = session();
    session.run(Command::Profile(ProfileCommand::SetLine([[10, 10], [60, 10]])));
    session.run(spectrum(SpectrumCommand::Show(Toggle::On)));
    assert!(session.viewer.spectrum().is_open(), "open");
    assert!(!session.viewer.profile().is_open(), "in place of the profile");
    session.run(Command::Inspector(InspectorCommand::Pin([20, 20])));
    session.run(Command::Window(WindowCommand::Escape));
    assert!(!session.viewer.spectrum().is_open(), "Esc closes it first");
    assert!(session.viewer.pixels().pinned().is_some(), "and nothing else");
    session.run(spectrum(SpectrumCommand::Show(Toggle::On)));
    session.run(Command::Profile(ProfileCommand::Show(Toggle::On)));
    assert!(!session.viewer.spectrum().is_open(), "the profile in its place");
    session.run(Command::Window(WindowCommand::HideEverything(Toggle::On)));
    session.run(spectrum(SpectrumCommand::Show(Toggle::On)));
    assert!(session.viewer.spectrum().is_open(), "it brings back what is hidden");
}

#[test]
fn board_gives_back_the_card_that_it_displaced() {
    let mut session = session();
    let open = |session: &Session| {
        let viewer = &session.viewer;
        [
            viewer.profile().is_open(),
            viewer.board().is_open(),
            viewer.spectrum().is_open(),
        ]
    };
    for (card, after) in [
        (spectrum(SpectrumCommand::Show(Toggle::On)), [false, false, true]),
        (
            Command::Profile(ProfileCommand::SetLine([[10, 10], [60, 10]])),
            [true, false, false],
        ),
    ] {
        session.run(card);
        session.run(Command::Board(BoardCommand::Show(Toggle::On)));
        session.run(Command::Board(BoardCommand::Sort(BoardSort::Flip)));
        assert_eq!(open(&session), [false, true, false], "the board in its place");
        session.run(Command::Window(WindowCommand::Escape));
        assert_eq!(open(&session), after, "given back");
        session.run(Command::Window(WindowCommand::Escape));
        assert_eq!(open(&session), [false; 3], "and closed");
    }
    session.run(Command::Board(BoardCommand::Show(Toggle::On)));
    session.run(Command::Window(WindowCommand::Escape));
    assert_eq!(open(&session), [false; 3], "there was none");
}

#[test]
fn spectrum_is_named_in_scripts() {
    let mut session = Session::open(&[TRIANGLES], [100, 80]);
    let script = Script::parse("spectrum scene; spectrum pin", "s").unwrap();
    play(&script, "s", &mut ViewerStage::new(&mut session.viewer)).unwrap();
    let spectrum = session.viewer.spectrum();
    assert!(spectrum.is_open(), "open");
    assert_eq!(
        (spectrum.of(), spectrum.part()),
        (SpectrumOf::Scene, SpectrumPart::Pin),
        "both choices"
    );
    assert_eq!(spectrum.found().unwrap().analysis.of(), SpectrumOf::Scene, "waited for");
    let error = Script::parse("spectrum picture", "s").unwrap_err();
    assert!(error.to_string().contains("frame|difference|texture|scene"), "{error}");
}
