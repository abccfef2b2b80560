//! Values that decide where samples lie, what is computed at them, and how they make a pixel.

use super::ValueNote;

/// What a pattern other than the grid costs that has one set of places.
const SAME_PLACES: &str = "about twice the grid's time at 16 samples";
/// The same of patterns that place samples anew in each pixel.
const OWN_PLACES: &str = "about three times the grid's time at 16 samples";

/// What patterns are compared with.
const GRID: &str = "pattern grid";

const fn pattern(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("pattern", value, does, costs)
}

/// Where samples lie.
pub(super) const PATTERNS: &[ValueNote] = &[
    pattern(
        "grid",
        "Samples lie in the middles of n x n cells",
        "least: rows of samples are decided at once",
    ),
    pattern(
        "rotated",
        "The grid turned a little, so that no two samples share a row or column",
        SAME_PLACES,
    )
    .beside(["13_thin_rays", "sample-rate 16", GRID],
        ["34_leaning_edges", "sample-rate 16", GRID],
    ),
    pattern(
        "jittered",
        "Each sample lies anywhere in its cell, elsewhere in every pixel: aliases become noise",
        OWN_PLACES,
    )
    .beside(["04_picket_fence", "sample-rate 4", GRID],
        ["01_zone_plate", "sample-rate 16", GRID],
    ),
    pattern(
        "jittered-same",
        "Each sample lies anywhere in its cell, at the same place in every pixel: edges stay straight, and some aliases stay, too",
        SAME_PLACES,
    )
    .beside(["04_picket_fence", "sample-rate 16", GRID],
        ["21_fine_spokes", "sample-rate 16", GRID],
    ),
    pattern(
        "multi-jittered",
        "Jittered, and no two samples share one of n² rows or columns: upright and level edges have less noise",
        OWN_PLACES,
    )
    .beside(["15_upright_bars", "sample-rate 16", GRID],
        ["34_leaning_edges", "sample-rate 4", GRID],
    ),
    pattern(
        "random",
        "Samples lie anywhere, elsewhere in every pixel: aliases become noise, the most of all patterns",
        OWN_PLACES,
    )
    .beside(["04_picket_fence", "sample-rate 4", GRID],
        ["14_one_edge", "sample-rate 16", GRID],
    ),
    pattern(
        "halton",
        "Radical inverses in bases 2 and 3: any number of samples is possible",
        SAME_PLACES,
    )
    .beside(["13_thin_rays", "sample-rate 16", GRID],
        ["02_siemens_star", "sample-rate 16", GRID],
    ),
    pattern(
        "hammersley",
        "Evenly from left to right, radical inverses from top to bottom: upright and level edges have a shade for every sample",
        SAME_PLACES,
    )
    .beside(["04_picket_fence", "sample-rate 16", GRID],
        ["34_leaning_edges", "sample-rate 16", GRID],
    ),
    pattern(
        "sobol",
        "A (0, 2)-sequence, scrambled otherwise in every pixel: even in all rows, columns and boxes, with fine noise",
        OWN_PLACES,
    )
    .beside(["33_nearly_level_edges", "sample-rate 16", GRID],
        ["01_zone_plate", "sample-rate 16", GRID],
    ),
    pattern(
        "sobol-same",
        "A (0, 2)-sequence, scrambled alike in every pixel: as even, without noise",
        SAME_PLACES,
    )
    .beside(["14_one_edge", "sample-rate 16", GRID],
        ["21_fine_spokes", "sample-rate 16", GRID],
    ),
    pattern(
        "blue-noise",
        "A (0, 2)-sequence, shifted so that neighbouring pixels differ most: noise of the finest grain",
        OWN_PLACES,
    )
    .beside(["13_thin_rays", "sample-rate 16", GRID],
        ["01_zone_plate", "sample-rate 16", GRID],
    ),
    pattern(
        "r2",
        "Steps by the plastic number: any number of samples keeps apart",
        SAME_PLACES,
    )
    .beside(["04_picket_fence", "sample-rate 4", GRID],
        ["02_siemens_star", "sample-rate 16", GRID],
    ),
    pattern(
        "msaa-2",
        "The 2 places of multisampling in Vulkan and Direct3D 11",
        "little more than the grid's time with as many samples",
    )
    .beside(["14_one_edge", "", "pattern grid, sample-rate 1"], ["34_leaning_edges", "", "pattern grid, sample-rate 4"]),
    pattern(
        "msaa-4",
        "The 4 places of multisampling in Vulkan and Direct3D 11: the rotated grid",
        SAME_PLACES,
    )
    .beside(["13_thin_rays", "", "pattern grid, sample-rate 4"], ["34_leaning_edges", "", "pattern grid, sample-rate 4"]),
    pattern(
        "msaa-8",
        "The 8 places of multisampling in Vulkan and Direct3D 11: no two share a row or column",
        SAME_PLACES,
    )
    .beside(["33_nearly_level_edges", "", "pattern grid, sample-rate 9"],
        ["34_leaning_edges", "", "pattern grid, sample-rate 9"],
    ),
    pattern(
        "msaa-16",
        "The 16 places of multisampling in Vulkan and Direct3D 11: no two share a row or column",
        SAME_PLACES,
    )
    .beside(["13_thin_rays", "", "pattern grid, sample-rate 16"], ["01_zone_plate", "", "pattern grid, sample-rate 16"]),
];

/// What wide filters are compared with.
const BOX: &str = "resolve-filter box";

const fn filter(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("resolve-filter", value, does, costs).beside(
        ["21_fine_spokes", "sample-rate 16", BOX],
        ["22_what_filters_cost", "sample-rate 16", BOX],
    )
}

/// What is computed at samples, how they make a pixel, and what follows.
pub(super) const PIXELS: &[ValueNote] = &[
    ValueNote::new(
        "shading-rate",
        "sample",
        "Computes a colour at every sample, which is supersampling",
        "as many colours as samples",
    ),
    ValueNote::new(
        "shading-rate",
        "centre",
        "Computes one colour per primitive and pixel, in its middle, which is multisampling: edges are smooth, textures alias",
        "one colour for all samples, and gives a wrong one where the middle lies outside",
    )
    .beside(
        ["23_one_colour_a_pixel", "sample-rate 16", "shading-rate sample, sample-rate 1"],
        ["24_what_one_colour_misses", "sample-rate 16", "shading-rate sample"],
    ),
    ValueNote::new(
        "shading-rate",
        "centroid",
        "Computes one colour per primitive and pixel, in the mean of the samples that it covers, so that it is never outside",
        "one colour for all samples, and gives uneven steps of colour along edges",
    )
    .beside(
        ["23_one_colour_a_pixel", "sample-rate 16", "shading-rate sample, sample-rate 1"],
        ["24_what_one_colour_misses", "sample-rate 16", "shading-rate sample"],
    ),
    ValueNote::new(
        "coverage",
        "sampled",
        "Samples tell how much of a pixel a primitive covers",
        "time for every sample, and gives no more shades than they can tell apart",
    ),
    ValueNote::new(
        "coverage",
        "exact",
        "Paints by the exact area that a primitive covers, as renderers of vector graphics do",
        "about the time of 16 samples, several times that where many edges cross; one colour per pixel, and seams between neighbours",
    )
    .beside(
        ["30_exact_greys", "sample-rate 16", "coverage sampled"],
        ["31_seams_of_a_mesh", "sample-rate 16", "coverage sampled"],
    ),
    ValueNote::new(
        "resolve-filter",
        "box",
        "Averages the pixel's own samples alone, each with the same weight",
        "least, and lets details finer than a pixel leave false stripes",
    ),
    filter(
        "tent",
        "Weighs samples up to a pixel away, less the farther they are",
        "about three times the time of the box at 16 samples on the grid, and blurs a little; it never rings",
    ),
    filter(
        "gaussian",
        "Weighs samples up to 1.5 pixels away by a bell curve",
        "about three times the time of the box at 16 samples on the grid, and blurs; it never rings",
    ),
    filter(
        "b-spline",
        "Weighs samples up to two pixels away by a cubic bell: the fewest aliases of all",
        "about three times the time of the box at 16 samples on the grid, and blurs most; it never rings",
    ),
    filter(
        "catmull-rom",
        "Weighs samples up to two pixels away, some below zero: a sharp cubic",
        "about three times the time of the box at 16 samples on the grid, and rings at edges",
    ),
    filter(
        "mitchell",
        "Weighs samples up to two pixels away, some below zero: a cubic between blur and ringing",
        "about three times the time of the box at 16 samples on the grid, and blurs and rings a little",
    ),
    filter(
        "lanczos2",
        "A windowed sinc up to two pixels away: as sharp as Catmull-Rom's",
        "about three times the time of the box at 16 samples on the grid, and rings at edges",
    ),
    filter(
        "lanczos3",
        "A windowed sinc up to three pixels away: the sharpest",
        "about four times the time of the box at 16 samples on the grid, and rings most",
    ),
    filter(
        "blackman-harris",
        "A window up to 1.5 pixels away, close to a Gaussian that ends smoothly",
        "about three times the time of the box at 16 samples on the grid, and blurs a little; it never rings",
    ),
    ValueNote::new(
        "resolve",
        "stored",
        "Averages samples as they are stored, as most programs do",
        "nothing, and shows thin light lines on dark ground too dark",
    ),
    ValueNote::new(
        "resolve",
        "linear",
        "Averages samples as light, so that black and white lines make a brighter grey",
        "up to twice the time, and shows thin dark lines on light ground paler",
    ),
    ValueNote::new(
        "post-process",
        "none",
        "Leaves the pixels as the samples made them",
        "nothing",
    ),
    ValueNote::new(
        "post-process",
        "smaa",
        "Guesses from the finished pixels where edges were, and smooths them (SMAA), as games do",
        "some milliseconds at any rate, and blurs fine detail; what samples missed stays missed",
    )
    .beside(
        ["28_guessed_edges", "", "post-process none"],
        ["29_what_guesses_miss", "", "post-process none, sample-rate 4"],
    ),
];
