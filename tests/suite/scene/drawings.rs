//! What drawings of today hold: gradients, patterns, clips, masks, blend modes, text, and things that are used again.

use std::sync::Arc;

use glam::{DAffine2, DVec2};
use rasterscope::color::{BlendMode, Rgba, Spread};
use rasterscope::geometry::{GradientShape, LineCap};
use rasterscope::scene::{Composite, DialectChoice, Fill, MaskKind, PrimitiveKind, Scene, Shape};

use crate::support::documents::{area, kinds, lines, read, svg};

fn svg_scene(body: &str) -> Scene {
    let root = "width='100' height='100' xmlns:xlink='http://www.w3.org/1999/xlink'";
    read(&svg(root, body), DialectChoice::Svg)
}

/// What kinds of primitives there are, in short.
fn outline(scene: &Scene) -> Vec<String> {
    let short = |kind: &PrimitiveKind| match kind {
        PrimitiveKind::Triangle { .. } => "triangle".to_owned(),
        PrimitiveKind::Polygon { fill, .. } => match fill {
            Fill::Solid(_) => "area".to_owned(),
            Fill::Gradient(_) => "gradient".to_owned(),
            Fill::Pattern(_) => "pattern".to_owned(),
        },
        PrimitiveKind::BeginLayer => "(".to_owned(),
        PrimitiveKind::EndLayer { composite } => match composite {
            Composite::Over { opacity, blend } => format!(") {} {opacity}", blend.name()),
            Composite::Clip => ") clip".to_owned(),
            Composite::Mask(MaskKind::Luminance) => ") luminance".to_owned(),
            Composite::Mask(MaskKind::Alpha) => ") alpha".to_owned(),
        },
        other => format!("{other:?}"),
    };
    kinds(scene).iter().map(short).collect()
}

/// The shapes that something is painted for, in painter's order, each once.
fn painted(scene: &Scene) -> Vec<&Shape> {
    let mut ids: Vec<_> = scene.primitives.iter().map(|primitive| primitive.shape).collect();
    ids.dedup();
    ids.into_iter().map(|id| &scene.shapes[id.0 as usize]).collect()
}

#[test]
fn curves_stay_curves() {
    let scene = svg_scene(
        "<circle r='40' transform='scale(2)'/><path d='M0 0C10 10 20 0 30 30Z'/><rect width='9' height='9'/>",
    );
    for (kind, curved) in kinds(&scene).iter().zip([true, true, false]) {
        let PrimitiveKind::Polygon { polygon, .. } = kind else {
            panic!("a polygon: {kind:?}");
        };
        assert_eq!(polygon.curves().is_some(), curved, "{kind:?}");
        assert_eq!(
            polygon.at_scale(4000.0).is_some(),
            curved,
            "finer edges where a view shows it larger"
        );
        assert!(polygon.at_scale(40.0).is_none(), "fine enough for 4000 samples");
    }
    let circle = svg_scene("<circle r='10'/>");
    // A tenth of a sample along its border: 0.0024 units of 62.8.
    assert!((area(&circle) - 314.159).abs() < 0.1, "{}", area(&circle));
}

#[test]
fn strokes_keep_their_dashes() {
    let scene = svg_scene(
        "<path d='M0 0H20' stroke='red' stroke-width='2' stroke-dasharray='3 1' stroke-dashoffset='1' stroke-linecap='round'/>",
    );
    let found = kinds(&scene);
    let [PrimitiveKind::Polygon { polygon, .. }] = found.as_slice() else {
        panic!("one stroke: {found:?}");
    };
    let stroke = polygon
        .curves()
        .and_then(|curves| curves.stroke.clone())
        .expect("a stroke");
    assert_eq!((stroke.dashes.as_slice(), stroke.dash_offset), (&[3.0, 1.0][..], 1.0));
    assert_eq!((stroke.style.width, stroke.style.cap), (2.0, LineCap::Round));
}

#[test]
fn gradients_are_resolved() {
    let scene = svg_scene(
        "<linearGradient id='base'><stop stop-color='red'/><stop offset='1' stop-color='blue' stop-opacity='.5'/></linearGradient>\
         <radialGradient id='round' href='#base' gradientUnits='userSpaceOnUse' cx='5' cy='6' r='7' fx='4' spreadMethod='reflect'/>\n\
         <rect width='10' height='20' fill='url(#base)' fill-opacity='.5'/>\
         <g fill='url(#round)'><rect width='10' height='20'/><rect x='50' width='10' height='20'/></g>",
    );
    assert_eq!(outline(&scene), ["gradient"; 3]);
    let [linear, radial] = scene.gradients.as_slice() else {
        panic!("each once: {:?}", scene.gradients);
    };
    let box_of_rect = DAffine2::from_scale(DVec2::new(10.0, 20.0));
    assert!(linear.to_user.abs_diff_eq(box_of_rect, 1e-6), "{:?}", linear.to_user);
    let colors: Vec<Rgba> = linear.ramp.stops().iter().map(|stop| stop.color).collect();
    assert_eq!(
        colors,
        [
            Rgba::opaque(1.0, 0.0, 0.0).faded(0.5),
            Rgba::opaque(0.0, 0.0, 1.0).faded(0.25)
        ]
    );
    let expected = GradientShape::Radial {
        center: DVec2::new(5.0, 6.0),
        radius: 7.0,
        focus: DVec2::new(4.0, 6.0),
        focal_radius: 0.0,
    };
    assert_eq!((radial.geometry, radial.ramp.spread()), (expected, Spread::Reflect));
    for (gradient, id) in [(linear, "base"), (radial, "round")] {
        let shape = &scene.shapes[gradient.shape.0 as usize];
        assert_eq!(shape.id.as_deref(), Some(id), "its own element");
    }
}

#[test]
fn gradients_by_boxes_know_their_element_whoever_uses_them() {
    let scene = svg_scene(
        "<linearGradient id='g'><stop stop-color='red'/><stop offset='1'/></linearGradient>\
         <rect width='10' height='20' fill='url(#g)'/><rect width='30' height='20' fill='url(#g)'/>",
    );
    assert_eq!(scene.gradients.len(), 2, "one for each box");
    for gradient in &scene.gradients {
        assert_eq!(&*scene.shapes[gradient.shape.0 as usize].element, "linearGradient");
    }
}

#[test]
fn patterns_are_scenes_of_their_own() {
    let scene = svg_scene(
        "<pattern id='p' x='3' y='4' width='5' height='6' patternUnits='userSpaceOnUse' patternTransform='scale(2)'>\
         <circle r='2'/><rect width='1' height='1' fill='url(#g)'/></pattern>\
         <linearGradient id='g'><stop/><stop offset='1'/></linearGradient>\
         <g transform='translate(10)'><rect width='50' height='50' fill='url(#p)' opacity='.5'/><rect width='9' height='9' fill='url(#p)'/></g>",
    );
    assert_eq!(outline(&scene), ["pattern", "pattern"]);
    let [faded, plain] = scene.patterns.as_slice() else {
        panic!("two of them: {:?}", scene.patterns);
    };
    assert_eq!((faded.opacity, plain.opacity), (0.5, 1.0));
    assert!(Arc::ptr_eq(&faded.tile, &plain.tile), "one tile");
    assert_eq!(plain.tile.canvas, DVec2::new(5.0, 6.0), "as large as the pattern says");
    assert_eq!(outline(&plain.tile), ["area", "gradient"]);
    let corner = plain.to_user.transform_point2(DVec2::ZERO);
    assert_eq!(corner, DVec2::new(16.0, 8.0), "moved and enlarged");
    assert_eq!(&*scene.shapes[plain.shape.0 as usize].element, "pattern");
    assert_eq!(
        &*plain.tile.shapes[plain.tile.primitives[0].shape.0 as usize].element,
        "circle"
    );
}

#[test]
fn clips_and_masks_are_layers() {
    let definitions = "<clipPath id='c'><circle r='9'/></clipPath>\
         <clipPath id='cc' clip-path='url(#c)'><path d='M0 0L5 0L0 5' clip-path='url(#c)'/></clipPath>\
         <clipPath id='none'><circle r='0'/></clipPath>\
         <mask id='m'><rect width='9' height='9' fill='white'/></mask>\
         <mask id='mm' mask='url(#m)' mask-type='alpha'><rect width='9' height='9'/></mask>";
    let clip = ["(", "area", ") clip"];
    let mask = ["(", "area", "(", "area", ") clip", ") luminance"];
    let alpha = ["(", "area", "(", "area", ") clip", ") alpha"];
    let over = [") normal 1"];
    for (attribute, expected) in [
        ("clip-path='url(#c)'", [&["(", "area"][..], &clip, &over].concat()),
        (
            "clip-path='url(#cc)'",
            [
                &["(", "area"][..],
                &clip,
                &["(", "(", "triangle"],
                &clip,
                &[") normal 1", ") clip"],
                &over,
            ]
            .concat(),
        ),
        ("clip-path='url(#none)'", vec![]),
        ("clip-path='url(#nobody)'", vec!["area"]),
        ("mask='url(#m)'", [&["(", "area"][..], &mask, &over].concat()),
        ("mask='url(#mm)'", [&["(", "area"][..], &mask, &alpha, &over].concat()),
        (
            "mask='url(#m)' clip-path='url(#c)' opacity='.5'",
            [&["(", "area"][..], &clip, &mask, &[") normal 0.5"]].concat(),
        ),
        // The document's root is a group of its own, which is blended with the paper as a whole.
        (
            "style='mix-blend-mode: multiply'",
            vec!["(", "(", "area", ") multiply 1", ") normal 1"],
        ),
        ("opacity='.5'", vec!["area"]),
    ] {
        let scene = svg_scene(&format!("{definitions}<rect width='50' height='50' {attribute}/>"));
        assert_eq!(outline(&scene), expected, "{attribute}");
        let depth = kinds(&scene).iter().fold(0, |depth, kind| match kind {
            PrimitiveKind::BeginLayer => depth + 1,
            PrimitiveKind::EndLayer { .. } => depth - 1,
            _ => depth,
        });
        assert_eq!(depth, 0, "{attribute}: every layer ends");
    }
    let scene = svg_scene(&format!(
        "{definitions}<rect width='50' height='50' clip-path='url(#c)'/>"
    ));
    let elements: Vec<&str> = painted(&scene).iter().map(|shape| &*shape.element).collect();
    assert_eq!(
        elements,
        ["rect", "clipPath", "circle", "clipPath", "rect"],
        "whose each layer is"
    );
}

#[test]
fn every_blend_mode_is_known() {
    for mode in BlendMode::ALL {
        let body = format!(
            "<g style='mix-blend-mode:{}'><rect width='9' height='9'/><rect width='9' height='9' fill='red'/></g>",
            mode.name()
        );
        let layered = outline(&svg_scene(&body));
        let expected = format!(") {} 1", mode.name());
        let found = layered.iter().rev().nth(1).map(String::as_str);
        assert!(
            found == Some(&expected) || mode == BlendMode::Normal,
            "{body}: {layered:?}"
        );
    }
}

#[test]
fn shapes_keep_their_places() {
    let scene = svg_scene(
        "\n<rect width='5' height='5'/>\n<g>\n <circle r='3' id='mine'/>\n</g>\n<text y='20'>a</text>\n\
         <colortri points='0 0 1 0 0 1' colors='0 0 0 1 0 0 0 1 0 0 0 1'/>\n<path d='M0 0L1 1L2 0' opacity='.5' fill='red' stroke='blue'/>",
    );
    let found: Vec<(&str, u32, Option<&str>)> = painted(&scene)
        .iter()
        .map(|shape| (&*shape.element, shape.location.line, shape.id.as_deref()))
        .collect();
    let expected = [
        ("rect", 2, None),
        ("circle", 4, Some("mine")),
        ("text", 6, None),
        ("colortri", 7, None),
        ("path", 8, None),
    ];
    assert_eq!(found, expected);
}

#[test]
fn what_is_used_again_knows_both_places() {
    let scene = svg_scene(
        "<defs>\n<g id='g'>\n<rect width='5' height='5'/>\n<circle r='3'/>\n</g>\n<symbol id='s'><path d='M0 0L1 1L2 0'/></symbol></defs>\n\
         <use href='#g'/>\n<g><use xlink:href='#s' id='twice'/></g>",
    );
    let shapes = painted(&scene);
    let of = |element: &str| {
        shapes
            .iter()
            .find(|shape| &*shape.element == element)
            .expect("it is painted")
    };
    for (element, own, used) in [("rect", 3, 7), ("circle", 4, 7), ("path", 6, 8)] {
        let shape = of(element);
        assert_eq!(
            (shape.location.line, shape.used.map(|used| used.line)),
            (own, Some(used)),
            "{element}"
        );
        assert_eq!(shape.id, None, "no id of ours is seen");
    }
    // Where it cannot be told which is which, everything is the use's.
    let unclear = svg_scene(
        "<defs><g id='g'><rect width='1' height='1' style='display:none'/><circle r='3'/></g></defs>\n<use href='#g'/>",
    );
    let shapes = painted(&unclear);
    assert_eq!((&*shapes[0].element, shapes[0].location.line), ("use", 2));
}

#[test]
fn ids_that_look_like_ours_are_no_trouble() {
    let scene = svg_scene(
        "<rect width='5' height='5'/>\n<rect id='_0_0' width='6' height='5'/>\n<rect id='_1_0' width='7' height='5'/>\n<circle r='2'/>",
    );
    let found: Vec<(u32, Option<&str>)> = painted(&scene)
        .iter()
        .map(|shape| (shape.location.line, shape.id.as_deref()))
        .collect();
    assert_eq!(found, [(1, None), (2, Some("_0_0")), (3, Some("_1_0")), (4, None)]);
}

#[test]
fn style_sheets_and_inheritance_count() {
    let scene = svg_scene(
        "<style>rect { fill: blue } .big rect#x { fill: red; opacity: .5 }</style>\
         <rect width='1' height='1'/><g class='big'><rect id='x' width='1' height='1'/></g>",
    );
    let colors: Vec<Rgba> = kinds(&scene)
        .iter()
        .map(|kind| match kind {
            PrimitiveKind::Polygon {
                fill: Fill::Solid(color),
                ..
            } => *color,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        colors,
        [Rgba::opaque(0.0, 0.0, 1.0), Rgba::opaque(1.0, 0.0, 0.0).faded(0.5)]
    );
}

#[test]
fn text_is_outlines_of_the_shipped_typefaces() {
    let scene = svg_scene("<text x='5' y='50' font-size='20'>Hi</text>");
    assert!(
        lines(&scene).is_empty(),
        "nobody asked for a typeface: {:?}",
        lines(&scene)
    );
    assert!(area(&scene) > 20.0, "letters: {}", area(&scene));
    let named = svg_scene(
        "\n<text y='50' font-family='No Such, Neither Such'>Hi <tspan font-family='No Such'>you</tspan></text>",
    );
    let told = lines(&named);
    assert_eq!(told.len(), 2, "each list once: {told:?}");
    assert!(
        told[0].starts_with("2:1: there is no typeface No Such or Neither Such; Ubuntu is taken instead"),
        "{told:?}"
    );
    let bold = svg_scene(
        "<text y='50' font-family='sans-serif' font-weight='700'>Hi <tspan font-style='italic'>you</tspan></text>",
    );
    let told = lines(&bold);
    assert_eq!(told.len(), 2, "each face once: {told:?}");
    assert!(told[0].contains("no bold face of Ubuntu"), "{told:?}");
    assert!(told[1].contains("no italic face of Ubuntu"), "{told:?}");
    let boxes = svg_scene("\n<text y='50'>ab \u{13000}\u{13001} cd</text>\n<text y='70'>\u{13002}</text>");
    let told = lines(&boxes);
    assert_eq!(told.len(), 1, "once: {told:?}");
    assert!(
        told[0].starts_with("2:1: there is no typeface with the character \u{13000} (U+13000); a box"),
        "{told:?}"
    );
    let letters = |text: &str| svg_scene(&format!("<text y='50' font-size='20'>{text}</text>"));
    let (alone, beside) = (area(&letters("Small")), letters("Small \u{2192}"));
    let sign = svg_scene("<text y='50' font-size='20' font-family='Hack'>\u{2192}</text>");
    assert!(
        (area(&beside) - alone - area(&sign)).abs() < 0.01 * alone,
        "only the missing sign is of another typeface: {} beside {alone} and {}",
        area(&beside),
        area(&sign)
    );
    assert!(lines(&beside).is_empty(), "{:?}", lines(&beside));
    let mono = svg_scene("<text y='50' font-family='Hack'>Hi</text>");
    assert!(lines(&mono).is_empty(), "it is shipped: {:?}", lines(&mono));
}

#[test]
fn typefaces_inside_a_document_are_read() {
    let bytes: String = epaint_default_fonts::HACK_REGULAR
        .iter()
        .flat_map(|byte| {
            let digits = [byte >> 4, byte & 15].map(|digit| char::from_digit(digit.into(), 16));
            ['%'].into_iter().chain(digits.into_iter().flatten())
        })
        .collect();
    let text = |family: &str, source: &str| {
        svg_scene(&format!(
            "<style>@font-face {{ font-family: Mine; src: url({source}) }}</style>\n\
             <text y='50' font-family='{family}'>Hi</text>"
        ))
    };
    let own = text("Mine", &format!("data:font/ttf,{bytes}"));
    assert!(lines(&own).is_empty(), "{:?}", lines(&own));
    assert!(
        (area(&own) - area(&text("Hack", "local(x)"))).abs() < 1e-9,
        "its letters"
    );
    let told = lines(&text("Mine", "data:font/woff2;base64,d09GMgAA"));
    assert!(
        told[0].starts_with("1:") && told[0].contains("the typeface Mine in the document is not read: it is WOFF2"),
        "{told:?}"
    );
}

#[test]
fn own_triangles_stand_in_drawings() {
    let triangle = "<colortri points='0 0 10 0 0 10' colors='1 0 0 1 0 1 0 1 0 0 1 1'";
    for (body, opacity, corner) in [
        (
            format!("<g transform='translate(5 6)'>{triangle}/></g>"),
            1.0,
            [5.0, 6.0],
        ),
        (format!("{triangle} opacity='.5'></colortri >"), 0.5, [0.0, 0.0]),
        (
            format!("<g stroke='red'>{triangle} style='fill:none' transform='scale(2)'/></g>"),
            1.0,
            [0.0, 0.0],
        ),
    ] {
        let scene = svg_scene(&body);
        let found = kinds(&scene);
        let [PrimitiveKind::Triangle { points, paint }] = found.as_slice() else {
            panic!("{body}: {found:?}");
        };
        assert_eq!(points[0], DVec2::from(corner), "{body}");
        let rasterscope::scene::Paint::Vertex(colors) = paint else {
            panic!("{body}: {paint:?}");
        };
        assert_eq!(colors[1], Rgba::opaque(0.0, 1.0, 0.0).faded(opacity), "{body}");
    }
    let hidden = svg_scene(&format!(
        "<g visibility='hidden'>{triangle}/></g><clipPath id='c'>{triangle}/></clipPath>"
    ));
    assert!(hidden.primitives.is_empty(), "{:?}", hidden.primitives);
}

#[test]
fn lengths_of_texts_with_others_inside_are_told_to_have_no_effect() {
    let text = |length: &str, inside: &str| svg_scene(&format!("<text y='9' {length}>{inside}</text>"));
    let long = "textLength='99'";
    assert!(kinds(&text(long, "plain")) != kinds(&text("", "plain")), "a text alone");
    assert_eq!(
        lines(&text(long, "plain")),
        lines(&text("", "plain")),
        "nothing to tell"
    );
    for inside in ["<tspan>one</tspan>", "mix <tspan>one</tspan> end"] {
        let (found, plain) = (text(long, inside), text("", inside));
        assert!(kinds(&found) == kinds(&plain), "{inside}: as without");
        let told = lines(&found);
        assert_eq!(told.len(), lines(&plain).len() + 1, "{inside}: {told:?}");
        assert!(
            told.iter().any(|line| line.contains("textLength has no effect")),
            "{inside}: {told:?}"
        );
    }
}
