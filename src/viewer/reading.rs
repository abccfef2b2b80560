//! Reading scenes and drawing their thumbnails, in threads beside the user interface.

use std::io;
use std::sync::Arc;

use glam::DVec2;

use super::background::{AtEnd, Crew, guarded};
use super::mailbox::Mailbox;
use super::{SceneEntry, SceneSource, SceneState, Viewer};
use crate::geometry::{View, ViewTransform};
use crate::raster::{Framebuffer, SampleRate};
use crate::render::{RenderSettings, draw};
use crate::scene::{DialectChoice, Scene};
use crate::texture::{LevelSampling, PixelSampling};

/// Threads that read: a second one, so that a slow scene does not hold up the next.
const READERS: usize = 2;
/// Scenes kept in memory besides the current one.
const KEPT: usize = 3;
/// Longer side of a thumbnail, in pixels.
const THUMBNAIL_SIDE: f64 = 160.0;

/// The threads that read.
#[derive(Debug)]
pub(super) struct Readers {
    scenes: Crew<Order>,
    thumbnails: Crew<Order>,
    pending_thumbnails: usize,
}

/// Whose dialect a scene is read in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    A,
    B,
}

impl Side {
    /// Who waits for a scene to be read in a dialect. A and B may have changed places since that began.
    fn reading(entry: &SceneEntry, dialect: DialectChoice) -> Option<Self> {
        let waits =
            |state: &SceneState| matches!(state, SceneState::Reading { dialect: wanted, .. } if *wanted == dialect);
        if waits(&entry.state) {
            return Some(Self::A);
        }
        waits(&entry.other_state).then_some(Self::B)
    }

    fn state(self, entry: &mut SceneEntry) -> &mut SceneState {
        match self {
            Self::A => &mut entry.state,
            Self::B => &mut entry.other_state,
        }
    }
}

/// Which scene, and for which list.
#[derive(Clone, Debug)]
struct Order {
    generation: u64,
    index: usize,
    document: u64,
    source: SceneSource,
    dialect: DialectChoice,
    /// Set where it was read already.
    scene: Option<Arc<Scene>>,
}

/// A scene that was read, or not.
#[derive(Debug)]
pub(super) struct ReadScene {
    generation: u64,
    index: usize,
    document: u64,
    dialect: DialectChoice,
    result: Result<Arc<Scene>, String>,
}

/// A thumbnail that was drawn, or not.
#[derive(Debug)]
pub(super) struct Thumbnail {
    generation: u64,
    index: usize,
    picture: Option<Arc<Framebuffer>>,
}

impl Readers {
    pub(super) fn start(scenes: Mailbox<ReadScene>, thumbnails: Mailbox<Thumbnail>) -> io::Result<Self> {
        let read = move |order: Order| {
            let Order {
                generation,
                index,
                document,
                dialect,
                ..
            } = order;
            let result = order.read();
            scenes.post(ReadScene {
                generation,
                index,
                document,
                dialect,
                result,
            });
        };
        let draw = move |order: Order| {
            let (generation, index) = (order.generation, order.index);
            let picture = order.thumbnail();
            thumbnails.post(Thumbnail {
                generation,
                index,
                picture,
            });
        };
        Ok(Self {
            scenes: Crew::start("read", READERS, AtEnd::Detach, read)?,
            thumbnails: Crew::start("thumbnails", 1, AtEnd::Detach, draw)?,
            pending_thumbnails: 0,
        })
    }

    /// Forgets the thumbnails that wait: they belong to an old list.
    pub(super) fn drop_thumbnails(&mut self) {
        let dropped = self.thumbnails.take_back();
        self.pending_thumbnails = self.pending_thumbnails.saturating_sub(dropped.len());
    }

    pub(super) fn has_thumbnails_pending(&self) -> bool {
        self.pending_thumbnails > 0
    }
}

impl Order {
    fn read(&self) -> Result<Arc<Scene>, String> {
        let read = guarded(|| self.source.read(self.dialect));
        match read {
            Some(Ok(scene)) => Ok(Arc::new(scene)),
            Some(Err(error)) => Err(error.to_string()),
            None => Err(format!(
                "{}: reading this document failed inside the program; please report it with the file",
                self.source.address()
            )),
        }
    }

    /// The scene in small. It uses one thread, to leave the others to the frames of the window.
    fn thumbnail(self) -> Option<Arc<Framebuffer>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
        let picture = pool.install(|| {
            let scene = match &self.scene {
                Some(scene) => Arc::clone(scene),
                None => self.read().ok()?,
            };
            guarded(|| draw_thumbnail(&scene))
        })?;
        Some(Arc::new(picture))
    }
}

/// The whole canvas, as large as a thumbnail may be.
fn draw_thumbnail(scene: &Scene) -> Framebuffer {
    let size = scene.canvas * (THUMBNAIL_SIDE / scene.canvas.max_element());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and the longer side"
    )]
    let side = |length: f64| length.round().clamp(1.0, THUMBNAIL_SIDE) as u32;
    let mut frame = Framebuffer::new(side(size.x), side(size.y));
    let view: ViewTransform = View::Canvas.transform(scene.canvas, [frame.width(), frame.height()]);
    let settings = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap_or_default(),
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        outline: false,
        ..RenderSettings::default()
    };
    draw(scene, &view, &settings, &mut frame);
    frame
}

impl Viewer {
    /// Sees to it that the current scene is read in the dialect that is set, and in B's.
    pub(super) fn want_scene(&mut self) {
        let Some(entry) = self.scenes.get(self.current) else {
            return;
        };
        match entry.state.dialect() {
            None => self.read_current(),
            Some(dialect) if dialect != self.reading_of(self.current, self.settings.dialect) => self.read_for(Side::A),
            Some(_) => {}
        }
        self.let_go_of_old_scenes();
        self.want_other_scene();
    }

    /// The same for B where it has a dialect of its own; else B shares A's scene.
    fn want_other_scene(&mut self) {
        let own = self.own_dialect_of_b();
        let wanted = own.map(|dialect| self.reading_of(self.current, dialect));
        let Some(entry) = self.scenes.get_mut(self.current) else {
            return;
        };
        match wanted {
            None => entry.other_state = SceneState::Unread,
            Some(dialect) if entry.other_state.dialect() != Some(dialect) => self.read_for(Side::B),
            Some(_) => {}
        }
    }

    /// Reads the current scene again.
    pub(super) fn read_current(&mut self) {
        self.documents += 1;
        let documents = self.documents;
        let Some(entry) = self.scenes.get_mut(self.current) else {
            return;
        };
        entry.document = documents;
        self.read_for(Side::A);
        if self.own_dialect_of_b().is_some() {
            self.read_for(Side::B);
        }
    }

    /// Reads the current scene for one side, in its dialect.
    fn read_for(&mut self, side: Side) {
        let (generation, index) = (self.generation, self.current);
        let dialect = match side {
            Side::A => self.settings.dialect,
            Side::B => self.own_dialect_of_b().unwrap_or(self.settings.dialect),
        };
        let dialect = self.reading_of(index, dialect);
        let Some(entry) = self.scenes.get_mut(index) else {
            return;
        };
        let state = side.state(entry);
        let before = state.scene().cloned();
        *state = SceneState::Reading { dialect, before };
        let order = Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            scene: None,
        };
        if side == Side::B {
            self.readers.scenes.push(order);
            return;
        }
        for order in self.readers.scenes.replace(order) {
            let forgotten = self
                .scenes
                .get_mut(order.index)
                .filter(|_| order.generation == generation);
            let again = order.index == index && order.dialect == dialect;
            if let Some((side, entry)) = forgotten
                .filter(|_| !again)
                .and_then(|entry| Some((Side::reading(entry, order.dialect)?, entry)))
            {
                *side.state(entry) = SceneState::Unread;
            }
        }
    }

    /// Takes in a scene that was read. One that is no longer shown is kept, if it was read as the settings say.
    pub(super) fn scene_read(&mut self, read: ReadScene) {
        let is_current = read.index == self.current;
        let Some(entry) = self.scenes.get_mut(read.index) else {
            return;
        };
        let dialect = read.dialect;
        let is_newest = read.generation == self.generation && read.document == entry.document;
        let Some(side) = Side::reading(entry, dialect).filter(|_| is_newest) else {
            return;
        };
        // A scene that was read again may look different in small too, and so may a file that was let go meanwhile. The old
        // thumbnail stays until the new one is there.
        let was_read = entry.scene().is_some();
        let is_stale = side == Side::A && (was_read || matches!(entry.source, SceneSource::File(_)));
        let draws_again = is_stale && entry.thumbnail.is_some() && read.result.is_ok();
        if side == Side::A {
            entry.thumbnail_asked &= !was_read && !draws_again;
            if read.result.is_err() {
                entry.thumbnail = None;
            }
        }
        *side.state(entry) = match read.result {
            Ok(scene) => {
                self.messages.forget_problems_of(&entry.source.address());
                SceneState::Ready { scene, dialect }
            }
            Err(message) => {
                if is_current {
                    self.messages.error(message.clone());
                }
                SceneState::Failed { message, dialect }
            }
        };
        if draws_again {
            self.request_thumbnail(read.index);
        }
    }

    /// Keeps the current scene and the ones shown last; the others are read again when they are asked for.
    fn let_go_of_old_scenes(&mut self) {
        let current = self.current;
        if self.recent.last() == Some(&current) {
            return;
        }
        for index in &self.recent {
            if let Some(entry) = self.scenes.get_mut(*index) {
                entry.other_state = SceneState::Unread;
            }
        }
        self.recent.retain(|index| *index != current);
        self.recent.push(current);
        while self.recent.len() > KEPT + 1 {
            let oldest = self.recent.remove(0);
            if let Some(entry) = self.scenes.get_mut(oldest) {
                entry.state = SceneState::Unread;
            }
        }
    }

    /// Asks for the thumbnail of a scene in the list: it is read and drawn when nothing else is to be done, and stands
    /// in [`super::SceneEntry::thumbnail`] then. To be called for the scenes that a panel shows.
    pub fn request_thumbnail(&mut self, index: usize) {
        let generation = self.generation;
        let dialect = self.reading_of(index, self.settings.dialect);
        let Some(entry) = self.scenes.get_mut(index).filter(|entry| !entry.thumbnail_asked) else {
            return;
        };
        entry.thumbnail_asked = true;
        self.readers.pending_thumbnails += 1;
        self.readers.thumbnails.push(Order {
            generation,
            index,
            document: entry.document,
            source: entry.source.clone(),
            dialect,
            scene: entry.scene().cloned(),
        });
    }

    pub(super) fn thumbnail_drawn(&mut self, thumbnail: Thumbnail) {
        self.readers.pending_thumbnails = self.readers.pending_thumbnails.saturating_sub(1);
        let in_list = thumbnail.generation == self.generation;
        if let Some(entry) = self.scenes.get_mut(thumbnail.index).filter(|_| in_list) {
            entry.thumbnail = thumbnail.picture;
        }
    }

    /// The point in the middle of the window, in frame pixels.
    pub(super) fn middle(&self) -> DVec2 {
        DVec2::from(self.frame_size().map(f64::from)) / 2.0
    }
}
