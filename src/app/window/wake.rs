//! What other threads, screen readers and the system tell the event loop.

use std::collections::BTreeMap;

use egui_winit::accesskit_winit;

use crate::viewer::Theme;

/// Sent from other threads.
#[derive(Clone, Debug)]
pub(super) enum Wake {
    /// The viewer has something to take in.
    Work,
    /// The desktop became dark or light.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "winit tells it elsewhere"))]
    Theme(Theme),
    /// Monitors show windows at other percentages than before.
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "only Wayland has such monitors")
    )]
    Scales(ShownScales),
    /// A screen reader came, asked for something, or went.
    ScreenReader(accesskit_winit::WindowEvent),
    /// The system asks the program to end.
    End,
}

/// At how many percent monitors show what is drawn for them, by their names; those that show it pixel for pixel are left out.
pub(super) type ShownScales = BTreeMap<String, u32>;
