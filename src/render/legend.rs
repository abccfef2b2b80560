//! What the colours of a visualisation mean: data for whoever draws it.

/// The legend of a visualisation. Colours are opaque `0xAARRGGBB`.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// What the colours show, and in which unit.
    pub title: &'static str,
    /// How they show it.
    pub key: LegendKey,
    /// What has a colour outside the key, such as primitives without a texture.
    pub others: Vec<(u32, &'static str)>,
}

/// How colours stand for what is shown.
#[derive(Clone, Debug, PartialEq)]
pub enum LegendKey {
    /// A scale from left to right: its colours, and labels at parts `0.0..=1.0` of its length.
    Scale(Vec<u32>, Vec<(f32, String)>),
    /// Colours that stand for things.
    Swatches(Vec<(u32, String)>),
    /// A triangle's corners, between which colours are mixed.
    Triangle([(u32, &'static str); 3]),
    /// Two axes from the upper left corner, to the right and down, whose colours add up.
    Square([(u32, &'static str); 2]),
}
