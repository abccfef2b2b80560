//! Screenshots: PNG files named by a template, at first the time to the millisecond, that tell how they were made and never replace another
//! file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use jiff::Timestamp;
use jiff::tz::TimeZone;

use super::background::{AtEnd, Crew, guarded};
use super::mailbox::Mailbox;
use super::sheet::SheetJob;
use super::{Effect, Frame, NameTemplate, PictureSpec, Viewer};
use crate::figure::{InsetSpec, Record, add_furniture, add_legends, encode_png, write_new};
use crate::raster::Framebuffer;
use crate::render::Legend;
use crate::scene::Scene;

/// Names that are tried for one picture: others may have been saved in the same millisecond.
const ATTEMPTS: u32 = 1000;

/// Largest file of a time zone that is read, in bytes.
const MAX_ZONE: u64 = 1 << 20;

/// The state of saving.
#[derive(Debug)]
pub(super) struct Saver {
    crew: Crew<Job>,
    /// Where pictures go; `None` is the current folder.
    folder: Option<PathBuf>,
    name: NameTemplate,
    /// Screenshots that wait for a final frame, and the wish that it must not be older than: what was to be seen when
    /// the last was asked for.
    waiting: u32,
    since: u64,
    /// Pictures at work.
    running: u32,
}

/// What is to be saved, and where.
struct Job {
    folder: PathBuf,
    name: NameTemplate,
    work: Work,
}

enum Work {
    Picture(Shot, Option<Box<Recipe>>),
    Sheet(Box<SheetJob>),
}

/// How a picture was made; its record names the file, whose name is not known before it is written.
#[derive(Clone, Debug)]
pub(super) struct Recipe {
    spec: PictureSpec,
    scene: Arc<Scene>,
    /// How the picture differs from what `spec` alone makes.
    differs: Option<String>,
}

impl Recipe {
    /// The record for the file `output`.
    pub(super) fn record(&self, output: &Path) -> Record {
        Record {
            differs: self.differs.clone(),
            ..self.spec.record(&self.scene, output)
        }
    }
}

enum Shot {
    /// A frame, what of it is magnified, and what its colours show.
    Frame {
        frame: Arc<Frame>,
        insets: Vec<InsetSpec>,
        legends: Vec<Legend>,
    },
    /// A picture that is put together already.
    Ready(Framebuffer),
}

/// What became of a picture.
#[derive(Debug)]
pub(super) struct Saved(Result<(PathBuf, [u32; 2]), String>);

impl Saver {
    pub(super) fn start(mailbox: Mailbox<Saved>, folder: Option<PathBuf>, name: NameTemplate) -> io::Result<Self> {
        let work = move |job: Job| {
            let saved = guarded(|| job.save()).unwrap_or_else(|| Err("saving failed inside the program".to_owned()));
            mailbox.post(Saved(saved));
        };
        Ok(Self {
            crew: Crew::start("save", 1, AtEnd::Complete, work)?,
            folder,
            name,
            waiting: 0,
            since: 0,
            running: 0,
        })
    }

    pub(super) fn is_idle(&self) -> bool {
        self.waiting == 0 && self.running == 0
    }

    /// Whether a screenshot waits for its frame.
    pub(super) fn is_waiting(&self) -> bool {
        self.waiting > 0
    }

    /// Saves a sheet beside the pictures.
    pub(super) fn push_sheet(&mut self, sheet: SheetJob) {
        self.push(Work::Sheet(Box::new(sheet)));
    }

    fn push(&mut self, work: Work) {
        let folder = self.folder.clone().unwrap_or_else(|| PathBuf::from("."));
        self.running += 1;
        self.crew.push(Job {
            folder,
            name: self.name.clone(),
            work,
        });
    }
}

impl Viewer {
    /// Saves the picture of the whole window, as [`super::Effect::PictureOfWindow`] asks for it.
    pub fn save_window_picture(&mut self, window: Framebuffer) {
        if window.pixels().is_empty() {
            self.messages
                .error("nothing to save: the window has no pixels; make it larger".to_owned());
        } else {
            let recipe = self.recipe_of_window();
            self.saver
                .push(Work::Picture(Shot::Ready(window), recipe.map(Box::new)));
        }
        self.update();
    }

    pub(super) fn ask_for_screenshot(&mut self) {
        self.saver.waiting = self.saver.waiting.saturating_add(1);
        self.saver.since = self.drawing.newest_wish();
        // No preview, and no rest: the picture of this moment, even if the view goes on moving.
        self.set_hurry(true);
    }

    /// The picture that screenshots wait for is another one now.
    pub(super) fn wait_for_newest_frame(&mut self) {
        self.saver.since = self.drawing.newest_wish();
    }

    /// Saves the screenshots that wait, as soon as there is a final frame of the state when they were asked for, or of
    /// a later one.
    pub(super) fn save_when_ready(&mut self) {
        let reading = self.current().is_some_and(super::SceneEntry::is_reading);
        if self.saver.waiting == 0 || reading || !self.probing.is_current() {
            return;
        }
        let Some(frame) = self.drawing.final_frame(self.saver.since).cloned() else {
            if !self.drawing.is_current() {
                return;
            }
            self.saver.waiting = 0;
            self.set_hurry(false);
            self.messages
                .error("nothing to save: there is no picture; open a scene first".to_owned());
            return;
        };
        if self.comparison.shows_both() && !self.comparison.is_current() {
            return;
        }
        let recipe = self.recipe_of_frame(&frame, self.comparison.shows_both());
        for _ in 0..std::mem::take(&mut self.saver.waiting) {
            let shot = self.shot_of(&frame, recipe.as_ref());
            self.saver.push(Work::Picture(shot, recipe.clone().map(Box::new)));
        }
        self.set_hurry(false);
    }

    /// What a screenshot of this frame shows.
    fn shot_of(&self, frame: &Arc<Frame>, recipe: Option<&Recipe>) -> Shot {
        if !self.comparison.shows_both() {
            return Shot::Frame {
                frame: Arc::clone(frame),
                insets: recipe.map_or(Vec::new(), |recipe| recipe.spec.insets.clone()),
                legends: self.legends_of_picture(),
            };
        }
        if self.inset.is_some() {
            // The inset is in window pixels.
            return Shot::Ready(self.window_picture());
        }
        let mut picture = self.composite().picture();
        add_legends(&mut picture, &self.legends_of_picture(), &[]);
        Shot::Ready(picture)
    }

    /// Copies the inspected pixel in words, or the picture while no pixel is inspected.
    pub(super) fn copy(&mut self) -> Vec<Effect> {
        if self.inspector.open {
            self.copy_pixel()
        } else {
            self.copy_picture()
        }
    }

    /// The picture as a screenshot of this moment shows it.
    pub(super) fn copy_picture(&mut self) -> Vec<Effect> {
        let frame = self.drawing.final_frame(self.drawing.newest_wish()).cloned();
        let both_current = !self.comparison.shows_both() || self.comparison.is_current();
        let Some(frame) = frame.filter(|_| both_current) else {
            let problem = "nothing copied: there is no finished picture yet; copy again when it is drawn";
            self.messages.error(problem.to_owned());
            return Vec::new();
        };
        let recipe = self.recipe_of_frame(&frame, self.comparison.shows_both());
        match self.shot_of(&frame, recipe.as_ref()).picture() {
            Ok(picture) => {
                let (width, height) = (picture.width(), picture.height());
                self.messages
                    .done(format!("copied the picture, {width} x {height} pixels"));
                vec![Effect::CopyPicture(picture)]
            }
            Err(problem) => {
                self.messages.error(problem);
                Vec::new()
            }
        }
    }

    /// How the picture of the whole window was made.
    fn recipe_of_window(&self) -> Option<Recipe> {
        Some(Recipe {
            spec: self.picture_spec()?,
            scene: Arc::clone(self.current()?.scene()?),
            differs: Some("a picture of the window; the command line draws what it shows, without panels".to_owned()),
        })
    }

    /// The record of a picture of the window that is written to `output`; `None` without a scene.
    pub fn record_of_window(&self, output: &Path) -> Option<Record> {
        Some(self.recipe_of_window()?.record(output))
    }

    /// How a frame was made, and what else its picture shows.
    fn recipe_of_frame(&self, frame: &Frame, with_other: bool) -> Option<Recipe> {
        let now = self.picture_spec()?;
        let picture = &frame.picture;
        let spec = PictureSpec {
            size: picture.size,
            render: picture.settings,
            // What A and B share has its own insets, in window pixels.
            insets: if with_other { Vec::new() } else { now.insets.clone() },
            ..now
        };
        let drawn_of_now = self
            .current()?
            .scene()
            .is_some_and(|scene| Arc::ptr_eq(scene, &picture.scene));
        let seen_from_there = spec.view.transform(picture.scene.canvas, picture.size) == picture.view;
        let differs = if !drawn_of_now || !seen_from_there {
            Some("the view moved on while this picture was saved; the command line draws where it went")
        } else if with_other {
            Some("A and B share this picture; the command line draws A alone")
        } else {
            None
        };
        Some(Recipe {
            spec,
            scene: Arc::clone(&picture.scene),
            differs: differs.map(str::to_owned),
        })
    }

    pub(super) fn picture_saved(&mut self, Saved(saved): Saved) {
        self.saver.running = self.saver.running.saturating_sub(1);
        match saved {
            Ok((path, [width, height])) => {
                self.messages
                    .done(format!("saved {}, {width} x {height} pixels", path.display()));
            }
            Err(problem) => self.messages.error(problem),
        }
    }
}

impl Shot {
    fn picture(self) -> Result<Framebuffer, String> {
        match self {
            Self::Frame { frame, insets, legends } => {
                let mut picture = frame.pixels.clone();
                add_furniture(&mut picture, &insets, &frame.picture.subject(), &legends)
                    .map_err(|error| error.to_string())?;
                Ok(picture)
            }
            Self::Ready(picture) => Ok(picture),
        }
    }
}

impl Job {
    fn save(self) -> Result<(PathBuf, [u32; 2]), String> {
        match self.work {
            Work::Picture(picture, recipe) => {
                save_new((&self.folder, &self.name), &picture.picture()?, recipe.as_deref())
            }
            Work::Sheet(sheet) => {
                let stem = self.name.name(Some(sheet.spec()), &now());
                sheet.save(&self.folder, &format!("{stem}-sheet"))
            }
        }
    }
}

/// The time of day, as names of files tell it.
fn now() -> String {
    time_text(SystemTime::now(), zone())
}

/// A clock that is set to another age than calendars know tells seconds.
fn time_text(time: SystemTime, zone: TimeZone) -> String {
    if let Ok(time) = Timestamp::try_from(time) {
        return time.to_zoned(zone).strftime("%Y-%m-%d_%H-%M-%S_%3f").to_string();
    }
    match time.duration_since(UNIX_EPOCH) {
        Ok(after) => format!("{}s", after.as_secs()),
        Err(before) => format!("{}s-before-1970", before.duration().as_secs()),
    }
}

/// The zone of the system; UTC where `TZ` leads to what is no file of a zone, such as a pipe that would be read for ever.
fn zone() -> TimeZone {
    let named = std::env::var_os("TZ").unwrap_or_default();
    let named = named.to_string_lossy();
    let about = std::fs::metadata(named.strip_prefix(':').unwrap_or(&named));
    if about.is_ok_and(|about| !about.is_file() || about.len() > MAX_ZONE) {
        return TimeZone::UTC;
    }
    TimeZone::system()
}

/// Saves `picture` in `folder` under a name that did not exist.
fn save_new(
    (folder, name): (&Path, &NameTemplate),
    picture: &Framebuffer,
    recipe: Option<&Recipe>,
) -> Result<(PathBuf, [u32; 2]), String> {
    let cure = "choose another folder with --screenshot-dir";
    let stem = name.name(recipe.map(|recipe| &recipe.spec), &now());
    for attempt in 1..=ATTEMPTS {
        let name = match attempt {
            1 => format!("{stem}.png"),
            _ => format!("{stem}-{attempt}.png"),
        };
        let path = folder.join(name);
        let path = path.strip_prefix(".").unwrap_or(&path).to_owned();
        let record = recipe.map(|recipe| recipe.record(&path));
        let bytes = encode_png(picture, record.as_ref())
            .map_err(|error| format!("cannot make a PNG of this picture: {error}"))?;
        match write_new(&path, &bytes) {
            Ok(()) => return Ok((path, [picture.width(), picture.height()])),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(format!("{}: cannot save here: {error}; {cure}", folder.display())),
        }
    }
    Err(format!(
        "{}: every name for this picture is taken; {cure}",
        folder.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn screenshots_never_replace() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut picture = Framebuffer::new(3, 2);
        picture.pixels_mut()[4] = 0x80ff_8000;
        let paths: Vec<PathBuf> = (0..20)
            .map(|_| {
                save_new((folder.path(), &NameTemplate::default()), &picture, None)
                    .expect("a writable folder")
                    .0
            })
            .collect();
        let files = std::fs::read_dir(folder.path()).expect("the folder").count();
        assert_eq!(files, paths.len(), "each picture has a file of its own");
        let back = image::open(&paths[0]).expect("a PNG").into_rgba8();
        assert_eq!(back.get_pixel(1, 1).0, [255, 128, 0, 128], "straight alpha");
        assert!(write_new(&paths[0], b"x").is_err(), "an existing file is left alone");
        assert_eq!(
            image::open(&paths[0]).expect("still whole").into_rgba8(),
            back,
            "unchanged"
        );
    }

    #[test]
    fn screenshot_names_come_from_any_clock() {
        let at = |seconds: i64| {
            let distance = std::time::Duration::from_secs(seconds.unsigned_abs());
            let time = if seconds < 0 {
                UNIX_EPOCH - distance
            } else {
                UNIX_EPOCH + distance
            };
            time_text(time, TimeZone::UTC)
        };
        assert_eq!(at(0), "1970-01-01_00-00-00_000", "the start");
        assert_eq!(at(-86_400), "1969-12-31_00-00-00_000", "before it");
        assert_eq!(at(253_402_300_800), "253402300800s", "the year 10000");
        assert_eq!(at(i64::MAX / 4), "2305843009213693951s", "the end of time");
        assert_eq!(
            at(-900_000_000_000),
            "900000000000s-before-1970",
            "before all calendars"
        );
    }

    #[test]
    fn screenshot_folder_missing() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let nowhere = folder.path().join("no/such");
        let problem =
            save_new((&nowhere, &NameTemplate::default()), &Framebuffer::new(1, 1), None).expect_err("no folder");
        assert!(
            problem.contains("no/such") && problem.contains("--screenshot-dir"),
            "{problem}"
        );
    }
}
