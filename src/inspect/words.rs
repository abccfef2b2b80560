//! The report in words: one sentence per fact, as a teacher would say it. Text, Markdown and the window's tree are made of
//! these lines.

use super::model::{Explanation, Fragment, Paint, Shape, Source, View};
use super::numbers::{about, hex, number, percent, runs, weight, which};
use super::part_words::{Composited, color};
use crate::color::ResolveSpace;

/// Why a fragment is not seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unseen {
    /// A clip path or mask, the paint of this number, leaves nothing of it.
    TakenBy(usize),
    /// It has no opacity.
    Transparent,
    /// Its layer is blended with what is below so that nothing changes.
    Neutral,
    /// Something is painted over it.
    Hidden,
}

impl Explanation {
    /// Where the pixel is, and its colour.
    pub fn pixel_lines(&self) -> Vec<String> {
        let [r, g, b, a] = self.color;
        let seen = self.seen_words();
        let unit = self.color.map(|byte| format!("{:.4}", f64::from(byte) / 255.0));
        let mut lines = vec![
            format!(
                "centre      ({}, {}) in canvas units",
                number(self.user[0]),
                number(self.user[1])
            ),
            format!("colour      {}  red {r}, green {g}, blue {b}, alpha {a}", self.hex),
            format!("as parts    {}", unit.join(" ")),
            seen,
        ];
        if self.resolved() != self.color {
            lines.push(format!("SMAA made this colour of {}.", hex(self.resolved())));
        }
        lines
    }

    /// What the samples show, in one sentence, such as `9 of 16 samples show 1 (polygon "left", line 3), 7 show the background.`
    fn seen_words(&self) -> String {
        if self.exact {
            return self.area_words();
        }
        let mut seen: Vec<(Option<usize>, usize)> = Vec::new();
        for sample in &self.samples {
            match seen.iter().position(|(other, _)| *other == sample.seen) {
                Some(known) => seen[known].1 += 1,
                None => seen.push((sample.seen, 1)),
            }
        }
        seen.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let what = |seen: Option<usize>| match seen.and_then(|paint| Some((paint, self.paints.get(paint)?))) {
            Some((paint, found)) => format!("{} ({})", paint + 1, found.name()),
            None => "the background".to_owned(),
        };
        let all = self.samples.len();
        match seen.as_slice() {
            [(only, 1)] => format!("Its only sample shows {}.", what(*only)),
            [(only, _)] => format!("All {all} samples show {}.", what(*only)),
            several => {
                let parts = several.iter().enumerate().map(|(i, (seen, count))| {
                    let verb = if *count == 1 { "shows" } else { "show" };
                    let of = if i == 0 {
                        format!(" of {all} samples")
                    } else {
                        String::new()
                    };
                    format!("{count}{of} {verb} {}", what(*seen))
                });
                format!("{}.", parts.collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// Such as `sample 3 at (0.625, 0.125)`; samples are counted from 1 in words.
    pub fn sample_title(&self, sample: usize) -> String {
        let at = self
            .samples
            .get(sample)
            .map(|sample| sample.position)
            .unwrap_or_default();
        if self.exact {
            return "the pixel's centre".to_owned();
        }
        format!("sample {} at ({}, {})", sample + 1, number(at[0]), number(at[1]))
    }

    /// The colour of a sample and what made it, from the top down: of its stack the topmost few.
    pub fn short_sample_lines(&self, sample: usize) -> Vec<String> {
        /// So many fit beside a picture of the pixel.
        const MOST: usize = 3;
        let Some(found) = self.samples.get(sample) else {
            return Vec::new();
        };
        vec![
            format!("colour  {}", color(found.color)),
            format!("shows   {}", self.stack_from(sample, MOST)),
        ]
    }

    /// The stack of a sample, from the top down, such as `2 over 1 over the background`.
    pub fn stack(&self, sample: usize) -> String {
        self.stack_from(sample, usize::MAX)
    }

    /// The same, of which only the topmost are named one by one.
    fn stack_from(&self, sample: usize, most: usize) -> String {
        let Some(found) = self.samples.get(sample) else {
            return String::new();
        };
        let mut words: Vec<String> = found
            .stack
            .iter()
            .rev()
            .take(most)
            .map(|paint| {
                let note = match self.unseen(*paint, sample) {
                    None => "",
                    Some(Unseen::TakenBy(_)) => " (taken away)",
                    Some(Unseen::Transparent) => " (transparent)",
                    Some(Unseen::Neutral) => " (changes nothing)",
                    Some(Unseen::Hidden) => " (hidden)",
                };
                format!("{}{note}", paint + 1)
            })
            .collect();
        let others = found.unlisted + found.stack.len() - words.len();
        if others > 0 {
            words.push(format!("{others} more"));
        }
        words.push("the background".to_owned());
        words.join(" over ")
    }

    /// Why a fragment is not seen; `None` where it is, and where there is none.
    fn unseen(&self, paint: usize, sample: usize) -> Option<Unseen> {
        let fragment = self.fragment(paint, sample).filter(|fragment| !fragment.seen)?;
        if self.paints[paint].in_mask {
            return None;
        }
        // How many layers are open that began later: what ends one of them does not act on this paint.
        let mut later = 0_usize;
        for (number, found) in self.paints.iter().enumerate().skip(paint + 1) {
            match found.shape {
                Shape::BeginLayer => later += 1,
                Shape::EndLayer { .. } => {
                    let own = later == 0;
                    later = later.saturating_sub(1);
                    if own && self.fragment(number, sample).is_some_and(Fragment::is_neutral) {
                        return Some(Unseen::Neutral);
                    }
                }
                Shape::EndClip | Shape::EndMask { .. } => {
                    later = later.saturating_sub(1);
                    let keeps = |fragment: &Fragment| fragment.color[3] > 0.0;
                    if later == 0 && !self.fragment(number, sample).is_some_and(keeps) {
                        return Some(Unseen::TakenBy(number));
                    }
                }
                _ => {}
            }
        }
        Some(if fragment.color[3] <= 0.0 {
            Unseen::Transparent
        } else {
            Unseen::Hidden
        })
    }

    /// The fragment that a paint left on a sample.
    pub fn fragment(&self, paint: usize, sample: usize) -> Option<&Fragment> {
        let fragments = &self.paints.get(paint)?.fragments;
        fragments.iter().find(|fragment| fragment.sample == sample)
    }

    /// Such as `2  triangle of polygon "left", line 12`; paints are counted from 1 in words.
    pub fn paint_title(&self, paint: usize) -> String {
        let Some(found) = self.paints.get(paint) else {
            return String::new();
        };
        format!("{}  {}", paint + 1, found.name())
    }

    /// Where a paint stands, what of the pixel it covers, how it reads its texture.
    pub fn paint_lines(&self, paint: usize) -> Vec<String> {
        let Some(found) = self.paints.get(paint) else {
            return Vec::new();
        };
        let mut lines: Vec<String> = found.source.iter().flat_map(Source::lines).collect();
        lines.push(self.painted_line(paint, found));
        if self.exact {
            // Told already.
        } else if let Some(area) = found.area.filter(|_| found.is_crisp()) {
            let whole = if self.covered_part(found) > 0.0 { "all" } else { "none" };
            let area = percent(area);
            lines.push(format!(
                "covers {area} of the pixel's area, and {whole} of it as drawn: shape-rendering asks for one sample per pixel"
            ));
        } else if let Some(area) = found.area {
            let whose = if found.is_cut {
                "with the other triangles of its outline "
            } else {
                ""
            };
            lines.push(format!(
                "{whose}covers {} of the pixel's area, {} of its samples",
                percent(area),
                percent(self.covered_part(found))
            ));
        }
        if let Shape::Triangle { corners } = &found.shape {
            let corners = corners.map(|[x, y]| format!("({}, {})", number(x), number(y)));
            lines.push(format!("corners A {}  B {}  C {}", corners[0], corners[1], corners[2]));
            if found.is_clipped() {
                let words = "these are of a piece: the triangle reaches too far beyond the frame and was clipped";
                lines.push(words.to_owned());
            }
        }
        lines.extend(found.server_lines());
        lines
    }

    /// What a paint does to the pixel's samples.
    fn painted_line(&self, paint: usize, found: &Paint) -> String {
        let all = self.samples.len();
        let count = found.fragments.len();
        match &found.shape {
            Shape::BeginLayer if found.in_mask => {
                "what follows is the shape of a clip path or mask: it takes away, and is not seen itself".to_owned()
            }
            Shape::BeginLayer => "what follows is painted on a transparent layer".to_owned(),
            Shape::EndLayer { opacity, blend: None } => {
                format!(
                    "the layer is painted over what is below, at opacity {}",
                    number(*opacity)
                )
            }
            Shape::EndLayer {
                opacity,
                blend: Some(blend),
            } => {
                format!(
                    "the layer is blended with what is below by {blend}, at opacity {}",
                    number(*opacity)
                )
            }
            Shape::EndClip => {
                let by = if found.is_clip_path() { "clip path" } else { "viewport" };
                format!("what is below stays where the {by} covers it: {}", self.kept(found))
            }
            Shape::EndMask { by } => {
                format!(
                    "what is below stays as far as the mask's {by} lets it: {}",
                    self.kept(found)
                )
            }
            Shape::Triangle { .. } | Shape::Polygon { .. } if self.exact => self.area_line(paint, found),
            Shape::WholePixel | Shape::CanvasOutline => {
                "one pixel wide at every zoom: paints whole pixels, whatever the samples".to_owned()
            }
            Shape::Triangle { .. } | Shape::Polygon { .. } if found.in_mask => {
                format!("part of a clip path or mask: lies on {}", which(&found.samples(), all))
            }
            Shape::Triangle { .. } | Shape::Polygon { .. } => {
                let lost = |is_so: fn(Unseen) -> bool, what: &str| {
                    let samples = found.samples().into_iter();
                    let lost: Vec<usize> = samples
                        .filter(|sample| self.unseen(paint, *sample).is_some_and(is_so))
                        .collect();
                    match lost.len() {
                        0 => String::new(),
                        1 if count == 1 => format!("; it is {what}"),
                        lost if lost == count => format!("; all are {what}"),
                        _ => format!("; {what} on {}", runs(&lost)),
                    }
                };
                let lost = [
                    lost(|why| matches!(why, Unseen::TakenBy(_)), "taken away again"),
                    lost(|why| why == Unseen::Transparent, "transparent"),
                    lost(|why| why == Unseen::Neutral, "without effect"),
                    lost(|why| why == Unseen::Hidden, "hidden"),
                ];
                format!("paints {}{}", which(&found.samples(), all), lost.concat())
            }
        }
    }

    /// What a paint does to a pixel that has areas and no samples.
    fn area_line(&self, paint: usize, found: &Paint) -> String {
        let part = if found.in_mask {
            "; part of a clip path or mask"
        } else {
            ""
        };
        let lost = match self.unseen(paint, 0) {
            None => "",
            Some(Unseen::TakenBy(_)) => "; it is taken away again",
            Some(Unseen::Transparent) => "; it is transparent",
            Some(Unseen::Neutral) => "; it changes nothing",
            Some(Unseen::Hidden) => "; it is hidden",
        };
        format!(
            "paints {} of the pixel{part}{lost}",
            percent(found.covered.unwrap_or(0.0))
        )
    }

    /// Which samples a clip path or mask leaves something of, in words.
    fn kept(&self, mask: &Paint) -> String {
        if self.exact {
            let kept = mask.fragments.first().map_or(0.0, |fragment| fragment.color[3]);
            return format!("{} of it", percent(kept / 255.0));
        }
        let kept = mask.fragments.iter().filter(|fragment| fragment.color[3] > 0.0);
        let kept: Vec<usize> = kept.map(|fragment| fragment.sample).collect();
        let whole = |fragment: &&Fragment| fragment.color[3] >= 255.0;
        let in_part = kept.len() - mask.fragments.iter().filter(whole).count();
        let all = self.samples.len();
        match (kept.len(), in_part) {
            (0, _) => "it takes away all samples".to_owned(),
            (count, 0) if count == all => "it takes away none".to_owned(),
            (count, 0) => format!("{count} of {all} samples stay: {}", runs(&kept)),
            (1, _) if all == 1 => "it takes a part of the only sample".to_owned(),
            (count, part) if count == all => format!("it takes a part of {part} of {all} samples"),
            (count, part) => format!("{count} of {all} samples stay, {part} of them in part: {}", runs(&kept)),
        }
    }

    /// What a sample sees of a paint: edges, weights, texels, blending.
    pub fn fragment_lines(&self, paint: usize, sample: usize) -> Vec<String> {
        let Some(found) = self.paints.get(paint) else {
            return Vec::new();
        };
        let mut lines = Vec::new();
        match found.views.get(sample) {
            Some(View::Triangle { edges, weights, value }) => {
                for (name, edge) in ["AB", "BC", "CA"].iter().zip(edges) {
                    lines.push(format!("edge {name}   {}", edge.words()));
                }
                lines.extend(found.shaded_line());
                let [a, b, c] = weights;
                let of = if found.is_clipped() {
                    ", of the whole triangle"
                } else {
                    ""
                };
                let [a, b, c] = [a, b, c].map(|value| weight(*value));
                lines.push(format!("weights   A {a}  B {b}  C {c}{of}"));
                lines.extend(value.lines());
            }
            Some(View::Polygon { winding, value }) => {
                let rule = match &found.shape {
                    Shape::Polygon { rule, .. } => rule,
                    _ => "nonzero",
                };
                let inside = if self.exact {
                    *winding != 0 && (winding % 2 != 0 || rule == "nonzero")
                } else {
                    self.fragment(paint, sample).is_some()
                };
                let verdict = if inside { "inside" } else { "outside" };
                // What is scanned of a crisp shape are whole pixels.
                lines.push(if found.is_crisp() {
                    format!("crisp     the pixel's middle is {verdict} by the rule {rule}, and so are all its samples")
                } else {
                    format!("winding   {winding}: {verdict} by the rule {rule}")
                });
                lines.extend(found.shaded_line());
                lines.extend(value.lines());
            }
            None => {}
        }
        match self.fragment(paint, sample) {
            Some(fragment) => {
                lines.extend(fragment.lines(
                    found,
                    Composited {
                        exact: self.exact,
                        in_light: self.resolve.space == ResolveSpace::Linear.name(),
                    },
                ));
                lines.extend(self.unseen(paint, sample).map(|why| match why {
                    Unseen::TakenBy(mask) => format!("and is taken away by {}", self.paint_title(mask)),
                    Unseen::Transparent => "and shows nothing of itself".to_owned(),
                    Unseen::Neutral => "and its layer changes nothing of what is below it".to_owned(),
                    Unseen::Hidden => "and is hidden by what is painted later".to_owned(),
                }));
            }
            None if found.in_mask && !found.shape.is_layer_mark() => {
                lines.push("does not lie on this sample".to_owned());
            }
            None => lines.push("leaves this sample as it was".to_owned()),
        }
        lines
    }

    /// What is not listed of a deep stack, in one sentence.
    pub fn unlisted_words(&self) -> Option<String> {
        let listed = self.paints.len();
        (self.unlisted > 0).then(|| {
            format!(
                "{} more paint this pixel below; the last ones are listed, and what samples show: {listed} in all.",
                self.unlisted
            )
        })
    }

    /// What covers parts of the pixel, and none of its samples.
    pub fn missed_lines(&self) -> Vec<String> {
        /// The part of an area that has to be left for nothing to be said of the rest.
        const MOSTLY: f64 = 0.75;
        /// So much may come of where the truth's samples lie.
        const TOLD: f64 = 1.0 / 64.0;
        let line = |missed: &super::model::Missed| {
            let Source { file, line, column, .. } = &missed.source;
            let area = percent(missed.area);
            let shown = missed.shown.map_or(String::new(), |shown| match shown {
                _ if missed.in_mask => "; it is part of a clip path or mask".to_owned(),
                0.0 => "; nothing of it shows there".to_owned(),
                shown if shown < missed.area * MOSTLY && missed.area - shown > TOLD => {
                    format!("; {} of the pixel shows it", about(shown))
                }
                _ => String::new(),
            });
            let of = match (missed.part, missed.stroke) {
                (true, _) => "triangle of ",
                (false, true) => "stroke of ",
                (false, false) => "",
            };
            let name = missed.source.name();
            let what = if missed.crisp {
                "not its middle, where shape-rendering asks for its one sample"
            } else {
                "no sample"
            };
            let what = what.to_owned() + &self.tie_words(missed);
            format!("{of}{name} at {file}:{line}:{column} covers {area} of the pixel, and {what}{shown}")
        };
        self.missed.iter().map(line).collect()
    }

    /// The sample that explains a paint best: the first that is seen, else the first that it painted.
    pub fn telling_sample(&self, paint: usize) -> Option<usize> {
        let fragments = &self.paints.get(paint)?.fragments;
        let seen = fragments.iter().find(|fragment| fragment.seen);
        Some(seen.or(fragments.first())?.sample)
    }
}
