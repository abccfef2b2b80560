//! Invented names of places, the same every time.

use super::chance::Chance;

const HEADS: [&str; 24] = [
    "AL", "BRA", "COR", "DEL", "ER", "FAR", "GAL", "HOL", "IL", "JUN", "KAR", "LIM", "MON", "NOR", "OS", "PEL", "QUIN",
    "ROS", "SAL", "TOR", "UL", "VES", "WIN", "ZAN",
];
const MIDDLES: [&str; 12] = [
    "A", "E", "I", "O", "U", "ENI", "ARA", "OLO", "UVI", "ISE", "ANTA", "ERRO",
];
const TAILS: [&str; 16] = [
    "BURG", "DEN", "FORD", "GATE", "HAVEN", "LAND", "MAR", "MOUTH", "NA", "POLIS", "RIA", "STEAD", "TOWN", "VILLE",
    "WICK", "SUND",
];

/// A name of two or three parts.
pub(crate) fn place(chance: &mut Chance) -> String {
    let middle = if chance.unit() < 0.45 {
        chance.pick(&MIDDLES)
    } else {
        ""
    };
    format!("{}{middle}{}", chance.pick(&HEADS), chance.pick(&TAILS))
}
