//! `--size WxH`: a frame in device pixels.

use std::str::FromStr;

use crate::raster::Framebuffer;

/// Width and height of a frame in device pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FrameSize(pub(super) [u32; 2]);

impl FromStr for FrameSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let problem = || {
            format!(
                "a size is WIDTHxHEIGHT in pixels, each 1 to {}, such as 1024x768",
                Framebuffer::MAX_SIDE
            )
        };
        let (width, height) = text.split_once(['x', 'X']).ok_or_else(problem)?;
        let side = |text: &str| {
            let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            let side: Option<u32> = text.parse().ok().filter(|_| digits);
            side.filter(|side| (1..=Framebuffer::MAX_SIDE).contains(side))
                .ok_or_else(problem)
        };
        Ok(Self([side(width)?, side(height)?]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn size_reads_width_and_height() {
        assert_eq!("1024x768".parse(), Ok(FrameSize([1024, 768])), "as documented");
        assert_eq!("1X16384".parse(), Ok(FrameSize([1, 16_384])), "to the limits");
        for text in [
            "",
            "10",
            "x",
            "10x",
            "x10",
            "0x10",
            "10x0",
            "-1x5",
            "+1x5",
            "1e3x5",
            "16385x1",
            "5x5x5",
            "5 x5",
            "99999999999x1",
        ] {
            assert!(text.parse::<FrameSize>().is_err(), "{text:?} is no size");
        }
    }
}
