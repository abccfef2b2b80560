//! Deep zooms: what reaches far beyond the frame on all sides fills it, whatever the scale.

use std::sync::Arc;

use glam::DVec2;
use rasterscope::color::Rgba;
use rasterscope::geometry::{FillRule, Polygon, View};
use rasterscope::raster::SamplePattern;
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{Fill, Paint, PrimitiveKind};

use crate::support::scenes::{at_rate, drawn, scene};

const SIZE: [u32; 2] = [41, 29];

#[test]
fn what_surrounds_the_frame_fills_it_at_every_scale() {
    arbtest::arbtest(|u| {
        let corners = u.int_in_range(3..=12_u32)?;
        // A polygon around the middle, whose sides are at least half as far from it as its corners are.
        let turn: f64 = f64::from(u.int_in_range(0..=1000)?) / 1000.0;
        let round: Vec<DVec2> = (0..corners)
            .map(|i| {
                DVec2::from_angle((f64::from(i) + turn) * std::f64::consts::TAU / f64::from(corners)) * 500.0 + 500.0
            })
            .collect();
        let color = Rgba::from_bytes([30, 60, 90, 255]);
        let kind = if corners == 3 && u.arbitrary()? {
            PrimitiveKind::Triangle {
                points: [round[0], round[1], round[2]],
                paint: Paint::Solid(color),
            }
        } else {
            PrimitiveKind::Polygon {
                polygon: Arc::new(Polygon::new(vec![round], FillRule::NonZero)),
                fill: Fill::Solid(color),
            }
        };
        let scene = scene(1000.0, vec![kind]);
        let scale = 10.0_f64.powf(f64::from(u.int_in_range(0..=120)?) / 10.0);
        let away = |u: &mut arbtest::arbitrary::Unstructured<'_>| -> arbtest::arbitrary::Result<f64> {
            Ok(f64::from(u.int_in_range(-1000..=1000)?) * 0.1)
        };
        let view = View::At {
            center: DVec2::new(500.0 + away(u)?, 500.0 + away(u)?),
            scale,
            rotation: f64::from(u.int_in_range(0..=359)?),
        };
        let pattern = *u.choose(&SamplePattern::ALL)?;
        let settings = RenderSettings {
            pattern,
            rules: *u.choose(&[Rules::Standard, Rules::Course])?,
            outline: false,
            ..at_rate(*u.choose(&[1, 4, 16])?)
        };
        let frame = drawn(&scene, &view.transform(scene.canvas, SIZE), &settings, SIZE);
        let [r, g, b, a] = color.to_bytes(Rules::Standard);
        let wanted = u32::from_be_bytes([a, r, g, b]);
        let wrong = frame.pixels().iter().filter(|pixel| **pixel != wanted).count();
        assert_eq!(wrong, 0, "{corners} corners, {view:?}, {settings:?}");
        Ok(())
    })
    .budget_ms(1000);
}
