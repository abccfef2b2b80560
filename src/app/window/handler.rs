//! winit's events to what the session understands.

use std::io::Write as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec2;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::{Window, WindowId};

use super::super::headless::{self, NamedScript};
use super::super::session::{Clock, Session};
use super::super::{AppError, ViewOptions};
use super::frame_log::FrameLog;
use super::icon;
use super::opened::{Opened, Sight};
use super::player::Player;
use super::remembered::Remembered;
use super::startup::{self, ThemeQuestion};
use super::wake::Wake;
use super::watch::Watch;
use super::whole_pixels;
use super::winit_keys;
use crate::figure::{Guard, TableOf};
use crate::viewer::script::Stage as _;
use crate::viewer::{Command, PointerButton, SceneCommand, Theme, Toggle, Viewer, ViewerOptions, Waker, WindowCommand};

/// Device pixels of a touch pad's motion that count as a click of the wheel, at scale 1.
const PIXELS_PER_CLICK: f64 = 40.0;
/// Smallest useful window, in device pixels.
pub(super) const SMALLEST: PhysicalSize<u32> = PhysicalSize::new(320, 240);

/// The program as winit sees it.
#[derive(Debug)]
pub(super) struct Handler {
    pub(super) options: ViewOptions,
    proxy: EventLoopProxy<Wake>,
    pub(super) opened: Option<Opened>,
    player: Option<Player>,
    /// Follows the files that are shown; `None` where the system watches none.
    watch: Option<Watch>,
    held: ModifiersState,
    /// Files that were dropped together.
    dropped: Vec<PathBuf>,
    /// What the session before left, and where; a script's window neither reads nor writes that.
    pub(super) remembered: Remembered,
    pub(super) remembered_in: Option<PathBuf>,
    /// The theme at the start.
    pub(super) first_theme: Option<Theme>,
    pub(super) failure: Option<AppError>,
}

impl Handler {
    pub(super) fn new(options: ViewOptions, script: Option<NamedScript>, proxy: EventLoopProxy<Wake>) -> Self {
        let remembers = !options.no_config && options.script.is_none();
        Self {
            options,
            proxy,
            opened: None,
            player: script.map(Player::new),
            watch: None,
            held: ModifiersState::empty(),
            dropped: Vec::new(),
            remembered: Remembered::default(),
            remembered_in: remembers.then(Remembered::file).flatten(),
            first_theme: None,
            failure: None,
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a scale is a small number")]
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<Opened, AppError> {
        let mut problem = None;
        if let Some(file) = &self.remembered_in {
            (self.remembered, problem) = Remembered::read(file);
        }
        self.take_up_settings();
        let chosen = self.options.theme.or(self.remembered.theme());
        // Answered while the window opens.
        let asked = chosen.is_none().then(|| ThemeQuestion::ask(self.proxy.clone()));
        let guard = Guard::new(self.options.force).of_tables(TableOf::FrameLog);
        let log = self.options.frame_log.as_deref();
        let log = log.map(|path| FrameLog::create(path, &guard)).transpose()?;
        let [width, height] = self.first_size(event_loop);
        let attributes = Window::default_attributes()
            .with_title("Rasterscope")
            .with_inner_size(PhysicalSize::new(width, height))
            .with_window_icon(icon::icon())
            .with_min_inner_size(SMALLEST)
            // Not before screen readers are served.
            .with_visible(false);
        let attributes = startup::named(self.placed(attributes, event_loop));
        let failed = |what: &dyn std::fmt::Display| AppError::Window(format!("cannot open a window: {what}"));
        let window = Arc::new(event_loop.create_window(attributes).map_err(|error| failed(&error))?);
        let is_wayland = startup::is_wayland(event_loop);
        let PhysicalSize { width, height } = if is_wayland {
            whole_pixels::fit(&window, SMALLEST)
        } else {
            window.inner_size()
        };
        let theme = chosen.or_else(|| window.theme().map(theme).or(asked.and_then(ThemeQuestion::answer)));
        let viewer = Viewer::new(ViewerOptions {
            // winit tells of none under Wayland.
            takes_drops: !is_wayland,
            ..headless::viewer_options(&self.options, [width, height], theme, self.waker())
        });
        let viewer = viewer.map_err(AppError::Threads)?;
        let scale = window.scale_factor() as f32;
        let mut session = Session::new(viewer, scale, Clock::Real(Instant::now()));
        self.first_theme = Some(session.viewer().chrome().theme());
        self.take_up(&mut session, scale);
        if self.is_bare() && !self.remembered.greeted {
            session.run(Command::Window(WindowCommand::StartCard(Toggle::On)));
        }
        if let Some(problem) = problem {
            session.tell_problem(problem);
        }
        let mut opened =
            Opened::new(event_loop.owned_display_handle(), window, session).map_err(|error| failed(&error))?;
        opened.log_to(log);
        opened.serve_screen_readers(event_loop, self.proxy.clone());
        opened.window.set_visible(true);
        self.fill_again(&opened.window);
        Ok(opened)
    }

    /// Wakes the event loop from other threads.
    fn waker(&self) -> Waker {
        let proxy = self.proxy.clone();
        Arc::new(move || {
            // The event loop has ended: nobody is to be woken.
            let _ = proxy.send_event(Wake::Work);
        })
    }

    /// Whether the program was started without saying what to show: by a newcomer, perhaps.
    pub(super) fn is_bare(&self) -> bool {
        let ViewOptions {
            paths,
            against,
            script,
            restored,
            ..
        } = &self.options;
        paths.is_empty() && against.is_none() && script.is_none() && restored.is_none()
    }

    /// The desktop became dark or light: so do the panels, unless somebody has chosen their theme.
    fn desktop_theme(&mut self, to: Theme) {
        let Some(opened) = &mut self.opened else { return };
        let is_chosen = self.options.theme.or(self.remembered.theme()).is_some()
            || self.first_theme != Some(opened.session.viewer().chrome().theme());
        if !is_chosen {
            opened.session.run(Command::Window(WindowCommand::SetTheme(to)));
            self.first_theme = Some(to);
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: AppError) {
        self.failure.get_or_insert(error);
        event_loop.exit();
    }
}

impl ApplicationHandler<Wake> for Handler {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.opened.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(opened) => {
                startup::follow_scales(event_loop, &opened.window, self.proxy.clone());
                self.opened = Some(opened);
                self.watch = watch(self.waker());
            }
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, wake: Wake) {
        match (wake, &mut self.opened) {
            (Wake::Work, Some(opened)) => opened.session.poll(),
            (Wake::Theme(to), Some(_)) => self.desktop_theme(to),
            (Wake::Scales(scales), Some(opened)) => opened.set_scales(scales),
            (Wake::ScreenReader(event), Some(opened)) => opened.screen_reader(event),
            (Wake::Work | Wake::Theme(_) | Wake::Scales(_) | Wake::ScreenReader(_), None) => {}
            (Wake::End, _) => self.fail(event_loop, AppError::Ended),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(opened) = &mut self.opened else {
            return;
        };
        if !matches!(event, WindowEvent::RedrawRequested) {
            opened.note_event();
        }
        match event {
            WindowEvent::RedrawRequested => {
                if let Err(error) = opened.draw() {
                    self.fail(
                        event_loop,
                        AppError::Window(format!("cannot draw into the window: {error}")),
                    );
                }
            }
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Destroyed => {
                opened.sight = Sight::Gone;
                event_loop.exit();
            }
            WindowEvent::Moved(place) => opened.place = Some(place.into()),
            WindowEvent::Resized(size) => opened.resized(size),
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => {
                opened.set_scale(scale_factor);
                if startup::is_wayland(event_loop) {
                    let size = whole_pixels::fit(&opened.window, SMALLEST);
                    opened.resized(size);
                } else {
                    opened.rescaled();
                }
                opened.tell_panels(&event);
            }
            WindowEvent::Occluded(occluded) => {
                opened.sight = if occluded { Sight::Occluded } else { Sight::Open };
                opened.touch();
            }
            WindowEvent::DroppedFile(path) => self.dropped.push(path),
            WindowEvent::ModifiersChanged(modifiers) => {
                self.held = modifiers.state();
                opened.tell_panels(&event);
            }
            WindowEvent::KeyboardInput {
                event: ref key,
                is_synthetic,
                ..
            } => {
                if is_synthetic || !opened.key(key, self.held) {
                    opened.tell_panels(&event);
                }
            }
            WindowEvent::ThemeChanged(to) => self.desktop_theme(theme(to)),
            event => opened.pointer_event(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(opened) = &mut self.opened else {
            return;
        };
        if !self.dropped.is_empty() {
            opened
                .session
                .run(Command::Scenes(SceneCommand::Open(std::mem::take(&mut self.dropped))));
        }
        let mut again = None;
        if let Some(player) = &mut self.player {
            match player.advance(opened) {
                Ok(next) => again = next,
                Err(error) => return self.fail(event_loop, error),
            }
        }
        let mut watched = None;
        if let Some(watch) = &mut self.watch {
            let viewer = opened.session.viewer();
            let files = if viewer.scene_list().follows_files() {
                viewer.files()
            } else {
                Vec::new()
            };
            let changed = watch.turn(files);
            watched = watch.due();
            if !changed.is_empty() {
                opened.session.run(Command::Scenes(SceneCommand::FilesChanged(changed)));
            }
        }
        if opened.session.has_quit() {
            return event_loop.exit();
        }
        let next = [opened.schedule(), again, watched].into_iter().flatten().min();
        event_loop.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}

impl Opened {
    /// Hands an event to the panels.
    fn tell_panels(&mut self, event: &WindowEvent) {
        if self.egui.on_window_event(&self.window, event).repaint {
            self.touch();
        }
    }

    /// A key. True if it meant a command, so that the panels do not see it.
    fn key(&mut self, event: &KeyEvent, held: ModifiersState) -> bool {
        if event.state != ElementState::Pressed {
            return false;
        }
        let Some(command) = self.session.command_for(&winit_keys::press(event, held)) else {
            return false;
        };
        if !event.repeat || winit_keys::repeats(&command) {
            self.session.run(command);
        }
        true
    }

    /// Pointer, wheel, gestures, and what only the panels care for.
    fn pointer_event(&mut self, event: &WindowEvent) {
        if matches!(event, WindowEvent::CursorMoved { .. } | WindowEvent::CursorLeft { .. }) {
            self.pointer = Some(event.clone());
            self.pointer_scale = self.session.ctx().pixels_per_point();
        } else {
            self.place_pointer();
        }
        let taken = match event {
            WindowEvent::CursorMoved { position, .. } => {
                self.session.pointer_at(Some(DVec2::new(position.x, position.y)));
                false
            }
            WindowEvent::CursorLeft { .. } => {
                self.session.pointer_at(None);
                false
            }
            WindowEvent::MouseInput { state, button, .. } => {
                if let Some(button) = pointer_button(*button) {
                    self.session.pointer_button(button, *state == ElementState::Pressed);
                }
                false
            }
            WindowEvent::MouseWheel { delta, .. } => {
                self.session.turn_wheel(clicks(*delta, self.window.scale_factor()))
            }
            WindowEvent::PinchGesture { delta, .. } => self.session.pinch(delta.exp()),
            _ => false,
        };
        if !taken {
            self.tell_panels(event);
        }
    }
}

/// Follows files; where the system watches none, one line says so.
fn watch(waker: Waker) -> Option<Watch> {
    let watch = Watch::new(waker);
    if let Err(error) = &watch {
        // Whoever closed stderr does not want to read it.
        let _ = writeln!(
            std::io::stderr().lock(),
            "rasterscope: files that change are not read again by themselves: {error}; F5 reads the scene again"
        );
    }
    watch.ok()
}

fn pointer_button(button: MouseButton) -> Option<PointerButton> {
    match button {
        MouseButton::Left => Some(PointerButton::Primary),
        MouseButton::Right => Some(PointerButton::Secondary),
        _ => None,
    }
}

/// Turns of the wheel, up is above zero.
fn clicks(delta: MouseScrollDelta, scale: f64) -> f64 {
    match delta {
        MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
        MouseScrollDelta::PixelDelta(pixels) => pixels.y / (PIXELS_PER_CLICK * scale.max(0.1)),
    }
}

fn theme(theme: winit::window::Theme) -> Theme {
    match theme {
        winit::window::Theme::Dark => Theme::Dark,
        winit::window::Theme::Light => Theme::Light,
    }
}
