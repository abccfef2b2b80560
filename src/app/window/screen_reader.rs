//! What screen readers ask of the window: names, values and places of its controls, and to press them, through AccessKit.

use egui_winit::accesskit_winit::{Event, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};

use super::opened::Opened;
use super::wake::Wake;

impl From<Event> for Wake {
    fn from(event: Event) -> Self {
        Self::ScreenReader(event.window_event)
    }
}

impl Opened {
    /// Offers the controls to screen readers; before the window is shown for the first time.
    pub(super) fn serve_screen_readers(&mut self, event_loop: &ActiveEventLoop, proxy: EventLoopProxy<Wake>) {
        self.egui.init_accesskit(event_loop, &self.window, proxy);
    }

    /// A screen reader came, asked for something, or went.
    pub(super) fn screen_reader(&mut self, event: WindowEvent) {
        match event {
            WindowEvent::InitialTreeRequested => self.session.ctx().enable_accesskit(),
            WindowEvent::ActionRequested(request) => self.egui.on_accesskit_action_request(request),
            WindowEvent::AccessibilityDeactivated => self.session.ctx().disable_accesskit(),
        }
        self.touch();
    }
}
