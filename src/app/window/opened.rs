//! An open window: its surface, its session, and when it is to be drawn next.
//!
//! The surface is the one source of the window's size: it is set from the last `Resized` event, and everything else
//! follows it. Nothing is drawn unless something changed.

use std::num::NonZeroU32;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Color32, ColorImage, OutputCommand};
use softbuffer::{Context, Rect, SoftBufferError, Surface};
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

use super::super::session::{PanelTimes, Session};
use super::frame_log::{FrameLog, Shown};
use super::rhythm::Rhythm;
use super::wake::ShownScales;
use crate::raster::Framebuffer;
use crate::viewer::{PixelRect, Viewer};

/// Longest wait for the frame of a new size, so that a resized window shows no border.
const RESIZE_WAIT: Duration = Duration::from_millis(24);

/// What can be seen of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sight {
    /// Some of it, or all.
    Open,
    /// Nothing.
    Occluded,
    /// Nothing any more: the system has destroyed it.
    Gone,
}

/// An open window.
pub(super) struct Opened {
    pub(super) window: Arc<Window>,
    pub(super) session: Session,
    pub(super) egui: egui_winit::State,
    surface: Surface<OwnedDisplayHandle, Arc<Window>>,
    /// From the last event that told it.
    size: PhysicalSize<u32>,
    /// Device pixels per point of its monitor, from the last event that told it: the window itself still has the one before,
    /// then, on X11.
    scale: f32,
    title: String,
    /// The upper left corner of its frame on the desktop, where the system told it.
    pub(super) place: Option<[i32; 2]>,
    pub(super) sight: Sight,
    /// Something changed since the last frame; the viewer's revision tells what it knows.
    dirty: bool,
    /// Since when a frame is asked for by us, not by the window system.
    asked: Option<Instant>,
    drawn_revision: u64,
    rhythm: Rhythm,
    /// When the panels want to be shown again.
    next_wish: Option<Instant>,
    /// When the first event came that nothing was shown for.
    event: Option<Instant>,
    /// Where the pointer was last, as the window system told, and the scale of the panels then.
    pub(super) pointer: Option<WindowEvent>,
    pub(super) pointer_scale: f32,
    log: Option<FrameLog>,
    /// What monitors do not show pixel for pixel, and at how many percent that of the window does.
    scales: ShownScales,
    shown_at: Option<u32>,
}

impl std::fmt::Debug for Opened {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Opened")
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

impl Opened {
    /// Makes a surface for `window`.
    ///
    /// # Errors
    /// When the display does not take pictures.
    pub(super) fn new(
        display: OwnedDisplayHandle,
        window: Arc<Window>,
        session: Session,
    ) -> Result<Self, SoftBufferError> {
        let scale = points_of(window.scale_factor());
        let egui = egui_winit::State::new(
            session.ctx().clone(),
            egui::ViewportId::ROOT,
            &display,
            Some(scale),
            window.theme(),
            None,
        );
        let surface = Surface::new(&Context::new(display)?, Arc::clone(&window))?;
        let size = window.inner_size();
        let mut opened = Self {
            window,
            session,
            egui,
            surface,
            size,
            scale,
            place: None,
            title: String::new(),
            sight: Sight::Open,
            dirty: true,
            asked: None,
            drawn_revision: 0,
            rhythm: Rhythm::default(),
            next_wish: None,
            event: None,
            pointer: None,
            pointer_scale: 0.0,
            log: None,
            scales: ShownScales::new(),
            shown_at: None,
        };
        opened.session.lend_surface();
        opened.resized(size);
        Ok(opened)
    }

    /// Writes down what is shown from now on.
    pub(super) fn log_to(&mut self, log: Option<FrameLog>) {
        self.log = log;
    }

    /// Something came that may have to be shown.
    pub(super) fn note_event(&mut self) {
        self.event.get_or_insert_with(Instant::now);
        // It may have come to another monitor, which is no event of its own.
        self.note_shown_scale();
    }

    /// Monitors show windows at these percentages.
    pub(super) fn set_scales(&mut self, scales: ShownScales) {
        self.scales = scales;
        self.note_shown_scale();
    }

    /// At how many percent the window's monitor shows it.
    fn note_shown_scale(&mut self) {
        if self.scales.is_empty() && self.shown_at.is_none() {
            return;
        }
        let name = self.window.current_monitor().and_then(|monitor| monitor.name());
        let percent = name.and_then(|name| self.scales.get(&name).copied());
        if percent != self.shown_at {
            self.shown_at = percent;
            self.session.set_shown_at(percent);
            self.touch();
        }
    }

    /// Another size or scale; zero while the window is minimised.
    pub(super) fn resized(&mut self, size: PhysicalSize<u32>) {
        self.size = size;
        let longest = Framebuffer::MAX_SIDE;
        let pixels = [size.width, size.height].map(|side| side.min(longest));
        self.session.set_size(pixels, self.scale);
        self.dirty = true;
    }

    /// Another scale of the monitor.
    pub(super) fn set_scale(&mut self, scale: f64) {
        self.scale = points_of(scale);
    }

    /// The scale of the monitor changed; the size follows in an event of its own.
    pub(super) fn rescaled(&mut self) {
        self.resized(self.size);
    }

    /// Tells the panels' input where a pointer is that rests: they know it in points, of which the panels have another size
    /// now.
    pub(super) fn place_pointer(&mut self) {
        let scale = self.session.ctx().pixels_per_point();
        if self.pointer_scale.total_cmp(&scale).is_eq() {
            return;
        }
        self.pointer_scale = scale;
        if let Some(moved) = &self.pointer
            && self.egui.on_window_event(&self.window, moved).repaint
        {
            self.dirty = true;
        }
    }

    /// Something is to be shown anew.
    pub(super) fn touch(&mut self) {
        self.dirty = true;
    }

    /// Asks for a frame if one is due; returns when to look again, `None` for "when something happens".
    pub(super) fn schedule(&mut self) -> Option<Instant> {
        let now = Instant::now();
        if self.session.viewer().due().is_some_and(|due| due <= now) {
            self.session.poll();
        }
        let viewer = self.session.viewer();
        let (picture, due) = (shown_next(viewer), viewer.due());
        // A window system that shows nothing at the moment must not hold up a frame that waits to be shown.
        let patience = due.filter(|_| viewer.frames().waits_for_surface());
        self.dirty |= viewer.revision() != self.drawn_revision || viewer.frames().waits_for_surface();
        if self.next_wish.is_some_and(|request| request <= now) {
            self.dirty = true;
        }
        if self.sight != Sight::Open || self.size.width == 0 || self.size.height == 0 {
            return patience;
        }
        if !self.dirty {
            self.event = None;
            return [self.next_wish, due].into_iter().flatten().min();
        }
        let next_frame = self.rhythm.due(picture, now);
        if next_frame.is_none() {
            self.asked = Some(now);
            self.window.request_redraw();
        }
        [next_frame, patience].into_iter().flatten().min()
    }

    /// Draws and presents a frame.
    ///
    /// # Errors
    /// When the display refuses it.
    pub(super) fn draw(&mut self) -> Result<(), SoftBufferError> {
        let PhysicalSize { width, height } = self.size;
        let Some((columns, rows)) = NonZeroU32::new(width).zip(NonZeroU32::new(height)) else {
            return Ok(());
        };
        // Asked by the window system, the window may have lost any of its pixels.
        let exposed = self.asked.take().is_none();
        self.rhythm.begin(Instant::now());
        self.dirty = false;
        self.await_resized_frame();
        let start = Instant::now();
        self.surface.resize(columns, rows)?;
        let mut buffer = self.surface.buffer_mut()?;
        // The display is done with what was presented before.
        let ready = Instant::now();
        let age = buffer.age();
        let holds = self.session.draw_frame(&mut buffer, columns.get(), age);
        let drawn = Instant::now();
        let (panels, next) = run_panels(&mut self.session, &mut self.egui, &self.window);
        self.next_wish = Instant::now().checked_add(next);
        self.drawn_revision = self.session.viewer().revision();
        self.rhythm.shows(self.session.viewer().picture_revision());
        let painted = Instant::now();
        let mut parts = self.session.compose(&mut buffer, columns.get(), holds);
        if exposed || age == 0 {
            parts = vec![PixelRect::of_size([columns.get(), rows.get()])];
        }
        let composed = Instant::now();
        let event = self.event.take();
        let damage: Vec<Rect> = parts.iter().filter_map(surface_rect).collect();
        if !damage.is_empty() {
            self.window.pre_present_notify();
            buffer.present_with_damage(&damage)?;
            if let Some(log) = &mut self.log {
                let shown = Shown {
                    event,
                    onto: drawn.saturating_duration_since(ready),
                    panels,
                    compose: composed.saturating_duration_since(painted),
                    present: ready.saturating_duration_since(start) + composed.elapsed(),
                    parts: &parts,
                };
                log.add(self.session.viewer(), &shown);
            }
        }
        self.tell_title();
        Ok(())
    }

    fn tell_title(&mut self) {
        let title = self.session.viewer().both().title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }

    /// Gives the frame of a new size a moment to be finished.
    fn await_resized_frame(&mut self) {
        let start = Instant::now();
        while start.elapsed() < RESIZE_WAIT {
            self.session.poll();
            let viewer = self.session.viewer();
            let is_right = |frame: &crate::viewer::Frame| frame.picture.size == viewer.both().layout().frame_size();
            if viewer.is_settled()
                || viewer.frames().waits_for_surface()
                || viewer.frames().frame().is_some_and(is_right)
            {
                return;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

/// Runs the panels and tells the window system what they ask of it; where their time went, and when they want to be shown
/// next.
fn run_panels(session: &mut Session, egui: &mut egui_winit::State, window: &Window) -> (PanelTimes, Duration) {
    let mut turn = session.turn(egui.take_egui_input(window));
    if let Some(picture) = session.take_copied_picture() {
        turn.platform
            .commands
            .push(OutputCommand::CopyImage(image_of(&picture)));
    }
    if let Some(folder) = session.take_folder() {
        show_folder(session, &folder);
    }
    egui.handle_platform_output(window, turn.platform);
    if let Some(text) = session.take_copied() {
        egui.set_clipboard_text(text);
    }
    (turn.times, turn.next)
}

/// Opens a folder in the desktop's file manager; says so where there is none.
fn show_folder(session: &mut Session, folder: &Path) {
    if let Err(error) = open::that_detached(folder) {
        let folder = folder.display();
        let problem = format!("{folder}: no file manager shows this folder: {error}; open it by hand");
        session.tell_problem(problem);
    }
}

/// The number of the picture that the next frame will show.
fn shown_next(viewer: &Viewer) -> u64 {
    viewer.picture_revision() + u64::from(viewer.frames().waits_for_surface())
}

/// A part of the window as softbuffer names it.
fn surface_rect(part: &PixelRect) -> Option<Rect> {
    Some(Rect {
        x: u32::try_from(part.x).ok()?,
        y: u32::try_from(part.y).ok()?,
        width: NonZeroU32::new(part.width)?,
        height: NonZeroU32::new(part.height)?,
    })
}

/// Device pixels per point, within what panels can be drawn at.
#[expect(clippy::cast_possible_truncation, reason = "a small number")]
fn points_of(scale: f64) -> f32 {
    (scale as f32).clamp(0.5, 8.0)
}

/// A picture as egui hands it to the clipboard.
fn image_of(picture: &Framebuffer) -> ColorImage {
    let [width, height] = [picture.width(), picture.height()].map(|side| side as usize);
    let pixels = picture.pixels().iter().map(|pixel| {
        let [a, r, g, b] = pixel.to_be_bytes();
        Color32::from_rgba_unmultiplied(r, g, b, a)
    });
    ColorImage::new([width, height], pixels.collect())
}
