//! How the panels look: sizes, type and colours of both themes, with and without the presenter look, set once per change.

use egui::style::{ScrollFadeStyle, ScrollStyle};
use egui::{
    Color32, Context, CornerRadius, FontDefinitions, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Ui, Vec2,
    vec2,
};

use crate::viewer::Theme;

/// Width of the side panel in points, frame included.
pub(super) const PANEL_WIDTH: f32 = 264.0;
/// Free space inside the panels, in points.
pub(super) const MARGIN: i8 = 12;

/// Room for the bar beside what scrolls, in points.
pub(super) const BAR_ROOM: i8 = 8;

/// The few colours that all else is made of.
struct Palette {
    panel: Color32,
    field: Color32,
    control: Color32,
    control_hovered: Color32,
    control_pressed: Color32,
    /// Boxes to tick, which have no text that tells them from the panel.
    tick_box: Color32,
    line: Color32,
    text: Color32,
    weak: Color32,
    strong: Color32,
    accent: Color32,
    on_accent: Color32,
    warning: Color32,
    error: Color32,
    shadow: u8,
}

const DARK: Palette = Palette {
    panel: Color32::from_rgb(30, 32, 36),
    field: Color32::from_rgb(20, 21, 24),
    control: Color32::from_rgb(46, 49, 55),
    control_hovered: Color32::from_rgb(60, 64, 72),
    control_pressed: Color32::from_rgb(38, 40, 45),
    tick_box: Color32::from_rgb(84, 89, 99),
    line: Color32::from_rgb(56, 59, 66),
    text: Color32::from_rgb(208, 211, 216),
    weak: Color32::from_rgb(152, 157, 166),
    strong: Color32::from_rgb(240, 241, 243),
    accent: Color32::from_rgb(44, 104, 186),
    on_accent: Color32::from_rgb(248, 250, 253),
    warning: Color32::from_rgb(240, 180, 70),
    error: Color32::from_rgb(246, 120, 110),
    shadow: 90,
};

/// What differs in the presenter look: a projector in a lit room makes grey of dark, and eats thin lines.
const DARK_CONTRAST: Palette = Palette {
    panel: Color32::BLACK,
    field: Color32::BLACK,
    control: Color32::from_rgb(52, 54, 60),
    line: Color32::from_rgb(150, 154, 162),
    text: Color32::from_rgb(245, 246, 248),
    weak: Color32::from_rgb(214, 217, 222),
    strong: Color32::WHITE,
    tick_box: Color32::from_rgb(120, 125, 135),
    ..DARK
};

const LIGHT_CONTRAST: Palette = Palette {
    panel: Color32::WHITE,
    control: Color32::from_rgb(222, 222, 219),
    line: Color32::from_rgb(110, 112, 116),
    text: Color32::from_rgb(8, 9, 10),
    weak: Color32::from_rgb(52, 54, 58),
    strong: Color32::BLACK,
    tick_box: Color32::from_rgb(150, 150, 146),
    warning: Color32::from_rgb(120, 72, 0),
    error: Color32::from_rgb(156, 20, 16),
    ..LIGHT
};

const LIGHT: Palette = Palette {
    panel: Color32::from_rgb(246, 246, 244),
    field: Color32::from_rgb(255, 255, 255),
    control: Color32::from_rgb(228, 228, 225),
    control_hovered: Color32::from_rgb(216, 216, 213),
    control_pressed: Color32::from_rgb(204, 204, 201),
    tick_box: Color32::from_rgb(190, 190, 186),
    line: Color32::from_rgb(208, 208, 204),
    text: Color32::from_rgb(46, 48, 52),
    weak: Color32::from_rgb(96, 99, 105),
    strong: Color32::from_rgb(16, 17, 19),
    accent: Color32::from_rgb(36, 98, 184),
    on_accent: Color32::from_rgb(255, 255, 255),
    warning: Color32::from_rgb(148, 92, 0),
    error: Color32::from_rgb(178, 34, 28),
    shadow: 40,
};

/// Sets sizes and type, and what holds for both themes. `animated` is false where pictures must not depend on time.
pub(super) fn install(ctx: &Context, animated: bool) {
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.set_fonts(fonts());
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        ctx.style_mut_of(theme, |style| {
            let font = |size| FontId::new(size, FontFamily::Proportional);
            style.text_styles = [
                (TextStyle::Heading, font(15.0)),
                (TextStyle::Body, font(13.0)),
                (TextStyle::Button, font(13.0)),
                (TextStyle::Small, font(11.0)),
                (TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace)),
            ]
            .into();
            style.spacing.item_spacing = vec2(6.0, 5.0);
            style.spacing.button_padding = vec2(6.0, 3.0);
            style.spacing.interact_size = vec2(28.0, 22.0);
            style.spacing.tooltip_width = 300.0;
            style.spacing.window_margin = Margin::same(MARGIN);
            // Dialogs grow with what they hold; each limits itself to the window.
            style.spacing.default_area_size = vec2(600.0, 4000.0);
            style.interaction.selectable_labels = false;
            style.interaction.tooltip_delay = 0.4;
            if !animated {
                style.animation_time = 0.0;
                style.visuals.text_cursor.blink = false;
                style.scroll_animation = egui::style::ScrollAnimation::none();
            }
        });
    }
}

/// egui's typefaces. What Ubuntu Light lacks, such as arrows and `≈`, comes from Hack in words, too, as it does in pictures.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let words = fonts.families.entry(FontFamily::Proportional).or_default();
    words.push("Hack".to_owned());
    fonts
}

/// Free space inside a panel that scrolls: the bar's room is a part of that on the right.
pub(super) fn scrolling_margin(above: i8) -> Margin {
    Margin {
        right: MARGIN - BAR_ROOM,
        ..Margin::symmetric(MARGIN, above)
    }
}

/// From here on bars are always to be seen, since they tell that there is more, and stand beside the contents: over
/// controls they would take the clicks.
pub(super) fn bars_beside(ui: &mut Ui) {
    ui.spacing_mut().scroll = ScrollStyle {
        bar_width: f32::from(BAR_ROOM),
        floating_width: 4.0,
        floating_allocated_width: 0.0,
        content_margin: Margin {
            right: BAR_ROOM,
            ..Margin::ZERO
        },
        foreground_color: true,
        // The bar tells that there is more; a fade would look like pictures that are not ready.
        fade: ScrollFadeStyle {
            strength: 0.0,
            ..ScrollFadeStyle::default()
        },
        ..ScrollStyle::thin()
    };
}

/// Contents above what scrolls, as wide as that is: the bar's room stays free.
pub(super) fn beside_bar<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width() - f32::from(BAR_ROOM));
        contents(ui)
    })
    .inner
}

/// Chooses the theme, and whether it is the one for a projector.
pub(super) fn set_look(ctx: &Context, (theme, presenter): (Theme, bool)) {
    let [dark, light] = if presenter {
        [&DARK_CONTRAST, &LIGHT_CONTRAST]
    } else {
        [&DARK, &LIGHT]
    };
    for (theme, palette) in [(egui::Theme::Dark, dark), (egui::Theme::Light, light)] {
        ctx.style_mut_of(theme, |style| paint(&mut style.visuals, palette));
    }
    ctx.set_theme(match theme {
        Theme::Dark => egui::Theme::Dark,
        Theme::Light => egui::Theme::Light,
    });
}

fn paint(visuals: &mut egui::Visuals, palette: &Palette) {
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.field;
    visuals.faint_bg_color = palette.control;
    visuals.weak_text_color = Some(palette.weak);
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.selection.bg_fill = palette.accent;
    visuals.selection.stroke = Stroke::new(1.0, palette.on_accent);
    let shadow = Shadow {
        offset: [0, 4],
        blur: 16,
        spread: 0,
        color: Color32::from_black_alpha(palette.shadow),
    };
    visuals.window_shadow = shadow;
    visuals.popup_shadow = shadow;
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(6);
    visuals.text_cursor.stroke = Stroke::new(1.5, palette.strong);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, palette.text);
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    widgets.noninteractive.bg_fill = palette.panel;
    for (state, fill, text) in [
        (&mut widgets.inactive, palette.control, palette.text),
        (&mut widgets.hovered, palette.control_hovered, palette.strong),
        (&mut widgets.active, palette.control_pressed, palette.strong),
        (&mut widgets.open, palette.control_hovered, palette.strong),
    ] {
        state.bg_fill = fill;
        state.weak_bg_fill = fill;
        state.bg_stroke = Stroke::NONE;
        state.fg_stroke = Stroke::new(1.0, text);
        state.corner_radius = CornerRadius::same(4);
        state.expansion = 0.0;
    }
    widgets.inactive.bg_fill = palette.tick_box;
    widgets.hovered.bg_fill = palette.tick_box;
}

/// The smallest extent that a control for a finger or a mouse has, in points.
pub(super) const CONTROL: Vec2 = vec2(28.0, 22.0);

/// A straight colour without its alpha: swatches are opaque.
pub(super) fn opaque([r, g, b, _]: [u8; 4]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_the_signs_that_lessons_use() {
        let ctx = Context::default();
        install(&ctx, false);
        ctx.run_ui(egui::RawInput::default(), |_| {}).textures_delta.clear();
        for sign in "→←↑↓≈≤≥×–…−·²√".chars() {
            for family in [FontFamily::Proportional, FontFamily::Monospace] {
                let font = FontId::new(13.0, family);
                assert!(
                    ctx.fonts_mut(|fonts| fonts.has_glyph(&font, sign)),
                    "{sign} in {font:?}"
                );
            }
        }
    }
}
