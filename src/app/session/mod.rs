//! A viewer with its panels: routes keys and pointer to the one or the other, runs egui, and puts the picture of the
//! whole window together. Knows no window system, so that a session runs with or without a display.

mod damage;
mod input;
mod room;
mod stage;
mod surface;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use egui::{Event, PlatformOutput, Pos2, RawInput, Rect, ViewportId, vec2};
use glam::DVec2;

use super::interface::{Asked, Interface, PanelWidths, Sections};
use super::overlay::{CanvasRect, Output, Overlay};
use crate::inspect::counted;
use crate::plain;
use crate::raster::Framebuffer;
use crate::viewer::{
    AbCommand, Arrangement, Command, Effect, InspectorCommand, LessonCommand, MessageKind, Modifiers, PixelRect,
    PointerButton, PointerCommand, SceneCommand, SheetCommand, Viewer, WindowCommand,
};
use damage::Damage;
use room::{Asks, PanelRoom, Wanted};

/// Passes of the panels for one change: a command of a panel changes what the panels show.
const MAX_PASSES: u32 = 4;
/// Surfaces have two or three buffers; one that was shown longer ago is written whole.
const LONGEST_AGE: usize = 3;
/// How the message about what a reader left out begins.
const NOT_ALL: &str = "not all is drawn as the document says";

/// What time it is for the panels.
#[derive(Debug)]
pub(super) enum Clock {
    /// Real time.
    Real(Instant),
    /// Seconds that pass only when a script says so: pictures do not depend on the machine.
    Simulated(f64),
}

/// What a pass of the panels asks of the window system.
#[derive(Default)]
pub(super) struct Turn {
    /// Pointer shape, text for the clipboard, text input.
    pub(super) platform: PlatformOutput,
    /// When the panels want the next pass.
    pub(super) next: Duration,
    /// Where its time went.
    pub(super) times: PanelTimes,
}

/// How long the stages of the panels took, all passes together.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PanelTimes {
    /// egui's work: where everything lies, and its shapes.
    pub(super) layout: Duration,
    /// Cutting the shapes that changed into triangles.
    pub(super) tessellate: Duration,
    /// Comparing the shapes with those before, and painting.
    pub(super) paint: Duration,
}

/// What a surface holds that is to be composed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Holds {
    /// What [`Session::compose`] wrote, and how many calls ago; 0 where that is of no use.
    Composed(u8),
    /// The frame, all of it, and nothing else.
    Frame,
}

/// A viewer with its panels.
#[derive(Debug)]
pub(super) struct Session {
    viewer: Viewer,
    interface: Interface,
    overlay: Overlay,
    clock: Clock,
    /// Device pixels per point of the monitor's own scale.
    native_scale: f32,
    /// What of the panels changed since [`Session::compose`], and what it wrote, the latest first.
    damage: Damage,
    composed: VecDeque<Damage>,
    free_area: Option<PixelRect>,
    pointer: Option<DVec2>,
    /// The scale at which the panels know where it is.
    pointer_scale: f32,
    /// A drag that began on the picture stays with it.
    holds_picture: bool,
    /// Whether the side panel folds by itself.
    room: PanelRoom,
    modifiers: Modifiers,
    /// For the next pass.
    events: Vec<Event>,
    outbox: Outbox,
    /// The scene whose report was told last.
    told: Option<std::sync::Arc<crate::scene::Scene>>,
    /// What was told last of a scene that cannot be read.
    told_failure: Option<String>,
}

/// What the program around has to do.
#[derive(Debug, Default)]
struct Outbox {
    quit: bool,
    /// Pictures of the window that were asked for.
    pictures: u32,
    copied: Option<String>,
    copied_picture: Option<Framebuffer>,
    /// The folder to show in the file manager.
    folder: Option<PathBuf>,
}

impl Session {
    /// A session with `scale` device pixels per point.
    pub(super) fn new(viewer: Viewer, scale: f32, clock: Clock) -> Self {
        let timed = matches!(clock, Clock::Real(_));
        let mut session = Self {
            viewer,
            interface: Interface::new(timed),
            overlay: Overlay::default(),
            clock,
            native_scale: scale,
            damage: Damage::default(),
            composed: VecDeque::new(),
            free_area: None,
            pointer: None,
            pointer_scale: 0.0,
            holds_picture: false,
            room: PanelRoom::default(),
            modifiers: Modifiers::NONE,
            events: Vec::new(),
            outbox: Outbox::default(),
            told: None,
            told_failure: None,
        };
        session.fold_panel();
        session
    }

    pub(super) fn viewer(&self) -> &Viewer {
        &self.viewer
    }

    pub(super) fn ctx(&self) -> &egui::Context {
        self.interface.ctx()
    }

    /// Takes in what the viewer's threads finished.
    pub(super) fn poll(&mut self) {
        self.viewer.poll();
        self.tell_report();
        // A session without a window ends with what is wrong.
        if matches!(self.clock, Clock::Real(_)) {
            self.tell_failure();
        }
    }

    /// Tells the user what is as he left it.
    pub(super) fn tell(&mut self, words: String) {
        self.viewer.tell(MessageKind::Done, words);
    }

    /// Tells the user what went wrong around the viewer.
    pub(super) fn tell_problem(&mut self, problem: String) {
        self.viewer.tell(MessageKind::Error, problem);
    }

    /// Whether the side panel is open, where the user said so.
    pub(super) fn panel_choice(&self) -> Option<bool> {
        self.room.choice(self.viewer.chrome().panel())
    }

    /// What the user folded and unfolded in the explanation.
    pub(super) fn sections(&self) -> Sections {
        self.interface.sections()
    }

    /// Sections begin as they were left.
    pub(super) fn set_sections(&mut self, sections: Sections) {
        self.interface.set_sections(sections);
    }

    /// How wide panels are.
    pub(super) fn panel_widths(&self) -> PanelWidths {
        self.interface.widths
    }

    /// Makes panels as wide as in another session.
    pub(super) fn set_panel_widths(&mut self, widths: PanelWidths) {
        self.interface.widths = widths;
    }

    /// Says on stderr, once, why the scene that should be shown is not.
    fn tell_failure(&mut self) {
        let failure = self.viewer.scene_list().current().and_then(|entry| entry.failure());
        if let Some(failure) = failure.filter(|failure| self.told_failure.as_deref() != Some(*failure)) {
            // Whoever closed stderr does not want to read it.
            let _ = writeln!(std::io::stderr().lock(), "rasterscope: {}", plain::line(failure));
            self.told_failure = Some(failure.to_owned());
        }
    }

    /// Says on stderr, once for every scene that is shown, what its reader left out; the message goes with the scene.
    fn tell_report(&mut self) {
        let shown = self.viewer.scene_list().current();
        let Some((entry, scene)) = shown.and_then(|entry| Some((entry, entry.scene()?))) else {
            // While a scene is read, the one before may still be seen, but not for long.
            if self.told.take().is_some() {
                self.viewer.retract(NOT_ALL);
            }
            return;
        };
        let is_told = |told: &std::sync::Arc<crate::scene::Scene>| std::sync::Arc::ptr_eq(told, scene);
        if self.told.as_ref().is_some_and(is_told) {
            return;
        }
        let mut stderr = std::io::stderr().lock();
        let address = entry.source.address();
        for line in scene.report.lines_in(&address) {
            // Whoever closed stderr does not want to read it.
            let _ = writeln!(stderr, "rasterscope: {}", plain::line(&line));
        }
        if let Some(note) = self.viewer.scene_list().reading_note(self.viewer.settings().dialect) {
            let _ = writeln!(
                stderr,
                "rasterscope: {}: {note}; the command other-reading shows it",
                plain::line(&address)
            );
        }
        let notes = scene.report.count();
        if self.told.replace(std::sync::Arc::clone(scene)).is_some() {
            self.viewer.retract(NOT_ALL);
        }
        if notes > 0 {
            let words = format!("{NOT_ALL}: {} at the end of the panel", counted(notes, "note"));
            self.viewer.tell(MessageKind::Done, words);
        }
    }

    /// The text that a command copied.
    pub(super) fn take_copied(&mut self) -> Option<String> {
        self.outbox.copied.take()
    }

    /// The picture that a command copied.
    pub(super) fn take_copied_picture(&mut self) -> Option<Framebuffer> {
        self.outbox.copied_picture.take()
    }

    /// The folder that is to be shown in the file manager.
    pub(super) fn take_folder(&mut self) -> Option<PathBuf> {
        self.outbox.folder.take()
    }

    /// Another size of the window, in device pixels, or another scale of the panels.
    pub(super) fn set_size(&mut self, size: [u32; 2], scale: f32) {
        self.native_scale = scale;
        if self.viewer.chrome().window_size() != size {
            self.run(Command::Window(WindowCommand::Resize(size)));
        }
        self.fold_panel();
        self.share_room(Wanted::Explanation);
        self.take_back_missing_room();
    }

    /// At how many percent the desktop shows the window, where it scales that by itself.
    pub(super) fn set_shown_at(&mut self, percent: Option<u32>) {
        self.interface.shown_at = percent;
    }

    /// Device pixels per point: as large as the user wants panels, as far as they fit.
    fn scale(&self) -> f32 {
        self.wanted_scale().min(self.largest_scale())
    }

    /// Runs a command and carries out its effects.
    pub(super) fn run(&mut self, command: Command) {
        let (wanted, command) = self.wanted(command);
        let fold = |viewer: &Viewer| (viewer.lesson().is_some(), viewer.chrome().interface_factor());
        let before = fold(&self.viewer);
        let asks = asked_for(&command);
        let lacked = self.viewer.inspector().lacks_room();
        self.apply(command);
        if before != fold(&self.viewer) {
            self.fold_panel();
        }
        self.share_room(wanted);
        self.take_back_missing_room();
        self.tell_missing_room(asks, wanted);
        if !lacked {
            self.tell_no_inspector();
        }
    }

    fn apply(&mut self, command: Command) {
        for effect in self.viewer.apply(command) {
            match effect {
                Effect::CopyText(text) => self.outbox.copied = Some(text),
                Effect::CopyPicture(picture) => self.outbox.copied_picture = Some(picture),
                Effect::PictureOfWindow => self.outbox.pictures = self.outbox.pictures.saturating_add(1),
                Effect::OpenFolder(folder) => self.outbox.folder = Some(folder),
                Effect::FocusPanel { back } => self.interface.step_focus(&self.viewer, back),
                Effect::Quit => self.outbox.quit = true,
            }
        }
    }

    /// Seconds on the panels' clock.
    fn now(&self) -> f64 {
        match self.clock {
            Clock::Real(start) => start.elapsed().as_secs_f64(),
            Clock::Simulated(now) => now,
        }
    }

    /// Runs the panels on `input`, does what they ask for, and paints them.
    pub(super) fn turn(&mut self, mut input: RawInput) -> Turn {
        let size = self.viewer.chrome().window_size();
        let mut turn = Turn::default();
        if size.contains(&0) {
            turn.next = Duration::MAX;
            return turn;
        }
        for _ in 0..MAX_PASSES {
            input.events.append(&mut self.events);
            input.time = Some(self.now());
            let scale = self.scale();
            let points = vec2(size[0] as f32, size[1] as f32) / scale;
            // At another scale a pointer that rests is at other points.
            if std::mem::replace(&mut self.pointer_scale, scale)
                .total_cmp(&scale)
                .is_ne()
                && let Some(at) = self.pointer
            {
                input.events.insert(0, Event::PointerMoved(self.to_points(at)));
            }
            input.screen_rect = Some(Rect::from_min_size(Pos2::ZERO, points));
            let viewport = input.viewports.entry(ViewportId::ROOT).or_default();
            viewport.native_pixels_per_point = Some(self.native_scale);
            let mut asked = Asked::default();
            let (interface, viewer) = (&mut self.interface, &self.viewer);
            interface.follow_theme(viewer.chrome());
            let ctx = interface.ctx().clone();
            ctx.options_mut(|options| options.zoom_factor = scale / self.native_scale);
            let start = Instant::now();
            let mut output = ctx.run_ui(input.take(), |ui| {
                asked = Asked::default();
                interface.show(ui, viewer, &mut asked);
            });
            let pixels_per_point = output.pixels_per_point;
            let shapes = Output {
                size,
                pixels_per_point,
                shapes: std::mem::take(&mut output.shapes),
            };
            let laid_out = Instant::now();
            let mut cutting = Duration::ZERO;
            let tessellate = |shapes| {
                let start = Instant::now();
                let primitives = ctx.tessellate(shapes, pixels_per_point);
                cutting = start.elapsed();
                primitives
            };
            let parts = self.overlay.paint(shapes, &mut output.textures_delta, tessellate);
            turn.times.layout += laid_out - start;
            turn.times.tessellate += cutting;
            turn.times.paint += laid_out.elapsed().saturating_sub(cutting);
            if !self.damage.is_for(size) {
                self.damage = Damage::all(size);
            }
            for part in parts {
                self.damage.add(&window_rect(part));
            }
            let root = output.viewport_output.get(&ViewportId::ROOT);
            turn.next = root.map_or(Duration::MAX, |root| root.repaint_delay);
            turn.platform.append(std::mem::take(&mut output.platform_output));
            if !self.carry_out(asked) {
                break;
            }
        }
        if self.find_pointer() || self.lose_pointer() {
            turn.next = Duration::ZERO;
        }
        self.save_pictures();
        turn
    }

    /// Does what the panels ask for; true if they are to be shown anew.
    fn carry_out(&mut self, asked: Asked) -> bool {
        for index in asked.thumbnails {
            self.viewer.request_thumbnail(index);
        }
        let mut any = asked.goes_round || asked.scroll.is_some();
        self.events.extend(asked.scroll);
        for command in asked.commands {
            // The layout of a sheet's dialog tells its room in every pass.
            if let Command::Sheet(SheetCommand::SetRoom(room)) = command
                && !self.viewer.sheet().room_changes(room)
            {
                continue;
            }
            if let Command::Window(WindowCommand::SetFreeArea(area)) = command {
                if self.free_area == area {
                    continue;
                }
                self.free_area = area;
            }
            self.run(command);
            any = true;
        }
        any
    }

    /// Saves the pictures of the window that were asked for, once it shows the final picture.
    fn save_pictures(&mut self) {
        if self.outbox.pictures == 0 || !self.viewer.is_final() {
            return;
        }
        let picture = self.picture();
        for _ in 0..std::mem::take(&mut self.outbox.pictures) {
            self.viewer.save_window_picture(picture.clone());
        }
    }

    /// A turn without any window system behind it.
    fn quiet_turn(&mut self) -> Turn {
        let input = RawInput {
            focused: true,
            ..RawInput::default()
        };
        self.turn(input)
    }
}

/// What a command asks for by hand that may have no room.
fn asked_for(command: &Command) -> Asks {
    match command {
        Command::Inspector(
            InspectorCommand::PinUnderPointer | InspectorCommand::PinEdge | InspectorCommand::Explanation(_),
        )
        | Command::Pointer(PointerCommand::Pressed(PointerButton::Secondary)) => Asks::Why,
        Command::Lesson(LessonCommand::Open(_) | LessonCommand::Step(_))
        | Command::Scenes(SceneCommand::Next | SceneCommand::Previous | SceneCommand::Open(_)) => Asks::Lesson,
        Command::Window(WindowCommand::StepInterfaceScale { .. } | WindowCommand::SetInterfaceScale(_)) => Asks::Size,
        Command::Ab(
            AbCommand::Arrange(Arrangement::Difference) | AbCommand::ToggleArrangement(Arrangement::Difference),
        ) => Asks::Difference,
        _ => Asks::Nothing,
    }
}

/// A part of the overlay as a part of the window.
fn window_rect(part: CanvasRect) -> PixelRect {
    PixelRect {
        x: part.left.into(),
        y: part.top.into(),
        width: part.right.saturating_sub(part.left),
        height: part.bottom.saturating_sub(part.top),
    }
}
