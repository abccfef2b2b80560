//! Pictures made smaller for previews and thumbnails.

use crate::raster::Framebuffer;

/// The picture over white, shrunk to fit `room` with its aspect kept, never enlarged; each pixel is the mean of those that it
/// covers, in stored values.
pub fn shrunk(source: &Framebuffer, room: [u32; 2]) -> Framebuffer {
    let [width, height] = [source.width().max(1), source.height().max(1)];
    let (w, h) = (u64::from(width), u64::from(height));
    // The side that is tighter decides.
    let [rw, rh] = room.map(u64::from);
    let (to_w, to_h) = if w * rh > h * rw {
        (rw, (h * rw / w).max(1))
    } else {
        ((w * rh / h).max(1), rh)
    };
    let [to_w, to_h] = [to_w.min(w), to_h.min(h)].map(|side| u32::try_from(side).unwrap_or(1));
    let mut small = Framebuffer::new(to_w, to_h);
    if source.pixels().is_empty() || small.pixels().is_empty() {
        return small;
    }
    let columns: Vec<[usize; 2]> = (0..to_w).map(|x| covered(x, to_w, width)).collect();
    let targets = small.pixels_mut().chunks_exact_mut(to_w as usize);
    for (y, target) in (0..to_h).zip(targets) {
        let [top, bottom] = covered(y, to_h, height);
        let lines = &source.pixels()[top * width as usize..bottom * width as usize];
        for (pixel, [left, right]) in target.iter_mut().zip(&columns) {
            let rows = lines.chunks_exact(width as usize).map(|line| &line[*left..*right]);
            *pixel = mean(rows.flatten());
        }
    }
    small
}

/// Which of `from` pixels the pixel `at` of `to` covers: from the first to before the second.
fn covered(at: u32, to: u32, from: u32) -> [usize; 2] {
    let edge = |at: u32| u64::from(at) * u64::from(from) / u64::from(to.max(1));
    let first = edge(at);
    [first, edge(at + 1).max(first + 1)].map(|edge| usize::try_from(edge).unwrap_or(0))
}

/// The mean over white, rounded to nearest.
fn mean<'a>(pixels: impl Iterator<Item = &'a u32>) -> u32 {
    let (mut sum, mut count) = ([0_u64; 3], 0_u64);
    for pixel in pixels {
        let [a, r, g, b] = pixel.to_be_bytes().map(u32::from);
        for (sum, channel) in sum.iter_mut().zip([r, g, b]) {
            *sum += u64::from((channel * a + 255 * (255 - a)) / 255);
        }
        count += 1;
    }
    let [r, g, b] = sum.map(|sum| u8::try_from((sum + count / 2) / count.max(1)).unwrap_or(255));
    u32::from_be_bytes([255, r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shrinking_keeps_shape_and_mean() {
        let mut picture = Framebuffer::new(400, 100);
        for (i, pixel) in picture.pixels_mut().iter_mut().enumerate() {
            *pixel = if i % 2 == 0 { 0xff00_0000 } else { 0xffff_ffff };
        }
        let small = shrunk(&picture, [100, 100]);
        assert_eq!([small.width(), small.height()], [100, 25], "as wide as there is room");
        assert!(
            small.pixels().iter().all(|pixel| *pixel == 0xff80_8080),
            "the mean of black and white"
        );
        assert_eq!(shrunk(&picture, [4000, 5000]), picture, "never made larger");
        assert_eq!(shrunk(&picture, [1, 1]).pixels().len(), 1, "not less than a pixel");
    }

    #[test]
    fn shrinking_lies_over_white() {
        let mut picture = Framebuffer::new(2, 1);
        picture.pixels_mut().copy_from_slice(&[0x0000_0000, 0xff00_00ff]);
        assert_eq!(
            shrunk(&picture, [1, 1]).pixels(),
            [0xff80_80ff],
            "half white, half blue"
        );
    }
}
