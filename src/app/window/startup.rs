//! Why a window cannot be opened, told apart: no display, or a library of the system that is missing.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use winit::event_loop::{ActiveEventLoop, EventLoop, EventLoopBuilder};
use winit::window::{Window, WindowAttributes};

use super::wake::Wake;

#[cfg(not(target_os = "linux"))]
use crate::viewer::Theme;

/// Why there is no window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NoWindow {
    /// Nothing to open a window on; a few words say why.
    NoDisplay(String),
    /// A library is missing: one line with the packages that have it.
    MissingLibrary(String),
}

/// Libraries that are loaded when a window opens, and the Debian packages that have them. A name that begins another
/// one stands after it.
const LIBRARIES: [(&str, &str); 7] = [
    ("libxkbcommon-x11", "libxkbcommon-x11-0"),
    ("libxkbcommon", "libxkbcommon0"),
    ("libx11-xcb", "libx11-xcb1"),
    ("libx11", "libx11-6"),
    ("libxcursor", "libxcursor1"),
    ("libxi", "libxi6"),
    ("libwayland-client", "libwayland-client0"),
];
/// All that a window on X11 needs.
const X11_PACKAGES: &str = "libx11-6 libxcursor1 libxi6 libx11-xcb1 libxkbcommon-x11-0";
/// All that a window on Wayland needs.
const WAYLAND_PACKAGES: &str = "libwayland-client0 libxkbcommon0";

/// Connects to the display.
pub(super) fn event_loop() -> Result<EventLoop<Wake>, NoWindow> {
    if cfg!(target_os = "linux") && !any_display(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty())) {
        return Err(NoWindow::NoDisplay(
            "neither DISPLAY nor WAYLAND_DISPLAY is set".to_owned(),
        ));
    }
    match quietly(|| builder().build()) {
        Ok(Ok(event_loop)) => Ok(event_loop),
        Ok(Err(error)) => Err(explain(&format!("{error}"), &format!("{error:?}"))),
        Err(panic) => Err(explain(&panic, "")),
    }
}

/// An event loop to be: on Wayland where that answers, else on X11 where there is one, as after a compositor that has ended.
fn builder() -> EventLoopBuilder<Wake> {
    #[cfg_attr(not(target_os = "linux"), expect(unused_mut, reason = "there is one window system"))]
    let mut builder = EventLoop::with_user_event();
    #[cfg(target_os = "linux")]
    if let Some(socket) = linux::wayland_socket(|name| std::env::var_os(name).filter(|value| !value.is_empty()))
        && std::os::unix::net::UnixStream::connect(socket).is_err()
    {
        use winit::platform::x11::EventLoopBuilderExtX11 as _;

        builder.with_x11();
    }
    builder
}

#[cfg(target_os = "linux")]
pub(super) use super::desktop_theme::Question as ThemeQuestion;

/// Nothing is to be asked where winit knows the desktop's theme.
#[cfg(not(target_os = "linux"))]
#[derive(Debug)]
pub(super) struct ThemeQuestion;

#[cfg(not(target_os = "linux"))]
impl ThemeQuestion {
    pub(super) fn ask(_: winit::event_loop::EventLoopProxy<Wake>) -> Self {
        Self
    }

    #[expect(clippy::unused_self, reason = "as on Linux")]
    pub(super) fn answer(self) -> Option<Theme> {
        None
    }
}

/// Follows the scale of monitors where winit does not: X11's, and at how many percent a compositor of Wayland shows windows that
/// it scales by itself.
pub(super) fn follow_scales(
    event_loop: &ActiveEventLoop,
    window: &Window,
    proxy: winit::event_loop::EventLoopProxy<Wake>,
) {
    #[cfg(target_os = "linux")]
    if linux::is_wayland(event_loop) {
        super::desktop_scale::follow(proxy);
    } else {
        super::x11_scale::follow(window);
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (event_loop, window, proxy);
}

/// Whether the window is shown by a compositor of Wayland.
pub(super) fn is_wayland(event_loop: &ActiveEventLoop) -> bool {
    #[cfg(target_os = "linux")]
    let is_wayland = linux::is_wayland(event_loop);
    #[cfg(not(target_os = "linux"))]
    let is_wayland = {
        let _ = event_loop;
        false
    };
    is_wayland
}

/// A window with the name by which desktops find its icon: that of the desktop file.
pub(super) fn named(attributes: WindowAttributes) -> WindowAttributes {
    #[cfg(target_os = "linux")]
    let attributes = linux::named(attributes);
    attributes
}

#[cfg(target_os = "linux")]
mod linux {
    use std::ffi::OsString;
    use std::path::{Path, PathBuf};

    use winit::event_loop::ActiveEventLoop;
    use winit::platform::{wayland, x11};
    use winit::window::WindowAttributes;

    const NAME: &str = "rasterscope";

    /// Where the compositor should answer; `None` where only it may, or none is asked for.
    pub(super) fn wayland_socket(value: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
        value("DISPLAY")?;
        if value("WAYLAND_SOCKET").is_some() {
            return None;
        }
        // A name with a root is the path itself (wl_display_connect).
        let name = value("WAYLAND_DISPLAY")?;
        let folder = value("XDG_RUNTIME_DIR").unwrap_or_default();
        Some(Path::new(&folder).join(name))
    }

    pub(super) fn is_wayland(event_loop: &ActiveEventLoop) -> bool {
        wayland::ActiveEventLoopExtWayland::is_wayland(event_loop)
    }

    pub(super) fn named(attributes: WindowAttributes) -> WindowAttributes {
        let attributes = x11::WindowAttributesExtX11::with_name(attributes, NAME, NAME);
        wayland::WindowAttributesExtWayland::with_name(attributes, NAME, NAME)
    }
}

fn any_display(is_set: impl Fn(&str) -> bool) -> bool {
    ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(is_set)
}

/// Runs `work` and turns a panic into its message, without a word on stderr: winit panics where libraries are missing.
fn quietly<R>(work: impl FnOnce() -> R) -> Result<R, String> {
    let message = Arc::new(Mutex::new(String::new()));
    let seen = Arc::clone(&message);
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        *seen.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
    }));
    let result = catch_unwind(AssertUnwindSafe(work));
    std::panic::set_hook(before);
    result.map_err(|_| message.lock().unwrap_or_else(PoisonError::into_inner).clone())
}

/// The cause behind a failure of the window system.
fn explain(message: &str, details: &str) -> NoWindow {
    let text = format!("{message} {details}").to_lowercase();
    if let Some((library, package)) = LIBRARIES.into_iter().find(|(library, _)| text.contains(library)) {
        return NoWindow::MissingLibrary(missing(&format!("the library {library} is missing"), package));
    }
    if text.contains("shared librar") || text.contains("nowaylandlib") || text.contains("xlib library") {
        let wayland = text.contains("wayland");
        let packages = if wayland { WAYLAND_PACKAGES } else { X11_PACKAGES };
        let what = if wayland {
            "a library of Wayland is missing"
        } else {
            "a library of X11 is missing"
        };
        return NoWindow::MissingLibrary(missing(what, packages));
    }
    NoWindow::NoDisplay(format!("the display does not answer ({})", cause(message)))
}

fn missing(what: &str, packages: &str) -> String {
    format!("cannot open a window: {what}; install it with: sudo apt install {packages}")
}

/// The message as one line, without winit's own place in its source.
fn cause(message: &str) -> String {
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": ")) {
        Some((_, cause)) => cause.to_owned(),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn startup_names_the_package() {
        let cases = [
            (
                "Library libxkbcommon-x11.so could not be loaded.",
                "apt install libxkbcommon-x11-0",
            ),
            (
                "Library libxkbcommon.so could not be loaded.",
                "apt install libxkbcommon0",
            ),
            (
                "libX11-xcb.so.1: cannot open shared object file",
                "apt install libx11-xcb1",
            ),
            (
                "libXcursor.so.1: cannot open shared object file",
                "apt install libxcursor1",
            ),
            (
                "Failed to load one of xlib's shared libraries",
                "apt install libx11-6 libxcursor1",
            ),
            (
                "WaylandError(Connection(NoWaylandLib))",
                "apt install libwayland-client0",
            ),
        ];
        for (message, cure) in cases {
            match explain(message, "") {
                NoWindow::MissingLibrary(line) => assert!(line.contains(cure) && !line.contains('\n'), "{line}"),
                other @ NoWindow::NoDisplay(_) => panic!("{message}: {other:?}"),
            }
        }
        let refused = explain("os error: failed to open connection\nto X server", "");
        assert!(
            matches!(&refused, NoWindow::NoDisplay(why) if !why.contains('\n')),
            "{refused:?}"
        );
    }

    #[test]
    fn startup_panics_become_messages() {
        assert_eq!(quietly(|| 7), Ok(7), "nothing happened");
        let panic = quietly(|| panic!("Library libxkbcommon-x11.so could not be loaded.")).map(|()| 0);
        assert!(
            panic.is_err_and(|message| message.contains("libxkbcommon-x11")),
            "the message is kept"
        );
    }

    #[test]
    fn startup_looks_for_any_display() {
        assert!(any_display(|name| name == "WAYLAND_DISPLAY"), "Wayland alone");
        assert!(!any_display(|_| false), "none");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn compositor_is_only_asked_for_where_x11_could_take_its_place() {
        let socket = |set: &[(&str, &str)]| {
            let value = |name: &str| {
                set.iter()
                    .find(|(known, _)| *known == name)
                    .map(|(_, value)| value.into())
            };
            linux::wayland_socket(value)
        };
        let both = [
            ("DISPLAY", ":0"),
            ("XDG_RUNTIME_DIR", "/run/user/1"),
            ("WAYLAND_DISPLAY", "wayland-0"),
        ];
        assert_eq!(socket(&both), Some("/run/user/1/wayland-0".into()));
        assert_eq!(socket(&both[1..]), None, "no X11");
        assert_eq!(socket(&both[..2]), None, "no Wayland");
        let rooted = [("DISPLAY", ":0"), ("WAYLAND_DISPLAY", "/tmp/wayland-7")];
        assert_eq!(socket(&rooted), Some("/tmp/wayland-7".into()));
        let given = [
            ("DISPLAY", ":0"),
            ("WAYLAND_DISPLAY", "wayland-0"),
            ("WAYLAND_SOCKET", "4"),
        ];
        assert_eq!(socket(&given), None, "a connection that is open already");
    }
}
