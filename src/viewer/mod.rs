//! The program without a window: a [`Viewer`] takes [`Command`]s and keeps scenes, views, settings, a finished frame
//! and what is open on the screen.
//!
//! Whatever a user can do is a [`Command`], so whatever a user can do is testable here. Reading and drawing run in
//! threads of their own: [`Viewer::apply`] never waits, [`Viewer::poll`] takes in what they finished, and
//! [`Viewer::finish`] waits until the frame of the current state is there, for scripts and tests.
//!
//! The parts stand on floors, and each imports only those below it:
//!
//! ```text
//! script, slides                        who drives a viewer by texts, or step by step through a lesson
//! control                               what commands and results do to several parts, through structs that borrow them
//! state                                 the viewer: its parts side by side
//! command                               what a user can do, as data
//! lesson, board, export, spectrum,     the parts, each with its own state;
//! profile,                              none of them knows the viewer
//! inspector, ab, frames, library,       none of them knows the viewer
//! view, chrome
//! settings, jobs, key_chords            what all of them use
//! ```
//!
//! A part answers for itself: `viewer.scene_list().current()`, `viewer.ab().arrangement()`. What takes several parts is asked
//! of [`Both`] (A, B and where they lie), [`Pointing`] (which pixel is meant), [`Profiled`] (an edge's profile), [`Spectral`]
//! (a spectrum), [`Boarded`] (several settings beside the truth),
//! [`WindowContent`] and [`Recipes`].
//!
//! Window pixels are device pixels from the window's upper left corner; frame pixels are `pixel zoom` times larger.

mod ab;
mod board;
mod chrome;
mod command;
mod control;
mod export;
mod frames;
mod inspector;
mod jobs;
mod key_chords;
mod lesson;
mod library;
mod profile;
pub mod script;
mod settings;
mod slides;
mod spectrum;
mod state;
mod view;

pub use ab::comparison::Comparison;
pub use ab::measuring::{Measures, Seen};
pub use ab::other::{Against, Arrangement, Other};
pub use ab::outside::OutsidePicture;
pub use board::entry::{AS_A, BoardEntry, MAX_ENTRIES};
pub use board::measure::{BoardMeasure, BoardPlace, BoardTile};
pub use board::numbers::{BoardNumbers, BoardSort};
pub use board::report::{BoardCommandLine, BoardReport};
pub use chrome::ending::ASKS_FOR;
pub use chrome::interface_scale::InterfaceScale;
pub use chrome::messages::{Message, MessageKind, NO_ROOM};
pub use chrome::{Chrome, Dialog};
pub use command::arguments::Argument;
pub use command::key_bindings as commands;
pub use command::key_bindings::Gesture;
pub use command::spec::{Action, CommandSpec, Group};
pub use command::{
    AbCommand, BoardCommand, Command, Effect, ExportCommand, InspectorCommand, LessonCommand, PointerCommand,
    ProfileCommand, SceneCommand, SheetCommand, SpectrumCommand, ViewCommand, WindowCommand,
};
pub use control::boarded::{Boarded, ShownTile};
pub use control::both::Both;
pub use control::open::kind_of_file;
pub use control::pointing::Pointing;
pub use control::profiled::{LinePlace, ProfileCurve, ProfileSide, Profiled};
pub use control::recipes::Recipes;
pub use control::spectral::{Spectral, SpectrumPane};
pub use control::window::WindowContent;
pub use export::naming::NameTemplate;
pub use export::restored::{Grammar, ReadArguments, Restored, changed_inputs, found_file};
pub use export::sheet::axes::{Axis, AxisLists, Choice};
pub use export::sheet::captions::{caption_of, conditions_of, title as scene_title};
pub use export::sheet::desk::SheetDesk;
pub use export::sheet::draft::{PanelSize, SheetChange, SheetDraft, SheetSide};
pub use export::sheet::drawing::{Panel, SceneReader, Sheet, SheetRequest};
pub use export::sheet::preview::ReadSheet;
pub use export::sheet::preview::SheetPreview;
pub use export::spec::{PictureSpec, as_path, input_file, plain_record, shell_line, texture_files};
pub use frames::frame::{Frame, Picture, Preview, PreviewQuality};
pub use frames::present::WindowPixels;
pub use frames::state::Frames;
pub use inspector::samples::{Hit, ProbedSample};
pub use inspector::state::Inspection;
pub use inspector::status::Status;
pub use inspector::{AskedAt, Inspector, PixelLabel, PlacedInset};
pub use jobs::mailbox::Waker;
pub use key_chords::{Chord, Key, KeyPress, Modifiers};
pub use lesson::markdown::{Block, Look, Span};
pub use lesson::model::{Lesson, LessonError, LessonStep};
pub use lesson::source::{BUILT_IN, LessonSource};
pub use library::gallery;
pub use library::state::SceneList;
pub use library::{SceneEntry, SceneSource, SceneState, in_gallery, is_folder_of_course, list_scenes, natural_order};
pub use settings::notes::{self, Study, ValueNote};
pub use settings::patterns;
pub use settings::picture::{self, PictureSetting, SettingChange};
pub use settings::{PixelZoom, Settings, Theme, Toggle};
pub use slides::{Slide, SlideError, slides};
pub use spectrum::SpectrumPart;
pub use spectrum::question::{SpectrumFound, SpectrumPlace, spectrum_of};
pub use state::{Viewer, ViewerOptions};
pub use view::camera::{Camera, ViewContext, ViewNumbers};
pub use view::layout::WindowLayout;
pub use view::pointer::PointerButton;

pub use crate::figure::PixelRect;
