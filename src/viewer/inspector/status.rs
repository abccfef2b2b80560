//! The pixel under the pointer in numbers, and how far the frame is from final.

use std::fmt;

use glam::DVec2;

/// A pixel in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// The frame pixel.
    pub pixel: [u32; 2],
    /// Its centre in user space.
    pub user: DVec2,
    /// Its colour, straight `[r, g, b, a]`; `None` before the first frame.
    pub rgba: Option<[u8; 4]>,
    /// Frame pixels per canvas unit: tells how many digits of `user` mean something.
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
