//! Keys and how a press finds its command on any keyboard layout.
//!
//! A press carries the character that the layout makes of it (logical) and the place of the key, named by what a
//! US keyboard has there (physical). The character decides first, so `=` is found wherever a layout keeps it; the
//! place helps where a layout has no such character: Cyrillic letters, the digits of AZERTY, `[` on QWERTZ.

use std::fmt;

/// A key, by the character it makes or by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A character other than the blank; letters in lower case.
    Char(char),
    /// The space bar.
    Space,
    /// Esc.
    Escape,
    /// Enter, on the keypad too.
    Enter,
    /// Tab.
    Tab,
    /// Arrow left.
    Left,
    /// Arrow right.
    Right,
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// A function key, counted from 1.
    F(u8),
}

/// Ctrl (Command on a Mac), Shift and Alt, in any combination.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Modifiers(u8);

/// A key with its modifiers, as the command table names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Chord {
    /// What the key makes, or is.
    pub key: Key,
    /// Held with it. Shift is not told for characters other than letters: `?` needs it on one layout, not on another.
    pub modifiers: Modifiers,
    /// Where a US keyboard has the chord: key without Shift, and modifiers. `None` when the place decides nothing.
    pub place: Option<(Key, Modifiers)>,
}

/// One press of a key, as the keyboard reports it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct KeyPress {
    /// What the layout makes of the key with the modifiers held. For a dead key the character it would add.
    pub logical: Option<Key>,
    /// The key's place, named by what a US keyboard has there without Shift.
    pub physical: Option<Key>,
    /// What is held.
    pub modifiers: Modifiers,
}

/// Every key that has a name, with the names that scripts may use; the first is the one shown.
const NAMES: [(Key, &[&str]); 11] = [
    (Key::Space, &["Space"]),
    (Key::Escape, &["Esc", "Escape"]),
    (Key::Enter, &["Enter", "Return"]),
    (Key::Tab, &["Tab"]),
    (Key::Left, &["Left"]),
    (Key::Right, &["Right"]),
    (Key::Up, &["Up"]),
    (Key::Down, &["Down"]),
    (Key::PageUp, &["PageUp"]),
    (Key::PageDown, &["PageDown"]),
    (Key::Char('+'), &["+", "Plus"]),
];

impl Modifiers {
    /// Nothing held.
    pub const NONE: Self = Self(0);
    /// Ctrl, or Command on a Mac.
    pub const CTRL: Self = Self(1);
    /// Shift.
    pub const SHIFT: Self = Self(2);
    /// Alt, and `AltGr` where the system reports it as Alt.
    pub const ALT: Self = Self(4);

    /// Both.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// These without `other`.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether all of `other` are held.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

impl Key {
    /// The key that makes `character`; letters of either case are one key.
    pub fn from_char(character: char) -> Self {
        if character == ' ' {
            return Self::Space;
        }
        let mut lower = character.to_lowercase();
        match (lower.next(), lower.next()) {
            (Some(one), None) => Self::Char(one),
            _ => Self::Char(character),
        }
    }

    /// The key of this name, such as `PageUp`, `f5` or `=`; case does not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        let named = NAMES
            .iter()
            .find(|(_, names)| names.iter().any(|n| n.eq_ignore_ascii_case(name)));
        if let Some((key, _)) = named {
            return Some(*key);
        }
        let mut characters = name.chars();
        match (characters.next(), characters.next()) {
            (Some(one), None) if !one.is_control() => Some(Self::from_char(one)),
            (Some('f' | 'F'), Some(_)) => match name[1..].parse() {
                Ok(number @ 1..=12) => Some(Self::F(number)),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether Shift is part of the key's meaning rather than of how a layout makes its character.
    fn tells_shift(self) -> bool {
        match self {
            Self::Char(character) => character.is_alphabetic(),
            _ => true,
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, names)) = NAMES.iter().find(|(key, _)| key == self) {
            return f.write_str(names[0]);
        }
        match self {
            Self::Char(character) => write!(f, "{}", character.to_uppercase()),
            Self::F(number) => write!(f, "F{number}"),
            _ => write!(f, "{self:?}"),
        }
    }
}

impl Chord {
    /// `key` with `modifiers`, in the place where a US keyboard has it.
    pub const fn new(key: Key, modifiers: Modifiers) -> Self {
        Self {
            key,
            modifiers,
            place: Some((key, modifiers)),
        }
    }

    /// A character without modifiers.
    pub const fn char(character: char) -> Self {
        Self::new(Key::Char(character), Modifiers::NONE)
    }

    /// A character without modifiers, wherever a layout makes it.
    pub const fn anywhere(character: char) -> Self {
        Self {
            key: Key::Char(character),
            modifiers: Modifiers::NONE,
            place: None,
        }
    }

    /// A character that a US keyboard makes from `base` with Shift.
    pub const fn shifted(character: char, base: char) -> Self {
        Self {
            key: Key::Char(character),
            modifiers: Modifiers::NONE,
            place: Some((Key::Char(base), Modifiers::SHIFT)),
        }
    }

    /// A named key without modifiers.
    pub const fn named(key: Key) -> Self {
        Self::new(key, Modifiers::NONE)
    }

    /// A character with Ctrl.
    pub const fn ctrl(character: char) -> Self {
        Self::new(Key::Char(character), Modifiers::CTRL)
    }

    /// A letter with Ctrl and Shift.
    pub const fn ctrl_shift(character: char) -> Self {
        Self::new(Key::Char(character), Modifiers::CTRL.with(Modifiers::SHIFT))
    }

    /// Whether the layout's character (or the key's name) asks for this chord.
    pub fn matches_logical(&self, press: &KeyPress) -> bool {
        if press.logical != Some(self.key) {
            return false;
        }
        if self.key.tells_shift() {
            return press.modifiers == self.modifiers;
        }
        // Shift and AltGr made the character; Windows reports AltGr as Ctrl and Alt together.
        let alt_gr = Modifiers::CTRL.with(Modifiers::ALT);
        let held = if press.modifiers.contains(alt_gr) {
            press.modifiers.without(alt_gr)
        } else {
            press.modifiers.without(Modifiers::ALT)
        };
        held.without(Modifiers::SHIFT) == self.modifiers
    }

    /// Whether the key's place asks for this chord. A layout that makes a Latin letter or a digit of the key means
    /// just that: `W` of AZERTY, which lies where `Z` is on a US keyboard, must not act as `Z`.
    pub fn matches_place(&self, press: &KeyPress) -> bool {
        let means_itself = matches!(press.logical, Some(Key::Char(c)) if c.is_ascii_alphanumeric());
        let place = press.physical.map(|key| (key, press.modifiers));
        !means_itself && place.is_some() && place == self.place
    }
}

impl fmt::Display for Chord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let held = [
            (Modifiers::CTRL, "Ctrl+"),
            (Modifiers::SHIFT, "Shift+"),
            (Modifiers::ALT, "Alt+"),
        ];
        for (modifier, name) in held {
            if self.modifiers.contains(modifier) {
                f.write_str(name)?;
            }
        }
        self.key.fmt(f)
    }
}

impl KeyPress {
    /// A press of `key` with `modifiers` held, in no particular place.
    pub const fn logical(key: Key, modifiers: Modifiers) -> Self {
        Self {
            logical: Some(key),
            physical: None,
            modifiers,
        }
    }

    /// The press that a script or a person writes as `Ctrl+Shift+S`, `=` or `PageUp`; case does not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        let mut rest = name.trim();
        let mut modifiers = Modifiers::NONE;
        // A lone `+` is a key, and so is the last one of `Ctrl++`.
        while let Some((head, tail)) = rest.split_once('+').filter(|(_, tail)| !tail.is_empty()) {
            let modifier = match head.trim().to_ascii_lowercase().as_str() {
                "ctrl" | "control" | "cmd" => Modifiers::CTRL,
                "shift" => Modifiers::SHIFT,
                "alt" => Modifiers::ALT,
                _ => return None,
            };
            modifiers = modifiers.with(modifier);
            rest = tail.trim();
        }
        Key::from_name(rest).map(|key| Self::logical(key, modifiers))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(logical: char, physical: char, modifiers: Modifiers) -> KeyPress {
        KeyPress {
            logical: Some(Key::from_char(logical)),
            physical: Some(Key::Char(physical)),
            modifiers,
        }
    }

    #[test]
    fn name_round_trip() {
        for name in [
            "Ctrl+Shift+S",
            "=",
            "+",
            "Ctrl+0",
            "PageUp",
            "F5",
            "Space",
            "Esc",
            "`",
            "?",
            "Shift+Left",
        ] {
            let press = KeyPress::from_name(name).expect(name);
            let chord = Chord::new(press.logical.expect(name), press.modifiers);
            assert_eq!(chord.to_string(), name, "{press:?}");
        }
        for wrong in ["", "Hyper+X", "F13", "Fx", "abc", "Ctrl+", "+Ctrl"] {
            assert_eq!(KeyPress::from_name(wrong), None, "{wrong:?} is no key");
        }
    }

    #[test]
    fn layouts_logical_first() {
        // AZERTY: `-` lies on the digit 6, and digits need Shift.
        let dash = press('-', '6', Modifiers::NONE);
        assert!(Chord::char('-').matches_logical(&dash), "the character decides");
        assert!(
            Chord::char('1').matches_logical(&press('1', '1', Modifiers::SHIFT)),
            "Shift makes the digit"
        );
        assert!(
            Chord::char('1').matches_place(&press('&', '1', Modifiers::NONE)),
            "the place helps"
        );
        // AZERTY's W lies where a US keyboard has Z.
        assert!(
            !Chord::char('z').matches_place(&press('w', 'z', Modifiers::NONE)),
            "a Latin letter means itself"
        );
        // QWERTZ: `=` is Shift+0, `[` is AltGr+8, the place of `[` makes `ü`.
        assert!(
            Chord::char('=').matches_logical(&press('=', '0', Modifiers::SHIFT)),
            "Shift+0"
        );
        assert!(
            Chord::char('[').matches_logical(&press('[', '8', Modifiers::CTRL.with(Modifiers::ALT))),
            "AltGr+8"
        );
        assert!(
            Chord::char('[').matches_place(&press('ü', '[', Modifiers::NONE)),
            "the place of ["
        );
        // Swedish: `?` is Shift with the key right of 0.
        assert!(
            Chord::shifted('?', '/').matches_logical(&press('?', '-', Modifiers::SHIFT)),
            "Swedish ?"
        );
        assert!(
            Chord::char('s').matches_place(&press('ы', 's', Modifiers::NONE)),
            "Cyrillic"
        );
    }

    #[test]
    fn modifiers_tell_letters_apart() {
        let save = press('s', 's', Modifiers::NONE);
        let with_overlay = press('S', 's', Modifiers::CTRL.with(Modifiers::SHIFT));
        assert!(Chord::char('s').matches_logical(&save), "S");
        assert!(!Chord::char('s').matches_logical(&with_overlay), "not S");
        assert!(Chord::ctrl_shift('s').matches_logical(&with_overlay), "Ctrl+Shift+S");
        assert!(
            Chord::ctrl('0').matches_place(&press('à', '0', Modifiers::CTRL)),
            "AZERTY Ctrl+0"
        );
    }
}
