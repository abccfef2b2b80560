//! The colours that all scenes and textures share, and how they mix.

/// An sRGB colour; channels in `0.0..=1.0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Color(pub(crate) [f64; 3]);

pub(crate) const INK: Color = hex(0x172A3A);
pub(crate) const NIGHT: Color = hex(0x22405A);
pub(crate) const SLATE: Color = hex(0x4A6A80);
pub(crate) const MIST: Color = hex(0xA9BFC6);
pub(crate) const PAPER: Color = hex(0xF7F1E3);
pub(crate) const SAND: Color = hex(0xEAD9B5);
pub(crate) const AMBER: Color = hex(0xF2A541);
pub(crate) const CORAL: Color = hex(0xE8634A);
pub(crate) const BRICK: Color = hex(0xB23A3A);
pub(crate) const PLUM: Color = hex(0x6D3B63);
pub(crate) const TEAL: Color = hex(0x1E8A88);
pub(crate) const SEA: Color = hex(0x6DBFB0);
pub(crate) const LEAF: Color = hex(0x7FA650);
pub(crate) const PINE: Color = hex(0x2F5D50);
pub(crate) const SKY: Color = hex(0x8FCBE3);
pub(crate) const WHITE: Color = hex(0xFFFFFF);

/// The colour written `#RRGGBB`.
pub(crate) const fn hex(rgb: u32) -> Color {
    Color([
        ((rgb >> 16) & 255) as f64 / 255.0,
        ((rgb >> 8) & 255) as f64 / 255.0,
        (rgb & 255) as f64 / 255.0,
    ])
}

impl Color {
    /// This colour at `0.0`, `other` at `1.0`.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let t = t.clamp(0.0, 1.0);
        Self([0, 1, 2].map(|i| self.0[i] * (1.0 - t) + other.0[i] * t))
    }

    /// Towards white for positive `amount`, towards deep ink for negative, up to 1.
    pub(crate) fn shade(self, amount: f64) -> Self {
        if amount >= 0.0 {
            self.mix(WHITE, amount)
        } else {
            self.mix(hex(0x0B1622), -amount)
        }
    }

    /// 8-bit channels, rounded.
    pub(crate) fn bytes(self) -> [u8; 3] {
        self.0.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
    }
}

/// The colour at `t` in `0.0..=1.0` of evenly spaced `stops`.
pub(crate) fn gradient(stops: &[Color], t: f64) -> Color {
    let place = t.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let first = (place.floor() as usize).min(stops.len().saturating_sub(2));
    stops[first].mix(stops[(first + 1).min(stops.len() - 1)], place - first as f64)
}

/// Full colour of a hue; `turn` goes once round from red over yellow, green and blue.
pub(crate) fn hue(turn: f64) -> Color {
    let channel = |shift: f64| {
        let place = (turn + shift).rem_euclid(1.0) * 6.0;
        ((place - 3.0).abs() - 1.0).clamp(0.0, 1.0)
    };
    Color([channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)])
}
