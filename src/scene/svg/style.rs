//! Properties: from presentation attributes and the `style` attribute, inherited from element to element.

use roxmltree::Node;
use svgtypes::{Length, LengthUnit};

use super::declarations::declarations;
use super::values::{self, Along, SvgPaint, Units};
use crate::color::Rgba;
use crate::geometry::{FillRule, LineCap, LineJoin};

/// Properties that the reader understands. `font-size` and `color` come first: others refer to them.
const PROPERTIES: [&str; 15] = [
    "font-size",
    "color",
    "fill",
    "fill-opacity",
    "fill-rule",
    "stroke",
    "stroke-opacity",
    "stroke-width",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-miterlimit",
    "visibility",
    "opacity",
    "display",
    "transform",
];

/// Properties that change the picture and are not drawn, with the value that means no change.
const WITHOUT_EFFECT: [(&str, &str); 13] = [
    ("clip-path", "none"),
    ("mask", "none"),
    ("filter", "none"),
    ("stroke-dasharray", "none"),
    ("marker", "none"),
    ("marker-start", "none"),
    ("marker-mid", "none"),
    ("marker-end", "none"),
    ("mix-blend-mode", "normal"),
    ("isolation", "auto"),
    ("paint-order", "normal"),
    ("vector-effect", "none"),
    ("transform-origin", "0 0"),
];

/// What an element hands down to its children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub(super) font_size: f64,
    pub(super) color: Rgba,
    pub(super) fill: SvgPaint,
    pub(super) fill_opacity: f32,
    pub(super) fill_rule: FillRule,
    pub(super) stroke: SvgPaint,
    pub(super) stroke_opacity: f32,
    pub(super) stroke_width: Length,
    pub(super) cap: LineCap,
    pub(super) join: LineJoin,
    pub(super) miter_limit: f64,
    pub(super) visible: bool,
}

/// What an element keeps to itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OwnStyle<'doc> {
    pub(super) opacity: f32,
    pub(super) displayed: bool,
    pub(super) transform: Option<&'doc str>,
}

/// What was wrong with the properties of one element.
#[derive(Debug, Default)]
pub(super) struct Complaints<'doc> {
    /// Names and values that could not be understood.
    pub(super) invalid: Vec<(&'static str, &'doc str)>,
    /// Names of properties without effect.
    pub(super) without_effect: Vec<&'static str>,
}

impl Style {
    /// The initial values of SVG.
    pub(super) const INITIAL: Self = Self {
        font_size: 16.0,
        color: Rgba::BLACK,
        fill: SvgPaint::Color(Rgba::BLACK),
        fill_opacity: 1.0,
        fill_rule: FillRule::NonZero,
        stroke: SvgPaint::None,
        stroke_opacity: 1.0,
        stroke_width: Length {
            number: 1.0,
            unit: LengthUnit::None,
        },
        cap: LineCap::Butt,
        join: LineJoin::Miter,
        miter_limit: 4.0,
        visible: true,
    };

    /// The colour of the fill with its opacity.
    pub(super) fn fill_color(&self) -> Rgba {
        self.paint_color(self.fill).faded(self.fill_opacity)
    }

    /// The colour of the stroke with its opacity.
    pub(super) fn stroke_color(&self) -> Rgba {
        self.paint_color(self.stroke).faded(self.stroke_opacity)
    }

    fn paint_color(&self, paint: SvgPaint) -> Rgba {
        match paint {
            SvgPaint::None => Rgba::TRANSPARENT,
            SvgPaint::CurrentColor => self.color,
            SvgPaint::Color(color) => color,
        }
    }
}

/// Whether the reader knows a property of this name.
pub(super) fn is_property(name: &str) -> bool {
    PROPERTIES.contains(&name)
}

/// The style of `node` below an element of the style `parent`.
pub(super) fn cascade<'doc>(
    node: Node<'doc, 'doc>,
    parent: Style,
    units: Units,
) -> (Style, OwnStyle<'doc>, Complaints<'doc>) {
    let mut complaints = Complaints::default();
    let mut style = parent;
    let mut own = OwnStyle {
        opacity: 1.0,
        displayed: true,
        transform: None,
    };
    let declared = declared(node, &mut complaints);
    for (name, value) in PROPERTIES.into_iter().zip(declared) {
        let Some(value) = value.filter(|value| *value != "inherit") else {
            continue;
        };
        let units = Units {
            font_size: parent.font_size,
            ..units
        };
        let understood = match name {
            "opacity" => values::opacity(value).map(|opacity| own.opacity = opacity),
            "display" => {
                own.displayed = value != "none";
                Some(())
            }
            "transform" => {
                own.transform = Some(value);
                Some(())
            }
            "fill" | "stroke" => style.set_paint(name, value, &mut complaints),
            _ => style.set(name, value, units),
        };
        if understood.is_none() {
            complaints.invalid.push((name, value));
        }
    }
    (style, own, complaints)
}

/// The value of each property: that of the `style` attribute before that of an attribute of its own.
fn declared<'doc>(node: Node<'doc, 'doc>, complaints: &mut Complaints<'doc>) -> [Option<&'doc str>; PROPERTIES.len()] {
    let mut values = [None; PROPERTIES.len()];
    let mut declare = |name: &str, value: &'doc str| {
        let value = value.trim();
        if let Some(i) = PROPERTIES.iter().position(|property| *property == name) {
            values[i] = Some(value);
        } else if let Some((property, harmless)) = WITHOUT_EFFECT.iter().find(|(property, _)| *property == name)
            && value != *harmless
            && !complaints.without_effect.contains(property)
        {
            complaints.without_effect.push(property);
        }
    };
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        declare(attribute.name(), attribute.value());
    }
    for (name, value) in declarations(node.attribute("style").unwrap_or("")) {
        declare(name, value);
    }
    values
}

impl Style {
    fn set_paint(&mut self, name: &'static str, value: &str, complaints: &mut Complaints<'_>) -> Option<()> {
        let (paint, points_elsewhere) = values::paint(value)?;
        let (field, complaint) = match name {
            "fill" => (&mut self.fill, "fill with url()"),
            _ => (&mut self.stroke, "stroke with url()"),
        };
        *field = paint;
        if points_elsewhere {
            complaints.without_effect.push(complaint);
        }
        Some(())
    }

    /// Sets an inherited property; `None` if the value is none.
    fn set(&mut self, name: &str, value: &str, units: Units) -> Option<()> {
        match name {
            "font-size" => self.font_size = font_size(value, units)?,
            "color" => self.color = values::color(value)?,
            "fill-opacity" => self.fill_opacity = values::opacity(value)?,
            "stroke-opacity" => self.stroke_opacity = values::opacity(value)?,
            "fill-rule" => {
                self.fill_rule = match value {
                    "nonzero" => FillRule::NonZero,
                    "evenodd" => FillRule::EvenOdd,
                    _ => return None,
                }
            }
            "stroke-width" => {
                let units = Units {
                    font_size: self.font_size,
                    ..units
                };
                units.length(value, Along::Diagonal).filter(|width| *width >= 0.0)?;
                self.stroke_width = value.parse().ok()?;
                if matches!(self.stroke_width.unit, LengthUnit::Em | LengthUnit::Ex) {
                    self.stroke_width = Length::new_number(units.resolve(self.stroke_width, Along::Diagonal));
                }
            }
            "stroke-linecap" => {
                self.cap = match value {
                    "butt" => LineCap::Butt,
                    "round" => LineCap::Round,
                    "square" => LineCap::Square,
                    _ => return None,
                }
            }
            "stroke-linejoin" => {
                self.join = match value {
                    "miter" | "miter-clip" | "arcs" => LineJoin::Miter,
                    "round" => LineJoin::Round,
                    "bevel" => LineJoin::Bevel,
                    _ => return None,
                }
            }
            "stroke-miterlimit" => {
                let limit: svgtypes::Number = value.parse().ok()?;
                self.miter_limit = Some(limit.0).filter(|limit| *limit >= 1.0)?;
            }
            _ => self.visible = value == "visible",
        }
        Some(())
    }
}

/// A font size in user units; the keywords of CSS around 16.
fn font_size(value: &str, units: Units) -> Option<f64> {
    let parent = units.font_size;
    let size = match value {
        "xx-small" => 9.0,
        "x-small" => 10.0,
        "small" => 13.0,
        "medium" => 16.0,
        "large" => 18.0,
        "x-large" => 24.0,
        "xx-large" => 32.0,
        "smaller" => parent / 1.2,
        "larger" => parent * 1.2,
        _ => {
            // A percentage of the parent's size, whatever the viewport.
            let viewport = glam::DVec2::splat(parent);
            Units { viewport, ..units }.length(value, Along::X)?
        }
    };
    Some(size).filter(|size| *size >= 0.0)
}
