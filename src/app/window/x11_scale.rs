//! Follows the scale of X11's monitors while the window is open.
//!
//! winit 0.30 reads it again at a change of the X settings alone. It is not told of changes on the root window, and the events of
//! the `RandR` extension never reach it: Xlib, whose queue it reads, drops those that no library of Xlib's knows. So a connection
//! of our own listens, and tells winit's window that the resource database may have changed.

use std::thread;

use winit::raw_window_handle::{HasWindowHandle as _, RawWindowHandle};
use winit::window::Window;
use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::randr::{ConnectionExt as _, NotifyMask};
use x11rb::protocol::xproto::{
    AtomEnum, ChangeWindowAttributesAux, ConnectionExt as _, EventMask, PROPERTY_NOTIFY_EVENT, Property,
    PropertyNotifyEvent,
};

/// Sees to it that `window` hears of other scales, until the server is gone.
pub(super) fn follow(window: &Window) {
    let handle = window.window_handle().map(|handle| handle.as_raw());
    let id = match handle {
        Ok(RawWindowHandle::Xlib(handle)) => u32::try_from(handle.window).ok(),
        Ok(RawWindowHandle::Xcb(handle)) => Some(handle.window.get()),
        _ => None,
    };
    let Some(id) = id else { return };
    let work = move || {
        // Without a second connection the scale is that of the start; a server that is gone ends the window, too.
        let _ = watch(id);
    };
    // Without a thread, likewise.
    let _ = thread::Builder::new().name("X11 scale".to_owned()).spawn(work);
}

/// Waits for changes and passes them on.
fn watch(window: u32) -> Option<()> {
    let (x, screen) = x11rb::connect(None).ok()?;
    let root = x.setup().roots.get(screen)?.root;
    let properties = ChangeWindowAttributesAux::new().event_mask(EventMask::PROPERTY_CHANGE);
    x.change_window_attributes(root, &properties).ok()?.check().ok()?;
    let monitors = NotifyMask::SCREEN_CHANGE | NotifyMask::CRTC_CHANGE | NotifyMask::OUTPUT_CHANGE;
    // A server without RandR has monitors that do not change.
    let has_monitors = x.randr_query_version(1, 3).is_ok_and(|version| version.reply().is_ok());
    if has_monitors {
        x.randr_select_input(root, monitors).ok()?.check().ok()?;
    }
    let database = u32::from(AtomEnum::RESOURCE_MANAGER);
    loop {
        let is_scale = match x.wait_for_event().ok()? {
            Event::PropertyNotify(event) => event.atom == database,
            Event::RandrScreenChangeNotify(_) | Event::RandrNotify(_) => true,
            _ => false,
        };
        if !is_scale {
            continue;
        }
        let event = PropertyNotifyEvent {
            response_type: PROPERTY_NOTIFY_EVENT,
            sequence: 0,
            window,
            atom: database,
            time: x11rb::CURRENT_TIME,
            state: Property::NEW_VALUE,
        };
        x.send_event(false, window, EventMask::NO_EVENT, event).ok()?;
        x.flush().ok()?;
    }
}
