//! Numbers of reports without the rounding of their last bits.

/// To millionths.
pub(super) fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_they_were_measured() {
        for (value, text) in [
            (0.317_221_000_000_000_03, "0.317221"),
            (0.0, "0.0"),
            (4.726_999_999_999_999, "4.727"),
        ] {
            assert_eq!(format!("{:?}", rounded(value)), text, "{value}");
        }
    }
}
