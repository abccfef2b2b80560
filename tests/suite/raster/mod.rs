//! What is drawn: coverage, patterns, rules, goldens, and the oracle that draws everything again.

mod areas;
mod coverage;
mod deep_zooms;
mod exact_coverage;
mod float_rules;
mod golden;
mod instruction_guard;
mod levels;
mod limits;
mod oracle;
mod patterns;
mod regions;
mod render;
mod resolve_filters;
mod robustness;
mod shading_rate;
mod smaa;
mod texture_kernels;
mod visualisation;
