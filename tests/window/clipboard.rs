//! What the program puts on the clipboard, as another program finds it there.

use rasterscope::compare::decode_picture;
use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt as _, CreateWindowAux, WindowClass};

use super::desktop::{Desktop, keysym};
use super::program::{Program, flat, until, viewed};

/// The clipboard's content as the type `target`; `None` while nobody offers it.
fn pasted(desktop: &Desktop, target: &str) -> Option<Vec<u8>> {
    let x = &desktop.x;
    let atom = |name: &str| x.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
    let window = x.generate_id().unwrap();
    let (class, look) = (WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
    x.create_window(0, window, desktop.root, 0, 0, 1, 1, 0, class, 0, &look)
        .unwrap();
    let (selection, target, property) = (atom("CLIPBOARD"), atom(target), atom("PASTED"));
    x.convert_selection(window, selection, target, property, x11rb::CURRENT_TIME)
        .unwrap();
    x.flush().unwrap();
    let answered = until("the clipboard's answer", || match x.poll_for_event().unwrap()? {
        Event::SelectionNotify(answer) if answer.requestor == window => Some(answer.property != 0),
        _ => None,
    });
    let content = answered.then(|| {
        let property = x.get_property(true, window, property, AtomEnum::ANY, 0, 1 << 20);
        property.unwrap().reply().unwrap().value
    });
    x.destroy_window(window).unwrap();
    content
}

#[test]
fn clipboard_gets_the_picture_and_its_command_line() {
    let path = flat();
    let program = Program::start_bare(&path);
    let picture = viewed(&path, &[]);
    program.shows(&picture, "the first picture");
    program.desktop.type_char('c', &[keysym::CONTROL]);
    let bytes = until("the picture", || pasted(&program.desktop, "image/png"));
    let found = decode_picture(&bytes).unwrap();
    assert!(found == picture, "every pixel of the picture");
    program.desktop.type_char('c', &[keysym::CONTROL, keysym::SHIFT]);
    let line = until("the command line", || {
        let text = pasted(&program.desktop, "UTF8_STRING")?;
        Some(String::from_utf8(text).unwrap())
    });
    assert!(line.starts_with("rasterscope render "), "{line}");
}
