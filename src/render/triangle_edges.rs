//! The triangles near a pixel by their edges, for who asks which of them continue one.

use std::collections::HashMap;
use std::sync::OnceLock;

/// The ends of an edge, as they can be looked up: in an order that does not depend on whose it is.
pub(super) type Ends = [[u64; 2]; 2];

/// The triangles near a pixel, by their edges.
#[derive(Debug, Default)]
pub(super) struct TriangleEdges {
    /// Found when somebody asks.
    pub(super) with: OnceLock<HashMap<Ends, Vec<u32>>>,
}
