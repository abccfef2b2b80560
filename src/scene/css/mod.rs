//! Style sheets and styles in one plain form, which the readers behind it understand: without comments, escapes, rules with an `@`
//! and what CSS passes over, each selector and each declaration as plainly as it can be written.
//!
//! ```text
//!     tokens -> selectors, declarations -> rules -> plain text, its places, and what is to be told
//! ```

mod classes;
mod declarations;
mod inherited;
mod letter_case;
mod plain;
mod rules;
mod selectors;
mod tokens;

pub(super) use declarations::{plain_word, style};
pub(super) use inherited::is_inherited;
pub(super) use letter_case::{is_in_other_case, other_case};
pub(super) use plain::{Place, Plain};
pub(super) use rules::sheet;
pub(super) use selectors::MOST_COMPARISONS;
pub(super) use tokens::{block_end, block_start};
