//! Values that decide how textures are read.

use super::ValueNote;

/// One value per pixel, read as most engines do.
const LINEAR: &str = "level-sampling linear, pixel-sampling bilinear";

const fn kernel(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("pixel-sampling", value, does, costs)
}

const fn level(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("level-sampling", value, does, costs)
}

const fn wrap(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("texture-wrap", value, does, costs)
}

const fn pyramid(value: &'static str, does: &'static str, costs: &'static str) -> ValueNote {
    ValueNote::new("pyramid", value, does, costs)
}

/// All of them.
pub(super) const NOTES: &[ValueNote] = &[
    kernel(
        "nearest",
        "Takes the texel that the point lies in: hard squares where texels are large",
        "least",
    ),
    kernel(
        "bilinear",
        "Mixes the four texels around the point: smooth, with creases along rows of texels",
        "four texels a sample, and is soft where texels are large",
    )
    .beside(
        ["06_zone_texture", "sample-rate 16", "pixel-sampling nearest"],
        [
            "26_hard_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling nearest",
        ],
    ),
    kernel(
        "catmull-rom",
        "Weighs sixteen texels, some below zero: the sharpest cubic, which goes through all texels",
        "some four times the time of the nearest texel, and rings at edges",
    )
    .beside(
        [
            "25_few_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling bilinear",
        ],
        [
            "26_hard_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling nearest",
        ],
    ),
    kernel(
        "b-spline",
        "Weighs sixteen texels, none below zero: the smoothest cubic",
        "some four times the time of the nearest texel, and blurs",
    )
    .beside(
        ["06_zone_texture", "sample-rate 16", "pixel-sampling bilinear"],
        [
            "25_few_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling bilinear",
        ],
    ),
    kernel(
        "mitchell",
        "Weighs sixteen texels, some below zero: a cubic between blur and ringing",
        "some four times the time of the nearest texel, and blurs and rings a little",
    )
    .beside(
        [
            "25_few_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling bilinear",
        ],
        [
            "26_hard_texels",
            "sample-rate 16, lod-level 2",
            "pixel-sampling nearest",
        ],
    ),
    wrap(
        "clamp",
        "Goes on beyond a texture's border with its outermost texels",
        "least, and leaves streaks beyond the border",
    ),
    wrap(
        "repeat",
        "Begins the texture anew beyond its border (study/27_beyond_the_border)",
        "little, and lets the first texels take on the colour of the last ones",
    ),
    wrap(
        "mirror",
        "Turns the texture round beyond its border, so that no seam shows (study/27_beyond_the_border)",
        "little, and turns every second tile the wrong way round",
    ),
    level(
        "zero",
        "Reads the full texture at any distance",
        "least, and lets sparkle what is far",
    ),
    level(
        "nearest",
        "Reads the mip level whose texels are closest to the footprint's size",
        "little, and shows a step where the level changes",
    )
    .beside(
        ["07_checker_floor", "", "level-sampling zero"],
        ["12_sharp_or_still", "sample-rate 16", "level-sampling zero"],
    ),
    level(
        "linear",
        "Mixes the two mip levels around the footprint's size: no steps",
        "little, and blurs what is seen at a slant",
    )
    .beside(
        ["07_checker_floor", "", "level-sampling zero"],
        ["12_sharp_or_still", "sample-rate 16", "level-sampling zero"],
    ),
    level(
        "ewa",
        "Weighs all texels under the footprint's ellipse by a bell curve: the reference of filters",
        "some forty times level zero with one sample, and blurs where texels are larger than pixels",
    )
    .beside(
        ["32_checker_fan_turned", LINEAR, LEVELS],
        ["26_hard_texels", LINEAR, LEVELS],
    ),
    level(
        "summed-area",
        "Averages an upright box of texels exactly, from a table of sums",
        "some ten times level zero with one sample, and blurs where a footprint lies askew",
    )
    .beside(
        ["06_zone_texture", LINEAR, LEVELS],
        ["32_checker_fan_turned", LINEAR, "level-sampling ewa"],
    ),
    level(
        "ripmap",
        "Reads levels that are narrowed in width and height apart: sharp along the axes",
        "some four times level zero with one sample and four times its memory, and blurs where a footprint lies askew",
    )
    .beside(
        ["07_checker_floor", LINEAR, LEVELS],
        ["32_checker_fan_turned", LINEAR, LEVELS],
    ),
    ValueNote::new(
        "lod-by",
        "longer",
        "Chooses the mip level by the longer side of the footprint: sparkles least",
        "nothing, and blurs what is seen at a slant",
    ),
    ValueNote::new(
        "lod-by",
        "area",
        "Chooses the mip level by the footprint's area: sharper at a slant",
        "nothing, and sparkles a little",
    )
    .beside(
        ["11_city_floor", LINEAR, BY_LONGER],
        ["08_checker_fan", LINEAR, BY_LONGER],
    ),
    ValueNote::new(
        "lod-by",
        "shorter",
        "Chooses the mip level by the ellipse's shorter axis: as sharp as can be",
        "nothing, and aliases along the longer axis",
    )
    .beside(
        ["11_city_floor", LINEAR, BY_LONGER],
        ["07_checker_floor", LINEAR, BY_LONGER],
    ),
    ValueNote::new(
        "lod-per",
        "pixel",
        "Takes a pixel's footprint for the mip level at any rate: as smooth as with one sample",
        "nothing, and lets samples average what is smooth already",
    ),
    ValueNote::new(
        "lod-per",
        "sample",
        "Takes a sample's footprint: with more samples finer mip levels are read, as fine as they can carry",
        "nothing, and leaves some aliases",
    )
    .beside(
        [
            "12_sharp_or_still",
            "sample-rate 16, level-sampling linear, pixel-sampling bilinear",
            "lod-per pixel",
        ],
        [
            "08_checker_fan",
            "sample-rate 4, level-sampling linear",
            "lod-per pixel",
        ],
    ),
    pyramid(
        "stored",
        "Averages texels as they are stored for the coarser levels",
        "nothing, and makes fine patterns too dark where samples are averaged as light",
    ),
    pyramid(
        "linear",
        "Averages texels as light for the coarser levels, as samples are with resolve linear",
        "nothing while drawing, and makes fine patterns too light where samples are averaged as stored",
    )
    .beside(
        [
            "07_checker_floor",
            "resolve linear, level-sampling linear, pixel-sampling bilinear",
            "pyramid stored",
        ],
        ["07_checker_floor", LINEAR, "pyramid stored"],
    ),
    ValueNote::new(
        "pyramid-filter",
        "box",
        "Averages two by two texels for each coarser one",
        "nothing, and lets a little of what is too fine alias",
    ),
    ValueNote::new(
        "pyramid-filter",
        "tent",
        "Weighs four by four texels for each coarser one: the softest, for a bias below zero",
        "nothing while drawing, and blurs",
    )
    .beside(
        [
            "08_checker_fan",
            "lod-bias -1, level-sampling linear, pixel-sampling bilinear",
            "pyramid-filter box",
        ],
        ["07_checker_floor", LINEAR, "pyramid-filter box"],
    ),
    ValueNote::new(
        "pyramid-filter",
        "kaiser",
        "Weighs a windowed sinc of texels for each coarser one: sharp, with few aliases",
        "nothing while drawing, and rings a little at edges",
    )
    .beside(
        ["06_zone_texture", LINEAR, "pyramid-filter box"],
        ["08_checker_fan", LINEAR, "pyramid-filter box"],
    ),
];

/// What ways to weigh an area are compared with.
const LEVELS: &str = "level-sampling linear";
/// What other levels of detail are compared with.
const BY_LONGER: &str = "lod-by longer";
