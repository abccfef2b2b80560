//! winit's events to what the session understands.

use crate::viewer::{SceneCommand, WindowCommand};
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
use super::opened::Opened;
use super::player::Player;
use super::startup::Wake;
use super::winit_keys;
use crate::figure::Guard;
use crate::viewer::script::Stage as _;
use crate::viewer::{Command, PointerButton, Theme, Viewer, Waker};

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
    held: ModifiersState,
    /// Files that were dropped together.
    dropped: Vec<PathBuf>,
    pub(super) failure: Option<AppError>,
}

impl Handler {
    pub(super) fn new(options: ViewOptions, script: Option<NamedScript>, proxy: EventLoopProxy<Wake>) -> Self {
        Self {
            options,
            proxy,
            opened: None,
            player: script.map(Player::new),
            held: ModifiersState::empty(),
            dropped: Vec::new(),
            failure: None,
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a scale is a small number")]
    fn open(&self, event_loop: &ActiveEventLoop) -> Result<Opened, AppError> {
        let guard = Guard::new(self.options.force);
        let log = self.options.frame_log.as_deref();
        let log = log.map(|path| FrameLog::create(path, &guard)).transpose()?;
        let scale = event_loop
            .primary_monitor()
            .map_or(1.0, |monitor| monitor.scale_factor());
        let [width, height] = headless::window_size(&self.options, scale as f32);
        let attributes = Window::default_attributes()
            .with_title("Rasterscope")
            .with_inner_size(PhysicalSize::new(width, height))
            .with_min_inner_size(SMALLEST);
        let failed = |what: &dyn std::fmt::Display| AppError::Window(format!("cannot open a window: {what}"));
        let window = Arc::new(event_loop.create_window(attributes).map_err(|error| failed(&error))?);
        let PhysicalSize { width, height } = window.inner_size();
        let proxy = self.proxy.clone();
        let waker: Waker = Arc::new(move || {
            // The event loop has ended: nobody is to be woken.
            let _ = proxy.send_event(Wake);
        });
        let theme = window.theme().map(theme);
        let viewer_options = headless::viewer_options(&self.options, [width, height], theme, waker);
        let viewer = Viewer::new(viewer_options).map_err(AppError::Threads)?;
        let session = Session::new(viewer, window.scale_factor() as f32, Clock::Real(Instant::now()));
        let mut opened =
            Opened::new(event_loop.owned_display_handle(), window, session).map_err(|error| failed(&error))?;
        opened.log_to(log);
        Ok(opened)
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
            Ok(opened) => self.opened = Some(opened),
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, _: Wake) {
        if let Some(opened) = &mut self.opened {
            opened.session.poll();
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
            WindowEvent::ThemeChanged(to) if self.options.theme.is_none() => {
                opened.session.run(Command::Window(WindowCommand::SetTheme(theme(to))));
            }
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
        if opened.session.has_quit() {
            return event_loop.exit();
        }
        let next = [opened.schedule(), again].into_iter().flatten().min();
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
            WindowEvent::ScaleFactorChanged { .. } => {
                self.rescaled();
                false
            }
            _ => false,
        };
        if !taken {
            self.tell_panels(event);
        }
    }
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
