//! The project itself: rooms and floors, documents, the front door, fuzzing seeds.

mod api;
mod architecture;
mod contributing;
mod floors;
mod fuzzing;
mod imports;
mod json;
mod readme;
mod values;
