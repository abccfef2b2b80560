//! What a sample interpolates in words: a place on a ramp, the texels that it reads.

use super::model::{Interpolated, RampStop, Tap, Texel, TileTexel, Wrapped};
use super::numbers::{counted, cut, hex, number, percent};

/// Points of a texture that are listed at most.
const MOST_TAPS: usize = 4;
/// Texels that are listed at most, the heaviest first.
const MOST_TEXELS: usize = 16;
/// How translucent texels are added.
const BY_ALPHA: &str = "          each multiplied by its own alpha before they are added";

/// How much of each of two stops a mix holds.
fn mix_of_stops(first: RampStop, second: RampStop, weight: f64) -> String {
    let stop = |stop: RampStop| {
        let hex = hex(stop.color);
        format!("stop {} ({hex} at {})", stop.number + 1, number(f64::from(stop.offset)))
    };
    if first.number == second.number {
        return format!("{} alone", stop(first));
    }
    let (rest, weight) = (percent(1.0 - weight), percent(weight));
    format!("{rest} of {}, {weight} of {}", stop(first), stop(second))
}

impl Interpolated {
    pub(super) fn lines(&self) -> Vec<String> {
        match self {
            Self::Flat => Vec::new(),
            Self::Color { rgba: [r, g, b, a] } => {
                vec![format!("mixed     red {r:.4}, green {g:.4}, blue {b:.4}, alpha {a:.4}")]
            }
            Self::Pattern {
                copy: [column, row],
                size: [width, height],
                texels,
            } => pattern_lines([*column, *row], [*width, *height], texels),
            Self::Gradient {
                t,
                at,
                stops: [first, second],
                weight,
                rgba: [r, g, b, a],
            } => vec![
                if (t - at).abs() > 1e-9 {
                    format!("t         {t:.5}, on the ramp {at:.5}")
                } else {
                    format!("t         {t:.5}")
                },
                format!("ramp      {}", mix_of_stops(*first, *second, *weight)),
                format!("mixed     red {r:.4}, green {g:.4}, blue {b:.4}, alpha {a:.4}"),
            ],
            Self::OffRamp => vec![
                "t         none: no circle of the gradient goes through this sample, which stays transparent"
                    .to_owned(),
            ],
            Self::Texture {
                uv: [u, v],
                wrapped,
                summed,
                texels,
                taps,
            } => {
                let mut lines = vec![format!("(u, v)    ({u:.5}, {v:.5})")];
                lines.extend(wrapped.as_ref().map(Wrapped::words));
                lines.extend(summed.iter().flat_map(|summed| summed.lines()));
                lines.extend(texture_lines(taps, texels));
                lines
            }
        }
    }
}

fn pattern_lines([column, row]: [i64; 2], [width, height]: [u32; 2], texels: &[TileTexel]) -> Vec<String> {
    let mut lines = vec![format!(
        "copy      ({column}, {row}) of the tile, drawn as {width} x {height} texels"
    )];
    for texel in texels {
        let [x, y] = texel.at;
        lines.push(format!(
            "{:>10}  of texel ({x}, {y}): {}",
            percent(texel.weight),
            hex(texel.color)
        ));
    }
    if texels.len() > 1 && texels.iter().any(|texel| texel.color[3] < 255) {
        lines.push(BY_ALPHA.to_owned());
    }
    lines
}

impl Wrapped {
    /// Which copy of the texture it is, and where in it.
    fn words(&self) -> String {
        let [u, v] = self.uv;
        let turned = match self.turned {
            [false, false] => "",
            [true, false] => ", turned left to right",
            [false, true] => ", turned upside down",
            [true, true] => ", turned both ways",
        };
        let [column, row] = self.copy.map(number);
        format!("wrapped   ({u:.5}, {v:.5}) in copy ({column}, {row}){turned}")
    }
}

fn texture_lines(taps: &[Tap], texels: &[Texel]) -> Vec<String> {
    let mut lines = Vec::new();
    for tap in taps.iter().take(MOST_TAPS) {
        let [x, y] = tap.at.map(cut);
        lines.push(format!("point     ({x}, {y}) of level {}, in texels", tap.level));
    }
    if let Some(rest) = taps.len().checked_sub(MOST_TAPS).filter(|rest| *rest > 0) {
        lines.push(format!("          and {}", counted(rest, "more point")));
    }
    let mut heaviest = texels.to_vec();
    heaviest.sort_by(|a, b| b.weight.abs().total_cmp(&a.weight.abs()));
    for texel in heaviest.iter().take(MOST_TEXELS) {
        let [x, y] = texel.at;
        let hex = hex(straight(texel.color));
        lines.push(format!(
            "{:>10}  of texel ({x}, {y}) of level {}: {hex}",
            percent(texel.weight),
            texel.level
        ));
    }
    if texels.len() > 1 && texels.iter().any(|texel| texel.color[3] < 255) {
        lines.push(BY_ALPHA.to_owned());
    }
    if let Some(rest) = heaviest.get(MOST_TEXELS..).filter(|rest| !rest.is_empty()) {
        let weight = rest.iter().map(|texel| texel.weight).sum();
        lines.push(format!(
            "{:>10}  of {}",
            percent(weight),
            counted(rest.len(), "more texel")
        ));
    }
    lines.extend(clamped(texels.iter().map(|texel| (texel.color, texel.weight))));
    lines
}

/// What was cut off of a sum of premultiplied texels, of which some weigh less than nothing: nothing where it is a colour.
fn clamped(texels: impl Iterator<Item = ([u8; 4], f64)>) -> Option<String> {
    let mut sum = [0.0; 4];
    for (color, weight) in texels {
        for (sum, channel) in sum.iter_mut().zip(color) {
            *sum += f64::from(channel) * weight;
        }
    }
    let alpha = sum[3].clamp(0.0, 255.0);
    let cut: Vec<String> = ["red", "green", "blue", "alpha"]
        .into_iter()
        .zip(sum)
        .zip([alpha, alpha, alpha, 255.0])
        .filter_map(|((name, sum), most)| {
            let kept = sum.clamp(0.0, most);
            // Less is rounding.
            ((kept - sum).abs() > 0.01).then(|| format!("{name} {sum:.2} to {kept:.2}"))
        })
        .collect();
    (!cut.is_empty()).then(|| format!("clamped   {}: no colour is beyond", cut.join(", ")))
}

/// A premultiplied colour as a file has it.
fn straight([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let divided = |channel: u8| {
        let (channel, alpha) = (u32::from(channel), u32::from(a).max(1));
        u8::try_from((channel * 255 + alpha / 2) / alpha).unwrap_or(u8::MAX)
    };
    [divided(r), divided(g), divided(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_that_are_no_colour_are_told() {
        let sum = |texels: &[([u8; 4], f64)]| clamped(texels.iter().copied());
        let (white, black, clear) = ([255; 4], [0, 0, 0, 255], [0; 4]);
        assert_eq!(sum(&[(white, 0.5), (black, 0.5)]), None, "a mean");
        assert_eq!(
            sum(&[(white, 1.125), (black, -0.125)]).as_deref(),
            Some("clamped   red 286.88 to 255.00, green 286.88 to 255.00, blue 286.88 to 255.00: no colour is beyond")
        );
        assert_eq!(
            sum(&[(white, -0.1), (black, 0.6), (clear, 0.5)]).as_deref(),
            Some("clamped   red -25.50 to 0.00, green -25.50 to 0.00, blue -25.50 to 0.00: no colour is beyond")
        );
        let shining = sum(&[([100, 0, 0, 100], 1.0), ([0, 0, 0, 100], -0.2), (clear, 0.2)]);
        assert_eq!(
            shining.as_deref(),
            Some("clamped   red 100.00 to 80.00: no colour is beyond"),
            "a channel is at most alpha"
        );
    }

    #[test]
    fn one_texel_that_is_not_listed_is_told_in_the_singular() {
        let texel = |column| Texel {
            level: 0,
            at: [column, 0],
            color: [255; 4],
            weight: 0.05,
        };
        let told = |count: u32| texture_lines(&[], &(0..count).map(texel).collect::<Vec<_>>()).pop();
        assert_eq!(told(17).as_deref(), Some("       5 %  of 1 more texel"));
        assert_eq!(told(18).as_deref(), Some("      10 %  of 2 more texels"));
    }

    #[test]
    fn texels_are_told_as_files_have_them() {
        assert_eq!(straight([0, 30, 128, 128]), [0, 60, 255, 128]);
        assert_eq!(straight([0; 4]), [0; 4], "nothing shows through");
        assert_eq!(straight([1, 2, 3, 255]), [1, 2, 3, 255]);
    }
}
