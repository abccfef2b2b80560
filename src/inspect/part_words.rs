//! The parts of a report in words: what painted a sample, where its edges are, what it read of a texture.

use super::area_use::AreaUse;
use super::model::{Edge, Fragment, GradientUse, Paint, Shape, Source, Texture, Verdict, View};
use super::numbers::{number, percent, significant};
use crate::color::{BlendMode, ResolveSpace};
use crate::plain;
use crate::texture::{FootprintExtent, PyramidFilter};

impl Paint {
    /// Such as `triangle of polygon "left", line 12`.
    pub fn name(&self) -> String {
        let of = |kind: &str| match &self.source {
            Some(source) if source.element == kind => format!("{}, line {}", source.name(), source.line),
            Some(source) => format!("{kind} of {}, line {}", source.name(), source.line),
            None => kind.to_owned(),
        };
        match &self.shape {
            Shape::Triangle { .. } => of("triangle"),
            Shape::Polygon { stroke: true, .. } => of("stroke"),
            Shape::Polygon { curved: true, .. } => self
                .source
                .as_ref()
                .map_or_else(|| of("shape"), |source| of(&source.element)),
            Shape::Polygon { .. } => of("polygon"),
            Shape::WholePixel => of("pixel"),
            Shape::CanvasOutline => "outline of the canvas".to_owned(),
            Shape::BeginLayer => of("layer"),
            Shape::EndLayer { .. } => of("end of the layer"),
            Shape::EndClip if self.is_clip_path() => of("clip"),
            Shape::EndClip => of("viewport"),
            Shape::EndMask { .. } => of("mask"),
        }
    }

    /// Whether some sample shows it.
    pub(super) fn is_seen(&self) -> bool {
        self.fragments.iter().any(|fragment| fragment.seen)
    }

    /// Whether it covers whole pixels, those whose middles it holds.
    pub(super) fn is_crisp(&self) -> bool {
        matches!(self.shape, Shape::Polygon { crisp: true, .. })
    }

    /// Whether it belongs to a `clipPath`, and not to the edge of a viewport, symbol, marker, mask or image.
    pub(super) fn is_clip_path(&self) -> bool {
        self.source.as_ref().is_some_and(|source| source.element == "clipPath")
    }

    /// The samples that it painted.
    pub fn samples(&self) -> Vec<usize> {
        self.fragments.iter().map(|fragment| fragment.sample).collect()
    }
}

impl Source {
    /// Such as `polygon "left"`.
    pub fn name(&self) -> String {
        match &self.id {
            Some(id) => format!("{} \"{id}\"", self.element),
            None => self.element.clone(),
        }
    }

    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("{}:{}:{}", plain::line(&self.file), self.line, self.column)];
        // An excerpt already.
        let quoted = self.text.iter().map(|text| text.replace('\t', " "));
        lines.extend(quoted.map(|text| format!("{} | {}", self.line, plain::line(&text))));
        let by = if self.element == "marker" {
            "as a mark of the line"
        } else {
            "by the use"
        };
        lines.extend(self.used.map(|line| format!("put here {by} in line {line}")));
        lines
    }
}

impl Edge {
    pub(super) fn words(&self) -> String {
        let verdict = match self.verdict {
            Verdict::Inside => "inside",
            Verdict::Outside => "outside",
            Verdict::TieTop => "on the line: a top edge owns it, so inside",
            Verdict::TieLeft => "on the line: a left edge owns it, so inside",
            Verdict::TieNeither => "on the line: neither top nor left, so the neighbour's",
            Verdict::TieInclusive => "on the line: inside by the course's rules",
            Verdict::TieUndecided => "on the line: no rule says whose it is, so nobody's",
        };
        if let Some(float) = self.float {
            let float = if self.verdict.is_tie() {
                "0".to_owned()
            } else {
                format!("{float:+.3e}")
            };
            return format!("{verdict} (edge function {float} in 32-bit floats{})", self.exactly());
        }
        if self.verdict.is_tie() {
            return format!("{verdict} (edge function 0)");
        }
        let distance = significant(self.distance.abs());
        format!("{distance} px {verdict} (edge function {:+})", self.value)
    }

    /// The exact edge function, where it says otherwise than 32-bit floats.
    fn exactly(&self) -> String {
        let agree = match self.value.signum() {
            1 => self.verdict == Verdict::Inside,
            0 => self.verdict.is_tie(),
            _ => self.verdict == Verdict::Outside,
        };
        if agree {
            String::new()
        } else {
            format!(", exactly {:+}", self.value)
        }
    }
}

impl Paint {
    /// The texture, pattern or gradient that it is filled by.
    pub(super) fn server_lines(&self) -> Vec<String> {
        let how = if matches!(self.shape, Shape::Polygon { stroke: true, .. }) {
            "stroked with"
        } else {
            "filled by"
        };
        let mut lines: Vec<String> = self.texture.iter().flat_map(Texture::lines).collect();
        if let Some(pattern) = &self.pattern {
            let [width, height] = pattern.tile.map(number);
            lines.push(format!(
                "{how} {}, line {}: tiles of {width} x {height} units",
                pattern.source.name(),
                pattern.source.line
            ));
            if pattern.opacity < 1.0 {
                lines.push(format!("opacity  {}", number(pattern.opacity)));
            }
        }
        if let Some(gradient) = &self.gradient {
            let GradientUse { source, spread, stops } = gradient;
            let plural = if *stops == 1 { "" } else { "s" };
            lines.push(format!(
                "{how} {}, line {}: {stops} stop{plural}, spread {spread}",
                source.name(),
                source.line
            ));
        }
        lines
    }
}

/// How fragments of a pixel are composited.
#[derive(Clone, Copy, Debug)]
pub(super) struct Composited {
    /// By exact areas: the pixel has no samples.
    pub(super) exact: bool,
    /// Whether areas are mixed in linear light.
    pub(super) in_light: bool,
}

impl Fragment {
    /// Whether it is opaque and leaves what is below it as it is, as white does that is multiplied.
    pub(super) fn is_neutral(&self) -> bool {
        let are_same = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < f64::EPSILON);
        self.color[3] >= 255.0 && are_same(self.after, self.before) && !are_same(self.after, self.color)
    }

    /// What it did, as one of a paint's fragments.
    pub(super) fn lines(&self, paint: &Paint, how: Composited) -> Vec<String> {
        let place = if how.exact { "pixel" } else { "sample" };
        match &paint.shape {
            _ if paint.in_mask && !paint.shape.is_layer_mark() => vec![
                format!("colour    {}", color(self.color)),
                "counts for the clip path or mask, and is not seen itself".to_owned(),
            ],
            Shape::EndMask { by: "luminance" } => {
                let mut lines = self.mask_lines(place);
                if (1..255).contains(&self.kept_level()) {
                    lines.push("weighed   0.2125 red + 0.7154 green + 0.0721 blue of the mask".to_owned());
                }
                lines
            }
            Shape::EndClip | Shape::EndMask { .. } => self.mask_lines(place),
            Shape::EndLayer { blend: Some(blend), .. } => self.blend_lines(blend),
            _ => match paint.covered.filter(|covered| *covered < 1.0) {
                Some(covered) => self.area_lines(covered, how),
                None => self.over_lines(),
            },
        }
    }

    /// How it was composited by a part of the pixel's area.
    fn area_lines(&self, covered: f64, how: Composited) -> Vec<String> {
        let light = if how.in_light { ", mixed in linear light" } else { "" };
        let alpha = self.color[3] / 255.0;
        vec![
            format!("colour    {}", color(self.color)),
            format!(
                "area      {} of the pixel, so alpha x area is {:.4}",
                percent(covered),
                alpha * covered
            ),
            format!("over      {}", color(self.before)),
            format!("gives     {}{light}", color(self.after)),
        ]
    }

    /// How much a clip path or mask leaves, in levels of 255.
    #[expect(clippy::cast_possible_truncation, reason = "0 to 255")]
    fn kept_level(&self) -> i32 {
        self.color[3].round() as i32
    }

    /// What a clip path or mask leaves of the sample.
    fn mask_lines(&self, place: &str) -> Vec<String> {
        let kept = self.color[3] / 255.0;
        if self.before[3] <= 0.0 {
            return vec![format!("finds nothing on this {place}: there is nothing to take")];
        }
        if kept <= 0.0 {
            return vec![format!("takes this {place} away: nothing of it is left")];
        }
        if kept >= 1.0 {
            return vec![format!("leaves this {place} as it was")];
        }
        vec![
            format!("keeps     {} of {}", percent(kept), color(self.before)),
            format!("gives     {}", color(self.after)),
        ]
    }

    /// How a layer's colour was blended, channel by channel.
    fn blend_lines(&self, name: &str) -> Vec<String> {
        let Some(mode) = BlendMode::ALL.into_iter().find(|mode| mode.name() == name) else {
            return self.over_lines();
        };
        let mut lines = vec![
            format!("above     {}", color(self.color)),
            format!("below     {}", color(self.before)),
        ];
        if self.color[3] > 0.0 && self.before[3] > 0.0 {
            let straight = |[r, g, b, a]: [f64; 4]| [r, g, b].map(|channel| unit(channel / a));
            let mixed = mode.mixed(straight(self.before), straight(self.color));
            let [r, g, b] = mixed.map(|channel| format!("{channel:.4}"));
            if self.color[3] < 255.0 || self.before[3] < 255.0 {
                let told = |[r, g, b]: [f32; 3]| format!("{r:.4}, {g:.4}, {b:.4}");
                let (above, below) = (straight(self.color), straight(self.before));
                lines.push(format!(
                    "divided   by their alpha: above {}, below {}, each 0 to 1",
                    told(above),
                    told(below)
                ));
            }
            lines.push(format!("{name}: {}", mode.formula()));
            lines.push(format!("mixed     red {r}, green {g}, blue {b}, each 0 to 1"));
            lines.push(
                "weighed   above x (1 - alpha below) + below x (1 - alpha above) + mixed x both alphas".to_owned(),
            );
        }
        if self.before[3] <= 0.0 {
            lines.push("nothing is below: the layer's colour stays as it is, whatever the mode".to_owned());
        } else if self.color[3] <= 0.0 {
            lines.push("the layer is transparent here: what is below stays as it is".to_owned());
        }
        lines.push(format!("gives     {}", color(self.after)));
        lines
    }

    fn over_lines(&self) -> Vec<String> {
        let mut lines = vec![format!("colour    {}", color(self.color))];
        if self.color[3] >= 255.0 {
            lines.push(format!("replaces  {}", color(self.before)));
        } else {
            lines.push(format!("over      {}", color(self.before)));
            lines.push(format!("gives     {}", color(self.after)));
        }
        lines
    }
}

impl Paint {
    /// Whether the place where it was shaded for all of its samples is the pixel's centre; `None` where each was.
    pub(super) fn is_shaded_in_centre(&self) -> Option<bool> {
        let [x, y] = self.shaded_at?;
        Some((x - 0.5).abs() < 1e-9 && (y - 0.5).abs() < 1e-9)
    }

    /// Where it was shaded for all of its samples.
    pub(super) fn shaded_line(&self) -> Option<String> {
        let [x, y] = self.shaded_at?;
        let what = if self.is_shaded_in_centre()? {
            "the pixel's centre"
        } else {
            "the mean of the samples that it covers"
        };
        Some(format!(
            "shaded    once for all its samples, at ({}, {}): {what}",
            number(x),
            number(y)
        ))
    }
}

impl Paint {
    /// Whether its corners are those of a piece that clipping left of a triangle, whose own weights are interpolated by.
    pub(super) fn is_clipped(&self) -> bool {
        /// The part of a weight that rounding may change.
        const ROUNDING: f64 = 1e-3;
        let Some(View::Triangle { edges, weights, .. }) = self.views.first().filter(|_| self.shaded_at.is_none())
        else {
            return false;
        };
        let [ab, bc, ca] = [0, 1, 2].map(|edge| edges[edge].value as f64);
        let twice_area = ab + bc + ca;
        let of_corners = [bc, ca, ab].map(|opposite| opposite / twice_area);
        let differ = |(own, weight): (f64, &f64)| (own - weight).abs() > ROUNDING * (1.0 + own.abs());
        twice_area != 0.0 && of_corners.into_iter().zip(weights).any(differ)
    }
}

impl Texture {
    /// In which values its coarser levels were averaged.
    pub fn averaged_in(&self) -> ResolveSpace {
        let space = ResolveSpace::ALL.into_iter().find(|space| space.name() == self.pyramid);
        space.unwrap_or_default()
    }

    /// By which filter they were made.
    pub fn filtered_by(&self) -> PyramidFilter {
        let filter = PyramidFilter::ALL
            .into_iter()
            .find(|filter| filter.name() == self.pyramid_filter);
        filter.unwrap_or_default()
    }

    /// What of the footprint the level of detail follows.
    pub(super) fn extent_words(&self) -> &'static str {
        let extent = FootprintExtent::ALL
            .into_iter()
            .find(|extent| extent.name() == self.extent);
        match extent.unwrap_or_default() {
            FootprintExtent::Longer => "the longer side",
            FootprintExtent::Area => "the area",
            FootprintExtent::Shorter => "the shorter axis",
        }
    }
}

impl Texture {
    /// What it shows beyond its border, where it does not end there.
    fn wrap_words(&self) -> &'static str {
        match self.wrap {
            "repeat" => ", repeated beyond its border",
            "mirror" => ", mirrored beyond its border",
            _ => "",
        }
    }

    /// How it is read inside a level.
    fn sampling_words(&self) -> String {
        let own = match (&self.area, self.pixel_sampling) {
            // These ask for no pixel sampling.
            (Some(AreaUse::Ellipse { .. }), _) => return "by a Gaussian over an ellipse".to_owned(),
            (Some(AreaUse::Box { .. }), _) => return "as the mean of a box".to_owned(),
            (_, own @ ("nearest" | "bilinear")) => own.to_owned(),
            (_, cubic) => format!("by the cubic kernel {cubic}"),
        };
        let asked = if self.asked { " as image-rendering asks" } else { "" };
        own + asked
    }

    /// The level of detail before it is clamped, and where it is from.
    fn detail_words(&self) -> String {
        let Some(lod) = self.level_of_detail else {
            return if self.major > 0.0 {
                format!("none, as {} of the footprint is 0", self.extent_words())
            } else {
                "none (no change)".to_owned()
            };
        };
        let by = if self.fixed {
            " as the settings say".to_owned()
        } else if self.extent == FootprintExtent::Longer.name() || self.taps > 1 || self.area.is_some() {
            String::new()
        } else {
            format!(" by {}", self.extent_words())
        };
        match self.bias {
            bias if bias != 0.0 => {
                let (sign, size) = if bias < 0.0 { ("-", -bias) } else { ("+", bias) };
                format!("{:.3}{by} {sign} {} of bias = {lod:.3}", lod - bias, number(size))
            }
            _ => format!("{lod:.3}{by}"),
        }
    }

    pub(super) fn lines(&self) -> Vec<String> {
        let vector = |[x, y]: [f64; 2]| format!("({}, {})", significant(x), significant(y));
        let [width, height] = self.size;
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        let [long, wide] = self.footprint();
        let mut lines = vec![
            format!(
                "texture {} of {width} x {height} texels, read {}{}",
                self.name,
                self.sampling_words(),
                self.wrap_words()
            ),
            format!(
                "one {} right is {} texels, down {}",
                self.step,
                vector(self.right),
                vector(self.down)
            ),
            format!(
                "these steps are {} and {} texels long, the footprint {} by {}",
                significant(length(self.right)),
                significant(length(self.down)),
                significant(long),
                significant(wide)
            ),
        ];
        if self.taps > 1 {
            lines.push(format!("anisotropy  {} taps along the longer side", self.taps));
        }
        lines.extend(self.area.as_ref().map(AreaUse::words));
        lines.push(format!(
            "level of detail  {}, clamped {:.3}; level sampling {}",
            self.detail_words(),
            self.clamped,
            self.level_sampling
        ));
        let levels: Vec<String> = self
            .levels
            .iter()
            .map(|level| {
                let [width, height] = level.size;
                format!(
                    "{} of level {} ({width} x {height})",
                    percent(level.weight),
                    level.number
                )
            })
            .collect();
        let is_coarse = self.levels.iter().any(|level| level.number > 0);
        let averaged = match (self.filtered_by(), self.averaged_in()) {
            _ if !is_coarse => "",
            (PyramidFilter::Box, ResolveSpace::Stored) => "",
            (PyramidFilter::Box, ResolveSpace::Linear) => ", averaged in linear light",
            (PyramidFilter::Tent, ResolveSpace::Stored) => ", made by a tent of two texels",
            (PyramidFilter::Tent, ResolveSpace::Linear) => ", made by a tent of two texels in linear light",
            (PyramidFilter::Kaiser, ResolveSpace::Stored) => ", made by a Kaiser filter of six texels",
            (PyramidFilter::Kaiser, ResolveSpace::Linear) => ", made by a Kaiser filter of six texels in linear light",
        };
        lines.push(format!("reads  {}{averaged}", levels.join(" and ")));
        if self.opacity < 1.0 {
            lines.push(format!("opacity  {}", number(self.opacity)));
        }
        lines
    }
}

impl Texture {
    /// The axes of the ellipse that the circle in a pixel (or in what a sample stands for) is on the texture, the longer one
    /// first, in texels: the singular values of the two steps. Levels and taps follow from the steps' lengths instead.
    pub(super) fn footprint(&self) -> [f64; 2] {
        let ([a, b], [c, d]) = (self.right, self.down);
        let squares = a * a + b * b + c * c + d * d;
        let area = (a * d - b * c).abs();
        let apart = (squares * squares - 4.0 * area * area).max(0.0).sqrt();
        let long = f64::midpoint(squares, apart).sqrt();
        [long, if long > 0.0 { area / long } else { 0.0 }]
    }
}

/// A part of one as a channel.
#[expect(clippy::cast_possible_truncation, reason = "colours are 32-bit floats")]
fn unit(value: f64) -> f32 {
    value as f32
}

/// A premultiplied colour in levels.
pub(super) fn color([r, g, b, a]: [f64; 4]) -> String {
    let [r, g, b] = [r, g, b].map(number);
    if a >= 255.0 {
        format!("{r}, {g}, {b}")
    } else {
        format!("{r}, {g}, {b}, alpha {} (premultiplied)", number(a))
    }
}
