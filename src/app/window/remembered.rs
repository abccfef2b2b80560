//! What is remembered from one session to the next: a small TOML file in the platform's folder for settings.
//!
//! It may have been edited by hand or cut off by a full disk: what cannot be understood never stops the start.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use etcetera::BaseStrategy as _;
use serde::{Deserialize, Serialize};

use crate::app::interface::PanelWidths;
use crate::plain;
use crate::viewer::picture::{self, PictureSetting};
use crate::viewer::{InterfaceScale, PixelZoom, Settings, Theme};

/// Largest file that is read, in bytes: ours have some hundred.
const MOST_BYTES: u64 = 1 << 20;
/// Files that are remembered at most.
const MOST_RECENT: usize = 12;
/// What stands at the head of the file.
const HEAD: &str =
    "# What Rasterscope remembers: written when its window closes, read when one opens (--no-config: neither).\n\n";

/// What is remembered. What the file leaves out is as in the first session.
#[expect(
    clippy::struct_excessive_bools,
    reason = "three things that are so or not, each on its own"
)]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(super) struct Remembered {
    /// Whether a newcomer was greeted already.
    pub(super) greeted: bool,
    /// Light or dark, where the user chose.
    #[serde(skip_serializing_if = "Option::is_none")]
    theme: Option<String>,
    /// Size of panels and letters in percent.
    #[serde(skip_serializing_if = "Option::is_none")]
    interface_scale: Option<u32>,
    /// Whether the window looks as a projector needs it.
    #[serde(skip_serializing_if = "is_first")]
    pub(super) presenter: bool,
    /// Whether the side panel is open, where the user chose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) panel: Option<bool>,
    /// The window's inner size in device pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) size: Option<[u32; 2]>,
    /// The upper left corner of the window with its frame, in device pixels of the desktop, where the system tells it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) place: Option<[i32; 2]>,
    /// Whether the window filled its monitor; size and place are those of before.
    #[serde(skip_serializing_if = "is_first")]
    pub(super) maximized: bool,
    /// Whether the scene's words are to be seen, where the user chose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) about: Option<bool>,
    /// Window pixels per frame pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pixel_zoom: Option<u32>,
    /// Whether coarse pictures stand in for slow ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    progressive: Option<bool>,
    /// Whether files are read again when they change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) follow_files: Option<bool>,
    /// Files and folders that were opened, the latest first.
    pub(super) recent: Vec<PathBuf>,
    /// Settings of sampling and textures that are not at their defaults, by the names of their options.
    #[serde(skip_serializing_if = "is_first")]
    settings: BTreeMap<String, String>,
    /// Sections of the explanation that the user folded (`false`) or unfolded.
    #[serde(skip_serializing_if = "is_first")]
    pub(super) sections: BTreeMap<String, bool>,
    /// How wide the user made panels, in points: a table, which stands last in the file.
    #[serde(skip_serializing_if = "is_first")]
    pub(super) panel_widths: PanelWidths,
}

/// Whether nothing was chosen.
fn is_first<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Remembered {
    /// The file; `None` where the system names no folder for it.
    pub(super) fn file() -> Option<PathBuf> {
        let folders = etcetera::choose_base_strategy().ok()?;
        Some(folders.config_dir().join("rasterscope").join("session.toml"))
    }

    /// Reads the file. One that cannot be understood is kept under another name; then a line tells that.
    pub(super) fn read(file: &Path) -> (Self, Option<String>) {
        let text = match text_of(file) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return (Self::default(), None),
            Err(error) => return (Self::default(), Some(set_aside(file, &error.to_string()))),
        };
        match toml::from_str::<Self>(&text) {
            Ok(remembered) => (remembered, None),
            Err(error) => (Self::default(), Some(set_aside(file, error.message()))),
        }
    }

    /// Writes the file, all of it or nothing.
    ///
    /// # Errors
    /// When the folder or the file cannot be written.
    pub(super) fn write(&self, file: &Path) -> io::Result<()> {
        let folder = file.parent().unwrap_or(Path::new("."));
        fs::create_dir_all(folder)?;
        let text = toml::to_string(self).map_err(io::Error::other)?;
        let draft = folder.join(format!(".session.toml.{}", std::process::id()));
        fs::write(&draft, format!("{HEAD}{text}"))?;
        fs::rename(&draft, file).inspect_err(|_| {
            // What could not be put in place is of no use.
            let _ = fs::remove_file(&draft);
        })
    }

    /// The theme, where the user chose one.
    pub(super) fn theme(&self) -> Option<Theme> {
        let name = self.theme.as_deref()?;
        Theme::ALL.into_iter().find(|theme| theme.name() == name)
    }

    /// Remembers a theme.
    pub(super) fn set_theme(&mut self, theme: Theme) {
        self.theme = Some(theme.name().to_owned());
    }

    /// The size of the interface.
    pub(super) fn interface_scale(&self) -> InterfaceScale {
        self.interface_scale
            .map_or(InterfaceScale::ORIGINAL, InterfaceScale::from_percent)
    }

    /// Remembers a size of the interface.
    pub(super) fn set_interface_scale(&mut self, scale: InterfaceScale) {
        self.interface_scale = (scale != InterfaceScale::ORIGINAL).then(|| scale.percent().into());
    }

    /// Takes up the settings of the last session, but for those options that the command line gave.
    pub(super) fn take_up(&self, settings: &mut Settings, given: &[&str]) {
        let asked = *settings;
        let mut taken = Settings {
            pixel_zoom: self.pixel_zoom.and_then(PixelZoom::new).unwrap_or(asked.pixel_zoom),
            progressive: self.progressive.unwrap_or(asked.progressive),
            ..asked
        };
        for setting in picture::sampling().filter(|setting| !given.contains(&setting.option)) {
            let value = self.settings.get(setting.option);
            if let Some(value) = value {
                // An older or a newer program may not know a name: then all stays as it is.
                setting.set(&mut taken, value);
            }
        }
        // Together, since a rate may be one that only the other pattern takes.
        let render = &mut taken.render;
        render.sample_rate = render.pattern.nearest(render.sample_rate);
        // What was given stays, even where a pattern of the last session would not take its sample rate.
        let is_kept = |setting: &&PictureSetting| setting.value(&taken) == setting.value(&asked);
        let given_stays = picture::sampling()
            .filter(|setting| given.contains(&setting.option))
            .all(|setting| is_kept(&setting));
        *settings = if given_stays { taken } else { asked };
    }

    /// Whether the last session left settings that are not the first ones.
    pub(super) fn has_settings(&self) -> bool {
        !self.settings.is_empty()
    }

    /// Remembers settings, but not in which dialect documents are read: that is theirs.
    pub(super) fn set_settings(&mut self, settings: &Settings) {
        // A window that begins with the levels of textures instead of the picture is taken for broken.
        let kept = picture::sampling().filter(|setting| setting.option != "visualise");
        let changed = kept.filter(|setting| !setting.is_default(settings));
        self.settings = changed
            .map(|setting| (setting.option.to_owned(), setting.value(settings)))
            .collect();
        let first = Settings::default();
        self.pixel_zoom = (settings.pixel_zoom != first.pixel_zoom).then(|| settings.pixel_zoom.factor());
        self.progressive = (settings.progressive != first.progressive).then_some(settings.progressive);
    }

    /// Remembers files and folders that were opened, the latest first.
    pub(super) fn set_recent(&mut self, files: &[PathBuf]) {
        // TOML is text.
        let files = files.iter().filter(|file| file.to_str().is_some());
        self.recent = files.take(MOST_RECENT).cloned().collect();
    }
}

/// The file's text, unless it is larger than ours ever are.
fn text_of(file: &Path) -> io::Result<String> {
    if !fs::metadata(file)?.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    let mut text = String::new();
    fs::File::open(file)?.take(MOST_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MOST_BYTES {
        return Err(io::Error::other("it is larger than 1 MiB"));
    }
    Ok(text)
}

/// Keeps a file that is not understood under another name. The line that tells it.
fn set_aside(file: &Path, why: &str) -> String {
    let kept = file.with_extension("toml.bad");
    let why = plain::line(why);
    match fs::rename(file, &kept) {
        Ok(()) => format!(
            "{}: what was remembered cannot be read: {why}; it is kept as {}, and all is as in the first session",
            file.display(),
            kept.display()
        ),
        Err(error) => format!(
            "{}: what was remembered cannot be read: {why}; nor can it be set aside: {error}; remove it",
            file.display()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("new/session.toml");
        assert_eq!(
            Remembered::read(&file),
            (Remembered::default(), None),
            "the first session"
        );
        let mut remembered = Remembered {
            greeted: true,
            panel: Some(false),
            size: Some([900, 700]),
            ..Remembered::default()
        };
        remembered.set_theme(Theme::Light);
        remembered.set_interface_scale(InterfaceScale::from_percent(150));
        remembered.presenter = true;
        remembered.place = Some([-20, 40]);
        remembered.sections.insert("hints".to_owned(), false);
        remembered.set_settings(&settings_of(&[("sample-rate", "9"), ("pixel-sampling", "bilinear")]));
        let many: Vec<PathBuf> = (0..40)
            .map(|i| PathBuf::from(format!("/scenes/a \"b\" {i}.svg")))
            .collect();
        remembered.set_recent(&many);
        remembered.write(&file).expect("written");
        assert_eq!(Remembered::read(&file), (remembered.clone(), None), "all of it");
        assert_eq!(remembered.recent, many[..MOST_RECENT], "the latest");
        assert_eq!(remembered.theme(), Some(Theme::Light));
        let text = fs::read_to_string(&file).expect("text");
        assert!(
            text.starts_with('#') && text.contains("interface-scale = 150"),
            "{text}"
        );
    }

    fn settings_of(changes: &[(&str, &str)]) -> Settings {
        let mut settings = Settings::default();
        for (option, value) in changes {
            let setting = picture::find(option).expect("a setting");
            assert!(setting.set(&mut settings, value), "{option} {value}");
        }
        settings
    }

    #[test]
    fn settings_are_taken_up_where_nothing_else_was_asked_for() {
        let left = [("sample-rate", "5"), ("pattern", "halton"), ("dialect", "course")];
        let mut remembered = Remembered::default();
        remembered.set_settings(&settings_of(&left));
        let taken = |given: &[(&str, &str)]| {
            let mut settings = settings_of(given);
            let names: Vec<&str> = given.iter().map(|(option, _)| *option).collect();
            remembered.take_up(&mut settings, &names);
            settings
        };
        assert_eq!(
            taken(&[]),
            settings_of(&left[..2]),
            "all but the dialect, which is the document's"
        );
        let sixteen = taken(&[("sample-rate", "16")]);
        assert_eq!(sixteen, settings_of(&[("sample-rate", "16"), left[1]]), "the rest");
        let grid = taken(&[("pattern", "grid")]);
        assert_eq!(grid.render.pattern, settings_of(&[]).render.pattern, "as asked for");
        assert_eq!(grid.render.sample_rate.samples(), 4, "a rate that the grid has");
        let one = taken(&[("sample-rate", "1"), ("pattern", "grid")]);
        assert_eq!(one, Settings::default(), "defaults that were asked for");
    }

    #[test]
    fn corrupt_file_is_set_aside() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("session.toml");
        let large = vec![b'#'; 2 << 20];
        for text in [&b"theme = "[..], b"size = 'large'", b"\xff\xfe", &large] {
            fs::write(&file, text).expect("a file");
            let (remembered, told) = Remembered::read(&file);
            assert_eq!(remembered, Remembered::default(), "as in the first session");
            let told = told.expect("it is told");
            assert!(told.contains("session.toml") && !told.contains('\n'), "{told}");
            assert!(!file.exists(), "it is out of the way");
            let kept = fs::read(folder.path().join("session.toml.bad")).expect("kept");
            assert!(kept == text, "as it was");
        }
        for text in [
            "unknown = 1",
            "theme = 'pink'",
            "interface-scale = 7",
            "size = [0, 4000000000]",
            "place = [-2000000000, 2000000000]",
            "pixel-zoom = 5",
            "[settings]\nsample-rate = 'many'\nno-such = '1'",
            "[sections]\nno-such = true",
        ] {
            fs::write(&file, text).expect("a file");
            let (remembered, told) = Remembered::read(&file);
            assert_eq!(told, None, "{text}: understood");
            assert_eq!(remembered.theme(), None, "no such theme");
            let mut settings = Settings::default();
            remembered.take_up(&mut settings, &[]);
            assert_eq!(settings, Settings::default(), "{text}: no such settings");
            assert!(remembered.interface_scale().percent() >= 50, "in its range");
        }
    }
}
