//! Antialiasing after the fact: finished pixels in, finished pixels out, with nothing known of the shapes that were drawn.
//!
//! The way is SMAA 1x: Jorge Jimenez, Jose I. Echevarria, Tiago Sousa and Diego Gutierrez, "SMAA: Enhanced Subpixel
//! Morphological Antialiasing", Computer Graphics Forum 31 (2), Eurographics 2012; with the values of the preset "high" of its
//! reference code: threshold 0.1, 16 search steps of two pixels, 8 diagonal ones, corners rounded by 25 %. In three steps:
//!
//! 1. `edges`: where the luma of neighbours differs, and nothing beside differs twice as much.
//! 2. `lines` and `diagonals`: how far each edge goes on, and how it ends. From that, `areas` guess the line that was
//!    drawn, and which part of the pixel lies on its other side.
//! 3. `blend`: pixels take that part of their neighbour's colour.
//!
//! It differs from the reference code where that is bound to textures: areas are computed, not read from a table of bytes;
//! searches go from pixel to pixel; lines end at the frame's border. Games blend in linear light; here that is done in the
//! values in which the picture's samples are averaged. Where pixels are translucent, luma is weighted by opacity, and a
//! difference of opacity is an edge too.
//!
//! All is whole numbers but the table of areas, which is computed from exact operations only: every machine and any number of
//! threads give the same bytes. A pixel depends on those at most [`REACH`] beside it.

mod areas;
mod bits;
mod blend;
mod diagonals;
mod edges;
mod lines;
mod smaa;
mod trace;
mod weights;

pub use blend::Values;
pub use edges::{FACTOR, THRESHOLD};
pub use smaa::{REACH, smaa};
pub use trace::{Form, Neighbour, Pattern, SideTrace, Trace, trace};

/// What is done to a finished picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PostProcess {
    /// Nothing.
    #[default]
    None,
    /// Morphological antialiasing.
    Smaa,
}

impl PostProcess {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::None, Self::Smaa];

    /// The name used in the command line and the interface.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Smaa => "smaa",
        }
    }
}
