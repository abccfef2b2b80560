//! From options to a picture: reading a scene, drawing it on as many threads as were asked for.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::failure::{Failure, print_error};
use super::options::framing::PictureOptions;
use super::options::render::RenderOptions;
use super::{memory, progress};
use crate::figure::{Guard, Record, add_furniture};
use crate::geometry::ViewTransform;
use crate::raster::Framebuffer;
use crate::render::{self, CancelToken, FrameStats, Legend, Repeats, Subject};
use crate::scene::{DialectChoice, Scene};
use crate::viewer::{PictureSpec, Restored, SceneSource};

/// A scene and everything that its picture depends on.
pub(super) struct Picture {
    pub(super) scene: Arc<Scene>,
    spec: PictureSpec,
    view: ViewTransform,
    frame: Framebuffer,
}

impl Picture {
    /// Reads the scene; what the reader skipped is said on stderr, line by line.
    pub(super) fn read(spec: PictureSpec) -> Result<Self, Failure> {
        memory::ask_for(memory::pixels(spec.size))?;
        let scene = read_scene(&spec.scene, spec.dialect)?;
        Ok(Self::of(spec, Arc::new(scene)))
    }

    /// As [`Picture::read`], of a scene that was read as `spec` says.
    pub(super) fn of(mut spec: PictureSpec, scene: Arc<Scene>) -> Self {
        spec.dialect = spec.dialect.anywhere(scene.dialect);
        let [width, height] = spec.size;
        Self {
            view: spec.view.transform(scene.canvas, spec.size),
            frame: Framebuffer::new(width, height),
            scene,
            spec,
        }
    }

    /// Says on stderr what has changed since the picture was made that the scene comes from.
    pub(super) fn tell_changes(&self, restored: Option<&Restored>) {
        if let Some(change) = restored.and_then(|restored| restored.changes(&self.scene.files)) {
            print_error(&change);
        }
    }

    /// Protects the scene and its textures from being written over.
    pub(super) fn protect(&self, guard: &mut Guard) {
        self.spec.scene.protect(&self.scene.files, guard);
    }

    /// The record of the picture, for the file `output`.
    pub(super) fn record(&self, output: &Path) -> Record {
        self.spec.record(&self.scene, output)
    }

    /// Draws the picture, on the pool that this is called in.
    pub(super) fn draw(&mut self) -> FrameStats {
        render::draw(&self.scene, &self.view, &self.spec.render, &mut self.frame)
    }

    /// The same, unless it is stopped: then `None`, and the picture is unfinished.
    pub(super) fn draw_unless(&mut self, stop: &CancelToken) -> Option<FrameStats> {
        render::draw_cancellable(&self.scene, &self.view, &self.spec.render, &mut self.frame, stop)
    }

    /// Draws the picture again and again, and gives the time of each frame that counts; `None` when stopped.
    pub(super) fn time_draws(&mut self, repeats: Repeats, stop: &CancelToken) -> Option<Vec<Duration>> {
        let subject = Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.spec.render,
        };
        render::time_draws(&subject, &mut self.frame, repeats, stop)
    }

    /// As [`Picture::draw`], telling how far it is.
    fn draw_watched(&mut self) {
        let subject = Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.spec.render,
        };
        let all = memory::pixels(self.spec.size);
        let drawn = Mutex::new((&mut self.frame, 0));
        let never = CancelToken::default();
        render::refine(&subject, self.spec.size, [0, 0], &never, |tile, pixels| {
            let mut drawn = drawn.lock().unwrap_or_else(PoisonError::into_inner);
            let (frame, done) = &mut *drawn;
            frame.copy_from(tile, pixels, tile);
            *done += u64::from(tile.width) * u64::from(tile.height);
            progress::share((*done).min(all), all);
        });
    }

    /// Draws the picture as a figure: with its insets, and the legend of what it shows where there is room; else says so on
    /// stderr.
    pub(super) fn draw_figure(&mut self) -> Result<(), Failure> {
        if progress::is_watched() {
            self.draw_watched();
        } else {
            self.draw();
        }
        let legend = self.spec.legend.then(|| self.legend()).flatten();
        let legends = legend.as_slice();
        let subject = Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.spec.render,
        };
        let drawn = add_furniture(&mut self.frame, &self.spec.insets, &subject, legends).map_err(Failure::input)?;
        if drawn < legends.len() {
            let [width, height] = [self.frame.width(), self.frame.height()];
            print_error(&format!(
                "no room for the legend in {width}x{height} pixels; make the picture larger with --size"
            ));
        }
        Ok(())
    }

    /// The legend of what the picture shows.
    pub(super) fn legend(&self) -> Option<Legend> {
        let shown = self.spec.render.visualisation;
        shown.legend_of(&self.scene, shown.clamped(self.frame.pixels()))
    }

    /// What the picture is of.
    pub(super) fn subject(&self) -> Subject<'_> {
        Subject {
            scene: &self.scene,
            view: &self.view,
            settings: &self.spec.render,
        }
    }

    /// What was drawn last, without the rest.
    pub(super) fn into_frame(self) -> Framebuffer {
        self.frame
    }

    /// What was drawn last.
    pub(super) fn frame(&self) -> &Framebuffer {
        &self.frame
    }
}

/// Reads a scene; what the reader skipped is said on stderr, line by line.
pub(super) fn read_scene(source: &SceneSource, dialect: DialectChoice) -> Result<Scene, Failure> {
    let scene = source.read(dialect).map_err(|error| Failure::of_scene(&error))?;
    for line in scene.report.lines_in(&source.address()) {
        print_error(&line);
    }
    if dialect == DialectChoice::Auto {
        tell_reading(source, &scene, "");
    }
    Ok(scene)
}

/// Says on stderr how a file was read that may be meant in the other dialect, and `why`.
pub(super) fn tell_reading(source: &SceneSource, scene: &Scene, why: &str) {
    let note = scene.reading_note(why);
    // The gallery's scenes say what they are.
    if let (SceneSource::File(path), Some(note)) = (source, note) {
        print_error(&format!("{}: {note}", path.display()));
    }
}

/// Runs `work` on a pool of as many threads as the option says, or one per core.
pub(super) fn on_threads<T: Send>(threads: Option<u16>, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.map_or(0, usize::from))
        .build()
        .map_err(|error| no_threads(threads, &error))?;
    Ok(pool.install(work))
}

/// As many threads as the option says, or one per core, for all that a viewer draws. Nothing may have used the pool before, so that
/// it fails only where the system gives no threads.
pub(super) fn set_threads(threads: Option<u16>) -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    pool.build_global().map_err(|error| no_threads(threads, &error))
}

/// The system gives no threads; none `wanted` means as many as it has cores.
fn no_threads(wanted: Option<u16>, error: &rayon::ThreadPoolBuildError) -> Failure {
    let wanted = wanted.map_or("a thread for every core".to_owned(), |count| match count {
        1 => "a thread".to_owned(),
        _ => format!("{count} threads"),
    });
    Failure::other(format!(
        "cannot start {wanted}: {error}; close other programs or draw with --threads 1"
    ))
}

/// The figure that `render` draws of one scene.
pub(super) fn spec_of_render(options: &RenderOptions) -> PictureSpec {
    PictureSpec {
        insets: options.insets.clone(),
        legend: !options.no_legend,
        ..spec(&options.scene, &options.picture)
    }
}

/// The picture that options ask for.
pub(super) fn spec(scene: &Path, options: &PictureOptions) -> PictureSpec {
    PictureSpec {
        scene: SceneSource::from_address(scene),
        size: options.size.0,
        view: options.framing.view,
        render: options.sampling.settings(options.framing.view),
        dialect: options.sampling.reading(),
        legend: true,
        insets: Vec::new(),
    }
}
