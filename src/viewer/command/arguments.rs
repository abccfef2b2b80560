//! Arguments that a person types after a command's word, in scripts and in the palette: text to [`Command`].

use std::borrow::Cow;
use std::path::PathBuf;

use crate::color::ResolveSpace;
use crate::compare::{Measure, ProfileChannel, SpectrumOf};
use crate::figure::{Ground, TableFormat};
use crate::viewer::ab::other::{Against, Arrangement};
use crate::viewer::board::SIDES;
use crate::viewer::board::numbers::BoardSort;
use crate::viewer::chrome::interface_scale::InterfaceScale;
use crate::viewer::command::Command;
use crate::viewer::export::sheet::axes::Axis;
use crate::viewer::export::sheet::draft::{PanelSize, SheetChange, SheetSide};
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::settings::picture;
use crate::viewer::settings::picture::PictureSetting;
use crate::viewer::settings::values::{named, number, path, pixels, point, toggle, whole};
use crate::viewer::settings::{PixelZoom, Theme, Toggle};
use crate::viewer::view::camera::ViewNumbers;
use crate::viewer::{
    AbCommand, BoardCommand, ExportCommand, InspectorCommand, LessonCommand, ProfileCommand, SceneCommand,
    SheetCommand, SpectrumCommand, SpectrumPart, ViewCommand, WindowCommand,
};

/// What may follow a command's word.
#[derive(Clone, Copy)]
pub enum Argument {
    /// Text of this form.
    Form {
        /// Such as `X,Y` or `on|off`.
        usage: &'static str,
        /// What the form does not say of it by itself.
        wanted: Option<&'static str>,
        /// The command that the text asks for; `None` when the text does not have the form.
        parse: fn(&str) -> Option<Command>,
    },
    /// A value of this setting.
    Value(&'static PictureSetting),
}

impl Argument {
    /// Its form, such as `X,Y` or `nearest|bilinear`.
    pub fn usage(&self) -> Cow<'static, str> {
        match self {
            Self::Form { usage, .. } => Cow::Borrowed(usage),
            Self::Value(setting) => Cow::Owned(setting.form()),
        }
    }

    /// The command that `text` asks for.
    ///
    /// # Errors
    /// One line that quotes the text and gives the form.
    pub fn parse(&self, text: &str) -> Result<Command, String> {
        let text = text.trim();
        match self {
            Self::Form { usage, wanted, parse } => parse(text).ok_or_else(|| {
                let wanted = wanted.map_or(String::new(), |wanted| format!(": {wanted}"));
                format!("\"{text}\" is not {usage}{wanted}")
            }),
            Self::Value(setting) => setting.to(&setting.read(text, None)?).map(Command::Set),
        }
    }
}

impl std::fmt::Debug for Argument {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Argument").field(&self.usage()).finish()
    }
}

const fn argument(usage: &'static str, parse: fn(&str) -> Option<Command>) -> Argument {
    Argument::Form {
        usage,
        wanted: None,
        parse,
    }
}

/// The same where the form does not say all of what is `wanted`.
const fn argument_of(usage: &'static str, wanted: &'static str, parse: fn(&str) -> Option<Command>) -> Argument {
    Argument::Form {
        usage,
        wanted: Some(wanted),
        parse,
    }
}

pub(in crate::viewer) const ROTATE: Argument = argument_of("DEGREES", "a number is wanted", |text| {
    number(text).map(|degrees| Command::View(ViewCommand::RotateBy { degrees }))
});

pub(in crate::viewer) const ZOOM: Argument = argument_of(
    "FACTOR [X,Y]",
    "a factor above 0 is wanted, alone or with a place behind it",
    |text| {
        let (factor, at) = match text.split_once(char::is_whitespace) {
            Some((factor, at)) => (factor, Some(point(at)?)),
            None => (text, None),
        };
        let factor = number(factor).filter(|factor| *factor > 0.0)?;
        Some(Command::View(ViewCommand::ZoomAt { at, factor }))
    },
);

pub(in crate::viewer) const PAN: Argument = argument("X,Y", |text| {
    point(text).map(|by| Command::View(ViewCommand::PanBy { by }))
});

pub(in crate::viewer) const VIEW: Argument = argument(ViewNumbers::FORM, |text| match text {
    "default" => Some(Command::View(ViewCommand::Reset)),
    _ => ViewNumbers::parse(text).map(ViewCommand::Set).map(Command::View),
});
pub(in crate::viewer) const PIXEL_ZOOM: Argument = argument("1, 2, 3, 4, 6 or 8", |text| {
    whole(text)
        .and_then(PixelZoom::new)
        .map(ViewCommand::SetPixelZoom)
        .map(Command::View)
});

pub(in crate::viewer) const PROGRESSIVE: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(ViewCommand::Progressive).map(Command::View)
});

pub(in crate::viewer) const WIPE: Argument = argument("a part of the width from 0 to 1", |text| {
    number(text)
        .filter(|part| (0.0..=1.0).contains(part))
        .map(AbCommand::SetWipe)
        .map(Command::Ab)
});

pub(in crate::viewer) const DIFFERENCE: Argument = argument("signed|absolute|relative|squared", |text| {
    named(&Measure::ALL, Measure::name, text)
        .map(AbCommand::SetMeasure)
        .map(Command::Ab)
});

pub(in crate::viewer) const NORMALIZE: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(AbCommand::Normalize).map(Command::Ab)
});

pub(in crate::viewer) const GAIN: Argument = argument("a number from 0.000001 to 1000000", |text| {
    let gain = text.trim().parse().ok().filter(|gain| (1e-6..=1e6).contains(gain));
    gain.map(AbCommand::SetGain).map(Command::Ab)
});

pub(in crate::viewer) const ARRANGE: Argument = argument(Arrangement::FORM, |text| {
    named(&Arrangement::ALL, Arrangement::name, text)
        .map(AbCommand::Arrange)
        .map(Command::Ab)
});

pub(in crate::viewer) const TRUTH: Argument = argument("stored|linear", |text| {
    let resolve = named(&ResolveSpace::ALL, ResolveSpace::name, text)?;
    Some(Command::Ab(AbCommand::Compare(Against::Truth(Some(resolve)))))
});

pub(in crate::viewer) const TRUTH_SPACE: Argument = argument("a|stored|linear", |text| {
    let space = match text {
        "a" => None,
        text => Some(named(&ResolveSpace::ALL, ResolveSpace::name, text)?),
    };
    Some(Command::Ab(AbCommand::SetTruthSpace(space)))
});

pub(in crate::viewer) const BOARD: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(BoardCommand::Show).map(Command::Board)
});

pub(in crate::viewer) const BOARD_ADD: Argument =
    argument("changes of A such as \"sample-rate 16, pattern sobol\"", |text| {
        let text = picture::read_files(text, None).ok()?;
        picture::parse_changes(&text).map(BoardCommand::Add).map(Command::Board)
    });

pub(in crate::viewer) const BOARD_VARY: Argument = argument(
    "a setting, with or without values, such as sample-rate 1,4,16",
    |text| {
        let axis = match text.split_once(char::is_whitespace) {
            Some((name, values)) => Axis::read(picture::option_meant(name), values).ok()?,
            None => Axis::first(picture::find(picture::option_meant(text))?),
        };
        Some(Command::Board(BoardCommand::Vary(axis)))
    },
);

pub(in crate::viewer) const BOARD_REMOVE: Argument = argument("the number of a tile, from 1", |text| {
    tile(text).map(BoardCommand::Remove).map(Command::Board)
});

pub(in crate::viewer) const BOARD_A: Argument = argument("the number of a tile, from 1", |text| {
    tile(text).map(BoardCommand::MakeA).map(Command::Board)
});

pub(in crate::viewer) const BOARD_SORT: Argument = argument(BoardSort::FORM, |text| {
    named(&BoardSort::ALL, BoardSort::name, text)
        .map(BoardCommand::Sort)
        .map(Command::Board)
});

pub(in crate::viewer) const BOARD_REGION: Argument = argument("a whole number from 16 to 256", |text| {
    whole(text)
        .filter(|side| (SIDES[0]..=SIDES[2]).contains(side))
        .map(BoardCommand::SetSide)
        .map(Command::Board)
});

pub(in crate::viewer) const BOARD_COPY: Argument = argument("markdown|csv", |text| {
    named(&TableFormat::ALL, TableFormat::name, text)
        .map(BoardCommand::Copy)
        .map(Command::Board)
});

/// The place of a tile, counted from 0.
fn tile(text: &str) -> Option<usize> {
    usize::try_from(whole(text)?).ok()?.checked_sub(1)
}

pub(in crate::viewer) const AGAINST: Argument = argument(
    "settings|truth|truth stored|truth linear|none, settings such as \"sample-rate 16, dialect svg\", or a picture's path",
    |text| {
        let text = picture::read_files(text, None).ok()?;
        Against::from_text(&text).map(AbCommand::Compare).map(Command::Ab)
    },
);

pub(in crate::viewer) const SCENE: Argument = argument("a scene's number, from 1", |text| {
    let index = usize::try_from(whole(text)?).ok()?.checked_sub(1)?;
    Some(Command::Scenes(SceneCommand::Show(index)))
});

pub(in crate::viewer) const LESSON: Argument = argument(
    "six-tasks, anisotropy, patterns, thin-ray, or the path of a lesson in TOML",
    |text| {
        LessonSource::named(text)
            .or_else(|| LessonSource::from_address(&path(text)))
            .map(LessonCommand::Open)
            .map(Command::Lesson)
    },
);

pub(in crate::viewer) const LESSON_STEP: Argument = argument("a step's number, from 1", |text| {
    let index = usize::try_from(whole(text)?).ok()?.checked_sub(1)?;
    Some(Command::Lesson(LessonCommand::Step(index)))
});

pub(in crate::viewer) const FOLLOW_FILES: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(SceneCommand::FollowFiles).map(Command::Scenes)
});

pub(in crate::viewer) const OPEN: Argument = argument("a path", |text| {
    (!text.is_empty()).then(|| Command::Scenes(SceneCommand::Open(vec![path(text)])))
});

pub(in crate::viewer) const SAVE_AS: Argument = argument("the path of a new PNG file", |text| {
    new_png(path(text)).map(ExportCommand::SaveAs).map(Command::Export)
});

/// A path that names a PNG file, with its ending where none was typed.
fn new_png(mut path: PathBuf) -> Option<PathBuf> {
    let is_folder = path.file_name().is_none() || path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
    if is_folder {
        return None;
    }
    match path.extension() {
        None => {
            path.set_extension("png");
            Some(path)
        }
        Some(ending) => ending.eq_ignore_ascii_case("png").then_some(path),
    }
}

pub(in crate::viewer) const INSPECTOR: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(InspectorCommand::Show).map(Command::Inspector)
});

pub(in crate::viewer) const PIN: Argument = argument("X,Y in whole pixels", |text| {
    pixels(text).map(InspectorCommand::Pin).map(Command::Inspector)
});

pub(in crate::viewer) const NUDGE: Argument = argument("X,Y in whole pixels", |text| {
    pixels(text).map(InspectorCommand::Nudge).map(Command::Inspector)
});

pub(in crate::viewer) const MAGNIFICATION: Argument = argument("a whole number of window pixels", |text| {
    whole(text)
        .map(InspectorCommand::SetMagnification)
        .map(Command::Inspector)
});

pub(in crate::viewer) const REGION: Argument = argument("a whole number from 8 to 64", |text| {
    let side = whole(text).filter(|side| (8..=64).contains(side));
    side.map(InspectorCommand::SetRegion).map(Command::Inspector)
});

pub(in crate::viewer) const PROFILE: Argument =
    argument("X,Y X,Y in whole pixels, luma|red|green|blue, or on|off|flip", |text| {
        let line = || {
            let (from, to) = text.split_once(char::is_whitespace)?;
            Some(ProfileCommand::SetLine([pixels(from)?, pixels(to)?]))
        };
        let channel = || named(&ProfileChannel::ALL, ProfileChannel::name, text).map(ProfileCommand::SetChannel);
        let switch = || toggle(text).map(ProfileCommand::Show);
        line().or_else(channel).or_else(switch).map(Command::Profile)
    });

pub(in crate::viewer) const SPECTRUM: Argument =
    argument("frame|difference|texture|scene, whole|pin, or on|off|flip", |text| {
        let of = || named(&SpectrumOf::ALL, SpectrumOf::name, text).map(SpectrumCommand::Of);
        let part = || named(&SpectrumPart::ALL, SpectrumPart::name, text).map(SpectrumCommand::Part);
        let switch = || toggle(text).map(SpectrumCommand::Show);
        of().or_else(part).or_else(switch).map(Command::Spectrum)
    });

pub(in crate::viewer) const OVERLAY: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::OverlayText).map(Command::Window)
});

pub(in crate::viewer) const HIDE: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::HideEverything).map(Command::Window)
});

pub(in crate::viewer) const ABOUT: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::About).map(Command::Window)
});

pub(in crate::viewer) const START_CARD: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::StartCard).map(Command::Window)
});

pub(in crate::viewer) const PRESENTER: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::Presenter).map(Command::Window)
});

pub(in crate::viewer) const INTERFACE_SCALE: Argument = argument("a percentage from 50 to 300", |text| {
    whole(text.trim_end_matches(['%', ' ']))
        .filter(|percent| (50..=300).contains(percent))
        .map(InterfaceScale::from_percent)
        .map(WindowCommand::SetInterfaceScale)
        .map(Command::Window)
});

pub(in crate::viewer) const EXPLANATION: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(InspectorCommand::Explanation).map(Command::Inspector)
});

pub(in crate::viewer) const PANEL: Argument = argument(Toggle::FORM, |text| {
    toggle(text).map(WindowCommand::Panel).map(Command::Window)
});

pub(in crate::viewer) const THEME: Argument = argument("dark|light", |text| {
    named(&Theme::ALL, Theme::name, text)
        .map(WindowCommand::SetTheme)
        .map(Command::Window)
});

pub(in crate::viewer) const SHEET_COLUMNS: Argument = argument(SHEET_AXIS, |text| sheet_axis(SheetSide::Columns, text));

pub(in crate::viewer) const SHEET_ROWS: Argument = argument(SHEET_AXIS, |text| sheet_axis(SheetSide::Rows, text));

pub(in crate::viewer) const SHEET_INSET: Argument = argument("on|off", |text| {
    let inset = match text {
        "on" => true,
        "off" => false,
        _ => return None,
    };
    Some(Command::Sheet(SheetCommand::Change(SheetChange::Inset(inset))))
});

pub(in crate::viewer) const SHEET_PANELS: Argument = argument("window, page or WIDTHxHEIGHT", |text| {
    let panels = PanelSize::parse(text)?;
    Some(Command::Sheet(SheetCommand::Change(SheetChange::Panels(panels))))
});

pub(in crate::viewer) const SHEET_THEME: Argument = argument("light|dark", |text| {
    named(&Ground::ALL, Ground::name, text).map(|theme| Command::Sheet(SheetCommand::Change(SheetChange::Theme(theme))))
});

pub(in crate::viewer) const SHEET_NOTE: Argument = argument("a sentence, or none", |text| {
    let note = if text == "none" { "" } else { text };
    (!text.is_empty()).then(|| Command::Sheet(SheetCommand::Change(SheetChange::Note(note.to_owned()))))
});

/// The form of an axis.
const SHEET_AXIS: &str = "a setting and its values, such as sample-rate 1,4,16; or none";

fn sheet_axis(side: SheetSide, text: &str) -> Option<Command> {
    let axis = if text == "none" {
        None
    } else {
        let (name, values) = text.split_once(char::is_whitespace)?;
        Some(Axis::read(picture::option_meant(name), values).ok()?)
    };
    Some(Command::Sheet(SheetCommand::Change(SheetChange::Axis(side, axis))))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    #[test]
    fn pictures_are_saved_as_png_files() {
        let file = |text| SAVE_AS.parse(text).ok();
        let at = |path: &str| Some(Command::Export(ExportCommand::SaveAs(path.into())));
        assert_eq!(file("a b/c.png"), at("a b/c.png"));
        assert_eq!(file("c.PNG"), at("c.PNG"));
        assert_eq!(file("c"), at("c.png"), "the ending need not be typed");
        for wrong in ["", "c.jpg", "folder/", "..", "/"] {
            assert_eq!(file(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn settings_have_the_names_of_scripts_and_of_options() {
        for (short, option) in [("rate 1,4", "sample-rate 1,4"), ("rate", "sample-rate")] {
            let vary = BOARD_VARY.parse(option);
            assert!(vary.is_ok(), "{option}");
            assert_eq!(BOARD_VARY.parse(short), vary, "{short}");
        }
        assert_eq!(
            BOARD_ADD.parse("rate 16, pattern sobol"),
            BOARD_ADD.parse("sample-rate 16, pattern sobol"),
            "changes, too"
        );
        assert_eq!(
            Against::from_text("rate 4"),
            Against::from_text("sample-rate 4"),
            "and B"
        );
        let file = Some(Against::File("rate 4.png".into()));
        assert_eq!(Against::from_text("rate 4.png"), file, "but a file may be called so");
        assert!(BOARD_VARY.parse("zoom 1,4").is_err(), "no setting");
    }

    #[test]
    fn paths_are_read_as_people_type_them() {
        let at_home = path("~/a.svg");
        assert_eq!(
            OPEN.parse("~/a.svg"),
            Ok(Command::Scenes(SceneCommand::Open(vec![at_home.clone()]))),
            "a scene"
        );
        assert_eq!(
            AGAINST.parse("~/a.svg"),
            Ok(Command::Ab(AbCommand::Compare(Against::File(at_home)))),
            "a picture"
        );
    }

    #[test]
    fn problems_of_numbers_say_what_is_wanted() {
        let problem = |argument: Argument, text: &str| argument.parse(text).expect_err(text);
        assert_eq!(problem(ROTATE, "nan"), "\"nan\" is not DEGREES: a number is wanted");
        let factor = problem(ZOOM, "0");
        assert!(
            factor.starts_with("\"0\" is not FACTOR [X,Y]: a factor above 0"),
            "{factor}"
        );
    }

    #[test]
    fn argument_forms() {
        let zoomed = ZOOM.parse("2 10,20");
        let expected = Command::View(ViewCommand::ZoomAt {
            at: Some(DVec2::new(10.0, 20.0)),
            factor: 2.0,
        });
        assert_eq!(zoomed, Ok(expected), "factor and place");
        assert_eq!(
            PIN.parse(" 512, 300 "),
            Ok(Command::Inspector(InspectorCommand::Pin([512, 300]))),
            "blanks do not matter"
        );
        assert_eq!(
            SCENE.parse("1"),
            Ok(Command::Scenes(SceneCommand::Show(0))),
            "people count from 1"
        );
        for (text, command) in [
            ("1,2  30,-4", ProfileCommand::SetLine([[1, 2], [30, -4]])),
            ("green", ProfileCommand::SetChannel(ProfileChannel::Green)),
            ("off", ProfileCommand::Show(Toggle::Off)),
        ] {
            assert_eq!(PROFILE.parse(text), Ok(Command::Profile(command)), "{text}");
        }
        for (text, command) in [
            ("scene", SpectrumCommand::Of(SpectrumOf::Scene)),
            ("pin", SpectrumCommand::Part(SpectrumPart::Pin)),
            ("off", SpectrumCommand::Show(Toggle::Off)),
        ] {
            assert_eq!(SPECTRUM.parse(text), Ok(Command::Spectrum(command)), "{text}");
        }
        for (argument, wrong) in [
            (SPECTRUM, "image"),
            (ZOOM, "-1"),
            (ZOOM, "inf"),
            (ROTATE, "nan"),
            (PAN, "1"),
            (VIEW, "0,0,0"),
            (WIPE, "1.5"),
            (DIFFERENCE, "other"),
            (GAIN, "0"),
            (GAIN, "nan"),
            (ARRANGE, "both"),
            (AGAINST, ""),
            (SCENE, "0"),
            (PIN, "1.5,2"),
            (PROFILE, "1,2"),
            (PROFILE, "1,2 3,x"),
            (PROFILE, "alpha"),
            (OPEN, ""),
        ] {
            let message = argument.parse(wrong).expect_err(wrong);
            assert!(message.contains(&*argument.usage()), "{message} gives the form");
        }
    }
}
