//! A viewer on scenes in a folder of its own, for tests that replay commands.

use std::fs;
use std::path::PathBuf;

use rasterscope::raster::Framebuffer;
use rasterscope::render;
use rasterscope::viewer::{Command, Effect, KeyPress, Viewer, ViewerOptions, commands};
use tempfile::TempDir;

/// Two flat triangles.
pub(crate) const TRIANGLES: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100">
  <polygon fill="#1f6feb" points="20,20 180,32 150,90"/>
  <polygon fill="#d1495b" points="10,90 60,10 90,95"/>
</svg>"##;
/// A square turned on its tip.
pub(crate) const SQUARE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
  <rect fill="#00798c" x="25" y="25" width="50" height="50" transform="matrix(0.7 0.7 -0.7 0.7 50 -20)"/>
</svg>"##;

/// Sets a picture setting by its option's name.
pub(crate) fn set(option: &str, value: &str) -> Command {
    Command::set(option, value).unwrap()
}

/// Steps a picture setting.
pub(crate) fn step(option: &str, by: f64) -> Command {
    Command::step(option, by).unwrap()
}

/// A viewer, and the folder with its scenes and screenshots.
pub(crate) struct Session {
    pub(crate) viewer: Viewer,
    pub(crate) folder: TempDir,
}

impl Session {
    /// A window of `window` pixels on these documents, called `1.svg`, `2.svg` ...
    pub(crate) fn open(documents: &[&str], window: [u32; 2]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let write = |(number, document): (usize, &&str)| {
            let path = folder.path().join(format!("{}.svg", number + 1));
            fs::write(&path, document).unwrap();
            path
        };
        let paths: Vec<PathBuf> = documents.iter().enumerate().map(write).collect();
        let options = ViewerOptions {
            paths,
            window,
            screenshot_dir: Some(folder.path().to_owned()),
            ..ViewerOptions::default()
        };
        let mut viewer = Viewer::new(options).unwrap();
        viewer.finish();
        Self { viewer, folder }
    }

    /// Does `command` and waits for the picture.
    pub(crate) fn run(&mut self, command: Command) -> Vec<Effect> {
        let effects = self.viewer.apply(command);
        self.viewer.finish();
        effects
    }

    /// Presses keys by their names and waits for the picture.
    pub(crate) fn keys(&mut self, names: &[&str]) {
        for name in names {
            let press = KeyPress::from_name(name).unwrap();
            let command = commands::for_key(&press).unwrap_or_else(|| panic!("{name} has no command"));
            self.run(command.clone());
        }
    }

    /// The finished frame.
    pub(crate) fn pixels(&self) -> &Framebuffer {
        &self.viewer.frames().frame().unwrap().pixels
    }

    /// Asserts that the frame is what the renderer makes of scene, view and settings of this moment.
    pub(crate) fn assert_frame_is_current(&self) {
        let entry = self.viewer.scene_list().current().unwrap();
        let scene = entry.scene().unwrap();
        let size = self.viewer.both().layout().frame_size();
        let view = entry.camera.view().transform(scene.canvas, size);
        let mut expected = Framebuffer::new(size[0], size[1]);
        render::draw(scene, &view, &self.viewer.settings().render, &mut expected);
        assert!(
            *self.pixels() == expected,
            "the frame shows another state than {:?}",
            entry.camera
        );
    }

    /// The PNG files in the folder.
    pub(crate) fn pictures(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = fs::read_dir(self.folder.path())
            .unwrap()
            .map(|item| item.unwrap().path())
            .filter(|path| path.extension().is_some_and(|ending| ending == "png"))
            .collect();
        // The second of a millisecond ends in `-2`, which in whole names sorts before `.png`.
        files.sort_by_key(|path| path.with_extension(""));
        files
    }
}
