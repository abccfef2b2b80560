//! How far A and B are apart, in numbers.

use egui::{Grid, RichText, Ui, vec2};

use super::controls::heading;
use crate::viewer::{Measures, Viewer};

/// The numbers; those of other pictures are marked.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer) {
    let found = viewer.both().measures();
    let title = match found {
        Some((_, true)) | None => "How far apart",
        Some((_, false)) => "How far apart (before the last change)",
    };
    heading(ui, title);
    let Some((measures, is_current)) = found else {
        let words = if viewer.scene_list().has_no_picture() {
            "There is no picture to measure: this scene could not be read."
        } else {
            "measuring …"
        };
        ui.label(RichText::new(words).weak());
        return;
    };
    Grid::new("metrics")
        .num_columns(2)
        .spacing(vec2(8.0, 3.0))
        .min_row_height(16.0)
        .show(ui, |ui| {
            for (name, value, tip) in lines(measures) {
                ui.label(RichText::new(name).weak()).on_hover_text(tip);
                let text = RichText::new(value).monospace();
                let text = if is_current { text } else { text.weak().italics() };
                ui.label(text).on_hover_text(tip);
                ui.end_row();
            }
        });
}

/// Name, value, and what it is.
fn lines(measures: &Measures) -> Vec<(&'static str, String, &'static str)> {
    let levels = &measures.levels;
    let share = levels.differing() as f64 * 100.0 / (levels.pixels as f64).max(1.0);
    let share = match share {
        share if levels.differing() > 0 && share < 0.01 => "< 0.01 %".to_owned(),
        share => format!("{share:.2} %"),
    };
    let largest = match measures.places.first() {
        Some(place) => format!("{} at {}, {}", place.largest(), place.at[0], place.at[1]),
        None => "0".to_owned(),
    };
    let psnr = match levels.psnr() {
        ratio if ratio.is_finite() => format!("{ratio:.2} dB"),
        _ => "infinite".to_owned(),
    };
    let seen = |value: Option<f64>| value.map_or("…".to_owned(), |value| format!("{value:.5}"));
    vec![
        (
            "Differing",
            format!("{} ({share})", levels.differing()),
            "Pixels of which any channel differs. In brackets their share of the picture.",
        ),
        (
            "Largest",
            largest,
            "The largest difference of any channel, in levels of 255. Then its pixel.",
        ),
        (
            "MAE",
            format!("{:.4}", levels.mae()),
            "Mean absolute error over pixels and channels, in levels of 255. 0 for equal pictures.",
        ),
        (
            "RMSE",
            format!("{:.4}", levels.rmse()),
            "Root mean square error over pixels and channels, in levels of 255. Large differences weigh more.",
        ),
        (
            "PSNR",
            psnr,
            "Peak signal-to-noise ratio, 20 log10(255 / RMSE). More is better; infinite for equal pictures.",
        ),
        (
            "SSIM",
            seen(measures.seen.map(|seen| seen.ssim)),
            "Structural similarity of luma, Wang et al. 2004. 1 for equal pictures, less for others.",
        ),
        (
            "FLIP",
            seen(measures.seen.map(|seen| seen.flip)),
            "What people see when they flip between both, Andersson et al. 2020. 0 when nobody sees a difference.",
        ),
    ]
}
