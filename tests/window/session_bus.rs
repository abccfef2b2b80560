//! What the desktop says over D-Bus, and who asks there: the settings portal and a screen reader, on a bus of their own.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command as Process, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use zbus::blocking::proxy::Builder;
use zbus::blocking::{Connection, Proxy, connection};
use zbus::proxy::CacheProperties;
use zbus::zvariant::{OwnedObjectPath, OwnedValue, Value};

use super::program::{PATIENCE, Program, flat, until};

const CONFIG: &str = "<busconfig><type>session</type><listen>unix:tmpdir=/tmp</listen><auth>EXTERNAL</auth>\
    <policy context='default'><allow send_destination='*'/><allow receive_sender='*'/><allow own='*'/></policy></busconfig>";

/// Where an application of AT-SPI stands, and the registry that it tells.
const ROOT: &str = "/org/a11y/atspi/accessible/root";

/// A message bus that ends with the test.
struct Bus {
    daemon: Child,
    address: String,
}

impl Bus {
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let config = folder.path().join("bus.conf");
        std::fs::write(&config, CONFIG).unwrap();
        let started = Process::new("dbus-daemon")
            .arg(format!("--config-file={}", config.display()))
            .args(["--nofork", "--nopidfile", "--print-address"])
            .stdout(Stdio::piped())
            .spawn();
        let mut daemon = started.unwrap_or_else(|error| {
            panic!("the window tests need dbus-daemon ({error}); install it with: sudo apt install dbus")
        });
        let mut address = String::new();
        BufReader::new(daemon.stdout.take().unwrap())
            .read_line(&mut address)
            .unwrap();
        Self {
            daemon,
            address: address.trim().to_owned(),
        }
    }

    fn builder(&self) -> connection::Builder<'_> {
        connection::Builder::address(self.address.as_str()).unwrap()
    }

    /// The program on this bus.
    fn open(&self, arguments: &[&str]) -> Program {
        let folder = tempfile::tempdir().unwrap();
        let variables = [("DBUS_SESSION_BUS_ADDRESS", self.address.as_str())];
        Program::open_where(folder, &[&flat()], arguments, &variables)
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        let _ = self.daemon.kill();
        let _ = self.daemon.wait();
    }
}

/// A settings portal.
struct Portal {
    scheme: u32,
}

#[zbus::interface(name = "org.freedesktop.portal.Settings")]
impl Portal {
    fn read(&self, namespace: &str, key: &str) -> OwnedValue {
        let asked = (namespace, key);
        assert_eq!(asked, ("org.freedesktop.appearance", "color-scheme"), "the one key");
        let inner = Value::Value(Box::new(Value::U32(self.scheme)));
        OwnedValue::try_from(inner).unwrap()
    }
}

#[test]
fn theme_is_that_of_the_desktop_until_one_is_chosen() {
    /// Inside the line at the foot.
    const FOOT: [u16; 4] = [3, 397, 1, 1];
    const LIGHT: [u8; 3] = [244, 246, 246];
    const PATH: &str = "/org/freedesktop/portal/desktop";
    let bus = Bus::start();
    let named = bus.builder().name("org.freedesktop.portal.Desktop").unwrap();
    let portal = named.serve_at(PATH, Portal { scheme: 2 }).unwrap().build().unwrap();
    let changed = |scheme: u32| {
        let body = ("org.freedesktop.appearance", "color-scheme", Value::U32(scheme));
        let none: Option<&str> = None;
        portal
            .emit_signal(none, PATH, "org.freedesktop.portal.Settings", "SettingChanged", &body)
            .unwrap();
    };
    let is_light = |program: &Program| program.desktop.part(program.window, FOOT).starts_with(&LIGHT);
    let program = bus.open(&["--do", "panel off"]);
    until("a light desktop", || is_light(&program).then_some(()));
    changed(1);
    until("a dark one", || (!is_light(&program)).then_some(()));
    changed(2);
    until("a light one again", || is_light(&program).then_some(()));
    drop(program);
    let program = bus.open(&["--theme", "dark", "--do", "panel off"]);
    until("a picture", || (!is_light(&program)).then_some(()));
    changed(2);
    std::thread::sleep(Duration::from_millis(300));
    assert!(!is_light(&program), "the theme that was asked for stays");
}

/// What a screen reader tells the programs: that it is there, and on which bus.
struct Status {
    address: String,
}

#[zbus::interface(name = "org.a11y.Bus")]
impl Status {
    fn get_address(&self) -> String {
        self.address.clone()
    }
}

struct Enabled(bool);

#[zbus::interface(name = "org.a11y.Status")]
impl Enabled {
    #[zbus(property)]
    fn is_enabled(&self) -> bool {
        self.0
    }

    #[zbus(property)]
    fn screen_reader_enabled(&self) -> bool {
        self.0
    }
}

/// Hears of programs that can be read.
struct Registry {
    heard: Sender<String>,
}

#[zbus::interface(name = "org.a11y.atspi.Socket")]
impl Registry {
    fn embed(&self, plug: (String, OwnedObjectPath)) -> ((String, OwnedObjectPath),) {
        // The test has what it needs.
        let _ = self.heard.send(plug.0);
        let no_desktop = OwnedObjectPath::try_from("/org/a11y/atspi/null").unwrap();
        ((String::new(), no_desktop),)
    }
}

/// A screen reader, and what it hears of.
fn screen_reader(bus: &Bus) -> (Connection, Receiver<String>) {
    let (heard, programs) = channel();
    let status = Status {
        address: bus.address.clone(),
    };
    // A program that is just making its tree may leave a question unanswered: it is asked again.
    let builder = bus.builder().method_timeout(Duration::from_secs(2));
    let builder = builder.name("org.a11y.Bus").unwrap();
    let builder = builder.name("org.a11y.atspi.Registry").unwrap();
    let builder = builder.serve_at("/org/a11y/bus", status).unwrap();
    let builder = builder.serve_at("/org/a11y/bus", Enabled(true)).unwrap();
    let builder = builder.serve_at(ROOT, Registry { heard }).unwrap();
    (builder.build().unwrap(), programs)
}

/// The control called `name` below an object; nothing while the program is still making it.
fn find(reader: &Connection, program: &str, path: &str, name: &str) -> Option<OwnedObjectPath> {
    let object = Builder::<Proxy<'_>>::new(reader).destination(program).ok()?;
    let object = object.path(path).ok()?.interface("org.a11y.atspi.Accessible").ok()?;
    let object = object.cache_properties(CacheProperties::No).build().ok()?;
    if object.get_property::<String>("Name").is_ok_and(|found| found == name) {
        return Some(path.try_into().unwrap());
    }
    let children: Vec<(String, OwnedObjectPath)> = object.call("GetChildren", &()).ok()?;
    children
        .iter()
        .find_map(|(program, path)| find(reader, program, path.as_str(), name))
}

#[test]
fn screen_reader_finds_controls_and_presses_them() {
    let bus = Bus::start();
    let (reader, programs) = screen_reader(&bus);
    let program = bus.open(&["--theme", "dark", "--do", "panel on; pin 225,150"]);
    let mut name = programs
        .recv_timeout(PATIENCE)
        .expect("the program says that it can be read");
    let nine = until("a control by its name", || {
        // It may say so again, under another name.
        name = programs.try_iter().last().unwrap_or_else(|| name.clone());
        find(&reader, &name, ROOT, "Samples per pixel: 9")
    });
    let press = Proxy::new(&reader, name.as_str(), nine.as_str(), "org.a11y.atspi.Action").unwrap();
    let pressed: bool = press.call("DoAction", &(0)).unwrap();
    assert!(pressed, "it can be pressed");
    // At this place of the scene the picture has one colour only.
    until("the colour of the pixel that is pinned", || {
        find(&reader, &name, ROOT, "Colour #6dbfb0")
    });
    until("the title with what was pressed", || {
        let title = program.desktop.property(program.window, "_NET_WM_NAME");
        String::from_utf8_lossy(&title).contains("sample rate 9").then_some(())
    });
}
