//! Notes what is painted on the samples of a single pixel, command by command.

use crate::color::Premultiplied16;
use crate::raster::binning::tile_command::Work;
use crate::raster::coverage::area::row::Area;
use crate::raster::coverage::covered::Covered;
use crate::raster::layers::Compositing;
use crate::raster::sampling::mask::SampleMask;
use crate::raster::shading::once::ShadingPlace;

/// Fragments that are kept at most; beyond that those of the commands painted first are forgotten.
const MOST_FRAGMENTS: usize = 1 << 19;

/// What one command did to a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintedCommand {
    /// The number that the caller of the list gave to the primitive.
    pub source: u32,
    /// Index of the command in its chunk.
    pub(crate) command: usize,
    /// What kind of command it is.
    pub kind: PaintedKind,
    /// How many layers were open when it painted.
    pub layers: usize,
    /// The samples that it painted, in the order of the pattern; empty where they were forgotten, under more than half a
    /// million of later ones.
    pub fragments: Vec<PaintedSample>,
    /// How many samples it painted, also where they were forgotten.
    pub count: usize,
    /// Where it was shaded for all of them, if not at each.
    pub shaded: Option<ShadingPlace>,
    /// Which part of the pixel's area it covered, where areas count: in parts of `2^16`.
    pub area: Option<u32>,
}

impl PaintedCommand {
    /// Which part of the pixel's area it covered, `0.0..=1.0`, where areas count.
    pub fn covered_part(&self) -> Option<f64> {
        Some(f64::from(self.area?) / f64::from(Area::WHOLE.parts()))
    }

    /// Whether it covered all of the samples that it painted.
    pub fn is_whole(&self) -> bool {
        self.area.is_none_or(|area| area == Area::WHOLE.parts())
    }
}

/// Kinds of commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaintedKind {
    /// A primitive.
    Primitive,
    /// The beginning of a layer, which paints nothing.
    BeginLayer,
    /// The end of a layer, which composites the layer's samples with those below.
    EndLayer(Compositing),
}

/// One fragment: what an command did to one sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PaintedSample {
    /// Number of the sample in the pattern.
    pub sample: usize,
    /// The fragment's colour.
    pub color: Premultiplied16,
    /// What the sample held before, and after.
    pub before: Premultiplied16,
    /// See `before`.
    pub after: Premultiplied16,
}

/// Follows the samples of a single-pixel tile.
#[derive(Debug)]
pub(in crate::raster) struct Recorder {
    painted: Vec<PaintedCommand>,
    /// What the samples that the command at work paints on held before it.
    before: Vec<Premultiplied16>,
    /// What it paints there.
    colors: Vec<Option<Premultiplied16>>,
    /// How many fragments each sample got, and which command painted it last.
    depths: Vec<usize>,
    last: Vec<usize>,
    /// How many fragments are kept, and how many commands from the first were forgotten.
    kept: usize,
    forgotten: usize,
}

impl PaintedKind {
    pub(in crate::raster) fn of(work: &Work<'_>) -> Self {
        match work {
            Work::Flat(..) | Work::Shaded(..) => Self::Primitive,
            Work::BeginLayer => Self::BeginLayer,
            Work::EndLayer(compositing) => Self::EndLayer(*compositing),
        }
    }
}

impl Recorder {
    /// For a pixel of so many samples.
    pub(in crate::raster) fn new(samples: usize) -> Self {
        Self {
            painted: Vec::new(),
            before: Vec::new(),
            colors: vec![None; samples],
            depths: vec![0; samples],
            last: vec![0; samples],
            kept: 0,
            forgotten: 0,
        }
    }

    /// A command begins; `now` is what samples of the topmost layer hold.
    pub(in crate::raster) fn next(&mut self, source: u32, command: usize, kind: PaintedKind, now: &[Premultiplied16]) {
        let layers = self.close(now);
        self.painted.push(PaintedCommand {
            source,
            command,
            kind,
            layers,
            fragments: Vec::new(),
            count: 0,
            shaded: None,
            area: None,
        });
    }

    /// The command that begins paints on samples which hold this.
    pub(in crate::raster) fn paint_on(&mut self, before: Vec<Premultiplied16>) {
        self.before = before;
    }

    /// Ends the command at work, after which its layer holds `after`; how many layers are open then.
    fn close(&mut self, after: &[Premultiplied16]) -> usize {
        let number = self.painted.len().saturating_sub(1);
        let Some(command) = self.painted.last_mut() else {
            return 0;
        };
        let before = self.before.iter().zip(after);
        for (sample, (color, (before, after))) in self.colors.iter_mut().zip(before).enumerate() {
            if let Some(color) = color.take() {
                command.fragments.push(PaintedSample {
                    sample,
                    color,
                    before: *before,
                    after: *after,
                });
                self.depths[sample] += 1;
                self.last[sample] = number;
            }
        }
        command.count = command.fragments.len();
        let layers = match command.kind {
            PaintedKind::Primitive => command.layers,
            PaintedKind::BeginLayer => command.layers + 1,
            PaintedKind::EndLayer(_) => command.layers.saturating_sub(1),
        };
        self.kept += command.count;
        self.forget();
        layers
    }

    /// Forgets fragments from the bottom of the stack while there are too many; what painted a sample last stays.
    fn forget(&mut self) {
        while self.kept > MOST_FRAGMENTS {
            let Some(command) = self.painted.get_mut(self.forgotten) else {
                return;
            };
            if !self.last.contains(&self.forgotten) {
                self.kept -= command.fragments.len();
                command.fragments = Vec::new();
            }
            self.forgotten += 1;
        }
    }

    /// The command paints all samples, each with its colour.
    pub(in crate::raster) fn paint_all(&mut self, colors: Vec<Premultiplied16>) {
        self.colors = colors.into_iter().map(Some).collect();
    }

    /// The command paints samples of the pixel; `color` is asked for those counted from the first of them.
    pub(in crate::raster) fn paint(&mut self, covered: Covered, color: impl Fn(usize) -> Premultiplied16) {
        let mask = match covered {
            Covered::Whole(_) => SampleMask::all(self.colors.len()),
            Covered::Part(_, mask) => mask,
        };
        let mut i = 0;
        mask.each(|sample| {
            self.colors[sample] = Some(color(i));
            i += 1;
        });
    }

    /// The command paints a part of the pixel's area.
    pub(in crate::raster) fn paint_area(&mut self, area: Area, color: Premultiplied16) {
        self.paint_all(vec![color]);
        if let Some(command) = self.painted.last_mut() {
            command.area = Some(area.parts());
        }
    }

    /// The command was shaded there for all samples.
    pub(in crate::raster) fn shaded_at(&mut self, place: ShadingPlace) {
        if let Some(command) = self.painted.last_mut() {
            command.shaded = Some(place);
        }
    }

    /// What was painted, now that the samples hold `after`; and how many fragments each sample got.
    pub(in crate::raster) fn finish(mut self, after: &[Premultiplied16]) -> (Vec<PaintedCommand>, Vec<usize>) {
        self.close(after);
        (self.painted, self.depths)
    }
}
