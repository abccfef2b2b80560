//! What a document asks of its rendering: crisp edges, texels as they are, lines that no transform widens.

use rasterscope::geometry::View;
use rasterscope::raster::{Framebuffer, SamplePattern};
use rasterscope::render::{RenderSettings, draw};
use rasterscope::scene::{DialectChoice, Scene};
use rasterscope::texture::PixelSampling;

use crate::support::documents::{lines, read, svg};
use crate::support::explaining::advised;
use crate::support::scenes::at_rate;

const SIZE: [u32; 2] = [32, 24];

/// A document of 32 by 24 units, a unit for each pixel.
fn scene(body: &str) -> Scene {
    let scene = read(&svg("width='32' height='24'", body), DialectChoice::Svg);
    assert!(scene.report.is_empty(), "{body}: {:?}", lines(&scene));
    scene
}

fn frame(scene: &Scene, settings: &RenderSettings) -> Vec<u32> {
    let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
    let view = View::Canvas.transform(scene.canvas, SIZE);
    draw(scene, &view, settings, &mut frame);
    frame.pixels().to_vec()
}

/// A disc, and a line over it.
fn shapes(rendering: &str) -> Scene {
    scene(&format!(
        "<g {rendering}><circle cx='14.6' cy='11.6' r='9.2' fill='#08a'/>\
         <path d='M2.2 3.1 28.7 19.4' stroke='#800' stroke-width='1.3'/></g>"
    ))
}

#[test]
fn crisp_shapes_look_at_every_rate_as_at_one_sample() {
    let once = frame(&shapes(""), &at_rate(1));
    for rendering in [
        "shape-rendering='crispEdges'",
        "shape-rendering='optimizeSpeed'",
        "style='shape-rendering:crispEdges'",
    ] {
        let crisp = shapes(rendering);
        for rate in [1, 4, 9, 16, 64] {
            assert_eq!(frame(&crisp, &at_rate(rate)), once, "{rendering} at rate {rate}");
        }
        for pattern in [SamplePattern::Jittered, SamplePattern::Halton] {
            let settings = RenderSettings { pattern, ..at_rate(16) };
            assert_eq!(frame(&crisp, &settings), once, "{rendering}, {pattern:?}");
        }
    }
    let smooth = shapes("shape-rendering='geometricPrecision'");
    assert_ne!(frame(&smooth, &at_rate(16)), once, "others have smooth edges");
}

#[test]
fn crisp_shapes_tell_why_their_edges_are() {
    let crisp = shapes("shape-rendering='crispEdges'");
    let smooth = frame(&shapes(""), &at_rate(16));
    let once = frame(&crisp, &at_rate(16));
    // On the left border of the disc.
    let at = |x: usize| 11 * SIZE[0] as usize + x;
    let x = (0..14).find(|x| smooth[at(*x)] != once[at(*x)]).expect("a border");
    let pixel = [u32::try_from(x).expect("a column"), 11];
    let found = advised(&crisp, &at_rate(16), SIZE, pixel);
    // Lines are broken where they are long.
    let text = found.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    let inside = found.paints.iter().any(|paint| !paint.fragments.is_empty());
    let (drawn, middle) = if inside { ("all", "inside") } else { ("none", "outside") };
    for part in [
        &format!("and {drawn} of it as drawn: shape-rendering asks for one sample per pixel"),
        &format!("the pixel's middle is {middle} by the rule nonzero"),
    ] {
        assert!(!inside || text.contains(part), "{part} in {text}");
    }
    assert!(!text.contains("By its samples"), "nobody asked them: {text}");
}

/// A PNG of 2 x 1 texels, black and white.
const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNg+A8AAQIBAEK+vGgAAAAASUVORK5CYII=";

#[test]
fn pixelated_images_keep_their_texels() {
    let bilinear = RenderSettings {
        pixel_sampling: PixelSampling::Bilinear,
        ..at_rate(4)
    };
    let image = |rendering: &str| {
        scene(&format!(
            "<image width='32' height='16' preserveAspectRatio='none' {rendering} href='{PNG}'/>"
        ))
    };
    let plain = image("");
    assert_ne!(
        frame(&plain, &bilinear),
        frame(&plain, &at_rate(4)),
        "a ramp and an edge"
    );
    for rendering in [
        "image-rendering='pixelated'",
        "image-rendering='optimizeSpeed'",
        "style='image-rendering:crisp-edges'",
    ] {
        let pixelated = image(rendering);
        assert_eq!(frame(&pixelated, &bilinear), frame(&plain, &at_rate(4)), "{rendering}");
        let text = advised(&pixelated, &bilinear, SIZE, [15, 5]).to_string();
        assert!(text.contains("read nearest as image-rendering asks"), "{text}");
    }
    for rendering in ["auto", "smooth", "optimizeQuality"] {
        let smooth = image(&format!("image-rendering='{rendering}'"));
        assert_eq!(frame(&smooth, &bilinear), frame(&plain, &bilinear), "{rendering}");
    }
    let both = scene(&format!(
        "<image href='{PNG}'/><image href='{PNG}' image-rendering='pixelated'/>"
    ));
    assert_eq!(both.files.textures.len(), 0, "an embedded image is no file");
    assert_eq!(both.textures.len(), 2, "one file, read in two ways");
}

#[test]
fn lines_that_do_not_scale_are_as_wide_as_the_canvas_says() {
    let line = |transform: &str, look: &str, inside: &str| {
        scene(&format!(
            "{inside}<g transform='{transform}'><path class='thin' d='M1 1H3' stroke='#000' {look}/></g>"
        ))
    };
    let wide = |scene: &Scene| {
        let [low, high] = match &scene.primitives[0].kind {
            rasterscope::scene::PrimitiveKind::Polygon { polygon, .. } => polygon.bounds(),
            other => panic!("a stroke: {other:?}"),
        };
        format!("{:.2} x {:.2}", high.x - low.x, high.y - low.y)
    };
    let look = "stroke-width='2' vector-effect='non-scaling-stroke'";
    assert_eq!(wide(&line("scale(4)", "stroke-width='2'", "")), "8.00 x 8.00", "scaled");
    assert_eq!(wide(&line("scale(4)", look, "")), "8.00 x 2.00", "by an attribute");
    assert_eq!(wide(&line("scale(1 9)", look, "")), "2.00 x 2.00", "in one direction");
    let style = "style='stroke-width:2;vector-effect:non-scaling-stroke'";
    assert_eq!(wide(&line("scale(4)", style, "")), "8.00 x 2.00", "by its style");
    let sheet = "<style>path.thin{vector-effect:non-scaling-stroke;stroke-width:2}</style>";
    assert_eq!(wide(&line("scale(4)", "", sheet)), "8.00 x 2.00", "by a style sheet");
    let none = format!("{look} style='vector-effect:none'");
    assert_eq!(wide(&line("scale(4)", &none, "")), "8.00 x 8.00", "the style wins");
    let used = scene(&format!(
        "<defs><path id='p' d='M1 1H3' stroke='#000' {look}/></defs><use href='#p' transform='scale(4)'/>"
    ));
    assert_eq!(wide(&used), "8.00 x 2.00", "what is used again");
    let outer = scene(&format!(
        "<g vector-effect='non-scaling-stroke'>{}</g>",
        "<path d='M1 1H3' transform='scale(4)' stroke='#000' stroke-width='2'/>"
    ));
    assert_eq!(wide(&outer), "8.00 x 8.00", "it is not inherited");
    let dashes = |look: &str| {
        let scene = line("scale(4)", &format!("{look} stroke-dasharray='2'"), "");
        match &scene.primitives[0].kind {
            rasterscope::scene::PrimitiveKind::Polygon { polygon, .. } => polygon.contours().count(),
            other => panic!("a stroke: {other:?}"),
        }
    };
    assert_eq!(
        [dashes("stroke-width='2'"), dashes(look)],
        [1, 2],
        "dashes do not scale either"
    );
}
