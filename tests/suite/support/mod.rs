//! What many tests need: small scenes, the brute-force renderer that knows no tiles, and one
//! that makes mistakes.

mod area_filters;
pub(crate) mod areas;
pub(crate) mod brute_force;
pub(crate) mod documents;
pub(crate) mod explaining;
pub(crate) mod folder;
pub(crate) mod foreign;
pub(crate) mod golden;
pub(crate) mod mutation;
pub(crate) mod program;
pub(crate) mod refusal;
pub(crate) mod resolve_filters;
pub(crate) mod scenes;
pub(crate) mod session;
pub(crate) mod smaa;
