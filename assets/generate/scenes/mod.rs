//! The scenes, a file per folder of `svg`.

mod basic;
mod hardcore;
mod locomotive;
mod outline;
mod subdiv;
mod transforms;

use super::SceneFile;

/// Every scene that is made by code.
pub(crate) fn scenes() -> Vec<SceneFile> {
    [basic::SCENES, transforms::SCENES, hardcore::SCENES, subdiv::SCENES].concat()
}
