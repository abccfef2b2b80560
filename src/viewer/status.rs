//! The pixel under the pointer in numbers, and how far the frame is from final.

use std::fmt;
use std::time::{Duration, Instant};

use glam::DVec2;

use super::{Manner, Viewer};

/// A refinement that takes longer shows how far it is.
const LONG: Duration = Duration::from_millis(200);

/// A pixel in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// The frame pixel.
    pub pixel: [u32; 2],
    /// Its centre in user space.
    pub user: DVec2,
    /// Its colour, straight `[r, g, b, a]`; `None` before the first frame.
    pub rgba: Option<[u8; 4]>,
    /// Frame pixels per user unit: tells how many digits of `user` mean something.
    pub scale: f64,
}

impl Status {
    /// Decimals that tell neighbouring pixels apart, with one to spare.
    fn decimals(&self) -> usize {
        let digits = self.scale.log10().ceil() + 1.0;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped; NaN becomes 0"
        )]
        let decimals = digits.clamp(1.0, 15.0) as usize;
        decimals
    }

    /// The place in user space, such as `12.5, 80.25`.
    pub fn user_text(&self) -> String {
        let decimals = self.decimals();
        format!("{:.decimals$}, {:.decimals$}", self.user.x, self.user.y)
    }

    /// The colour in decimal, such as `255 128 0`; the opacity follows where it is not full.
    pub fn decimal_text(&self) -> Option<String> {
        let [r, g, b, a] = self.rgba?;
        Some(match a {
            255 => format!("{r} {g} {b}"),
            _ => format!("{r} {g} {b} {a}"),
        })
    }

    /// The colour in hex, such as `#ff8000`; the opacity follows where it is not full.
    pub fn hex_text(&self) -> Option<String> {
        let [r, g, b, a] = self.rgba?;
        Some(match a {
            255 => format!("#{r:02x}{g:02x}{b:02x}"),
            _ => format!("#{r:02x}{g:02x}{b:02x}{a:02x}"),
        })
    }
}

impl fmt::Display for Status {
    /// One line: `pixel 512, 300  user 12.5, 80.3  255 128 0  #ff8000`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.pixel;
        write!(f, "pixel {x}, {y}  user {}", self.user_text())?;
        match self.decimal_text().zip(self.hex_text()) {
            Some((decimal, hex)) => write!(f, "  {decimal}  {hex}"),
            None => Ok(()),
        }
    }
}

impl Viewer {
    /// How the frame on the screen was made, unless it is final.
    pub fn preview(&self) -> Option<Manner> {
        Some(self.frame()?.preview.as_ref()?.manner)
    }

    /// Since when the picture on the screen has been wanted.
    pub fn wanted_since(&self) -> Instant {
        self.drawing.frame_since()
    }

    /// Whether final tiles are being drawn over what is on the screen.
    pub fn is_refining(&self) -> bool {
        self.drawing.refinement().is_some()
    }

    /// Which part of a refinement that takes long is done, `0.0..=1.0`.
    pub fn long_refinement(&self) -> Option<f64> {
        let (since, done) = self.drawing.refinement()?;
        (Instant::now().saturating_duration_since(since) >= LONG).then_some(done)
    }

    /// How many different colours the inspector's region shows: where that is an edge, its shades and both sides. `None`
    /// while the inspector is closed or the frame is not final.
    pub fn region_colors(&self) -> Option<usize> {
        let (shown, frame) = (self.inset()?.inset.source(), self.frame()?);
        if frame.preview.is_some() {
            return None;
        }
        let place = |start: i64, offset: u32| u32::try_from(start + i64::from(offset)).ok();
        let rows = (0..shown.height).filter_map(|row| place(shown.y, row));
        let mut colors: Vec<_> = rows
            .flat_map(|y| (0..shown.width).filter_map(move |column| Some((place(shown.x, column)?, y))))
            .filter_map(|(x, y)| frame.pixels.rgba(x, y))
            .collect();
        colors.sort_unstable();
        colors.dedup();
        Some(colors.len())
    }

    /// What the status line says about a frame that is not final, such as `preview, rate 1`.
    pub fn preview_text(&self) -> Option<String> {
        let preview = self.preview();
        match (preview, self.drawing.refinement()) {
            (Some(_), Some((_, done))) => Some(format!("refining {:.0} %", done * 100.0)),
            (Some(manner), None) => Some(format!("preview, {manner}")),
            (None, _) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn status_text() {
        let status = Status {
            pixel: [512, 300],
            user: DVec2::new(12.5, 80.256),
            rgba: Some([255, 128, 0, 255]),
            scale: 8.0,
        };
        assert_eq!(
            status.to_string(),
            "pixel 512, 300  user 12.50, 80.26  255 128 0  #ff8000",
            "opaque"
        );
        let clear = Status {
            rgba: Some([1, 2, 3, 4]),
            scale: 1e-9,
            ..status
        };
        assert_eq!(
            clear.to_string(),
            "pixel 512, 300  user 12.5, 80.3  1 2 3 4  #01020304",
            "translucent"
        );
        let odd = Status {
            rgba: None,
            scale: f64::NAN,
            ..status
        };
        assert!(odd.to_string().starts_with("pixel 512, 300  user 12"), "{odd}");
    }
}
