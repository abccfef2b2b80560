//! The figures that a course's write-up asks for, task by task, and the scenes that they show.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec2;

use crate::cli::failure::{Failure, print_error};
use crate::cli::options::writeup::WriteupOptions;
use crate::compare;
use crate::figure::InsetPlace;
use crate::scene::{self, Dialect, DialectChoice, FolderResources};
use crate::viewer::{gallery, is_folder_of_course};

/// A figure.
#[derive(Debug)]
pub(super) struct Item {
    /// Its file, without ending.
    pub(super) name: &'static str,
    /// What the caption starts with.
    pub(super) says: &'static str,
    /// The command.
    pub(super) verb: &'static str,
    pub(super) subject: Subject,
    /// Its options.
    pub(super) words: &'static [&'static str],
    /// The pin that its inset looks at.
    pub(super) pin: Option<PinnedInset>,
    /// Whether the caption tells how long each panel takes to draw.
    pub(super) timed: bool,
    /// By how many degrees the scene is turned; its whole canvas is shown then.
    pub(super) turned: Option<f64>,
}

/// A pin that insets look at.
#[derive(Clone, Copy, Debug)]
pub(super) struct PinnedInset {
    pub(super) name: &'static str,
    /// The settings that are compared to propose it.
    pub(super) compared: [&'static [&'static str]; 2],
}

/// What a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// A scene of the course, or the one of that name in the gallery.
    Scene(&'static str),
    /// The student's robot.
    Robot,
    /// One triangle with a red, a green and a blue corner.
    Triangle,
    /// The student's own picture on a rectangle.
    Own,
    /// The student's entry for the competition.
    Competition,
}

/// The pin in the student's own picture.
pub(super) const OWN: &str = "own";

const RATES: [&[&str]; 2] = [&[], &["--sample-rate=16"]];
const TEXELS: [&[&str]; 2] = [&[], &["--pixel-sampling=bilinear"]];
const LEVELS: [&[&str]; 2] = [&[], &["--pixel-sampling=bilinear", "--level-sampling=nearest"]];
const TRILINEAR: [&str; 2] = ["--pixel-sampling=bilinear", "--level-sampling=linear"];
const TAPS: [&[&str]; 2] = [
    &TRILINEAR,
    &[
        "--pixel-sampling=bilinear",
        "--level-sampling=linear",
        "--anisotropy=16",
    ],
];

/// A figure without options, pin and times.
const fn plain(name: &'static str, says: &'static str, subject: Subject) -> Item {
    Item {
        name,
        says,
        verb: "render",
        subject,
        words: &["--size=800x800"],
        pin: None,
        timed: false,
        turned: None,
    }
}

/// A pin by its name.
const fn pin(name: &'static str, compared: [&'static [&'static str]; 2]) -> PinnedInset {
    PinnedInset { name, compared }
}

/// A sheet with an inset.
const fn sheet(
    name: &'static str,
    says: &'static str,
    scene: &'static str,
    words: &'static [&'static str],
    pin: PinnedInset,
) -> Item {
    Item {
        verb: "sheet",
        words,
        pin: Some(pin),
        ..plain(name, says, Subject::Scene(scene))
    }
}

/// Every figure, in the order of the tasks.
pub(super) static ITEMS: &[Item] = &[
    Item {
        pin: Some(pin("test4", RATES)),
        ..plain(
            "T1_triangles",
            "Task 1: one sample per pixel",
            Subject::Scene("basic/test4.svg"),
        )
    },
    sheet(
        "T2_supersampling",
        "Task 2: more samples per pixel",
        "basic/test4.svg",
        &["--sample-rate=1,4,16"],
        pin("test4", RATES),
    ),
    Item {
        words: &["--size=800x800", "--sample-rate=16"],
        ..plain("T3_robot", "Task 3: transforms", Subject::Robot)
    },
    plain("T4_triangle", "Task 4: barycentric weights", Subject::Triangle),
    plain(
        "T4_wheel",
        "Task 4: barycentric weights",
        Subject::Scene("basic/test7.svg"),
    ),
    sheet(
        "T5_texels",
        "Task 5: pixel sampling against more samples",
        "texmap/test1.svg",
        &["--pixel-sampling=nearest,bilinear", "--sample-rate=1,16"],
        pin("texture", TEXELS),
    ),
    Item {
        subject: Subject::Own,
        ..sheet(
            "T6_levels",
            "Task 6: level sampling, zoomed out",
            "",
            &[
                "--level-sampling=zero,nearest,linear",
                "--pixel-sampling=nearest,bilinear",
                "--size=480x480",
            ],
            pin(OWN, LEVELS),
        )
    },
    sheet(
        "X1_patterns",
        "Extra: sample patterns where the grid fails",
        "study/13_thin_rays.svg",
        &[
            "--pattern=grid,rotated,jittered,jittered-same,halton,r2",
            "--sample-rate=4",
        ],
        pin(
            "patterns",
            [&["--sample-rate=4"], &["--sample-rate=4", "--pattern=jittered"]],
        ),
    ),
    Item {
        words: &["--size=800x800", "--sample-rate=4"],
        turned: Some(30.0),
        ..plain("X2_rotated", "Extra: a rotated view", Subject::Scene("basic/test4.svg"))
    },
    Item {
        timed: true,
        ..sheet(
            "X3_anisotropy",
            "Extra: anisotropic against trilinear filtering",
            "study/11_city_floor.svg",
            &[
                "--anisotropy=1,16",
                "--pixel-sampling=bilinear",
                "--level-sampling=linear",
            ],
            pin("floor", TAPS),
        )
    },
    Item {
        verb: "sheet",
        words: &["--visualise=coverage,overdraw", "--sample-rate=16"],
        ..plain(
            "X4_visualised",
            "Extra: what the samples know",
            Subject::Scene("study/16_what_is_painted.svg"),
        )
    },
    Item {
        words: &["--size=800x800", "--sample-rate=16"],
        ..plain("competition", "Competition, 800 x 800 pixels", Subject::Competition)
    },
];

/// The longest side of a picture in a panel that is easily seen, in pixels.
const EASILY_SEEN: f64 = 150.0;

/// Where scenes are found, and the files that are written for them.
pub(super) struct Scenes<'a> {
    options: &'a WriteupOptions,
    folder: PathBuf,
    /// What `folder` gets.
    pub(super) files: Vec<(PathBuf, Vec<u8>)>,
    /// The view of the student's own picture: it is seen from so far that its texture is minified.
    own_view: String,
    /// The canvas of its scene.
    own_canvas: DVec2,
    /// Whether an earlier write-up in the same folder showed another picture.
    own_changed: bool,
    /// Whether the folder of scenes is read as the course's.
    is_of_course: bool,
}

impl<'a> Scenes<'a> {
    /// Scenes for a write-up in `output`; those that are made for it go into a folder in there.
    pub(super) fn new(options: &'a WriteupOptions) -> Result<Self, Failure> {
        if let Some(folder) = options.scenes.as_deref().filter(|folder| !folder.is_dir()) {
            return Err(Failure::input(format!(
                "{}: no such folder; give the folder of your scenes with --scenes",
                folder.display()
            )));
        }
        let folder = options.output.join("scenes");
        let mut scenes = Self {
            options,
            files: vec![(folder.join("triangle.svg"), TRIANGLE.as_bytes().to_vec())],
            folder,
            own_view: String::new(),
            own_canvas: DVec2::ZERO,
            own_changed: false,
            is_of_course: options.scenes.as_deref().is_some_and(is_folder_of_course),
        };
        scenes.make_own()?;
        scenes.tell_missing();
        Ok(scenes)
    }

    /// The address of a subject, and the options that belong to it.
    pub(super) fn find(&self, subject: Subject) -> (String, Option<String>) {
        let path = |path: &Path| path.display().to_string();
        let scene = match subject {
            Subject::Scene(name) => self.scene(name),
            Subject::Robot => match &self.options.robot {
                Some(robot) => path(robot),
                None => self.scene("transforms/robot.svg"),
            },
            Subject::Triangle => path(&self.folder.join("triangle.svg")),
            Subject::Own => {
                return (
                    path(&self.folder.join("own.svg")),
                    Some(format!("--view={}", self.own_view)),
                );
            }
            Subject::Competition => match self.in_folder("competition.svg") {
                Some(found) => path(&found),
                None => "gallery:illustration/02_fox.svg".to_owned(),
            },
        };
        let is_of_course = self.is_of_course && !scene.starts_with("gallery:");
        let found = matches!(subject, Subject::Scene(_) | Subject::Competition);
        let is_read_so = || {
            let read = scene::load(Path::new(&scene), DialectChoice::AmongCourse);
            read.map_or(true, |read| read.dialect == Dialect::Course)
        };
        let dialect = (is_of_course && found && is_read_so()).then(|| "--dialect=course".to_owned());
        (scene, dialect)
    }

    /// A scene in the folder of scenes.
    fn in_folder(&self, name: &str) -> Option<PathBuf> {
        let folder = self.options.scenes.as_ref()?;
        [folder.join(name), folder.join("svg").join(name)]
            .into_iter()
            .find(|path| path.is_file())
    }

    fn scene(&self, name: &str) -> String {
        match self.in_folder(name) {
            Some(found) => found.display().to_string(),
            None => format!("gallery:{name}"),
        }
    }

    /// Says, once for each, which scenes are not in the folder that was given.
    fn tell_missing(&self) {
        let Some(folder) = &self.options.scenes else { return };
        let mut told = Vec::new();
        for item in ITEMS {
            let Subject::Scene(name) = item.subject else { continue };
            if !told.contains(&name) && !name.starts_with("study/") && self.in_folder(name).is_none() {
                told.push(name);
                print_error(&format!(
                    "{}: no {name} in this folder; the built-in scene of that name is drawn",
                    folder.display()
                ));
            }
        }
    }

    /// A scene that shows the student's own picture, or one of the gallery.
    fn make_own(&mut self) -> Result<(), Failure> {
        let (bytes, name) = match &self.options.own {
            Some(path) => {
                let refused = |error: &dyn std::fmt::Display| {
                    Failure::input(format!(
                        "{}: {error}; give a whole PNG or JPEG with --own",
                        path.display()
                    ))
                };
                let bytes = FolderResources::read_file(path).map_err(|error| refused(&error))?;
                compare::decode_picture(&bytes).map_err(|error| refused(&error))?;
                (bytes, path.display().to_string())
            }
            None => match gallery::TEXTURES.iter().find(|texture| texture.name == "foliage.jpg") {
                Some(texture) => (texture.bytes.to_vec(), texture.name.to_owned()),
                None => return Err(Failure::other("the gallery has no picture")),
            },
        };
        let size = compare::encoded_size(&bytes)
            .map_err(|error| Failure::input(format!("{name}: {error}; give another picture")))?;
        let texture = if bytes.starts_with(b"\x89PNG") {
            "own.png"
        } else {
            "own.jpg"
        };
        let [width, height] = size.map(f64::from);
        // The canvas has one unit for each texel. A pixel spans four of them each way: fewer where the picture would be too
        // small to see, but two at least, for else no level could be told from another; more where it would not fit the panel.
        let longest = width.max(height);
        let scale = (0.25_f64).max(EASILY_SEEN / longest).min(0.5);
        let scale = scale.min(400.0 / longest);
        if longest * scale < EASILY_SEEN {
            print_error(&format!(
                "{name}: {width} x {height} pixels, zoomed out, are few to see levels in; give a picture of {} or more with --own",
                2.0 * EASILY_SEEN
            ));
        }
        self.own_view = format!("{},{},{scale}", width / 2.0, height / 2.0);
        self.own_canvas = DVec2::new(width, height);
        let scene = (self.folder.join("own.svg"), own_scene(size, texture).into_bytes());
        let files = [scene, (self.folder.join(texture), bytes)];
        let was = |path: &Path| FolderResources::read_file(path).ok();
        self.own_changed =
            was(&files[0].0).is_some() && files.iter().any(|(path, bytes)| was(path).as_ref() != Some(bytes));
        self.files.extend(files);
        Ok(())
    }

    /// Why a pin of an earlier write-up says nothing about the student's own picture; `None` where it does.
    pub(super) fn why_stale(&self, at: InsetPlace) -> Option<String> {
        // Who names a file of pins means those in it.
        let is_other = self.own_changed && self.options.pins.is_none();
        let other = is_other.then(|| "the picture is another than it was proposed for".to_owned());
        self.why_outside(at).or(other)
    }

    /// Says that a place lies outside the student's own picture; `None` where it does not.
    pub(super) fn why_outside(&self, at: InsetPlace) -> Option<String> {
        let DVec2 { x, y } = self.own_canvas;
        match at {
            InsetPlace::User(at) if at.clamp(DVec2::ZERO, self.own_canvas) != at => {
                Some(format!("it lies outside the picture of {x} x {y} pixels"))
            }
            _ => None,
        }
    }
}

/// The view that shows the whole of a turned canvas in a picture of `size`, with a margin.
pub(super) fn turned_view(canvas: DVec2, size: [u32; 2], degrees: f64) -> String {
    const MARGIN: f64 = 1.08;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (sin, cos) = (sin.abs(), cos.abs());
    let extent = DVec2::new(canvas.x * cos + canvas.y * sin, canvas.x * sin + canvas.y * cos);
    let scale = (DVec2::from(size.map(f64::from)) / extent).min_element() / MARGIN;
    // Four digits are short to read and exact enough.
    let digits = 10.0_f64.powf(3.0 - scale.log10().floor());
    let scale = (scale * digits).round() / digits;
    format!("--view={},{},{scale},{degrees}", canvas.x / 2.0, canvas.y / 2.0)
}

const TRIANGLE: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
    <!-- One triangle with a red, a green and a blue corner; made by rasterscope. -->\n\
    <svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"1000\" height=\"1000\">\n\
    <colortri points=\"500,80 940,860 60,860\" colors=\"1 0 0 1  0 1 0 1  0 0 1 1\"/>\n</svg>\n";

/// A rectangle of two triangles with a picture as texture.
fn own_scene([width, height]: [u32; 2], texture: &str) -> String {
    let mut text =
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- A picture on a rectangle, one unit for each texel; made by rasterscope. -->\n"
            .to_owned();
    // Writing to a `String` cannot fail.
    let _ = write!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{width}\" height=\"{height}\">\n\
         <texture texid=\"own\" filename=\"{texture}\"/>\n\
         <textri texid=\"own\" uvs=\"0 0 1 0 1 1\" points=\"0,0 {width},0 {width},{height}\"/>\n\
         <textri texid=\"own\" uvs=\"0 0 1 1 0 1\" points=\"0,0 {width},{height} 0,{height}\"/>\n</svg>\n"
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::options::writeup::Assignment;

    #[test]
    fn pins_outside_of_the_own_picture_are_stale() {
        let options = |pins: Option<&str>| WriteupOptions {
            assignment: Assignment::Course,
            output: "out".into(),
            scenes: None,
            own: None,
            robot: None,
            force: false,
            pins: pins.map(PathBuf::from),
            threads: None,
        };
        let (named, unnamed) = (options(Some("pins.toml")), options(None));
        let mut scenes = Scenes {
            options: &named,
            folder: PathBuf::new(),
            files: Vec::new(),
            own_view: String::new(),
            own_canvas: DVec2::new(100.0, 60.0),
            own_changed: true,
            is_of_course: false,
        };
        let at = |x: f64, y: f64| InsetPlace::User(DVec2::new(x, y));
        let why = scenes.why_stale(at(254.0, 50.0)).expect("outside");
        assert!(why.contains("outside the picture of 100 x 60 pixels"), "{why}");
        assert_eq!(scenes.why_stale(at(99.0, 60.0)), None, "of a file that was named");
        scenes.options = &unnamed;
        assert!(scenes.why_stale(at(99.0, 60.0)).is_some(), "another picture");
    }

    #[test]
    fn turned_canvases_are_seen_whole() {
        for (canvas, size) in [
            ([1000.0, 1000.0], [800, 800]),
            ([487.211, 642.045], [800, 600]),
            ([0.02, 3.0], [64, 64]),
        ] {
            let canvas = DVec2::from(canvas);
            for degrees in [30.0, -75.0, 180.0] {
                let text = turned_view(canvas, size, degrees);
                let numbers: Vec<f64> = text["--view=".len()..]
                    .split(',')
                    .map(|n| n.parse().expect("a number"))
                    .collect();
                let view = crate::geometry::View::At {
                    center: DVec2::new(numbers[0], numbers[1]),
                    scale: numbers[2],
                    rotation: numbers[3],
                };
                let view = view.transform(canvas, size);
                let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
                let corners = corners.map(|corner| view.to_pixels(DVec2::from(corner) * canvas));
                let frame = DVec2::from(size.map(f64::from));
                assert!(
                    corners
                        .iter()
                        .all(|at| at.cmpgt(DVec2::ONE).all() && at.cmplt(frame - 1.0).all()),
                    "{text}: {corners:?}"
                );
                let reach = (corners.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) / frame).max_element();
                assert!(reach > 0.9, "and large: {text}: {corners:?}");
            }
        }
    }
}
