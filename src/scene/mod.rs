//! Documents to scenes: XML, dialects, attributes and styles, everything resolved.
//!
//! What leaves this room holds no string that is still to be interpreted: user-space geometry in painter's order,
//! colours as numbers, textures decoded. Every shape remembers where in the document it stands.

mod model;

pub use model::{Dialect, Paint, Primitive, PrimitiveKind, Scene, Shape, ShapeId, SourceLocation, TextureId};
