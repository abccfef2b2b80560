//! Where two pictures differ most over a region, as a figure would magnify it.

use super::Pair;

/// Side of the square over which differences are averaged first, in pixels.
const EYE: usize = 4;

impl Pair<'_> {
    /// The middle of the square of `side` pixels where the pictures differ most, the first in reading order of several; smaller
    /// pictures are one square. `None` where nothing differs.
    ///
    /// What counts is the sum of squared differences, times the same of differences that were averaged over 4 x 4 pixels, as
    /// an eye from afar does it: much differs there, and something is lost, such as a thin tip between samples. Where an edge
    /// has steps, as much is darker as is lighter.
    pub fn busiest(self, side: u32) -> Option<[u32; 2]> {
        let [width, height] = self.size();
        let square = [side.clamp(1, width.max(1)), side.clamp(1, height.max(1))];
        let differences = self.differences();
        let near = sums(&differences, width as usize);
        let afar = sums(&seen_from_afar(&differences, width as usize), width as usize);
        let stride = width as usize + 1;
        let mut best: Option<(u128, [u32; 2])> = None;
        for y in 0..=height.checked_sub(square[1])? {
            for x in 0..=width.checked_sub(square[0])? {
                let (right, below) = (x + square[0], y + square[1]);
                let sum = |sums: &[u64]| {
                    let at = |x: u32, y: u32| sums[y as usize * stride + x as usize];
                    u128::from(at(right, below) + at(x, y) - at(right, y) - at(x, below))
                };
                // Differences may cancel each other out everywhere.
                let score = sum(&near) * (sum(&afar) + 1);
                if score > best.map_or(0, |(score, _)| score) {
                    best = Some((score, [x + square[0] / 2, y + square[1] / 2]));
                }
            }
        }
        best.map(|(_, at)| at)
    }

    /// B - A, channel by channel.
    fn differences(self) -> Vec<[i32; 4]> {
        let pairs = self.a.pixels().iter().zip(self.b.pixels());
        let difference = |(a, b): (&u32, &u32)| {
            let (a, b) = (a.to_be_bytes(), b.to_be_bytes());
            [0, 1, 2, 3].map(|i| i32::from(b[i]) - i32::from(a[i]))
        };
        pairs.map(difference).collect()
    }
}

/// Sums of squares above and to the left of each corner of a pixel (Crow, "Summed-area tables for texture mapping", 1984).
fn sums(differences: &[[i32; 4]], width: usize) -> Vec<u64> {
    let stride = width + 1;
    let mut sums = vec![0; stride];
    for line in differences.chunks_exact(width.max(1)) {
        let above = sums.len() - stride;
        let mut row = 0;
        sums.push(0);
        for (x, channels) in line.iter().enumerate() {
            row += channels
                .iter()
                .map(|sum| u64::from(sum.unsigned_abs()).pow(2))
                .sum::<u64>();
            sums.push(sums[above + x + 1] + row);
        }
    }
    sums
}

/// For each pixel the sums of differences over the square around it, channel by channel; what lies outside counts nothing.
fn seen_from_afar(differences: &[[i32; 4]], width: usize) -> Vec<[i32; 4]> {
    let lines = differences.chunks_exact(width.max(1));
    let across: Vec<[i32; 4]> = lines
        .flat_map(|line| (0..width).map(|x| around(x, line.len(), |x| line[x])))
        .collect();
    let height = across.len() / width.max(1);
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    all.map(|(x, y)| around(y, height, |y| across[y * width + x])).collect()
}

/// The sum of values around the place `at`, of `count` places.
fn around(at: usize, count: usize, value: impl Fn(usize) -> [i32; 4]) -> [i32; 4] {
    let places = at.saturating_sub(EYE / 2)..(at + EYE / 2).min(count);
    places
        .map(value)
        .fold([0; 4], |sum, value| [0, 1, 2, 3].map(|i| sum[i] + value[i]))
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
            let square = |x: u32, y: u32, channel: usize| -> u64 {
                let (xs, ys) = (
                    x.saturating_sub(2)..(x + 2).min(width),
                    y.saturating_sub(2)..(y + 2).min(height),
                );
                let all = ys.flat_map(|y| xs.clone().map(move |x| (y * width + x) as usize));
                let level = |picture: &Framebuffer, i: usize| i64::from(picture.pixels()[i].to_be_bytes()[channel]);
                let sum: i64 = all.map(|i| level(b, i) - level(a, i)).sum();
                sum.unsigned_abs().pow(2)
            };
            let sum = |x: u32, y: u32| -> u128 {
                let all = || (y..y + h).flat_map(|y| (x..x + w).map(move |x| (x, y)));
                let all = || all().flat_map(|(x, y)| (0..4).map(move |channel| (x, y, channel)));
                let near = |(x, y, channel): (u32, u32, usize)| -> u64 {
                    let level = |picture: &Framebuffer| {
                        i64::from(picture.pixels()[(y * width + x) as usize].to_be_bytes()[channel])
                    };
                    (level(b) - level(a)).unsigned_abs().pow(2)
                };
                let afar: u64 = all().map(|(x, y, channel)| square(x, y, channel)).sum();
                u128::from(all().map(near).sum::<u64>()) * u128::from(afar + 1)
            };
            let corners = (0..=height - h).flat_map(|y| (0..=width - w).map(move |x| (x, y)));
            let most = corners.map(|(x, y)| sum(x, y)).max().unwrap_or(0);
            match pair.busiest(side) {
                None => assert_eq!(most, 0, "nothing that differs"),
                Some([x, y]) => assert_eq!(sum(x - w / 2, y - h / 2), most, "at {x}, {y}"),
            }
            Ok(())
        })
        .budget_ms(200);
    }

    #[test]
    fn busiest_is_where_something_is_lost() {
        let [mut a, mut b] = [Framebuffer::new(80, 40), Framebuffer::new(80, 40)];
        // Steps of an edge: as many pixels darker as lighter, side by side.
        for y in 0..40 {
            let (x, y) = (if y % 2 == 0 { 20 } else { 21 }, y);
            a.pixels_mut()[y * 80 + x] = 0xffff_ffff;
            b.pixels_mut()[y * 80 + 41 - x] = 0xffff_ffff;
        }
        // A thin line that A does not have.
        for y in 10..22 {
            b.pixels_mut()[y * 80 + 60] = 0xffff_ffff;
        }
        let pair = Pair::new(&a, &b).expect("one size");
        let [x, y] = pair.busiest(12).expect("they differ");
        assert!(x.abs_diff(60) < 6 && y.abs_diff(16) < 3, "at {x}, {y}");
    }

    #[test]
    fn busiest_is_where_most_differs_of_what_is_lost() {
        let [a, mut b] = [Framebuffer::new(80, 40), Framebuffer::new(80, 40)];
        // A wide veil, hardly to be seen, against a sliver.
        for (x, y) in (8..21).flat_map(|x| (8..21).map(move |y| (x, y))) {
            b.pixels_mut()[y * 80 + x] = 0x1414_1414;
        }
        for y in 12..20 {
            b.pixels_mut()[y * 80 + 60] = 0xa0a0_a0a0;
        }
        let pair = Pair::new(&a, &b).expect("one size");
        let [x, _] = pair.busiest(16).expect("they differ");
        assert!(x.abs_diff(60) <= 8, "at {x}");
    }
}
