//! Whether the desktop is dark or light, asked of the settings portal, which all of Linux's desktops have: winit says nothing of
//! that there.
//!
//! Source: XDG Desktop Portal, `org.freedesktop.portal.Settings`, key `color-scheme` of `org.freedesktop.appearance`.

use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use winit::event_loop::EventLoopProxy;
use zbus::blocking::{Connection, Proxy};
use zbus::zvariant::{OwnedValue, Value};

use super::wake::Wake;
use crate::viewer::Theme;

const NAMESPACE: &str = "org.freedesktop.appearance";
const KEY: &str = "color-scheme";

/// How long a start waits for the answer; a later one changes the theme of the open window.
const PATIENCE: Duration = Duration::from_millis(40);

/// A question to the desktop that is on its way.
#[derive(Debug)]
pub(in crate::app::window) struct Question(Receiver<Option<Theme>>);

impl Question {
    /// Asks for the theme; what the desktop says after the first answer, or later than that is waited for, comes as
    /// [`Wake::Theme`].
    pub(in crate::app::window) fn ask(proxy: EventLoopProxy<Wake>) -> Self {
        let (first, answer) = mpsc::channel();
        let work = move || {
            // Without a bus, or a portal on it, the desktop says nothing.
            let _ = watch(&first, &proxy);
        };
        // Without a thread nobody answers.
        let _ = thread::Builder::new().name("desktop theme".to_owned()).spawn(work);
        Self(answer)
    }

    /// The desktop's theme, `None` where it has none or does not say so soon.
    pub(in crate::app::window) fn answer(self) -> Option<Theme> {
        self.0.recv_timeout(PATIENCE).ok().flatten()
    }
}

/// Asks for the theme and waits for others, until the bus or the window is gone.
fn watch(first: &Sender<Option<Theme>>, proxy: &EventLoopProxy<Wake>) -> zbus::Result<()> {
    let connection = Connection::session()?;
    let settings = Proxy::new(
        &connection,
        "org.freedesktop.portal.Desktop",
        "/org/freedesktop/portal/desktop",
        "org.freedesktop.portal.Settings",
    )?;
    let changes = settings.receive_signal_with_args("SettingChanged", &[(0, NAMESPACE), (1, KEY)])?;
    let now = settings.call::<_, _, OwnedValue>("Read", &(NAMESPACE, KEY));
    let mut theme = now.ok().and_then(|value| theme_of(&value));
    // The start may have stopped waiting.
    let _ = first.send(theme);
    let tell = |theme: Option<Theme>| theme.is_none_or(|theme| proxy.send_event(Wake::Theme(theme)).is_ok());
    let mut is_open = tell(theme);
    for change in changes {
        let body = change.body();
        let (_, _, value): (String, String, Value<'_>) = body.deserialize()?;
        let next = theme_of(&value);
        if next != theme {
            theme = next;
            is_open = is_open && tell(theme);
        }
        if !is_open {
            break;
        }
    }
    Ok(())
}

/// What a value of `color-scheme` asks for: 1 dark, 2 light, anything else nothing. Older portals wrap it twice.
fn theme_of(value: &Value<'_>) -> Option<Theme> {
    match value {
        Value::Value(inner) => theme_of(inner),
        Value::U32(1) => Some(Theme::Dark),
        Value::U32(2) => Some(Theme::Light),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_the_portal_are_themes() {
        let wrapped = |number: u32| Value::Value(Box::new(Value::U32(number)));
        assert_eq!(theme_of(&Value::U32(1)), Some(Theme::Dark));
        assert_eq!(theme_of(&wrapped(2)), Some(Theme::Light), "as `Read` answers");
        assert_eq!(theme_of(&wrapped(0)), None, "no preference");
        assert_eq!(theme_of(&Value::U32(7)), None, "none that we know");
        assert_eq!(theme_of(&Value::from("dark")), None, "not a number");
    }
}
