//! A against B without a window: which settings each has, what the window shows of both, what Esc closes.

mod arrangements;
mod measures;
mod others;

use rasterscope::raster::Framebuffer;

use crate::support::session::{SQUARE, Session, TRIANGLES, set};

const WINDOW: [u32; 2] = [160, 120];

/// A at rate 16, B at rate 1.
fn sixteen_against_one(window: [u32; 2]) -> Session {
    let mut session = Session::open(&[TRIANGLES, SQUARE], window);
    session.keys(&["r"]);
    session.run(set("sample-rate", "16"));
    session
}

/// Both frames.
fn frames(session: &Session) -> [Framebuffer; 2] {
    let other = session.viewer.ab().other_pixels().unwrap().clone();
    [session.pixels().clone(), other]
}
