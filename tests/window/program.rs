//! The program in its window, and what it should show.

use std::io::Write as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command as Process, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use rasterscope::geometry::View;
use rasterscope::raster::Framebuffer;
use rasterscope::render::{RenderSettings, draw};
use rasterscope::scene::{self, DialectChoice};
use rasterscope::viewer::{Command, InspectorCommand, Viewer, ViewerOptions};
use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    CONFIGURE_NOTIFY_EVENT, ClientMessageEvent, ConfigureNotifyEvent, ConfigureWindowAux, ConnectionExt as _,
    EventMask, Window,
};

use super::desktop::Desktop;

/// The longest that anything may take, on a busy machine too.
pub(crate) const PATIENCE: Duration = Duration::from_secs(20);
/// Width and height of the window at the start.
pub(crate) const SIZE: [u32; 2] = [500, 400];

/// What has its words on stderr, in its folder.
const ERRORS: &str = "stderr";

/// A scene of ours with textures.
pub(crate) fn textured() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/texmap/test4.svg")
}

/// A scene of ours with flat triangles.
pub(crate) fn flat() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("svg/basic/test4.svg")
}

/// The program, its window, and the folder it runs in.
pub(crate) struct Program {
    child: Child,
    pub(crate) window: Window,
    pub(crate) desktop: Desktop,
    pub(crate) folder: tempfile::TempDir,
    /// What the window belongs to where the program is not a client of the X server itself.
    compositor: Option<Child>,
}

impl Program {
    /// Opens `path` and waits for the window.
    pub(crate) fn start(path: &Path) -> Self {
        Self::start_with(path, &[])
    }

    /// As [`Program::start`], with more arguments.
    pub(crate) fn start_with(path: &Path, arguments: &[&str]) -> Self {
        Self::open(&[path], arguments)
    }

    /// Opens `paths`, without any the gallery.
    pub(crate) fn open(paths: &[&Path], arguments: &[&str]) -> Self {
        Self::open_in(tempfile::tempdir().unwrap(), paths, arguments)
    }

    /// As [`Program::open`], in a folder that also holds what it remembers.
    pub(crate) fn open_in(folder: tempfile::TempDir, paths: &[&Path], arguments: &[&str]) -> Self {
        Self::open_where(folder, paths, arguments, &[])
    }

    /// As [`Program::open_in`], with more variables of the environment.
    pub(crate) fn open_where(
        folder: tempfile::TempDir,
        paths: &[&Path],
        arguments: &[&str],
        variables: &[(&str, &str)],
    ) -> Self {
        let desktop = Desktop::start();
        let child = Self::spawn(folder.path(), paths, arguments)
            .env("DISPLAY", &desktop.name)
            .envs(variables.iter().copied())
            .spawn()
            .unwrap();
        let window = until("the window", || desktop.find_window());
        desktop.focus(window);
        Self {
            child,
            window,
            desktop,
            folder,
            compositor: None,
        }
    }

    /// Opens `path` under a Wayland compositor of this scale, which fills its own window with the program's: keys and pixels
    /// are those of X, and go through the compositor.
    pub(crate) fn start_on_wayland(path: &Path, scale: u32) -> Self {
        const SOCKET: &str = "wayland-test";
        let folder = tempfile::tempdir().unwrap();
        // Compositors want a folder that nobody else can read.
        std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(0o700)).unwrap();
        let desktop = Desktop::start();
        let [width, height] = SIZE;
        let compositor = Process::new("weston")
            .args(["--no-config", "--backend=x11-backend.so", "--use-pixman"])
            .args(["--shell=kiosk-shell.so", "--idle-time=0"])
            .arg(format!("--socket={SOCKET}"))
            .args([format!("--width={width}"), format!("--height={height}")])
            .arg(format!("--scale={scale}"))
            .env("DISPLAY", &desktop.name)
            .env("XDG_RUNTIME_DIR", folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        let compositor = compositor.unwrap_or_else(|error| {
            panic!("the window tests need weston ({error}); install it with: sudo apt install weston")
        });
        let window = until("the compositor's window", || desktop.find_window());
        let socket = folder.path().join(SOCKET);
        until("the compositor", || socket.exists().then_some(()));
        desktop.focus(window);
        let child = Self::spawn(folder.path(), &[path], &[])
            .env_remove("DISPLAY")
            .env("XDG_RUNTIME_DIR", folder.path())
            .env("WAYLAND_DISPLAY", SOCKET)
            .spawn()
            .unwrap();
        Self {
            child,
            window,
            desktop,
            folder,
            compositor: Some(compositor),
        }
    }

    /// The program to be, without anything of the desktop that the test runs on.
    fn spawn(folder: &Path, paths: &[&Path], arguments: &[&str]) -> Process {
        let [width, height] = SIZE;
        let errors = std::fs::File::create(folder.join(ERRORS)).unwrap();
        let mut process = Process::new(env!("CARGO_BIN_EXE_rasterscope"));
        process
            .arg("view")
            .args(paths)
            .args(["--size", &format!("{width}x{height}")])
            .args(arguments)
            .env("XDG_CONFIG_HOME", folder.join("config"))
            // No test hears of the desktop that it runs on.
            .env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nowhere")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .env_remove("WINIT_X11_SCALE_FACTOR")
            .current_dir(folder)
            .stdout(Stdio::null())
            .stderr(errors);
        process
    }

    /// Opens `path` and hides everything but the picture, so that every pixel of the window is the scene's.
    pub(crate) fn start_bare(path: &Path) -> Self {
        let program = Self::start(path);
        program.desktop.point(250, 200);
        program.desktop.press(super::desktop::keysym::TAB, &[]);
        program
    }

    /// The process, for the system's tables.
    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits until the window shows `expected`; tells what differs if it never does.
    pub(crate) fn shows(&self, expected: &Framebuffer, what: &str) {
        let wanted: Vec<u32> = expected.pixels().iter().map(|pixel| pixel & 0x00ff_ffff).collect();
        let start = Instant::now();
        let mut last = None;
        while start.elapsed() < PATIENCE {
            last = self.desktop.pixels(self.window);
            if last.as_ref().is_some_and(|(pixels, _)| *pixels == wanted) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let (pixels, size) = last.unwrap();
        let wrong = pixels.iter().zip(&wanted).filter(|(a, b)| a != b).count();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let mut seen = Framebuffer::new(size[0], size[1]);
        for (to, from) in seen.pixels_mut().iter_mut().zip(&pixels) {
            *to = 0xff00_0000 | from;
        }
        rasterscope::figure::save_png(&seen, &folder.join("window-seen.png")).unwrap();
        rasterscope::figure::save_png(expected, &folder.join("window-expected.png")).unwrap();
        panic!(
            "{what}: {wrong} of {} pixels differ, {size:?} instead of {}x{}; see window-*.png in {}",
            wanted.len(),
            expected.width(),
            expected.height(),
            folder.display()
        );
    }

    /// Waits until `picture` stands somewhere in the window, pixel for pixel.
    pub(crate) fn shows_somewhere(&self, picture: &Framebuffer, what: &str) {
        let rows: Vec<Vec<u32>> = picture
            .pixels()
            .chunks(picture.width() as usize)
            .map(|row| row.iter().map(|pixel| pixel & 0x00ff_ffff).collect())
            .collect();
        until(what, || {
            let (pixels, [width, height]) = self.desktop.pixels(self.window)?;
            let (width, height) = (width as usize, height as usize);
            let stands_at = |x: usize, y: usize| {
                rows.iter().enumerate().all(|(i, row)| {
                    let start = (y + i) * width + x;
                    pixels[start..start + row.len()] == row[..]
                })
            };
            let columns = width.checked_sub(rows[0].len())?;
            let lines = height.checked_sub(rows.len())?;
            (0..=lines)
                .any(|y| (0..=columns).any(|x| stands_at(x, y)))
                .then_some(())
        });
    }

    /// Gives the window another size.
    pub(crate) fn resize(&self, [width, height]: [u32; 2]) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.desktop
            .x
            .configure_window(self.window, &size)
            .unwrap()
            .check()
            .unwrap();
    }

    /// Moves the window, as a window manager does: its upper left corner is then there, and it is told so.
    pub(crate) fn place(&self, [x, y]: [i16; 2]) {
        let connection = &self.desktop.x;
        let place = ConfigureWindowAux::new().x(i32::from(x)).y(i32::from(y));
        connection
            .configure_window(self.window, &place)
            .unwrap()
            .check()
            .unwrap();
        let size = connection.get_geometry(self.window).unwrap().reply().unwrap();
        let event = ConfigureNotifyEvent {
            response_type: CONFIGURE_NOTIFY_EVENT,
            sequence: 0,
            event: self.window,
            window: self.window,
            above_sibling: x11rb::NONE,
            x,
            y,
            width: size.width,
            height: size.height,
            border_width: 0,
            override_redirect: false,
        };
        connection
            .send_event(false, self.window, EventMask::STRUCTURE_NOTIFY, event)
            .unwrap()
            .check()
            .unwrap();
    }

    /// Where its upper left corner is: there is no frame around it.
    pub(crate) fn placed(&self) -> [i16; 2] {
        let place = self.desktop.x.get_geometry(self.window).unwrap().reply().unwrap();
        [place.x, place.y]
    }

    /// Asks the window to close, as a window manager does.
    pub(crate) fn close(&self) {
        let x = &self.desktop.x;
        let atom = |name: &str| x.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
        let data = [atom("WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let event = ClientMessageEvent::new(32, self.window, atom("WM_PROTOCOLS"), data);
        x.send_event(false, self.window, EventMask::NO_EVENT, event)
            .unwrap()
            .check()
            .unwrap();
        x.flush().unwrap();
    }

    /// What it said on stderr.
    pub(crate) fn errors(&self) -> String {
        std::fs::read_to_string(self.folder.path().join(ERRORS)).unwrap()
    }

    /// Waits for the program's end.
    pub(crate) fn ended(&mut self) -> ExitStatus {
        until("the end of the program", || self.child.try_wait().unwrap())
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
        if let Some(compositor) = &mut self.compositor {
            let _ = compositor.kill();
            let _ = compositor.wait();
        }
        if std::thread::panicking() {
            // Beside what the test says.
            let _ = std::io::stderr().write_all(self.errors().as_bytes());
        }
    }
}

/// Asks again and again until there is an answer.
pub(crate) fn until<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(start.elapsed() < PATIENCE, "waited too long for {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// What `render` makes of a scene in the default view.
pub(crate) fn rendered(path: &Path, settings: &RenderSettings, size: [u32; 2]) -> Framebuffer {
    let scene = scene::load(path, DialectChoice::Auto).unwrap();
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(
        &scene,
        &View::Default.transform(scene.canvas, size),
        settings,
        &mut frame,
    );
    frame
}

/// What the viewer without a window makes of the same commands.
pub(crate) fn viewed(path: &Path, commands: &[Command]) -> Framebuffer {
    viewer_after(path, commands).window().picture()
}

/// The inspector's inset after the same commands.
pub(crate) fn inset(path: &Path, commands: &[Command]) -> Framebuffer {
    let viewer = viewer_after(path, commands);
    let (window, place) = (viewer.window().picture(), viewer.inspector().inset().unwrap().rect);
    let mut picture = Framebuffer::new(place.width, place.height);
    let width = window.width() as usize;
    let (left, top) = (usize::try_from(place.x).unwrap(), usize::try_from(place.y).unwrap());
    for (i, row) in picture.pixels_mut().chunks_mut(place.width as usize).enumerate() {
        let start = (top + i) * width + left;
        row.copy_from_slice(&window.pixels()[start..start + place.width as usize]);
    }
    picture
}

/// The left part of the whole window, panels included, after a script: as many columns and rows as `part` says.
pub(crate) fn left_part(path: &Path, size: [u32; 2], steps: &str, part: [u32; 2]) -> Framebuffer {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("window.png");
    rasterscope::app::run(rasterscope::app::ViewOptions {
        paths: vec![path.to_owned()],
        size: Some(size),
        script: Some(rasterscope::app::ScriptSource::Text(format!(
            "{steps}; shot \"{}\"",
            file.display()
        ))),
        headless: true,
        ..rasterscope::app::ViewOptions::default()
    })
    .unwrap();
    let image = image::open(&file).unwrap().into_rgba8();
    let mut picture = Framebuffer::new(part[0], part[1]);
    for (i, to) in (0..).zip(picture.pixels_mut()) {
        let [r, g, b, a] = image.get_pixel(i % part[0], i / part[0]).0;
        *to = u32::from_be_bytes([a, r, g, b]);
    }
    picture
}

fn viewer_after(path: &Path, commands: &[Command]) -> Viewer {
    let options = ViewerOptions {
        paths: vec![path.to_owned()],
        window: SIZE,
        ..ViewerOptions::default()
    };
    let mut viewer = Viewer::new(options).unwrap();
    viewer.finish();
    for command in commands {
        // Effects are for the window.
        let _ = viewer.apply(command.clone());
        viewer.finish();
    }
    viewer
}

/// A small inset: it has neither words nor numbers, which are for eyes.
pub(crate) const SMALL_INSET: &str = "region 8; magnification 9";

/// The commands of [`SMALL_INSET`].
pub(crate) const SMALL_INSET_COMMANDS: [Command; 2] = [
    Command::Inspector(InspectorCommand::SetRegion(8)),
    Command::Inspector(InspectorCommand::SetMagnification(9)),
];
