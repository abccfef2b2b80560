//! Paint servers: gradients and patterns, each once however many shapes it fills.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;
use std::sync::Arc;

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use usvg::{BaseGradient, LinearGradient, Paint, RadialGradient};

use super::affine::affine;
use super::elements::Elements;
use super::painter::{Inside, Key, Painter, Place, Servers, color};
use super::references;
use crate::color::{Ramp, Spread, Stop};
use crate::geometry::GradientShape;
use crate::scene::error::Fault;
use crate::scene::{Fill, Gradient, GradientId, Pattern, PatternId, Scene, ShapeId};
use crate::texture::TileCache;

impl Servers {
    /// Remembers which gradients the document has.
    pub(super) fn name(&mut self, tree: &usvg::Tree, elements: &Elements<'_>) {
        let linear = tree.linear_gradients().iter();
        let radial = tree.radial_gradients().iter();
        let looks = linear.map(|gradient| (linear_look(gradient), gradient.id()));
        for (look, id) in looks.chain(radial.map(|gradient| (radial_look(gradient), gradient.id()))) {
            if elements.find(id).is_some() {
                self.names.entry(look).or_insert_with(|| id.to_owned());
            }
        }
    }
}

impl<'doc> Painter<'_, 'doc> {
    /// What fills a shape; `None` where nothing does.
    pub(super) fn server(&mut self, paint: &Paint, place: Place) -> Result<Option<Fill>, Fault> {
        if place.opacity <= 0.0 {
            return Ok(None);
        }
        Ok(match paint {
            Paint::Color(solid) => Some(Fill::Solid(color(*solid, place.opacity))),
            Paint::LinearGradient(gradient) => {
                let shape = GradientShape::Linear {
                    from: DVec2::new(gradient.x1().into(), gradient.y1().into()),
                    to: DVec2::new(gradient.x2().into(), gradient.y2().into()),
                };
                let element = GradientElement {
                    base: gradient,
                    address: Arc::as_ptr(gradient) as usize,
                    look: linear_look(gradient),
                };
                self.gradient(&element, shape, place)
            }
            Paint::RadialGradient(gradient) => {
                let shape = GradientShape::Radial {
                    center: DVec2::new(gradient.cx().into(), gradient.cy().into()),
                    radius: gradient.r().get().into(),
                    focus: DVec2::new(gradient.fx().into(), gradient.fy().into()),
                    focal_radius: gradient.fr().get().into(),
                };
                let element = GradientElement {
                    base: gradient,
                    address: Arc::as_ptr(gradient) as usize,
                    look: radial_look(gradient),
                };
                self.gradient(&element, shape, place)
            }
            Paint::Pattern(pattern) => self.pattern(pattern, place)?.map(Fill::Pattern),
        })
    }

    fn gradient(&mut self, element: &GradientElement<'_>, geometry: GradientShape, place: Place) -> Option<Fill> {
        let gradient = element.base;
        let to_user = place.to_user * affine(gradient.transform());
        let key = key(element.address, place.opacity, to_user);
        if let Some(known) = self.servers.gradients.get(&key) {
            return known.map(Fill::Gradient);
        }
        let stops = gradient.stops().iter().map(|stop| Stop {
            offset: stop.offset().get(),
            color: color(stop.color(), stop.opacity().get() * place.opacity),
        });
        let spread = match gradient.spread_method() {
            usvg::SpreadMethod::Pad => Spread::Pad,
            usvg::SpreadMethod::Reflect => Spread::Reflect,
            usvg::SpreadMethod::Repeat => Spread::Repeat,
        };
        let id = Ramp::new(stops.collect(), spread).and_then(|ramp| {
            let shape = self.shape_of_gradient(gradient.id(), &element.look, place.shape);
            let gradient = Gradient {
                shape,
                geometry,
                ramp,
                to_user,
            };
            let id = GradientId(u32::try_from(self.builder.gradients.len()).ok()?);
            self.builder.gradients.push(gradient);
            Some(id)
        });
        self.servers.gradients.insert(key, id);
        id.map(Fill::Gradient)
    }

    fn shape_of_gradient(&mut self, id: &str, look: &Vec<u32>, around: ShapeId) -> ShapeId {
        let named = self.servers.names.get(look).map_or("", String::as_str);
        let node = self.elements.find(id).or_else(|| self.elements.find(named));
        node.or_else(|| self.gradient_of_element())
            .map_or(around, |node| self.shape(node))
    }

    /// The gradient that the path being painted refers to, if it is one: usvg does not tell which are inside masks.
    fn gradient_of_element(&self) -> Option<Node<'doc, 'doc>> {
        let referred = |property| self.elements.own(references::inherited(self.painting?, property)?);
        let is_gradient = |node: &Node<'_, '_>| node.tag_name().name().ends_with("Gradient");
        let [fill, stroke] = ["fill", "stroke"].map(|property| referred(property).filter(is_gradient));
        fill.xor(stroke)
    }

    fn pattern(&mut self, pattern: &Arc<usvg::Pattern>, place: Place) -> Result<Option<PatternId>, Fault> {
        let rect = pattern.rect();
        let corner = DVec2::new(rect.x().into(), rect.y().into());
        let to_user = place.to_user * affine(pattern.transform()) * DAffine2::from_translation(corner);
        let key = key(Arc::as_ptr(pattern) as usize, place.opacity, to_user);
        if let Some(known) = self.servers.patterns.get(&key) {
            return Ok(*known);
        }
        let shape = self.definition(pattern.id(), pattern.root(), "pattern", place.shape);
        let id = self.tile(pattern, to_user)?.and_then(|tile| {
            let id = PatternId(u32::try_from(self.builder.patterns.len()).ok()?);
            self.builder.patterns.push(Pattern {
                shape,
                tile,
                to_user,
                opacity: place.opacity,
                drawn: TileCache::default(),
            });
            Some(id)
        });
        self.servers.patterns.insert(key, id);
        Ok(id)
    }

    /// One tile of a pattern; `None` where nothing is on it.
    fn tile(&mut self, pattern: &Arc<usvg::Pattern>, to_user: DAffine2) -> Result<Option<Arc<Scene>>, Fault> {
        let matrix = to_user.matrix2;
        let stretch = matrix.x_axis.length().max(matrix.y_axis.length());
        let scale = self.scale * stretch;
        let key = (Arc::as_ptr(pattern) as usize, scale.to_bits());
        if let Some(tile) = self.servers.tiles.get(&key) {
            return Ok(tile.clone());
        }
        let size = DVec2::new(pattern.rect().width().into(), pattern.rect().height().into());
        // A scene has its own shapes, gradients and patterns.
        let builder = &mut *self.builder;
        let (root, elements, pictures) = (self.root, self.elements, self.pictures);
        let image = self
            .inside
            .and_then(|inside| Some((builder.shapes.get(inside.image.0 as usize)?.clone(), inside.triangles)));
        let names = std::mem::take(&mut self.servers.names);
        let effects = Rc::clone(&self.effects);
        let markers = Rc::clone(&self.markers);
        let told = std::mem::take(&mut self.told);
        let mut back = (HashMap::new(), HashSet::new());
        let drawn = builder.apart(size, |builder| {
            let mut painter = Painter::new(builder, root, elements, pictures, scale);
            painter.servers.names = names;
            painter.effects = effects;
            painter.markers = markers;
            painter.told = told;
            let shape = match image {
                Some((shape, triangles)) => {
                    painter.builder.shapes.push(shape);
                    let image = ShapeId(0);
                    painter.inside = Some(Inside { image, triangles });
                    image
                }
                None => painter.shape(root),
            };
            let place = Place {
                to_user: DAffine2::IDENTITY,
                shape,
                opacity: 1.0,
            };
            let painted = painter.children(pattern.root(), place);
            back = (std::mem::take(&mut painter.servers.names), painter.told);
            painted
        });
        (self.servers.names, self.told) = back;
        let tile = Some(drawn?).filter(|scene| !scene.primitives.is_empty()).map(Arc::new);
        self.servers.tiles.insert(key, tile.clone());
        Ok(tile)
    }
}

fn key(address: usize, opacity: f32, to_user: DAffine2) -> Key {
    (address, opacity.to_bits(), to_user.to_cols_array().map(f64::to_bits))
}

/// What a gradient shows, but for its place: the same for all copies of one.
fn look(gradient: &BaseGradient, geometry: &[f32]) -> Vec<u32> {
    let mut look: Vec<u32> = geometry.iter().map(|number| number.to_bits()).collect();
    look.push(match gradient.spread_method() {
        usvg::SpreadMethod::Pad => 0,
        usvg::SpreadMethod::Reflect => 1,
        usvg::SpreadMethod::Repeat => 2,
    });
    for stop in gradient.stops() {
        let usvg::Color { red, green, blue } = stop.color();
        look.push(u32::from_be_bytes([0, red, green, blue]));
        look.extend([stop.offset().get(), stop.opacity().get()].map(f32::to_bits));
    }
    look
}

/// A gradient as usvg tells it.
struct GradientElement<'a> {
    base: &'a BaseGradient,
    /// Tells it from others.
    address: usize,
    /// By which its element is found where usvg gave it another name.
    look: Vec<u32>,
}

fn linear_look(gradient: &LinearGradient) -> Vec<u32> {
    look(gradient, &[gradient.x1(), gradient.y1(), gradient.x2(), gradient.y2()])
}

fn radial_look(gradient: &RadialGradient) -> Vec<u32> {
    let radii = [gradient.r().get(), gradient.fr().get()];
    let middles = [gradient.cx(), gradient.cy(), gradient.fx(), gradient.fy()];
    look(gradient, &[radii.as_slice(), &middles].concat())
}
