//! How large panels and their letters are, apart from the picture, whose pixels are always the screen's.

/// A size of the interface in percent of the monitor's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InterfaceScale(u16);

/// What the keys step through, in percent.
const STEPS: [u16; 13] = [50, 60, 70, 80, 90, 100, 110, 125, 150, 175, 200, 250, 300];

impl Default for InterfaceScale {
    fn default() -> Self {
        Self::ORIGINAL
    }
}

impl InterfaceScale {
    /// The monitor's own.
    pub const ORIGINAL: Self = Self(100);

    /// The nearest size of 50 to 300 percent.
    pub fn from_percent(percent: u32) -> Self {
        let [smallest, .., largest] = STEPS;
        let percent = percent.clamp(smallest.into(), largest.into());
        Self(u16::try_from(percent).unwrap_or(largest))
    }

    /// In percent.
    pub fn percent(self) -> u16 {
        self.0
    }

    /// As a factor: 1 is the monitor's own.
    pub fn factor(self) -> f32 {
        f32::from(self.0) / 100.0
    }

    /// The next larger one, or with `up` false the next smaller one.
    #[must_use]
    pub fn step(self, up: bool) -> Self {
        let next = if up {
            STEPS.into_iter().find(|step| *step > self.0)
        } else {
            STEPS.into_iter().rev().find(|step| *step < self.0)
        };
        next.map_or(self, Self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_reach_both_ends_and_stay_there() {
        let far = |up| (0..STEPS.len()).fold(InterfaceScale::ORIGINAL, |scale, _| scale.step(up));
        assert_eq!((far(false).percent(), far(true).percent()), (50, 300));
        assert_eq!(
            InterfaceScale::from_percent(112).step(true).percent(),
            125,
            "off the steps"
        );
        assert_eq!(
            InterfaceScale::from_percent(112).step(false).percent(),
            110,
            "off the steps"
        );
        assert_eq!(InterfaceScale::from_percent(7).percent(), 50);
        assert_eq!(InterfaceScale::from_percent(u32::MAX).percent(), 300);
    }
}
