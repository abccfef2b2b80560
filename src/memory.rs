//! Whether the system grants as much memory as a piece of work will take.
//!
//! A grant is no promise: a system that overcommits, as Linux does unless told otherwise, refuses only what it could never
//! have, or what goes beyond a limit of the process, and may still end the program when the memory is filled.
//!
//! Who asks before the work can say what is wrong; the work itself ends the program, with status 1, where a single vector
//! cannot grow.

/// The system gives less memory than was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("out of memory: about {megabytes} MB more are needed, and the system gives less")]
pub struct OutOfMemory {
    /// What was asked for, in megabytes of 2^20 bytes.
    pub megabytes: u64,
}

/// Asks the system for so many bytes, and gives them back unused.
///
/// # Errors
/// When it refuses them.
pub fn ask_for(bytes: u64) -> Result<(), OutOfMemory> {
    let mut room: Vec<u8> = Vec::new();
    let asked = room.try_reserve_exact(usize::try_from(bytes).unwrap_or(usize::MAX));
    // A room that nobody looks at would never be asked for.
    std::hint::black_box(&room);
    let megabytes = bytes.div_ceil(1 << 20);
    asked.map_err(|_| OutOfMemory { megabytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_no_system_has_is_told() {
        assert_eq!(ask_for(1 << 20), Ok(()), "a megabyte");
        let told = ask_for(u64::MAX).expect_err("more than addresses reach");
        assert!(told.to_string().starts_with("out of memory: about "), "{told}");
    }
}
