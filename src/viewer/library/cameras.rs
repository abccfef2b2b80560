//! Where the window looks at the current scene, and how that is changed.

use glam::{DVec2, dvec2};

use crate::viewer::library::state::SceneList;
use crate::viewer::view::camera::{Camera, ViewContext, ViewNumbers};
use crate::viewer::view::layout::WindowLayout;

impl SceneList {
    /// What the current camera looks at in a frame of this size; `None` before the scene was read.
    pub(in crate::viewer) fn view_context(&self, frame: [u32; 2]) -> Option<ViewContext> {
        let scene = self.current()?.scene()?;
        Some(ViewContext {
            canvas: scene.canvas,
            frame,
        })
    }

    /// The numbers of the current view in a frame of this size; `None` before the scene was read.
    pub(in crate::viewer) fn view_numbers(&self, frame: [u32; 2]) -> Option<ViewNumbers> {
        let entry = self.current()?;
        Some(entry.camera.numbers(&self.view_context(frame)?))
    }

    /// The camera of the current scene.
    pub(in crate::viewer) fn camera(&self) -> Option<Camera> {
        self.current().map(|entry| entry.camera)
    }

    /// Changes the current scene's camera; nothing happens before the scene was read.
    pub(in crate::viewer) fn look(&mut self, frame: [u32; 2], change: impl FnOnce(&mut Camera, &ViewContext)) {
        if let Some((context, entry)) = self.view_context(frame).zip(self.current_mut()) {
            change(&mut entry.camera, &context);
        }
    }

    /// Takes a view back that was set in place of another, unless it was changed since.
    pub(in crate::viewer) fn look_back(&mut self, frame: [u32; 2], [first, set]: [Camera; 2]) {
        self.look(frame, |camera, _| {
            if *camera == set {
                *camera = first;
            }
        });
    }

    /// Fits the view into the part of the window that no panel covers.
    pub(in crate::viewer) fn fit_view(&mut self, layout: &WindowLayout) {
        let part = layout.free_part();
        self.look(layout.frame_size(), |camera, context| camera.fit(part, context));
    }

    /// The default view, or where a panel covers some of the canvas then, the like in the part of the window that is free.
    pub(in crate::viewer) fn reset_view(&mut self, layout: &WindowLayout) {
        if let Some(entry) = self.current_mut() {
            entry.camera = Camera::default();
        }
        let part = layout.free_part();
        self.look(layout.frame_size(), |camera, context| camera.show_canvas(part, context));
    }

    /// Keeps a canvas that no hand has moved where panels leave room for it.
    pub(in crate::viewer) fn follow_free_part(&mut self, layout: &WindowLayout) {
        let part = layout.free_part();
        self.look(layout.frame_size(), |camera, context| camera.follow(part, context));
    }

    /// Frames have another size now, by `factor`: all views go on showing the same part.
    pub(in crate::viewer) fn rescale(&mut self, factor: f64, frame: [u32; 2]) {
        for entry in &mut self.scenes {
            if let Some(canvas) = entry.scene().map(|scene| scene.canvas) {
                entry.camera.rescale(factor, &ViewContext { canvas, frame });
            }
        }
    }

    /// Whether something of the canvas lies in the part of the window that no panel covers; true where there is no scene, or
    /// no canvas that a view could lose.
    pub fn canvas_in_sight(&self, layout: &WindowLayout) -> bool {
        let Some((context, camera)) = self.view_context(layout.frame_size()).zip(self.camera()) else {
            return true;
        };
        layout.fixed_size().is_some() || camera.sees_canvas(layout.free_part(), &context)
    }

    /// Whether a hand has moved the current view.
    pub fn view_is_moved(&self) -> bool {
        self.camera().is_some_and(|camera| !camera.is_untouched())
    }

    /// The corners of the box around the canvas, in frame pixels; `None` before the scene was read.
    pub(crate) fn canvas_in_frame(&self, layout: &WindowLayout) -> Option<[DVec2; 2]> {
        let context = self.view_context(layout.frame_size())?;
        let view = self.camera()?.transform(&context);
        let DVec2 { x, y } = context.canvas;
        let corners = [dvec2(0.0, 0.0), dvec2(x, 0.0), dvec2(0.0, y), dvec2(x, y)].map(|at| view.to_pixels(at));
        let low = corners.into_iter().reduce(DVec2::min)?;
        let high = corners.into_iter().reduce(DVec2::max)?;
        Some([low, high])
    }
}
