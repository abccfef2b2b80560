//! A file dropped on the window, spoken as XDND: the protocol by which file managers do it.

use std::path::Path;

use rasterscope::raster::Framebuffer;
use rasterscope::viewer::{Command, ViewCommand, ViewNumbers};
use x11rb::connection::Connection as _;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

use super::desktop::keysym;
use super::program::{Program, flat, textured, until, viewed};

#[test]
fn drop_opens_the_scene() {
    let program = Program::start_bare(&flat());
    program.shows(&viewed(&flat(), &[]), "the first picture");
    drop_file(&program, &textured());
    program.shows(&viewed(&textured(), &[]), "the dropped scene");
}

#[test]
fn drop_opens_the_lesson() {
    let program = Program::start_bare(&flat());
    program.shows(&viewed(&flat(), &[]), "the first picture");
    let lesson = program.folder.path().join("lesson.toml");
    let scene = textured();
    let text = format!(
        "title = 'Two steps'\n[[step]]\nscene = '{0}'\nsample-rate = 4\nview = '256,256,0.8'\ntext = 'One.'\n[[step]]\nscene = '{0}'\nview = '256,256,0.8'\ntext = 'Two.'\n",
        scene.display()
    );
    std::fs::write(&lesson, text).unwrap();
    drop_file(&program, &lesson);
    let view = Command::View(ViewCommand::Set(ViewNumbers {
        center: [256.0, 256.0].into(),
        scale: 0.8,
        rotation: 0.0,
    }));
    let four = Command::set("sample-rate", "4").expect("a value");
    let first = viewed(&scene, &[view.clone(), four]);
    program.shows_somewhere(&beside_the_text(&first), "the first step, as its author meant it");
    program.desktop.press(keysym::PAGE_DOWN, &[]);
    let second = viewed(&scene, &[view]);
    assert!(
        beside_the_text(&first) != beside_the_text(&second),
        "the steps can be told apart"
    );
    program.shows_somewhere(&beside_the_text(&second), "the second step");
}

#[test]
fn drop_takes_the_pattern() {
    let program = Program::start_bare(&flat());
    program.shows(&viewed(&flat(), &[]), "the first picture");
    let pattern = program.folder.path().join("own.toml");
    let text = "name = 'own'\nsamples = [{ x = 0.25, y = 0.75 }, { x = 0.5, y = 0.5, weight = 2 }]";
    std::fs::write(&pattern, text).unwrap();
    drop_file(&program, &pattern);
    let own = Command::set("pattern", "own:64/192+128/128x2").expect("a value");
    let drawn = viewed(&flat(), &[own]);
    assert!(drawn != viewed(&flat(), &[]), "it makes a difference");
    program.shows(&drawn, "the same scene by the samples of the file");
}

/// The part of the picture that no panel covers, of a small window.
fn beside_the_text(picture: &Framebuffer) -> Framebuffer {
    let ([left, top], [width, height]) = ([320, 100], [160, 240]);
    let mut part = Framebuffer::new(width, height);
    for (y, row) in part.pixels_mut().chunks_exact_mut(width as usize).enumerate() {
        let start = (top + y) * picture.width() as usize + left;
        row.copy_from_slice(&picture.pixels()[start..start + row.len()]);
    }
    part
}

/// Drops a file in the window.
fn drop_file(program: &Program, path: &Path) {
    let (x, root) = (&program.desktop.x, program.desktop.root);
    let atom = |name: &str| x.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
    let source = x.generate_id().unwrap();
    x.create_window(
        0,
        source,
        root,
        0,
        0,
        1,
        1,
        0,
        WindowClass::INPUT_OUTPUT,
        0,
        &CreateWindowAux::new(),
    )
    .unwrap();
    let (selection, uri_list) = (atom("XdndSelection"), atom("text/uri-list"));
    x.set_selection_owner(source, selection, x11rb::CURRENT_TIME).unwrap();
    let send = |kind: &str, data: [u32; 5]| {
        let event = ClientMessageEvent::new(32, program.window, atom(kind), data);
        x.send_event(false, program.window, EventMask::NO_EVENT, event).unwrap();
        x.flush().unwrap();
    };
    send("XdndEnter", [source, 5 << 24, uri_list, 0, 0]);
    send("XdndPosition", [source, 0, 0x0064_0064, 0, atom("XdndActionCopy")]);
    let uri = format!("file://{}\r\n", path.display());
    let mut dropped = false;
    until("the transfer", || {
        match x.poll_for_event().unwrap()? {
            Event::SelectionRequest(asked) => hand_over(x, &asked, &uri),
            Event::ClientMessage(message) if message.type_ == atom("XdndStatus") && !dropped => {
                dropped = true;
                send("XdndDrop", [source, 0, x11rb::CURRENT_TIME, 0, 0]);
            }
            Event::ClientMessage(message) if message.type_ == atom("XdndFinished") => return Some(()),
            _ => {}
        }
        None
    });
}

/// Gives the file's address to who asked for it.
fn hand_over(x: &RustConnection, asked: &SelectionRequestEvent, uri: &str) {
    let property = if asked.property == 0 {
        asked.target
    } else {
        asked.property
    };
    x.change_property8(
        PropMode::REPLACE,
        asked.requestor,
        property,
        asked.target,
        uri.as_bytes(),
    )
    .unwrap();
    let answer = SelectionNotifyEvent {
        response_type: SELECTION_NOTIFY_EVENT,
        sequence: 0,
        time: asked.time,
        requestor: asked.requestor,
        selection: asked.selection,
        target: asked.target,
        property,
    };
    x.send_event(false, asked.requestor, EventMask::NO_EVENT, answer)
        .unwrap();
    x.flush().unwrap();
}
