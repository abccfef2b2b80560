//! usvg, held to our promise that no document ends the program: it panics at some that 32-bit floats are too coarse for, such as an
//! image that is a millionth as wide as it lies far from the origin.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use usvg::{Options, Tree};

use crate::scene::Problem;

thread_local! {
    /// Whether a panic of this thread is told by its caller.
    static TOLD: Cell<bool> = const { Cell::new(false) };
}

/// usvg's tree of a document, or its error.
///
/// # Errors
/// [`Problem::Reader`] where usvg panics.
pub(super) fn tree(text: &str, options: &Options<'_>) -> Result<Result<Tree, usvg::Error>, Problem> {
    guarded(|| Tree::from_str(text, options))
}

/// Does what may panic; then nothing is printed, and the panic's own words are in the problem.
fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Problem> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !TOLD.get() {
                before(info);
            }
        }));
    });
    let before = TOLD.replace(true);
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    TOLD.set(before);
    done.map_err(|panic| Problem::Reader(words(panic.as_ref())))
}

/// What a panic says.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("no reason given").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_become_problems_also_inside_each_other() {
        let inner = |fails: bool| guarded(|| assert!(!fails, "the inner one"));
        let told = |found: Result<(), Problem>| found.expect_err("a panic").to_string();
        assert!(inner(false).is_ok(), "no panic");
        assert!(told(inner(true)).contains("the inner one"), "its words");
        let both = guarded(|| {
            assert!(inner(true).is_err(), "caught inside");
            panic!("the outer {}", "one");
        });
        assert!(told(both).contains("the outer one"), "told once the inner one is over");
        assert!(!TOLD.get(), "what panics later is printed");
    }
}
