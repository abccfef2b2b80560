//! The binary on the command line.

mod arguments;
mod boards;
mod diff;
mod disk;
mod figures;
mod full_disk;
mod guess;
mod hostile_names;
mod interrupts;
mod lessons;
mod outputs;
mod patterns;
mod profiles;
mod records;
mod spectra;
mod sweep;
mod writeup;
