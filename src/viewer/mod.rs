//! The program without a window: a [`Viewer`] takes [`Command`]s and keeps scenes, views, settings, a finished frame
//! and what is open on the screen.
//!
//! Whatever a user can do is a [`Command`], so whatever a user can do is testable here. Reading and drawing run in
//! threads of their own: [`Viewer::apply`] never waits, [`Viewer::poll`] takes in what they finished, and
//! [`Viewer::finish`] waits until the frame of the current state is there, for scripts and tests.
//!
//! Window pixels are device pixels from the window's upper left corner; frame pixels are `pixel zoom` times larger.

mod apply;
mod background;
mod camera;
mod command;
mod command_line;
mod command_spec;
mod command_table;
pub mod commands;
mod comparison;
mod dialects;
mod drawing;
mod ending;
mod explaining;
mod feeding;
mod frame;
pub mod gallery;
mod inspector;
mod key;
mod latest;
mod legends;
mod lesson;
mod library;
mod messages;
mod naming;
pub mod options;
mod pointer;
mod present;
mod probing;
mod reading;
mod recorded;
mod screenshot;
pub mod script;
mod settings;
mod sheet;
mod state;
mod status;
mod typed;
mod window_picture;

pub use camera::{Camera, Sight, ViewNumbers};
pub use command::{Command, Dialog, Effect, PointerButton};
pub use command_line::{PictureSpec, as_path, plain_record, shell_line};
pub use command_spec::{Action, CommandSpec, Group};
pub use commands::Gesture;
pub use comparison::{Against, Arrangement, Measures, Other, OutsidePicture, Seen};
pub use ending::ASKS_FOR;
pub use frame::{Frame, Manner, Picture, Preview};
pub use inspector::{AskedAt, Inspector, PixelLabel, PlacedInset};
pub use key::{Chord, Key, KeyPress, Modifiers};
pub use lesson::{BUILT_IN, Block, Lesson, LessonError, LessonSource, LessonStep, Look, SlideError, Span, slides};
pub use library::{SceneEntry, SceneSource, SceneState, is_folder_of_course, list_scenes};
pub use messages::{Message, MessageKind};
pub use naming::NameTemplate;
pub use present::WindowPixels;
pub use probing::{Hit, ProbedSample};
pub use recorded::{Grammar, ReadArguments, Restored};
pub use settings::{PixelZoom, Settings, Theme, Toggle, sample_words, texture_words};
pub use sheet::{
    Axis, AxisLists, Choice, Panel, PanelSize, ReadSheet, SceneReader, Sheet, SheetChange, SheetDraft, SheetPreview,
    SheetRequest, SheetSide, caption_of,
};
pub use state::{Viewer, ViewerOptions, Waker};
pub use status::Status;
pub use typed::Argument;

pub use crate::figure::PixelRect;
