//! The scenes, a file per folder of `svg`.

mod basic;
mod floor;
mod hardcore;
mod illustration;
mod locomotive;
mod mesh;
mod outline;
mod study;
mod study_kernels;
mod study_patterns;
mod study_shading;
mod study_shown;
mod study_textures;
mod subdiv;
mod texmap;
mod transforms;

use super::SceneFile;

/// Every scene that is made by code.
pub(crate) fn scenes() -> Vec<SceneFile> {
    [
        illustration::SCENES,
        basic::SCENES,
        texmap::SCENES,
        transforms::SCENES,
        hardcore::SCENES,
        subdiv::SCENES,
        study::SCENES,
        study_textures::SCENES,
        study_patterns::SCENES,
        study_shown::SCENES,
        study_shading::SCENES,
        study_kernels::SCENES,
    ]
    .concat()
}
