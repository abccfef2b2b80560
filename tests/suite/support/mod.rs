//! What many tests need: small scenes, and the brute-force renderer that knows no tiles.

pub(crate) mod brute_force;
pub(crate) mod documents;
pub(crate) mod folder;
pub(crate) mod golden;
pub(crate) mod mutation;
pub(crate) mod program;
pub(crate) mod refusal;
pub(crate) mod scenes;
pub(crate) mod session;
