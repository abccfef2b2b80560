//! What a texture's samples weigh where that is an area of it, and what a table of sums says of it, in words.

use serde::Serialize;

use super::numbers::{cut, significant};
use crate::texture::{Area, BoxRead};

/// What of a texture each sample weighs, in texels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum AreaUse {
    /// The texels of a level under an ellipse, by a Gaussian.
    Ellipse {
        /// The half axes, the longer one first, in texels of the level.
        axes: [[f64; 2]; 2],
    },
    /// All that lies in a box of a level.
    Box {
        /// Width and height in texels of the level.
        sides: [f64; 2],
    },
    /// The levels of a ripmap.
    Ripmap {
        /// The level of detail along `u` and along `v`, clamped to the levels that there are.
        detail: [f64; 2],
        /// How many levels there are of each height: level `j` times this plus `i` is halved `i` times in width, `j` in height.
        widths: usize,
    },
}

/// The sums that the mean over a box is made of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SummedBox {
    /// Number of the level.
    pub level: usize,
    /// The upper left corner, in texels.
    pub from: [f64; 2],
    /// The lower right corner.
    pub to: [f64; 2],
    /// The table at its corners, where it lies inside the level: upper left, upper right, lower left, lower right.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corners: Option<[[f64; 4]; 4]>,
    /// The sum over it: premultiplied red, green, blue, alpha.
    pub sum: [f64; 4],
    /// Its area in texels.
    pub area: f64,
    /// Whether light was summed, of which 65535 is all, instead of bytes.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub light: bool,
}

impl AreaUse {
    /// Of a texture whose ripmap has so many levels of each height.
    pub(super) fn new(area: &Area, widths: usize) -> Self {
        match area {
            Area::Ellipse(ellipse) => Self::Ellipse {
                axes: ellipse.axes.map(|axis| axis.to_array()),
            },
            Area::Box(area) => Self::Box {
                sides: area.sides.to_array(),
            },
            Area::Ripmap(choices) => Self::Ripmap {
                detail: choices.map(|choice| choice.level as f64 + f64::from(choice.next_weight)),
                widths,
            },
        }
    }

    pub(super) fn words(&self) -> String {
        let pair = |[x, y]: [f64; 2]| format!("({}, {})", significant(x), significant(y));
        match self {
            Self::Ellipse { axes: [long, short] } => format!(
                "ellipse  half axes {} and {}, {} and {} texels of its level long, with the circle of a texel added",
                pair(*long),
                pair(*short),
                significant(long[0].hypot(long[1])),
                significant(short[0].hypot(short[1]))
            ),
            Self::Box { sides: [width, height] } => format!(
                "box around the footprint  {} x {} texels, at least one each way",
                significant(*width),
                significant(*height)
            ),
            Self::Ripmap { detail: [u, v], widths } => format!(
                "ripmap  level of detail {u:.3} along u and {v:.3} along v; level i + {widths} j is halved i times in width, j times in height"
            ),
        }
    }
}

impl SummedBox {
    pub(super) fn new(read: &BoxRead) -> Self {
        Self {
            level: read.level,
            from: read.from.to_array(),
            to: read.to.to_array(),
            corners: read.corners,
            sum: read.sum,
            area: read.area,
            light: read.is_of_light,
        }
    }

    pub(super) fn lines(&self) -> Vec<String> {
        let pair = |at: [f64; 2]| at.map(cut).join(", ");
        let color = |color: [f64; 4]| color.map(|channel| format!("{channel:.2}")).join(", ");
        let mut lines = vec![format!(
            "box       ({}) to ({}) of level {}, in texels",
            pair(self.from),
            pair(self.to),
            self.level
        )];
        if let Some(corners) = self.corners {
            let names = ["upper left", "upper right", "lower left", "lower right"];
            for (name, corner) in names.iter().zip(corners) {
                lines.push(format!("sums      {name} {}", color(corner)));
            }
            lines.push("          lower right - upper right - lower left + upper left".to_owned());
        }
        let what = if self.light {
            "light, of which 65535 is all"
        } else {
            "texels"
        };
        lines.push(format!("sum       {} of {what}", color(self.sum)));
        let mean = self.sum.map(|sum| sum / self.area);
        lines.push(format!(
            "divided   by {} texels: {}",
            significant(self.area),
            color(mean)
        ));
        lines
    }
}
