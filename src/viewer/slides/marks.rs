//! What a slide marks in its picture.

use crate::figure::{PinRing, PixelRect, add_legends, tag_unit};
use crate::raster::Framebuffer;
use crate::viewer::inspector::{RING_ROOM, with_ring};
use crate::viewer::state::Viewer;

/// The line of a wipe from left to right.
const LINE: [u32; 3] = [0xff20_2428, 0xffff_ffff, 0xff20_2428];

/// The line of a wipe and the rings around pinned pixels, which pass behind the magnifiers as in the window; what the colours
/// of a difference mean.
pub(super) fn draw_marks(viewer: &Viewer, picture: &mut Framebuffer) {
    let plain = picture.clone();
    if let Some(line) = viewer.both().wipe_line() {
        draw_line(line, picture);
    }
    let unit = tag_unit([picture.width(), picture.height()]);
    for pixel in viewer.pixels().pinned_places() {
        PinRing::draw(picture, &pixel, unit);
    }
    let inspector = viewer.inspector();
    let insets = inspector.inset().into_iter().chain(inspector.other_inset());
    let insets: Vec<PixelRect> = insets.map(|placed| placed.rect).collect();
    for inset in &insets {
        copy_part(&plain, picture, inset);
    }
    if let Some(legend) = viewer.both().difference_legend() {
        let pins = viewer.pixels().pinned_places().into_iter();
        let spared: Vec<PixelRect> = pins.map(|pin| with_ring(&pin, RING_ROOM)).chain(insets).collect();
        add_legends(picture, &[legend], &spared);
    }
}

/// The line of a wipe, at `x` pixels from the left.
fn draw_line(x: f64, picture: &mut Framebuffer) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`as` saturates; the line lies in the picture"
    )]
    let at = x.round() as usize;
    let width = (picture.width() as usize).max(1);
    for row in picture.pixels_mut().chunks_exact_mut(width) {
        for (column, color) in (at.saturating_sub(1)..).zip(LINE) {
            if let Some(pixel) = row.get_mut(column) {
                *pixel = color;
            }
        }
    }
}

/// Copies a part of a picture to the same place in one of the same size.
fn copy_part(from: &Framebuffer, to: &mut Framebuffer, part: &PixelRect) {
    let width = from.width() as usize;
    let part = part.intersection(&PixelRect::of_size([from.width(), from.height()]));
    let [columns, rows] = [part.x..part.right(), part.y..part.bottom()]
        .map(|range| usize::try_from(range.start).unwrap_or(0)..usize::try_from(range.end).unwrap_or(0));
    for row in rows {
        let row = row * width + columns.start..row * width + columns.end;
        to.pixels_mut()[row.clone()].copy_from_slice(&from.pixels()[row]);
    }
}
