//! At how many percent a compositor shows the window, where it scales that by itself.
//!
//! A compositor of Wayland that does not speak of scales such as 1.5 (fractional-scale-v1) asks for a picture at the next whole
//! scale and makes it smaller: no pixel on the screen is one that was drawn.
//!
//! ```text
//!      window in points   x 2   the picture that is asked for
//!      window in points   x 1.5 what the screen shows of it: 75 %
//! ```

use std::thread;

use smithay_client_toolkit::output::{OutputHandler, OutputInfo, OutputState};
use smithay_client_toolkit::registry::{ProvidesRegistryState, RegistryState};
use smithay_client_toolkit::{delegate_output, delegate_registry, registry_handlers};
use wayland_client::globals::registry_queue_init;
use wayland_client::protocol::wl_output::{Transform, WlOutput};
use wayland_client::{Connection, QueueHandle};
use winit::event_loop::EventLoopProxy;

use super::wake::{ShownScales, Wake};

/// Tells by [`Wake::Scales`] which monitors do not show what is drawn pixel for pixel, now and whenever that changes: winit tells
/// nothing of a change from 2 to 1.5, since a picture at scale 2 is asked for before and after.
pub(super) fn follow(proxy: EventLoopProxy<Wake>) {
    let work = move || {
        // A compositor that does not answer tells nothing; one that has ended ends the window, too.
        let _ = watch(&proxy);
    };
    // Without a thread nobody is told.
    let _ = thread::Builder::new().name("desktop scale".to_owned()).spawn(work);
}

/// Asks for the monitors and waits for changes, until the compositor or the window is gone.
fn watch(proxy: &EventLoopProxy<Wake>) -> Option<()> {
    let connection = Connection::connect_to_env().ok()?;
    let (globals, mut queue) = registry_queue_init::<Outputs>(&connection).ok()?;
    let scales = |name: &str| name == "wp_fractional_scale_manager_v1";
    if globals
        .contents()
        .with_list(|globals| globals.iter().any(|global| scales(&global.interface)))
    {
        return None;
    }
    let mut outputs = Outputs {
        registry: RegistryState::new(&globals),
        outputs: OutputState::new(&globals, &queue.handle()),
    };
    let mut told = ShownScales::default();
    loop {
        queue.blocking_dispatch(&mut outputs).ok()?;
        let now = outputs.shown();
        if now != told {
            told.clone_from(&now);
            proxy.send_event(Wake::Scales(now)).ok()?;
        }
    }
}

/// The percent at which a monitor shows what is drawn for it; `None` where that is pixel for pixel, or the compositor does not
/// say.
fn percent(info: &OutputInfo) -> Option<u32> {
    let pixels = info.modes.iter().find(|mode| mode.current)?.dimensions;
    let lies = [
        Transform::_90,
        Transform::_270,
        Transform::Flipped90,
        Transform::Flipped270,
    ];
    let width = if lies.contains(&info.transform) {
        pixels.1
    } else {
        pixels.0
    };
    shown_at(width, info.logical_size?.0, info.scale_factor)
}

/// Of a monitor so many pixels and so many points wide, for which `scale` pixels per point are drawn.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "percent of sizes of monitors"
)]
fn shown_at(pixels: i32, points: i32, scale: i32) -> Option<u32> {
    if pixels <= 0 || points <= 0 || scale <= 0 {
        return None;
    }
    let percent = 100.0 * f64::from(pixels) / (f64::from(points) * f64::from(scale));
    let rounded = percent.round().clamp(1.0, 1000.0) as u32;
    // Points are whole numbers: what is less than a percent may be their rounding.
    (rounded != 100).then_some(rounded)
}

/// What listens while monitors are asked for.
struct Outputs {
    registry: RegistryState,
    outputs: OutputState,
}

impl Outputs {
    fn shown(&self) -> ShownScales {
        let infos = self.outputs.outputs().filter_map(|output| self.outputs.info(&output));
        infos
            .filter_map(|info| Some((info.name.clone()?, percent(&info)?)))
            .collect()
    }
}

impl OutputHandler for Outputs {
    fn output_state(&mut self) -> &mut OutputState {
        &mut self.outputs
    }

    fn new_output(&mut self, _: &Connection, _: &QueueHandle<Self>, _: WlOutput) {}

    fn update_output(&mut self, _: &Connection, _: &QueueHandle<Self>, _: WlOutput) {}

    fn output_destroyed(&mut self, _: &Connection, _: &QueueHandle<Self>, _: WlOutput) {}
}

impl ProvidesRegistryState for Outputs {
    fn registry(&mut self) -> &mut RegistryState {
        &mut self.registry
    }

    registry_handlers![OutputState];
}

delegate_output!(Outputs);
delegate_registry!(Outputs);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_scales_between_whole_ones_are_told() {
        assert_eq!(shown_at(1920, 1280, 2), Some(75), "one and a half, drawn at two");
        assert_eq!(shown_at(1920, 1536, 2), Some(63), "one and a quarter");
        assert_eq!(shown_at(1920, 1097, 2), Some(88), "one and three quarters");
        assert_eq!(shown_at(1920, 960, 2), None, "pixel for pixel");
        assert_eq!(shown_at(1920, 1920, 1), None, "pixel for pixel");
        assert_eq!(shown_at(1366, 683, 2), None, "an odd number of points");
        assert_eq!(shown_at(0, 0, 0), None, "a monitor that says nothing");
    }
}
