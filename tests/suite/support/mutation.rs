//! Small random changes to bytes, for tests of what strangers send.

use arbtest::arbitrary::{Result, Unstructured};

/// Changes a byte, drops or repeats a few, or splices in one of `splices`.
pub(crate) fn mutate(u: &mut Unstructured<'_>, bytes: &mut Vec<u8>, splices: &[&str]) -> Result<()> {
    if bytes.is_empty() {
        return Ok(());
    }
    let at = u.int_in_range(0..=bytes.len() - 1)?;
    let end = (at + u.int_in_range(0..=20)?).min(bytes.len());
    match u.int_in_range(0..=3)? {
        0 => bytes[at] = u.arbitrary()?,
        1 => drop(bytes.drain(at..end)),
        2 => drop(bytes.splice(at..at, u.choose(splices)?.bytes())),
        _ => {
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
    }
    Ok(())
}
