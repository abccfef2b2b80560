//! Screenshots: PNG files named by a template, at first the time to the millisecond, that tell how they were made and never
//! replace another file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use jiff::Timestamp;
use jiff::tz::TimeZone;

use crate::figure::{InsetSpec, Record, RecordedB, add_furniture, encode_png, write_new};
use crate::raster::Framebuffer;
use crate::render::Legend;
use crate::scene::Scene;
use crate::viewer::chrome::messages::Messages;
use crate::viewer::export::naming::{NameTemplate, names_to_try};
use crate::viewer::export::sheet::saving::SheetJob;
use crate::viewer::export::spec::{PictureSpec, RecipeOfCommand, input_file};
use crate::viewer::frames::frame::Frame;
use crate::viewer::jobs::mailbox::Mailbox;
use crate::viewer::jobs::pool::{AtEnd, WorkerPool, guarded};

/// Largest file of a time zone that is read, in bytes.
const MAX_ZONE: u64 = 1 << 20;

/// The state of saving.
#[derive(Debug)]
pub(in crate::viewer) struct Saver {
    workers: WorkerPool<Job>,
    /// Where pictures go; `None` is the current folder.
    folder: Option<PathBuf>,
    name: NameTemplate,
    /// Where the last picture went.
    last_folder: Option<PathBuf>,
    /// Screenshots that wait for a final frame, with their files where those were chosen, and the request that the frame
    /// must not be older than: what was to be seen when the last was asked for.
    pub(in crate::viewer) waiting: Vec<Option<PathBuf>>,
    pub(in crate::viewer) since: u64,
    /// Pictures at work.
    running: u32,
}

/// What is to be saved, and where.
pub(in crate::viewer) struct Job {
    folder: PathBuf,
    name: NameTemplate,
    work: Work,
}

pub(in crate::viewer) enum Work {
    Picture {
        shot: Shot,
        recipe: Option<Box<Recipe>>,
        /// The file; one with a name of its own in the folder where there is none.
        file: Option<PathBuf>,
    },
    Sheet(Box<SheetJob>),
}

/// Said until a sheet is saved, whose panels may take seconds to draw.
pub(in crate::viewer) const SAVING_SHEET: &str = "drawing the sheet that is saved";

/// How a picture was made; its record names the file, whose name is not known before it is written.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct Recipe {
    pub(in crate::viewer) spec: PictureSpec,
    pub(in crate::viewer) scene: Arc<Scene>,
    /// How the picture differs from what `spec` alone makes.
    pub(in crate::viewer) differs: Option<String>,
    /// The command that makes it, where that is not `render`.
    pub(in crate::viewer) command: Option<RecipeOfCommand>,
    /// B, where the picture shows more than `spec` makes.
    pub(in crate::viewer) compared: Option<RecipeOfB>,
}

/// B of a picture that A shares with it, or that it fills though no command line makes it.
#[derive(Clone, Debug)]
pub(in crate::viewer) struct RecipeOfB {
    /// What it is, as `view --against` takes it.
    pub(in crate::viewer) against: String,
    /// How both share the picture, as scripts say it.
    pub(in crate::viewer) arrangement: String,
    /// The file of a picture from outside.
    pub(in crate::viewer) picture: Option<PathBuf>,
}

impl Recipe {
    /// The record for the file `output`.
    pub(in crate::viewer) fn record(&self, output: &Path) -> Record {
        let mut record = Record {
            differs: self.differs.clone(),
            compared: self.compared.as_ref().map(|compared| compared.record(output)),
            ..self.spec.record(&self.scene, output)
        };
        if let Some(command) = &self.command {
            command.put_into(&mut record, &self.spec, output);
        }
        record
    }
}

impl RecipeOfB {
    fn record(&self, output: &Path) -> RecordedB {
        RecordedB {
            against: self.against.clone(),
            arrangement: self.arrangement.clone(),
            picture: self.picture.as_ref().map(|path| input_file(path, output)),
        }
    }
}

pub(in crate::viewer) enum Shot {
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
pub(in crate::viewer) struct Saved(pub(in crate::viewer) Result<(PathBuf, [u32; 2]), String>);

impl Saver {
    pub(in crate::viewer) fn start(
        mailbox: Mailbox<Saved>,
        folder: Option<PathBuf>,
        name: NameTemplate,
    ) -> io::Result<Self> {
        let work = move |job: Job| {
            let saved = guarded(|| job.save()).unwrap_or_else(|| Err("saving failed inside the program".to_owned()));
            mailbox.post(Saved(saved));
        };
        Ok(Self {
            workers: WorkerPool::start("save", 1, AtEnd::Complete, work)?,
            folder,
            name,
            last_folder: None,
            waiting: Vec::new(),
            since: 0,
            running: 0,
        })
    }

    pub(in crate::viewer) fn is_idle(&self) -> bool {
        self.waiting.is_empty() && self.running == 0
    }

    /// A screenshot of the frame of this request, or of a later one, is to be saved, in this file if one was chosen.
    pub(in crate::viewer) fn ask(&mut self, request: u64, file: Option<PathBuf>) {
        self.waiting.push(file);
        self.since = request;
    }

    /// The folder where the last picture went, or the next will go.
    pub(in crate::viewer) fn folder_to_show(&self) -> PathBuf {
        let folder = self.last_folder.as_ref().or(self.folder.as_ref());
        folder.cloned().unwrap_or_else(|| PathBuf::from("."))
    }

    /// Whether a screenshot waits for its frame.
    pub(in crate::viewer) fn is_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// Takes in what became of a picture, and tells the user.
    pub(in crate::viewer) fn take_in(&mut self, Saved(saved): Saved, messages: &mut Messages) {
        self.running = self.running.saturating_sub(1);
        if self.running == 0 {
            messages.retract(SAVING_SHEET);
        }
        match saved {
            Ok((path, [width, height])) => {
                let (name, folder) = (path.file_name().unwrap_or_default(), folder_of(&path));
                let (name, place) = (name.display(), folder.display());
                messages.saved(format!("saved {name}, {width} x {height} pixels, in {place}"));
                self.last_folder = Some(folder);
            }
            Err(problem) => messages.error(problem),
        }
    }

    /// Saves a sheet beside the pictures.
    pub(in crate::viewer) fn push_sheet(&mut self, sheet: SheetJob) {
        self.push(Work::Sheet(Box::new(sheet)));
    }

    pub(in crate::viewer) fn push(&mut self, work: Work) {
        let folder = self.folder.clone().unwrap_or_else(|| PathBuf::from("."));
        self.running += 1;
        self.workers.push(Job {
            folder,
            name: self.name.clone(),
            work,
        });
    }
}

impl Shot {
    pub(in crate::viewer) fn picture(self) -> Result<Framebuffer, String> {
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
            Work::Picture {
                shot,
                recipe,
                file: Some(file),
            } => save_at(&file, &shot.picture()?, recipe.as_deref()),
            Work::Picture { shot, recipe, .. } => {
                save_new(&self.folder, &self.name, &shot.picture()?, recipe.as_deref())
            }
            Work::Sheet(sheet) => {
                let stem = self.name.name(Some(sheet.spec()), &now());
                sheet.save(&self.folder, &format!("{stem}-sheet"))
            }
        }
    }
}

/// The time of day, as names of files tell it.
pub(in crate::viewer) fn now() -> String {
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

/// The whole path of the folder that holds a file, as far as it can be told.
fn folder_of(file: &Path) -> PathBuf {
    let folder = file.parent().unwrap_or(Path::new("."));
    std::path::absolute(folder.join(".")).map_or_else(|_| folder.to_owned(), |whole| whole.components().collect())
}

/// Saves `picture` in a file that does not exist yet.
fn save_at(path: &Path, picture: &Framebuffer, recipe: Option<&Recipe>) -> Result<(PathBuf, [u32; 2]), String> {
    let record = recipe.map(|recipe| recipe.record(path));
    let bytes =
        encode_png(picture, record.as_ref()).map_err(|error| format!("cannot make a PNG of this picture: {error}"))?;
    match write_new(path, &bytes) {
        Ok(()) => Ok((path.to_owned(), [picture.width(), picture.height()])),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(format!(
            "{}: this file exists and is not replaced; choose another name",
            path.display()
        )),
        Err(error) => Err(format!(
            "{}: cannot save here: {error}; choose another place",
            path.display()
        )),
    }
}

/// Saves `picture` in `folder` under a name that did not exist.
fn save_new(
    folder: &Path,
    name: &NameTemplate,
    picture: &Framebuffer,
    recipe: Option<&Recipe>,
) -> Result<(PathBuf, [u32; 2]), String> {
    let cure = "choose another folder with \"Save picture as\" or --screenshot-dir";
    let stem = name.name(recipe.map(|recipe| &recipe.spec), &now());
    for name in names_to_try(&stem) {
        let path = folder.join(format!("{name}.png"));
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
                save_new(folder.path(), &NameTemplate::default(), &picture, None)
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
            save_new(&nowhere, &NameTemplate::default(), &Framebuffer::new(1, 1), None).expect_err("no folder");
        assert!(
            problem.contains("no/such") && problem.contains("--screenshot-dir"),
            "{problem}"
        );
    }
}
