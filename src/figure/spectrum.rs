//! A spectrum as a figure: its waves in a square with axes, the box of frequencies that pixels can show, and what colours mean.

use glam::DVec2;

use super::legend::draw_legend;
use super::lines::{Stroke, draw_line};
use super::paint::{copy, fill};
use super::{Anchor, PixelRect, TextBlock, TextStyle};
use crate::compare::{Band, DECIBELS, SpectrumAnalysis, SpectrumOf, scale_color};
use crate::raster::Framebuffer;
use crate::render::{Legend, LegendKey};

/// Side of the square, in pixels.
const SIDE: u32 = 720;
/// Room beside the square for numbers and words, in pixels: left, above, right.
const BESIDE: [u32; 3] = [72, 16, 28];
/// Below the square up to the legend, in pixels.
const BELOW: u32 = 56;
const TEXT: TextStyle = TextStyle::new(14.0, 0xff20_2428);
const PAPER: u32 = 0xffff_ffff;
/// The border of the square, and the length of a mark at it in pixels.
const INK: u32 = 0xff20_2428;
const MARK: u32 = 5;
/// The line of the box.
const BOX: Stroke = Stroke {
    color: 0xffff_ffff,
    halo: 0xff00_0000,
    width: 1.0,
};

/// Draws a spectrum with its axes on white, below a `title`.
pub fn draw_spectrum(analysis: &SpectrumAnalysis, title: &str) -> Framebuffer {
    let [left, above, right] = BESIDE;
    let width = left + SIDE + right;
    let title = TextBlock::new(title, TEXT, Some(width - 2 * above));
    let top = above + title.size()[1] + above / 2;
    let legend = draw_legend(&legend(analysis), 1.0);
    let height = top + SIDE + BELOW + legend.height() + above;
    let mut picture = Framebuffer::new(width, height);
    fill(&mut picture, &PixelRect::of_size([width, height]), PAPER);
    title.draw(&mut picture, [i64::from(above), i64::from(above)], Anchor::Left);
    let square = PixelRect {
        x: i64::from(left),
        y: i64::from(top),
        width: SIDE,
        height: SIDE,
    };
    fill(&mut picture, &super::paint::outer(&square), INK);
    copy(&plot(analysis), &mut picture, [square.x, square.y]);
    axes(&mut picture, &square, analysis);
    let below = square.bottom() + i64::from(BELOW);
    copy(&legend, &mut picture, [square.x, below]);
    picture
}

/// The waves, and the box.
fn plot(analysis: &SpectrumAnalysis) -> Framebuffer {
    let mut plot = analysis.picture(SIDE);
    let reach = analysis.reach();
    // In the middle of pixels, where lines are sharp.
    let place = |frequency: [f64; 2]| ((DVec2::from(frequency) / reach + 1.0) / 2.0 * f64::from(SIDE)).floor() + 0.5;
    let corners = analysis.nyquist().into_iter().flatten().map(place);
    let corners: Vec<DVec2> = corners.collect();
    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        // Steep lines run down, others to the right, whichever way they are given.
        draw_line(&mut plot, *from, *to, BOX);
    }
    plot
}

/// Numbers and names of both axes.
fn axes(picture: &mut Framebuffer, square: &PixelRect, analysis: &SpectrumAnalysis) {
    let reach = analysis.reach();
    let unit = if analysis.of() == SpectrumOf::Texture {
        "texel"
    } else {
        "pixel"
    };
    let half = i64::from(TEXT.line_height() / 2);
    let gap = i64::from(2 * MARK);
    let marks = marks(reach);
    for mark in 0..=marks {
        let part = f64::from(mark) / f64::from(marks);
        let text = TextBlock::new(&frequency((2.0 * part - 1.0) * reach), TEXT, None);
        let along = i64::from(SIDE) * i64::from(mark) / i64::from(marks);
        let (x, y) = (square.x + along, square.y + along);
        let (short, long) = (1, MARK);
        let ticks = [
            (x, square.bottom(), short, long),
            (square.x - i64::from(MARK), y, long, short),
        ];
        for (x, y, width, height) in ticks {
            fill(picture, &PixelRect { x, y, width, height }, INK);
        }
        text.draw(picture, [x, square.bottom() + gap - 2], Anchor::Center);
        text.draw(picture, [square.x - gap, y - half], Anchor::Right);
    }
    let across = TextBlock::new(&format!("across, in cycles per {unit}; down the same"), TEXT, None);
    let below = square.bottom() + gap + i64::from(TEXT.line_height());
    across.draw(picture, [square.x + i64::from(SIDE / 2), below], Anchor::Center);
}

/// Into how many parts the marks divide an axis: eighths of a cycle where half a cycle is the highest frequency, else quarters.
fn marks(reach: f64) -> i32 {
    if reach > 1.25 { 12 } else { 8 }
}

/// A mark's number, which is a multiple of an eighth.
fn frequency(at: f64) -> String {
    let text = format!("{at:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// What colours mean.
fn legend(analysis: &SpectrumAnalysis) -> Legend {
    let [low, high] = DECIBELS;
    let at = |part: f64| low + (high - low) * part;
    let colors = (0..=255_u8).map(|i| scale_color(at(f64::from(i) / 255.0), None));
    let ticks = [0.0_f32, 0.25, 0.5, 0.75, 1.0].map(|part| (part, format!("{:.0}", at(f64::from(part)))));
    let bands = Band::ALL.map(|band| (band.color(), band.name()));
    Legend {
        title: match analysis.of() {
            SpectrumOf::Frame | SpectrumOf::Difference => {
                "dB; 0 is a wave from black to white. Coloured: aliases of waves that are"
            }
            SpectrumOf::Texture => "dB; 0 is a wave from black to white. Coloured: what is for pixels",
            SpectrumOf::Scene => {
                "dB; 0 is a wave from black to white. Coloured, also where they land in the box: waves that are"
            }
        },
        key: LegendKey::Scale(colors.collect(), ticks.to_vec()),
        others: bands.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use glam::DAffine2;

    use super::*;
    use crate::texture::MipLevel;

    #[test]
    fn axes_have_numbers_of_few_digits() {
        let all = |reach: f64| -> Vec<String> {
            let count = marks(reach);
            let part = |mark| f64::from(mark) / f64::from(count);
            (0..=count)
                .map(|mark| frequency((2.0 * part(mark) - 1.0) * reach))
                .collect()
        };
        let expected = [
            "-0.5", "-0.375", "-0.25", "-0.125", "0", "0.125", "0.25", "0.375", "0.5",
        ];
        assert_eq!(all(0.5), expected, "what pixels can show");
        assert_eq!(
            all(1.5)[6..],
            ["0", "0.25", "0.5", "0.75", "1", "1.25", "1.5"],
            "of a scene"
        );
    }

    #[test]
    fn figure_marks_waves_and_the_box() {
        // Stripes of four texels, and as many texels to a pixel: the wave lies outside of the box.
        let texels = (0..64 * 64).map(|i| if (i % 4) < 2 { [0, 0, 0, 255] } else { [255; 4] });
        let level = MipLevel::new(64, 64, texels.collect());
        let analysis = SpectrumAnalysis::of_level(&level, [10, 10], DAffine2::from_scale(DVec2::splat(4.0)));
        let picture = draw_spectrum(&analysis, "stripes");
        let top = picture.height() - draw_legend(&legend(&analysis), 1.0).height() - BESIDE[1] - BELOW - SIDE;
        let at = |[x, y]: [f64; 2]| {
            let place = |frequency: f64| (frequency + 0.5) * f64::from(SIDE);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "inside the square"
            )]
            let [x, y] = [place(x), place(y)].map(|at| at as u32);
            picture.rgba(BESIDE[0] + x, top + y).expect("inside")
        };
        let light = |[r, g, b, _]: [u8; 4]| r.max(g).max(b);
        assert!(light(at([0.25, 0.0])) > 150, "the wave: {:?}", at([0.25, 0.0]));
        assert!(light(at([0.1, 0.13])) < 60, "nothing: {:?}", at([0.1, 0.13]));
        assert!(
            light(at([0.05, 0.125])) > 200,
            "the box at an eighth: {:?}",
            at([0.05, 0.125])
        );
    }
}
