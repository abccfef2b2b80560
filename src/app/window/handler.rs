//! winit's events to what the session understands.

use crate::viewer::{SceneCommand, WindowCommand};
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
use winit::monitor::MonitorHandle;
use winit::window::{Window, WindowId};

use super::super::headless::{self, NamedScript};
use super::super::session::{Clock, Session};
use super::super::{AppError, ViewOptions};
use super::frame_log::FrameLog;
use super::icon;
use super::opened::Opened;
use super::player::Player;
use super::remembered::Remembered;
use super::startup::{self, ThemeQuestion, Wake};
use super::watch::Watch;
use super::whole_pixels;
use super::winit_keys;
use crate::figure::Guard;
use crate::raster::Framebuffer;
use crate::viewer::script::Stage as _;
use crate::viewer::{Command, InterfaceScale, PointerButton, Theme, Toggle, Viewer, ViewerOptions, Waker};

/// Device pixels of a touch pad's motion that count as a click of the wheel, at scale 1.
const PIXELS_PER_CLICK: f64 = 40.0;
/// Smallest useful window, in device pixels.
const SMALLEST: PhysicalSize<u32> = PhysicalSize::new(320, 240);

/// The program as winit sees it.
#[derive(Debug)]
pub(super) struct Handler {
    options: ViewOptions,
    proxy: EventLoopProxy<Wake>,
    opened: Option<Opened>,
    player: Option<Player>,
    /// Follows the files that are shown; `None` where the system watches none.
    watch: Option<Watch>,
    held: ModifiersState,
    /// Files that were dropped together.
    dropped: Vec<PathBuf>,
    /// What the session before left, and where; a script's window neither reads nor writes that.
    remembered: Remembered,
    remembered_in: Option<PathBuf>,
    /// The theme at the start.
    first_theme: Option<Theme>,
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

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a scale is a small number above zero"
    )]
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<Opened, AppError> {
        let mut problem = None;
        if let Some(file) = &self.remembered_in {
            (self.remembered, problem) = Remembered::read(file);
        }
        let chosen = self.options.theme.or(self.remembered.theme());
        // Answered while the window opens.
        let asked = chosen.is_none().then(|| ThemeQuestion::ask(self.proxy.clone()));
        let guard = Guard::new(self.options.force);
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
        let attributes = startup::named(attributes);
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
        let interface = self.options.scale.map_or(self.remembered.interface_scale(), |wanted| {
            InterfaceScale::from_percent((wanted / scale * 100.0).round().clamp(0.0, 1000.0) as u32)
        });
        session.run(Command::Window(WindowCommand::SetInterfaceScale(interface)));
        if self.remembered.presenter {
            session.run(Command::Window(WindowCommand::Presenter(Toggle::On)));
        }
        session.run(Command::Scenes(SceneCommand::RememberOpened(
            self.remembered.recent.clone(),
        )));
        session.set_panel_widths(self.remembered.panel_widths);
        if let Some(open) = self.remembered.panel {
            session.run(Command::Window(WindowCommand::Panel(if open {
                Toggle::On
            } else {
                Toggle::Off
            })));
        }
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
        Ok(opened)
    }

    /// The window's size at the start, in device pixels: the one that was asked for, or else one that the monitor has room for.
    #[expect(clippy::cast_possible_truncation, reason = "a scale is a small number")]
    fn first_size(&self, event_loop: &ActiveEventLoop) -> [u32; 2] {
        let monitor = event_loop
            .primary_monitor()
            .or_else(|| event_loop.available_monitors().next());
        let scale = monitor.as_ref().map_or(1.0, MonitorHandle::scale_factor);
        let remembered = self.remembered.size.filter(|_| self.options.size.is_none());
        let size = remembered.unwrap_or_else(|| headless::window_size(&self.options, scale as f32));
        match monitor.filter(|_| self.options.size.is_none()) {
            Some(monitor) => within(size, monitor.size()),
            None => size,
        }
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
    fn is_bare(&self) -> bool {
        let ViewOptions {
            paths,
            against,
            script,
            restored,
            ..
        } = &self.options;
        paths.is_empty() && against.is_none() && script.is_none() && restored.is_none()
    }

    /// Writes down what the next session begins with; where that cannot be, one line says so.
    pub(super) fn remember(&self) {
        let (Some(opened), Some(file)) = (&self.opened, &self.remembered_in) else {
            return;
        };
        let viewer = opened.session.viewer();
        let mut now = self.remembered.clone();
        now.greeted |= self.is_bare();
        if self.first_theme != Some(viewer.chrome().theme()) {
            now.set_theme(viewer.chrome().theme());
        }
        if self.options.scale.is_none() {
            now.set_interface_scale(viewer.chrome().interface_scale());
        }
        now.presenter = viewer.chrome().presenter();
        now.panel = opened.session.panel_choice().or(now.panel);
        now.panel_widths = opened.session.panel_widths();
        if self.options.size.is_none() && !viewer.chrome().window_size().contains(&0) {
            now.size = Some(viewer.chrome().window_size());
        }
        now.set_recent(viewer.scene_list().opened());
        if now == self.remembered {
            return;
        }
        if let Err(error) = now.write(file) {
            // Whoever closed stderr does not want to read it.
            let _ = writeln!(
                std::io::stderr().lock(),
                "rasterscope: {}: cannot remember this session: {error}; --no-config remembers none",
                file.display()
            );
        }
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
            (Wake::ScreenReader(event), Some(opened)) => opened.screen_reader(event),
            (Wake::Work | Wake::Theme(_) | Wake::ScreenReader(_), None) => {}
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
            WindowEvent::CloseRequested | WindowEvent::Destroyed => event_loop.exit(),
            WindowEvent::Resized(size) => opened.resized(size),
            WindowEvent::ScaleFactorChanged { .. } => {
                if startup::is_wayland(event_loop) {
                    let size = whole_pixels::fit(&opened.window, SMALLEST);
                    opened.session.set_shown_at(startup::shown_at(&opened.window));
                    opened.resized(size);
                } else {
                    opened.rescaled();
                }
                opened.tell_panels(&event);
            }
            WindowEvent::Occluded(occluded) => {
                opened.occluded = occluded;
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

/// A window's size, made smaller where its frame, with bars of the desktop beside it, would not fit into a monitor.
fn within(size: [u32; 2], monitor: PhysicalSize<u32>) -> [u32; 2] {
    /// What of a monitor a window may take, in percent: its title and the desktop's bars need the rest.
    const MOST: [u32; 2] = [96, 88];
    let largest = [monitor.width, monitor.height].map(u64::from);
    std::array::from_fn(|axis| {
        let most = largest[axis] * u64::from(MOST[axis]) / 100;
        let most = u32::try_from(most).unwrap_or(u32::MAX);
        // A monitor that tells no size counts as large.
        let most = if most == 0 { Framebuffer::MAX_SIDE } else { most };
        size[axis].min(most).max([SMALLEST.width, SMALLEST.height][axis])
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_fit_their_monitor() {
        let on = |width, height| PhysicalSize::new(width, height);
        assert_eq!(within([1280, 800], on(1920, 1080)), [1280, 800], "room for all");
        assert_eq!(within([1280, 800], on(1366, 768)), [1280, 675], "a small one");
        assert_eq!(within([1920, 1200], on(1920, 1080)), [1843, 950], "scale 1.5");
        assert_eq!(within([1280, 800], on(0, 0)), [1280, 800], "no size is told");
    }
}
