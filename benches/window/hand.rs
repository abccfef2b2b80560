//! The program in a window, and a hand that moves its mouse.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::desktop::{Desktop, keysym};
use super::log::{self, Line};

/// What a hand does; the spans of time in which it moved.
pub(crate) type Play = fn(&mut Hand) -> Vec<[f64; 2]>;

/// Between two motions of a mouse.
const MOTION: Duration = Duration::from_millis(8);
/// Nothing new for so long: at rest.
const QUIET: Duration = Duration::from_millis(600);

/// The program and its user.
pub(crate) struct Hand {
    child: Child,
    desktop: Desktop,
    log: PathBuf,
    _folder: tempfile::TempDir,
}

impl Hand {
    /// Opens the scene and waits for its final picture; `options` count more than those that all have.
    pub(crate) fn start(scene: &str, options: &[String], script: Option<&str>) -> Self {
        let desktop = Desktop::start();
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("frames.csv");
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(scene);
        let program = std::env::var_os("RASTERSCOPE_PROGRAM").unwrap_or(env!("CARGO_BIN_EXE_rasterscope").into());
        let mut command = Command::new(program);
        command
            .arg("view")
            .arg(scene)
            .args(["--size", "1920x1080", "--theme", "dark"]);
        command.args(options).arg("--frame-log").arg(&log);
        if let Some(script) = script {
            command.args(["--do", script]);
        }
        let mut child = command
            .env("DISPLAY", &desktop.name)
            .env("XDG_CONFIG_HOME", folder.path())
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .env_remove("WINIT_X11_SCALE_FACTOR")
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let window = loop {
            if let Some(window) = desktop.find_window() {
                break window;
            }
            assert!(child.try_wait().unwrap().is_none(), "the program ended at once");
            std::thread::sleep(Duration::from_millis(10));
        };
        desktop.focus(window);
        let hand = Self {
            child,
            desktop,
            log,
            _folder: folder,
        };
        hand.settle();
        hand
    }

    /// What was shown so far.
    pub(crate) fn lines(&self) -> Vec<Line> {
        log::read(&self.log)
    }

    /// Waits until nothing new is shown.
    fn settle(&self) {
        let is_quiet = || {
            let last = self.lines().pop();
            last.is_some_and(|line| log::now() - line.at > QUIET.as_secs_f64() * 1e3)
        };
        while !is_quiet() {
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Moves along a path for so long, `budget` motions after another; `at` tells the place after so many motions.
    fn path(&self, time: Duration, at: impl Fn(i16) -> [i16; 2]) -> [f64; 2] {
        let start = (Instant::now(), log::now());
        let mut step = 0;
        while start.0.elapsed() < time {
            step += 1;
            let [x, y] = at(step);
            self.desktop.point(x, y);
            let next = MOTION * u32::try_from(step).unwrap();
            std::thread::sleep(next.saturating_sub(start.0.elapsed()));
        }
        [start.1, log::now()]
    }

    /// A motion that is quick and slow by turns and never the same way twice.
    fn swing(step: i16) -> [i16; 2] {
        let time = f64::from(step) * MOTION.as_secs_f64();
        let (x, y) = ((time * 2.9).sin() * 420.0, (time * 1.7).sin() * 230.0);
        #[expect(clippy::cast_possible_truncation, reason = "inside the window")]
        let place = [700 + x as i16, 540 + y as i16];
        place
    }

    fn grab(&self) {
        let [x, y] = Self::swing(0);
        self.desktop.point(x, y);
        self.settle();
        self.desktop.button(1, true);
    }

    pub(crate) fn drag(&mut self) -> Vec<[f64; 2]> {
        self.grab();
        let span = self.path(Duration::from_secs(6), Self::swing);
        self.desktop.button(1, false);
        self.settle();
        vec![span]
    }

    pub(crate) fn stutter(&mut self) -> Vec<[f64; 2]> {
        self.grab();
        let spans = (0..12).map(|turn| {
            let span = self.path(Duration::from_millis(400), |step| Self::swing(turn * 50 + step));
            std::thread::sleep(Duration::from_millis(250));
            span
        });
        let spans = spans.collect();
        self.desktop.button(1, false);
        self.settle();
        spans
    }

    pub(crate) fn zoom(&mut self) -> Vec<[f64; 2]> {
        self.desktop.point(700, 540);
        self.settle();
        let start = log::now();
        for click in 0..360 {
            let button = if click / 20 % 2 == 0 { 4 } else { 5 };
            self.desktop.button(button, true);
            self.desktop.button(button, false);
            std::thread::sleep(2 * MOTION);
        }
        let span = [start, log::now()];
        self.settle();
        vec![span]
    }

    pub(crate) fn status(&mut self) -> Vec<[f64; 2]> {
        self.desktop.point(700, 540);
        self.settle();
        vec![self.path(Duration::from_secs(3), Self::swing)]
    }

    pub(crate) fn hover(&mut self) -> Vec<[f64; 2]> {
        self.desktop.point(1800, 60);
        self.settle();
        vec![self.path(Duration::from_secs(4), |step| [1780 + step % 40, 60 + (step * 3) % 900])]
    }

    pub(crate) fn palette(&mut self) -> Vec<[f64; 2]> {
        self.desktop.point(1200, 900);
        self.settle();
        let start = log::now();
        for _ in 0..5 {
            self.desktop.press(u32::from('p'), &[keysym::CONTROL, keysym::SHIFT]);
            std::thread::sleep(Duration::from_millis(300));
            for character in "sample".chars() {
                self.desktop.type_char(character, &[]);
                std::thread::sleep(Duration::from_millis(100));
            }
            self.desktop.press(keysym::ESCAPE, &[]);
            std::thread::sleep(Duration::from_millis(300));
        }
        vec![[start, log::now()]]
    }

    pub(crate) fn tick(&mut self) -> Vec<[f64; 2]> {
        self.desktop.point(1758, 461);
        self.settle();
        let start = log::now();
        for _ in 0..12 {
            self.desktop.button(1, true);
            self.desktop.button(1, false);
            std::thread::sleep(Duration::from_millis(250));
        }
        vec![[start, log::now()]]
    }
}

impl Drop for Hand {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
