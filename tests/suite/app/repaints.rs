//! Repainting parts of the interface: real widgets, random hands; the bytes of a full repaint after every pass.

use arbtest::arbitrary::{Result, Unstructured};
use egui::epaint::textures::TexturesDelta;
use egui::{Context, Event, Modifiers, PointerButton, RawInput, Rect, Vec2, pos2, vec2};
use rasterscope::app::overlay::{CanvasRect, Output, Overlay};

const SIZE: [u32; 2] = [400, 300];

/// What the widgets show.
#[derive(Default)]
struct State {
    on: bool,
    value: f32,
    text: String,
    rows: usize,
    open: bool,
}

fn show(ui: &mut egui::Ui, state: &mut State) {
    egui::Panel::right("panel").exact_size(160.0).show(ui, |ui| {
        ui.checkbox(&mut state.on, "a checkbox")
            .on_hover_text("a tool tip with a shadow");
        ui.add(egui::Slider::new(&mut state.value, 0.0..=10.0));
        ui.text_edit_singleline(&mut state.text);
        if ui.button("another row").clicked() {
            state.rows += 1;
        }
        ui.collapsing("folded", |ui| ui.label("text that comes and goes"));
        egui::ScrollArea::vertical().show(ui, |ui| {
            for row in 0..20 + 9 * state.rows {
                let _ = ui.selectable_label(row % 3 == 0, format!("row {row}"));
            }
        });
    });
    if state.on {
        egui::Window::new("A window")
            .open(&mut state.open)
            .show(ui.ctx(), |ui| {
                ui.label("over everything, translucent at its edges");
                ui.separator();
                ui.spinner();
            });
    }
}

fn event(u: &mut Unstructured<'_>) -> Result<Event> {
    let at = pos2(u.int_in_range(0..=400_u16)?.into(), u.int_in_range(0..=300_u16)?.into());
    Ok(match u.int_in_range(0..=5)? {
        0 | 1 => Event::PointerMoved(at),
        2 | 3 => Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: u.arbitrary()?,
            modifiers: Modifiers::NONE,
        },
        4 => Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: vec2(0.0, f32::from(u.int_in_range(-3..=3_i8)?)),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        },
        _ => Event::Text(u.choose(&["x", "ß", "7", "→"])?.to_string()),
    })
}

#[test]
fn overlay_parts_are_the_bytes_of_a_full_repaint() {
    arbtest::arbtest(|u| {
        let (scale, size) = *u.choose(&[(1.0, SIZE), (1.5, [600, 450])])?;
        let (ctx, mut state) = (Context::default(), State::default());
        state.open = true;
        let (mut parts, mut whole) = (Overlay::default(), Overlay::default());
        for pass in 0..u.int_in_range(2..=25)? {
            let mut input = RawInput {
                screen_rect: Some(Rect::from_min_size(
                    pos2(0.0, 0.0),
                    vec2(SIZE[0] as f32, SIZE[1] as f32),
                )),
                time: Some(f64::from(pass) * 0.1),
                focused: true,
                ..RawInput::default()
            };
            let root = input.viewports.entry(egui::ViewportId::ROOT).or_default();
            root.native_pixels_per_point = Some(scale);
            for _ in 0..u.int_in_range(0..=2)? {
                input.events.push(event(u)?);
            }
            let mut output = ctx.run_ui(input, |ui| show(ui, &mut state));
            let mut textures = output.textures_delta.clone();
            let pixels_per_point = output.pixels_per_point;
            let shapes = Output {
                size,
                pixels_per_point,
                shapes: output.shapes,
            };
            let tessellate = |shapes| ctx.tessellate(shapes, pixels_per_point);
            parts.paint(shapes.clone(), &mut output.textures_delta, tessellate);
            // Another size and back: nothing of the canvas is kept.
            let nothing = Output {
                size: [1, 1],
                pixels_per_point,
                shapes: Vec::new(),
            };
            whole.paint(nothing, &mut TexturesDelta::default(), tessellate);
            whole.paint(shapes, &mut textures, tessellate);
            assert!(
                parts.canvas().pixels() == whole.canvas().pixels(),
                "pass {pass} at scale {scale}"
            );
        }
        Ok(())
    })
    .budget_ms(3000);
}

/// A pass at this time; how many pixels were painted anew.
fn painted(ctx: &Context, overlay: &mut Overlay, (time, at): (f64, egui::Pos2), ui: impl FnMut(&mut egui::Ui)) -> u32 {
    let input = RawInput {
        screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), Vec2::new(400.0, 300.0))),
        time: Some(time),
        events: vec![Event::PointerMoved(at)],
        focused: true,
        ..RawInput::default()
    };
    let mut output = ctx.run_ui(input, ui);
    let pixels_per_point = output.pixels_per_point;
    let shapes = Output {
        size: SIZE,
        pixels_per_point,
        shapes: output.shapes,
    };
    let tessellate = |shapes| ctx.tessellate(shapes, pixels_per_point);
    let parts = overlay.paint(shapes, &mut output.textures_delta, tessellate);
    let area = |part: &CanvasRect| (part.right - part.left) * (part.bottom - part.top);
    parts.iter().map(area).sum()
}

#[test]
fn overlay_repaints_little_for_a_hovered_widget() {
    let (ctx, mut state, mut overlay) = (Context::default(), State::default(), Overlay::default());
    let mut areas = Vec::new();
    for (pass, y) in (0_u8..).zip([0.0, 0.0, 0.0, 200.0, 200.0, 222.0, 244.0, 244.0]) {
        let now = (f64::from(pass), pos2(262.0, y));
        areas.push(painted(&ctx, &mut overlay, now, |ui| show(ui, &mut state)));
    }
    assert_eq!(areas[0], 400 * 300, "everything at first");
    for (pass, area) in areas.iter().enumerate().skip(4) {
        assert!(*area < 160 * 60, "{area} pixels in pass {pass}: {areas:?}");
    }
    assert!(
        areas[5] > 0 && areas[7] == 0,
        "another row, then nothing new: {areas:?}"
    );
}

/// A popup fades in, and its frame comes together with a shadow.
#[test]
fn overlay_repaints_little_for_a_popup() {
    let (ctx, mut state, mut overlay) = (Context::default(), State::default(), Overlay::default());
    let mut areas = Vec::new();
    for pass in 0_u8..30 {
        let now = (f64::from(pass) / 30.0, pos2(0.0, 0.0));
        areas.push(painted(&ctx, &mut overlay, now, |ui| {
            show(ui, &mut state);
            let popup = egui::Area::new(egui::Id::unique("popup")).fixed_pos(pos2(20.0, 200.0));
            popup.show(ui.ctx(), |ui| {
                ui.multiply_opacity(f32::from(pass) / 30.0);
                egui::Frame::popup(ui.style()).show(ui, |ui| ui.label("popup"));
            });
        }));
    }
    let later = &areas[4..];
    assert!(later.iter().all(|area| *area > 0), "every step shows: {areas:?}");
    assert!(later.iter().all(|area| *area < 400 * 300 / 8), "{areas:?}");
}

/// New letters make the font's texture larger: those that are there stay as they are.
#[test]
fn overlay_repaints_little_for_new_letters() {
    let (ctx, mut overlay) = (Context::default(), Overlay::default());
    let mut areas = Vec::new();
    for pass in 0_u8..40 {
        let now = (f64::from(pass), pos2(0.0, 0.0));
        let size = if pass < 2 { 12.0 } else { 20.0 + 1.5 * f32::from(pass) };
        areas.push(painted(&ctx, &mut overlay, now, |ui| {
            ui.label("a word that stays");
            let place = Rect::from_min_size(pos2(20.0, 200.0), vec2(80.0, 60.0));
            let letters = ('a'..='z').chain('A'..='Z').collect::<String>();
            ui.painter_at(place).text(
                place.min,
                egui::Align2::LEFT_TOP,
                letters,
                egui::FontId::proportional(size),
                egui::Color32::WHITE,
            );
        }));
    }
    assert!(areas[2..].iter().all(|area| *area < 400 * 300 / 8), "{areas:?}");
}
