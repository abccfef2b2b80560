//! Why a pixel has its colour, in one call.

use rasterscope::geometry::View;
use rasterscope::inspect::{Explanation, Question};
use rasterscope::render::{RenderSettings, Subject};
use rasterscope::scene::Scene;

/// Why one pixel of the whole canvas, as a picture of `size` pixels, has its colour, and what would help.
pub(crate) fn advised(scene: &Scene, settings: &RenderSettings, size: [u32; 2], pixel: [u32; 2]) -> Explanation {
    advised_in(scene, settings, (View::Canvas, size), pixel)
}

/// As [`advised`], of the picture from any view.
pub(crate) fn advised_in(
    scene: &Scene,
    settings: &RenderSettings,
    shown: (View, [u32; 2]),
    pixel: [u32; 2],
) -> Explanation {
    told(scene, settings, shown, pixel, Explanation::advised)
}

/// As [`advised`], of the picture that is drawn where no view is asked for.
pub(crate) fn advised_by_default(
    scene: &Scene,
    settings: &RenderSettings,
    size: [u32; 2],
    pixel: [u32; 2],
) -> Explanation {
    advised_in(scene, settings, (View::Default, size), pixel)
}

/// As [`advised`], of the picture that is drawn where no view is asked for, without what would help.
pub(crate) fn explained(scene: &Scene, settings: &RenderSettings, size: [u32; 2], pixel: [u32; 2]) -> Explanation {
    told(scene, settings, (View::Default, size), pixel, Explanation::new)
}

fn told(
    scene: &Scene,
    settings: &RenderSettings,
    (view, size): (View, [u32; 2]),
    pixel: [u32; 2],
    ask: fn(&Question<'_>) -> Option<Explanation>,
) -> Explanation {
    let view = view.transform(scene.canvas, size);
    let subject = Subject {
        scene,
        view: &view,
        settings,
    };
    let question = Question {
        subject,
        file: "scene.svg",
        size,
        pixel,
    };
    ask(&question).unwrap()
}
