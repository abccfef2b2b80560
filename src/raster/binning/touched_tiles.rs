//! A triangle in each tile of which it touches anything, where areas count.

use crate::geometry::subpixel::GridPoint;
use crate::raster::binning::binner::Binner;
use crate::raster::binning::tile_command::TileCommand;
use crate::raster::coverage::edge_bounds::TileRows;
use crate::raster::span::Span;

impl Binner<'_> {
    /// A triangle in each tile of which it touches anything; `base` says that it is in no layer.
    #[cold]
    #[inline(never)]
    pub(super) fn touched_triangle(
        &self,
        corners: [GridPoint; 3],
        entry: TileCommand,
        base: bool,
        visit: &mut impl FnMut(usize, TileCommand),
    ) {
        let (grid, sides) = (self.context.grid, self.samples);
        let pixels = self.context.samples_of(corners).intersection(self.frame);
        if pixels.is_empty() {
            return;
        }
        let ((left, right), (top, bottom)) = (sides.columns(pixels.x), sides.rows(pixels.y));
        let tile_rows = top.max(self.rows.start)..=bottom.min(self.rows.end - 1);
        if tile_rows.is_empty() {
            return;
        }
        let ys = corners.map(|corner| corner.y);
        let (highest, lowest) = (ys[0].min(ys[1]).min(ys[2]), ys[0].max(ys[1]).max(ys[2]));
        let edges = TileRows::new(corners);
        for row in tile_rows {
            let in_tile = sides.painted(row, sides.height).intersection(self.frame.y);
            let [first, last] = [in_tile.start, in_tile.end].map(|row| row << grid.bits());
            let bounds = edges.between(first.max(highest), last.min(lowest));
            let touched = self.touched(bounds.touched, left, right);
            let covered = if highest <= first && last <= lowest {
                self.wholly_covered(bounds.covered)
            } else {
                Span::EMPTY
            };
            for (column, entry) in entry.along_row([touched, covered], base) {
                visit(self.tile(column, row), entry);
            }
        }
    }

    /// The tile columns that lie wholly between the two coordinates.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "clamped to the tiles of a frame; truncation rounds down there"
    )]
    fn wholly_covered(&self, [first, last]: [f64; 2]) -> Span {
        let bits = self.context.grid.bits();
        let units = |pixels: i32| f64::from(pixels << bits);
        let (width, overlap) = (units(self.samples.width.cast_signed()), units(self.samples.overlap));
        let columns = self.context.tiles.columns.cast_signed();
        let within = |tiles: f64| tiles.clamp(0.0, f64::from(columns)) as i32;
        // The frame may cut the last tile short.
        let end = if units(self.frame.x.end) <= last {
            columns
        } else {
            within((last - overlap) / width)
        };
        Span {
            start: within((first / width).ceil()),
            end,
        }
    }
}
