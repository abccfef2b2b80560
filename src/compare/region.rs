//! Where two pictures differ most over a region, as a figure would magnify it.

use super::Pair;

impl Pair<'_> {
    /// The middle of the square of `side` pixels whose pixels differ most in sum over their channels, the first in reading
    /// order of several; smaller pictures are one square. `None` for equal pictures.
    pub fn busiest(self, side: u32) -> Option<[u32; 2]> {
        let [width, height] = self.size();
        let square = [side.clamp(1, width.max(1)), side.clamp(1, height.max(1))];
        let sums = self.sums(width as usize);
        let stride = width as usize + 1;
        let mut best: Option<(u64, [u32; 2])> = None;
        for y in 0..=height.checked_sub(square[1])? {
            for x in 0..=width.checked_sub(square[0])? {
                let at = |x: u32, y: u32| sums[y as usize * stride + x as usize];
                let (right, below) = (x + square[0], y + square[1]);
                let sum = at(right, below) + at(x, y) - at(right, y) - at(x, below);
                if sum > best.map_or(0, |(sum, _)| sum) {
                    best = Some((sum, [x + square[0] / 2, y + square[1] / 2]));
                }
            }
        }
        best.map(|(_, at)| at)
    }

    /// Sums of all differences above and to the left of each corner of a pixel (Crow, "Summed-area tables for texture
    /// mapping", 1984).
    fn sums(self, width: usize) -> Vec<u64> {
        let stride = width + 1;
        let mut sums = vec![0; stride];
        let rows = self.a.pixels().chunks_exact(width.max(1));
        for (a, b) in rows.zip(self.b.pixels().chunks_exact(width.max(1))) {
            let above = sums.len() - stride;
            let mut row = 0;
            sums.push(0);
            for (x, (a, b)) in a.iter().zip(b).enumerate() {
                let channels = a.to_be_bytes().into_iter().zip(b.to_be_bytes());
                row += channels.map(|(a, b)| u64::from(a.abs_diff(b))).sum::<u64>();
                sums.push(sums[above + x + 1] + row);
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Framebuffer;

    #[test]
    fn busiest_region_is_that_of_a_brute_force_search() {
        arbtest::arbtest(|u| {
            let (width, height) = (u.int_in_range(1..=20)?, u.int_in_range(1..=20)?);
            let mut pictures = [Framebuffer::new(width, height), Framebuffer::new(width, height)];
            for picture in &mut pictures {
                for pixel in picture.pixels_mut() {
                    *pixel = if u.ratio(1, 4)? { u.arbitrary()? } else { 0 };
                }
            }
            let side: u32 = u.int_in_range(1..=8)?;
            let [a, b] = &pictures;
            let pair = Pair::new(a, b).expect("one size");
            let (w, h) = (side.min(width), side.min(height));
            let sum = |x: u32, y: u32| -> u64 {
                let all = (y..y + h).flat_map(|y| (x..x + w).map(move |x| (y * width + x) as usize));
                let levels = all.flat_map(|i| a.pixels()[i].to_be_bytes().into_iter().zip(b.pixels()[i].to_be_bytes()));
                levels.map(|(a, b)| u64::from(a.abs_diff(b))).sum()
            };
            let corners = (0..=height - h).flat_map(|y| (0..=width - w).map(move |x| (x, y)));
            let most = corners.map(|(x, y)| sum(x, y)).max().unwrap_or(0);
            match pair.busiest(side) {
                None => assert_eq!(most, 0, "equal pictures"),
                Some([x, y]) => assert_eq!(sum(x - w / 2, y - h / 2), most, "at {x}, {y}"),
            }
            Ok(())
        })
        .budget_ms(200);
    }
}
