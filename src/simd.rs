//! Which vector instructions the kernels use: the best the machine has, or fewer where a user or a test says so.

mod packed;
mod put;

use std::sync::OnceLock;

pub use fearless_simd::Level;
pub(crate) use packed::{PACKED, pack_four};
pub(crate) use put::put_lanes;

const _: () = assert!(
    cfg!(target_endian = "little"),
    "kernels take wide numbers apart as little-endian machines do"
);

/// What the kernels of this process use, once somebody asked.
static CHOSEN: OnceLock<Level> = OnceLock::new();

/// Why a level could not be chosen by name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ChooseError {
    /// No level has this name, or this machine does not have its instructions.
    #[error("SIMD level `{name}` is not available here; choose one of: auto, {available}")]
    Unavailable {
        /// The name that was asked for.
        name: String,
        /// The names that this machine understands, separated by commas.
        available: String,
    },
    /// Something was drawn already, with another level.
    #[error("SIMD level `{name}` was chosen too late: another level is already in use")]
    TooLate {
        /// The name that was asked for.
        name: String,
    },
}

/// The level that kernels are called with, chosen on the machine when first asked. Pictures do not depend on it.
#[inline]
pub fn level() -> Level {
    *CHOSEN.get_or_init(Level::new)
}

/// Every level that this machine has, with its name, from the poorest to the richest.
pub fn available() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    let mut levels = vec![("baseline", baseline())];
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        // Where kernels are not compiled for it, it is the baseline by another name; see `.cargo/config.toml`.
        #[cfg(not(disable_dispatch_sse4_2))]
        levels.extend(best.as_sse4_2().map(|token| ("sse4.2", Level::Sse4_2(token))));
        levels.extend(best.as_avx2().map(|token| ("avx2", Level::Avx2(token))));
        levels.extend(best.as_avx512().map(|token| ("avx512", Level::Avx512(token))));
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    levels.push(("best", best));
    levels
}

/// Fixes the level by name for the whole process: `auto`, or a name of [`available`].
///
/// # Errors
/// When this machine has no such level, or kernels already run with another one.
pub fn choose(name: &str) -> Result<(), ChooseError> {
    let level = if name == "auto" {
        Level::new()
    } else {
        let levels = available();
        let found = levels.iter().find(|(known, _)| *known == name);
        found.map(|(_, level)| *level).ok_or_else(|| ChooseError::Unavailable {
            name: name.to_owned(),
            available: levels.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
        })?
    };
    let in_use = *CHOSEN.get_or_init(|| level);
    if std::mem::discriminant(&in_use) == std::mem::discriminant(&level) {
        Ok(())
    } else {
        Err(ChooseError::TooLate { name: name.to_owned() })
    }
}

/// What every processor of the architecture has: SSE2 on x86-64, NEON on 64-bit ARM.
fn baseline() -> Level {
    Level::baseline()
}

/// Every level of this machine; with the feature `scalar` the one without vector instructions, too.
#[cfg(test)]
pub(crate) fn tested() -> Vec<(&'static str, Level)> {
    #[cfg(feature = "scalar")]
    let levels = [available(), vec![("scalar", Level::fallback())]].concat();
    #[cfg(not(feature = "scalar"))]
    let levels = available();
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_is_chosen_once_and_named_where_it_is_unknown() {
        let unknown = choose("mmx").expect_err("no such level");
        let text = unknown.to_string();
        assert!(text.contains("`mmx`") && text.contains("baseline"), "{text}");
        choose("auto").expect("the best one is always there");
        choose("auto").expect("and may be chosen again");
        assert_eq!(
            std::mem::discriminant(&level()),
            std::mem::discriminant(&Level::new()),
            "the best"
        );
        // On 64-bit ARM the baseline is the best there is.
        let poorest = std::mem::discriminant(&baseline());
        if poorest != std::mem::discriminant(&level()) {
            let late = choose("baseline").expect_err("kernels may run already");
            assert_eq!(
                late,
                ChooseError::TooLate {
                    name: "baseline".into()
                },
                "too late"
            );
        }
    }
}
