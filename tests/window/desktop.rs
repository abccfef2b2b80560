//! An X server without a screen, and the hands and eyes of a user on it.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};

use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ConnectionExt as _, ImageFormat, InputFocus, KEY_PRESS_EVENT,
    KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, MapState, PropMode, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// Keysyms of keys that make no character.
pub(crate) mod keysym {
    pub(crate) const TAB: u32 = 0xff09;
    pub(crate) const RETURN: u32 = 0xff0d;
    pub(crate) const ESCAPE: u32 = 0xff1b;
    pub(crate) const LEFT: u32 = 0xff51;
    pub(crate) const RIGHT: u32 = 0xff53;
    pub(crate) const PAGE_DOWN: u32 = 0xff56;
    pub(crate) const SHIFT: u32 = 0xffe1;
    pub(crate) const CONTROL: u32 = 0xffe3;
}

/// An X server and a connection to it.
pub(crate) struct Desktop {
    server: Child,
    pub(crate) name: String,
    pub(crate) x: RustConnection,
    pub(crate) root: Window,
}

impl Desktop {
    /// Starts a server with a screen of 1920x1200 pixels.
    pub(crate) fn start() -> Self {
        let started = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-noreset",
                "-nolisten",
                "tcp",
                "-screen",
                "0",
                "1920x1200x24",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut server = started.unwrap_or_else(|error| {
            panic!("the window tests need Xvfb ({error}); install it with: sudo apt install xvfb libxkbcommon-x11-0")
        });
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap())
            .read_line(&mut number)
            .unwrap();
        let name = format!(":{}", number.trim());
        let (x, screen) = x11rb::connect(Some(&name)).unwrap();
        let root = x.setup().roots[screen].root;
        Self { server, name, x, root }
    }

    /// The program's window, once it is on the screen: the only one there is.
    pub(crate) fn find_window(&self) -> Option<Window> {
        let windows = self.x.query_tree(self.root).unwrap().reply().unwrap().children;
        windows.into_iter().find(|window| {
            let shown = self
                .x
                .get_window_attributes(*window)
                .ok()
                .and_then(|cookie| cookie.reply().ok());
            let size = self.x.get_geometry(*window).ok().and_then(|cookie| cookie.reply().ok());
            shown.is_some_and(|shown| shown.map_state == MapState::VIEWABLE) && size.is_some_and(|size| size.width > 50)
        })
    }

    /// The bytes of a window's property.
    pub(crate) fn property(&self, window: Window, name: &str) -> Vec<u8> {
        let atom = self
            .x
            .intern_atom(false, name.as_bytes())
            .unwrap()
            .reply()
            .unwrap()
            .atom;
        let all = self
            .x
            .get_property(false, window, atom, AtomEnum::ANY, 0, u32::MAX / 4)
            .unwrap();
        all.reply().unwrap().value
    }

    /// Sets the desktop's scale, as its settings do: 96 dots per inch are one pixel per point.
    pub(crate) fn set_dots_per_inch(&self, dots: u32) {
        let text = format!("Xft.dpi:\t{dots}\n");
        let (to, text_type) = (AtomEnum::RESOURCE_MANAGER, AtomEnum::STRING);
        self.x
            .change_property8(PropMode::REPLACE, self.root, to, text_type, text.as_bytes())
            .unwrap()
            .check()
            .unwrap();
    }

    /// Gives the keyboard to `window`: there is no window manager to do so.
    pub(crate) fn focus(&self, window: Window) {
        self.x
            .set_input_focus(InputFocus::PARENT, window, x11rb::CURRENT_TIME)
            .unwrap()
            .check()
            .unwrap();
    }

    /// The window's pixels as `0xRRGGBB`, and their number in a row. `None` while the window changes its size.
    pub(crate) fn pixels(&self, window: Window) -> Option<(Vec<u32>, [u32; 2])> {
        let size = self.x.get_geometry(window).ok()?.reply().ok()?;
        let (width, height) = (size.width, size.height);
        let image = self
            .x
            .get_image(ImageFormat::Z_PIXMAP, window, 0, 0, width, height, u32::MAX)
            .ok()?
            .reply()
            .ok()?;
        let pixels = image
            .data
            .chunks_exact(4)
            .map(|p| u32::from_le_bytes([p[0], p[1], p[2], 0]))
            .collect();
        Some((pixels, [u32::from(width), u32::from(height)]))
    }

    /// The bytes of a part of the window: its corner, width and height. Empty while the window changes its size.
    pub(crate) fn part(&self, window: Window, [x, y, width, height]: [u16; 4]) -> Vec<u8> {
        let corner = [x, y].map(|at| i16::try_from(at).unwrap());
        let part = self
            .x
            .get_image(
                ImageFormat::Z_PIXMAP,
                window,
                corner[0],
                corner[1],
                width,
                height,
                u32::MAX,
            )
            .unwrap()
            .reply();
        part.map(|image| image.data).unwrap_or_default()
    }

    /// Presses and releases a key that makes `character`, with Shift where the keyboard needs it.
    pub(crate) fn type_char(&self, character: char, held: &[u32]) {
        self.press(u32::from(character), held);
    }

    /// Presses and releases the key with this keysym while others are held.
    pub(crate) fn press(&self, keysym: u32, held: &[u32]) {
        let (key, shifted) = self.key_of(keysym);
        let mut held: Vec<u8> = held.iter().map(|keysym| self.key_of(*keysym).0).collect();
        if shifted {
            held.push(self.key_of(keysym::SHIFT).0);
        }
        for key in &held {
            self.fake(KEY_PRESS_EVENT, *key);
        }
        self.fake(KEY_PRESS_EVENT, key);
        self.fake(KEY_RELEASE_EVENT, key);
        for key in held.iter().rev() {
            self.fake(KEY_RELEASE_EVENT, *key);
        }
    }

    /// The key that makes a keysym, and whether it takes Shift.
    fn key_of(&self, keysym: u32) -> (u8, bool) {
        let setup = self.x.setup();
        let (low, high) = (setup.min_keycode, setup.max_keycode);
        let map = self
            .x
            .get_keyboard_mapping(low, high - low + 1)
            .unwrap()
            .reply()
            .unwrap();
        let per_key = usize::from(map.keysyms_per_keycode);
        let find = |level: usize| {
            map.keysyms
                .chunks(per_key)
                .position(|keysyms| keysyms.get(level) == Some(&keysym))
        };
        let (index, shifted) = find(0)
            .map(|index| (index, false))
            .or(find(1).map(|index| (index, true)))
            .unwrap();
        (low + u8::try_from(index).unwrap(), shifted)
    }

    /// Moves the pointer to a pixel of the screen.
    pub(crate) fn point(&self, x: i16, y: i16) {
        self.x
            .xtest_fake_input(MOTION_NOTIFY_EVENT, 0, 0, self.root, x, y, 0)
            .unwrap()
            .check()
            .unwrap();
    }

    /// Presses (`down`) or releases a button: 1 left, 3 right, 4 wheel up, 5 wheel down.
    pub(crate) fn button(&self, button: u8, down: bool) {
        self.fake(if down { BUTTON_PRESS_EVENT } else { BUTTON_RELEASE_EVENT }, button);
    }

    fn fake(&self, kind: u8, detail: u8) {
        self.x
            .xtest_fake_input(kind, detail, 0, self.root, 0, 0, 0)
            .unwrap()
            .check()
            .unwrap();
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        // It may be gone already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
