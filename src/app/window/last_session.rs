//! What a window takes up of the last session, and what it leaves for the next.
//!
//! A place is that of the window's frame on the desktop. It is taken up only where its title can be grabbed:
//!
//! ```text
//!   monitor 0        monitor 1
//!  +---------------+---------+
//!  |          [=======]      |   in sight
//!  +---------------+         |
//!        [====]    +---------+   not in sight: the system places the window
//! ```

use std::io::Write as _;

use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::monitor::MonitorHandle;
use winit::window::{Window, WindowAttributes};

use super::super::headless;
use super::super::session::Session;
use super::handler::{Handler, SMALLEST};
use super::opened::Sight;
use crate::raster::Framebuffer;
use crate::viewer::picture;
use crate::viewer::{Command, InterfaceScale, SceneCommand, Settings, Toggle, WindowCommand};

impl Handler {
    /// What the window begins with besides its size: sampling and textures.
    pub(super) fn take_up_settings(&mut self) {
        if self.options.restored.is_none() {
            self.remembered.take_up(&mut self.options.settings, &self.options.given);
        }
    }

    /// What the panels begin with; `scale` is the monitor's. Settings that are not the first ones are told.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a scale is a small number above zero"
    )]
    pub(super) fn take_up(&self, session: &mut Session, scale: f32) {
        let remembered = &self.remembered;
        let interface = self.options.scale.map_or(remembered.interface_scale(), |wanted| {
            InterfaceScale::from_percent((wanted / scale * 100.0).round().clamp(0.0, 1000.0) as u32)
        });
        session.run(Command::Window(WindowCommand::SetInterfaceScale(interface)));
        if remembered.presenter {
            session.run(Command::Window(WindowCommand::Presenter(Toggle::On)));
        }
        session.run(Command::Scenes(SceneCommand::RememberOpened(remembered.recent.clone())));
        session.set_panel_widths(remembered.panel_widths);
        session.set_sections(remembered.sections.clone());
        let switch = |open| if open { Toggle::On } else { Toggle::Off };
        if let Some(open) = remembered.panel {
            session.run(Command::Window(WindowCommand::Panel(switch(open))));
        }
        if let Some(open) = remembered.about {
            session.run(Command::Window(WindowCommand::About(switch(open))));
        }
        if remembered.follow_files == Some(false) {
            session.run(Command::Scenes(SceneCommand::FollowFiles(Toggle::Off)));
        }
        let taken = remembered.has_settings() && self.options.restored.is_none();
        if let Some(words) = taken.then(|| as_left(session.viewer().settings())).flatten() {
            session.tell(words);
        }
    }

    /// A window where it was in the last session, if that can be.
    pub(super) fn placed(&self, attributes: WindowAttributes, event_loop: &ActiveEventLoop) -> WindowAttributes {
        let monitors: Vec<Area> = event_loop.available_monitors().map(|monitor| area(&monitor)).collect();
        match self.remembered.place {
            Some(place) if monitors.iter().any(|monitor| monitor.shows_title_at(place)) => {
                attributes.with_position(PhysicalPosition::<i32>::from(place))
            }
            _ => attributes,
        }
    }

    /// Lets a window fill its monitor as it did in the last session: window managers of X take no such wish before it is shown.
    pub(super) fn fill_again(&self, window: &Window) {
        if self.remembered.maximized && self.options.size.is_none() {
            window.set_maximized(true);
        }
    }

    /// The window's size at the start, in device pixels: the one that was asked for, or else one that the monitor has room for.
    #[expect(clippy::cast_possible_truncation, reason = "a scale is a small number")]
    pub(super) fn first_size(&self, event_loop: &ActiveEventLoop) -> [u32; 2] {
        let place = self.remembered.place;
        let monitor = event_loop
            .available_monitors()
            .find(|monitor| place.is_some_and(|place| area(monitor).shows_title_at(place)))
            .or_else(|| event_loop.primary_monitor())
            .or_else(|| event_loop.available_monitors().next());
        let scale = monitor.as_ref().map_or(1.0, MonitorHandle::scale_factor);
        let remembered = self.remembered.size.filter(|_| self.options.size.is_none());
        let size = remembered.unwrap_or_else(|| headless::window_size(&self.options, scale as f32));
        match monitor.filter(|_| self.options.size.is_none()) {
            Some(monitor) => within(size, monitor.size()),
            None => size,
        }
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
        now.sections = opened.session.sections();
        now.about = viewer.chrome().about().then_some(true);
        now.follow_files = (!viewer.scene_list().follows_files()).then_some(false);
        // A lesson brings its own settings, and what was asked for at the start was for this session.
        if viewer.lesson().is_none() && *viewer.settings() != self.options.settings {
            now.set_settings(viewer.settings());
        }
        // winit ends in a panic where it is asked about a window that is gone.
        let maximized = opened.sight != Sight::Gone && opened.window.is_maximized();
        if !maximized {
            now.place = opened.place.or(now.place);
        }
        if self.options.size.is_none() && !viewer.chrome().window_size().contains(&0) {
            now.maximized = maximized;
            if !maximized {
                now.size = Some(viewer.chrome().window_size());
            }
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
}

/// Tells the settings that the last session left; nothing where all are as in the first.
fn as_left(settings: &Settings) -> Option<String> {
    let changed = picture::sampling().filter(|setting| !setting.is_default(settings));
    let words: Vec<String> = changed.map(|setting| setting.words(settings)).collect();
    let words = words.join(", ");
    (!words.is_empty())
        .then(|| format!("settings as you left them: {words}; Defaults in the panel brings back the first settings"))
}

/// A monitor's part of the desktop, in device pixels.
#[derive(Clone, Copy, Debug)]
struct Area {
    corner: [i32; 2],
    size: [u32; 2],
}

fn area(monitor: &MonitorHandle) -> Area {
    Area {
        corner: monitor.position().into(),
        size: monitor.size().into(),
    }
}

impl Area {
    /// Whether the left end of a title at this place can be grabbed.
    fn shows_title_at(self, place: [i32; 2]) -> bool {
        /// Pixels of a title that a hand needs, to the right and downwards.
        const GRIP: i64 = 48;
        (0..2).all(|axis| {
            let at = i64::from(place[axis]) - i64::from(self.corner[axis]);
            (0..=i64::from(self.size[axis]) - GRIP).contains(&at)
        })
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

    #[test]
    fn places_off_the_screen_are_not_taken_up() {
        let second = Area {
            corner: [1920, -100],
            size: [1280, 1024],
        };
        for place in [[1920, -100], [2000, 300], [3152, 876]] {
            assert!(second.shows_title_at(place), "{place:?} can be grabbed");
        }
        for place in [[1919, 0], [2000, -101], [3153, 0], [2000, 900], [i32::MIN, i32::MAX]] {
            assert!(!second.shows_title_at(place), "{place:?} is off it");
        }
        let nothing = Area {
            corner: [0, 0],
            size: [0, 0],
        };
        assert!(!nothing.shows_title_at([0, 0]), "a monitor without a size shows none");
    }
}
