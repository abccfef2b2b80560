//! What the drawing thread does: whole frames, previews, and final tiles that come as they are painted.

use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::ThreadPool;

use crate::raster::{Framebuffer, PixelCoverage, Region, ResolveFilter, SampleRate};
use crate::render::{
    CancelToken, FrameStats, RenderSettings, Subject, draw_cancellable, draw_onto, draw_regions, refine,
};
use crate::viewer::frames::frame::{ExactCells, Frame, Picture, Preview, PreviewQuality};
use crate::viewer::frames::preview::{coarse_view, magnify, shift, view_of_part};
use crate::viewer::jobs::pool::guarded;

/// Time between two messages with tiles: the window shows about thirty stages of a refinement a second.
const TICK: Duration = Duration::from_millis(32);

/// A frame to be drawn.
#[derive(Debug)]
pub(in crate::viewer) struct Job {
    pub(in crate::viewer) picture: Picture,
    pub(in crate::viewer) plan: Plan,
    pub(in crate::viewer) cancel: Arc<CancelToken>,
    /// Pixels to draw into.
    pub(in crate::viewer) spare: Option<Framebuffer>,
    /// Final tiles come nearest to this pixel first.
    pub(in crate::viewer) from: [u32; 2],
    /// What must be final in a preview, too.
    pub(in crate::viewer) focus: Option<Region>,
}

/// How to come to a picture.
#[derive(Debug)]
pub(in crate::viewer) enum Plan {
    /// All of it at once.
    Whole,
    /// A step of the ladder.
    Coarse(PreviewQuality),
    /// A step of the ladder, then final tiles; a picture that is quick to draw comes at once.
    CoarseThenFine(PreviewQuality),
    /// This frame, moved by a number of pixels.
    Moved(Arc<Frame>, [i64; 2]),
    /// Final tiles over what is on the screen.
    Fine,
}

/// What the thread has to say.
#[derive(Debug)]
pub(in crate::viewer) enum Drawn {
    /// A frame in place of the one before. There is more to come unless it `ended`.
    Frame { frame: Box<Frame>, ended: bool },
    /// Final tiles of the picture; with the last come the times of all.
    Tiles {
        tiles: Vec<TilePixels>,
        ended: Option<FrameStats>,
    },
    /// It was given up.
    GivenUp,
    /// The renderer failed, which is a defect.
    Failed,
}

/// A painted tile.
#[derive(Debug)]
pub(in crate::viewer) struct TilePixels {
    pub(in crate::viewer) region: Region,
    pub(in crate::viewer) pixels: Vec<u32>,
}

/// Tiles on their way to the window.
struct Outbox<'a, F: Fn(Drawn)> {
    /// A preview that was not shown yet.
    preview: Option<Box<Frame>>,
    tiles: Vec<TilePixels>,
    last_post: Instant,
    post: &'a F,
}

impl Job {
    /// Draws, and hands every stage to `post`; the last is one that ends the job.
    pub(in crate::viewer) fn draw(self, post: &(impl Fn(Drawn) + Sync + Send)) {
        let ended = guarded(|| self.work(post)).unwrap_or(Some(Drawn::Failed));
        post(ended.unwrap_or(Drawn::GivenUp));
    }

    /// Draws a whole frame, or a preview at rate 1, in `pool` while the caller waits, resolved into `surface`, which has as
    /// many pixels. One that takes longer than `limit` is given up half-way.
    pub(in crate::viewer) fn draw_onto(mut self, surface: &mut [u32], pool: &ThreadPool, limit: Duration) -> Drawn {
        let mut pixels = self.pixels();
        let quality = match self.plan {
            Plan::Coarse(quality) => Some(quality),
            _ => None,
        };
        let settings = quality.map_or(self.picture.settings, |_| self.at_rate_one());
        let subject = Subject {
            settings: &settings,
            ..self.picture.subject()
        };
        let mut stats = None;
        pool.in_place_scope(|scope| {
            let (done, ended) = channel();
            let (pixels, stats, cancel) = (&mut pixels, &mut stats, &self.cancel);
            scope.spawn(move |_| {
                *stats = guarded(|| draw_onto(&subject, surface, pixels, cancel));
                // Nobody waits any more for what was given up.
                let _ = done.send(());
            });
            if ended.recv_timeout(limit).is_err() {
                self.cancel.cancel();
            }
        });
        let preview = quality.map(|quality| Preview {
            quality,
            exact: ExactCells::new(self.picture.size),
        });
        match stats {
            Some(Some(stats)) => self.frame(pixels, stats, preview, true),
            Some(None) => Drawn::GivenUp,
            None => Drawn::Failed,
        }
    }

    fn work(mut self, post: &(impl Fn(Drawn) + Sync + Send)) -> Option<Drawn> {
        let start = Instant::now();
        let plan = std::mem::replace(&mut self.plan, Plan::Fine);
        match plan {
            Plan::Whole => {
                let mut pixels = self.pixels();
                let Picture {
                    scene, view, settings, ..
                } = &self.picture;
                let stats = draw_cancellable(scene, view, settings, &mut pixels, &self.cancel)?;
                Some(self.frame(pixels, stats, None, true))
            }
            Plan::Coarse(quality) => self.coarse(quality, true),
            Plan::Moved(frame, by) => self.moved(&frame, by),
            Plan::CoarseThenFine(quality) => match self.coarse(quality, false)? {
                Drawn::Frame { frame, .. } if start.elapsed() < TICK => self.fine(post, Some(frame), start),
                preview => {
                    post(preview);
                    self.fine(post, None, Instant::now())
                }
            },
            Plan::Fine => self.fine(post, None, start),
        }
    }

    /// A frame's memory.
    fn pixels(&mut self) -> Framebuffer {
        let [width, height] = self.picture.size;
        let fits = |pixels: &Framebuffer| [pixels.width(), pixels.height()] == [width, height];
        let spare = self.spare.take().filter(fits);
        spare.unwrap_or_else(|| Framebuffer::new(width, height))
    }

    fn frame(&self, pixels: Framebuffer, stats: FrameStats, preview: Option<Preview>, ended: bool) -> Drawn {
        let frame = Box::new(Frame {
            pixels,
            picture: self.picture.clone(),
            stats,
            preview,
        });
        Drawn::Frame { frame, ended }
    }

    /// What previews are drawn with: one sample, which is its pixel.
    fn at_rate_one(&self) -> RenderSettings {
        RenderSettings {
            sample_rate: SampleRate::ONE,
            coverage: PixelCoverage::Sampled,
            resolve_filter: ResolveFilter::Box,
            filter_radius: None,
            ..self.picture.settings
        }
    }

    /// A preview on a step of the ladder.
    fn coarse(&mut self, quality: PreviewQuality, ended: bool) -> Option<Drawn> {
        let settings = self.at_rate_one();
        let mut pixels = self.pixels();
        let Picture { scene, view, .. } = &self.picture;
        let stats = match quality {
            PreviewQuality::Coarse(side) => {
                let [width, height] = self.picture.size.map(|length| length.div_ceil(side));
                let mut small = Framebuffer::new(width, height);
                let view = coarse_view(view, side);
                let stats = draw_cancellable(scene, &view, &settings, &mut small, &self.cancel)?;
                magnify(&small, side, &mut pixels);
                stats
            }
            _ => draw_cancellable(scene, view, &settings, &mut pixels, &self.cancel)?,
        };
        let exact = self.sharpen(&mut pixels)?;
        Some(self.frame(pixels, stats, Some(Preview { quality, exact }), ended))
    }

    /// A preview from a frame that lies elsewhere.
    fn moved(&mut self, frame: &Frame, by: [i64; 2]) -> Option<Drawn> {
        let mut pixels = self.pixels();
        let mut stats = FrameStats::default();
        for strip in shift(&frame.pixels, by, &mut pixels) {
            add(&mut stats, &self.strip(strip, &mut pixels)?);
        }
        let exact = self.sharpen(&mut pixels)?;
        let quality = PreviewQuality::Moved;
        Some(self.frame(pixels, stats, Some(Preview { quality, exact }), true))
    }

    /// Draws a strip as a frame of its own: the tiles of the whole frame that it touches have many times its pixels. Samples
    /// that depend on their place in the frame come elsewhere, so it is not final.
    fn strip(&self, strip: Region, pixels: &mut Framebuffer) -> Option<FrameStats> {
        let Picture {
            scene, view, settings, ..
        } = &self.picture;
        let mut part = Framebuffer::new(strip.width, strip.height);
        let view = view_of_part(view, [strip.x, strip.y]);
        let stats = draw_cancellable(scene, &view, settings, &mut part, &self.cancel)?;
        pixels.copy_from(strip, part.pixels(), strip);
        Some(stats)
    }

    /// Draws what must be final in a preview, too.
    fn sharpen(&self, pixels: &mut Framebuffer) -> Option<ExactCells> {
        let mut exact = ExactCells::new(self.picture.size);
        if let Some(focus) = self.focus {
            draw_regions(&self.picture.subject(), pixels, &[focus], &self.cancel)?;
            exact.mark(focus);
        }
        Some(exact)
    }

    /// Final tiles over what is on the screen, or over a preview that is shown with the first of them.
    fn fine<F: Fn(Drawn) + Sync + Send>(&self, post: &F, preview: Option<Box<Frame>>, since: Instant) -> Option<Drawn> {
        let outbox = Mutex::new(Outbox {
            preview,
            tiles: Vec::new(),
            last_post: since,
            post,
        });
        let publish = |region: Region, pixels: &[u32]| {
            let tile = TilePixels {
                region,
                pixels: pixels.to_vec(),
            };
            outbox.lock().unwrap_or_else(PoisonError::into_inner).add(tile);
        };
        let subject: Subject<'_> = self.picture.subject();
        let stats = refine(&subject, self.picture.size, self.from, &self.cancel, publish)?;
        let Outbox { preview, tiles, .. } = outbox.into_inner().unwrap_or_else(PoisonError::into_inner);
        match preview {
            // Nothing was shown yet: the picture is quick to draw and comes at once.
            Some(mut frame) => {
                for tile in &tiles {
                    tile.put(&mut frame.pixels);
                }
                (frame.preview, frame.stats) = (None, stats);
                Some(Drawn::Frame { frame, ended: true })
            }
            None => Some(Drawn::Tiles {
                tiles,
                ended: Some(stats),
            }),
        }
    }
}

impl<F: Fn(Drawn)> Outbox<'_, F> {
    /// Keeps a tile until it is time to show what came.
    pub(in crate::viewer) fn add(&mut self, tile: TilePixels) {
        self.tiles.push(tile);
        if self.last_post.elapsed() < TICK {
            return;
        }
        self.last_post = Instant::now();
        if let Some(frame) = self.preview.take() {
            (self.post)(Drawn::Frame { frame, ended: false });
        }
        let tiles = std::mem::take(&mut self.tiles);
        (self.post)(Drawn::Tiles { tiles, ended: None });
    }
}

impl TilePixels {
    /// Copies it to its place.
    pub(in crate::viewer) fn put(&self, frame: &mut Framebuffer) {
        frame.copy_from(self.region, &self.pixels, self.region);
    }
}

/// Adds what a part of the frame took.
fn add(all: &mut FrameStats, part: &FrameStats) {
    all.transform += part.transform;
    all.bin += part.bin;
    all.raster += part.raster;
    all.resolve += part.resolve;
    all.triangles += part.triangles;
    all.counters.blocks_whole += part.counters.blocks_whole;
    all.counters.blocks_split += part.counters.blocks_split;
    all.counters.samples_shaded += part.counters.samples_shaded;
}
