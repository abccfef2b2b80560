//! The card of a spectrum: which waves a picture is made of, and what is told of the one that is pointed at.
//!
//! ```text
//!    Spectrum                         x
//!    [ frame ][ difference ][ texture ][ scene ]
//!    [ whole ][ pin ]
//!   -0.5 .-------------.
//!        |      |      |
//!      0 |-- -- o -- --|          frequency zero in the middle, lighter is stronger
//!        |      |      |
//!    0.5 '-------------'
//!    0.25, 0.10 cycles/px, -12 dB
//! ```

use egui::{Align, Area, Button, Color32, Frame, Id, Layout, Order, Rect, RichText, Sense, Ui, vec2};

use super::board::told_of_all;
use super::controls::{choice, choice_where, tip};
use super::corner::{CardCorner, below_title, wide_enough};
use super::floating::things;
use super::focus::FocusPanel;
use super::look::CONTROL;
use super::spectrum_plot::SpectrumPlot;
use crate::compare::{Band, DECIBELS, SpectrumAnalysis, SpectrumOf, SpectrumReading, scale_color};
use crate::raster::Region;
use crate::viewer::{Command, SpectrumCommand, SpectrumFound, SpectrumPart, Toggle, Viewer, picture};

/// Free space around the card, in points.
const MARGIN: f32 = 10.0;
/// Sides that the plot with its numbers may have, in points: the first for which there is room beside other things.
const SIDES: [f32; 4] = [320.0, 270.0, 220.0, 190.0];
/// Width of the card's contents at least, in points: that of the legend.
const LEAST: f32 = 284.0;
/// What is below and above the plot, in points: title, choices, words, legend.
const BESIDES: f32 = 196.0;
/// Width of the card around its contents, in points.
const FRAME: f32 = 14.0;
/// Height of the title with what is around the card's contents, in points.
const HEAD: f32 = 46.0;
/// Height of the legend's bar and of what its swatches stand in, in points.
const LEGEND_HEIGHT: f32 = 12.0;

/// Where the card is, and its plot.
#[derive(Debug, Default)]
pub(super) struct SpectrumCard {
    corner: CardCorner,
    plot: SpectrumPlot,
}

/// What the card takes, and what is pointed at.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    /// Where it lies, in points: other words give way.
    pub(super) taken: Option<Rect>,
    /// The wave that the pointer is over in the plot.
    pub(super) reading: Option<SpectrumReading>,
}

impl SpectrumCard {
    /// Shows it in a corner of what is `free`.
    pub(super) fn show(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, commands: &mut Vec<Command>) -> Shown {
        let spectrum = viewer.spectrum();
        if !spectrum.is_open() {
            *self = Self::default();
            return Shown::default();
        }
        let size_of = |side: f32| vec2(side.max(LEAST) + FRAME, side + BESIDES);
        let least = size_of(SIDES[3]).x + 2.0 * MARGIN;
        let free = wide_enough(free, least, ui.ctx().content_rect());
        let room = free.shrink(MARGIN);
        let things = things(viewer, ui.pixels_per_point());
        let in_way = |place: Rect| things.iter().filter(|other| other.intersects(place)).count();
        let fits = |side: &f32| room.size().min_elem() > 0.0 && CardCorner::has_room(size_of(*side), room, in_way);
        let side = SIDES.into_iter().find(fits).unwrap_or(SIDES[3]);
        let corner = self.corner.choose(size_of(side), room, in_way);
        let mut reading = None;
        let id = Id::unique("spectrum");
        let area = Area::new(id)
            .order(Order::Middle)
            .fixed_pos(corner.pos_in_rect(&room))
            .pivot(corner)
            .constrain_to(free)
            .fade_in(false)
            .show(ui.ctx(), |ui| {
                FocusPanel::Spectrum.head_of_area(ui, id);
                Frame::popup(ui.style()).show(ui, |ui| {
                    let sizes = [size_of(side), room.size()].map(|size| size - vec2(FRAME, HEAD));
                    ui.set_width(sizes[0].x.min(sizes[1].x));
                    head(ui, viewer, commands);
                    below_title(ui, sizes, |ui| {
                        choices(ui, viewer, commands);
                        let found = spectrum.found().filter(|found| found.analysis.of() == spectrum.of());
                        match found {
                            Some(found) => {
                                reading = self.plot.show(ui, found, side, spectrum.is_current());
                                words(ui, viewer, found, reading.as_ref());
                                legend(ui, found.analysis.of());
                            }
                            None => unknown(ui, viewer, side),
                        }
                    });
                });
            });
        self.corner.drawn(ui.ctx(), area.response.rect);
        Shown {
            taken: Some(area.response.rect),
            reading,
        }
    }
}

/// What stands there while nothing is found: as high as what will be, so that the buttons stay under the pointer.
fn unknown(ui: &mut Ui, viewer: &Viewer, side: f32) {
    let size = SpectrumPlot::size(ui, side);
    ui.allocate_ui(size, |ui| {
        ui.set_min_size(size);
        ui.label(RichText::new(hint(viewer)).small().weak());
    });
    for _ in 0..2 {
        ui.label(RichText::new(" ").small());
    }
    legend(ui, viewer.spectrum().of());
}

/// What is said where there is nothing to plot.
fn hint(viewer: &Viewer) -> &'static str {
    let spectrum = viewer.spectrum();
    if !spectrum.is_current() {
        "Computing \u{2026}"
    } else if spectrum.of() == SpectrumOf::Texture && spectrum.has_pin() {
        "The pinned pixel shows no texture: pin one that does, by a right click."
    } else if spectrum.of() == SpectrumOf::Texture {
        "The pixel in the middle shows no texture: pin one that does, by a right click."
    } else {
        "There is no picture."
    }
}

/// The title, and what closes the card.
fn head(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let close = ui.add(Button::new("\u{d7}").min_size(CONTROL));
            let close = close.on_hover_text("Closes the spectrum. Nothing is drawn for it any more.");
            if close.accessible_name("Close the spectrum").clicked() {
                commands.push(Command::Spectrum(SpectrumCommand::Show(Toggle::Off)));
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let title = egui::Label::new(RichText::new(title(viewer)).strong()).truncate();
                ui.add(title).on_hover_text(tip("spectrum"));
            });
        });
    });
}

/// Of what it is where that is not plain: beside B it is A's, and the difference is the one from the truth, whatever B is.
fn title(viewer: &Viewer) -> &'static str {
    let spectrum = viewer.spectrum();
    match (spectrum.of(), spectrum.is_of_a()) {
        (SpectrumOf::Difference, true) => "Spectrum: A \u{2212} truth",
        (SpectrumOf::Difference, false) => "Spectrum: frame \u{2212} truth",
        (SpectrumOf::Frame | SpectrumOf::Texture, true) => "Spectrum of A",
        _ => "Spectrum",
    }
}

/// Of what, and of which part.
fn choices(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let spectrum = viewer.spectrum();
    let values = SpectrumOf::ALL.map(|of| (of, of.name().to_owned()));
    let tip = "Of the frame as its pixels are, A's where there is a B, of what it differs from the truth by (whatever B is), of the mip level that the pinned pixel reads, or \
               of the scene before pixels sample it. The difference costs a drawing with 256 samples for each pixel.";
    let chosen = choice(ui, "Spectrum of", tip, spectrum.of(), &values);
    commands.extend(chosen.map(SpectrumCommand::Of).map(Command::Spectrum));
    let values = SpectrumPart::ALL.map(|part| (Some(part), words_of(part, spectrum.free()).to_owned()));
    // Of a texture it is neither.
    let current = Some(spectrum.part()).filter(|_| spectrum.of() != SpectrumOf::Texture);
    let tip = |part: Option<SpectrumPart>| match (spectrum.of(), part) {
        (SpectrumOf::Texture, _) => (NO_PART.to_owned(), false),
        (_, Some(SpectrumPart::Pin)) if !spectrum.has_pin() => (NO_PIN.to_owned(), false),
        _ => (PARTS.to_owned(), true),
    };
    let chosen = choice_where(ui, "Part", &tip, current, &values);
    commands.extend(chosen.flatten().map(SpectrumCommand::Part).map(Command::Spectrum));
}

/// What the parts are.
const PARTS: &str = "Of what panels leave free of the picture, or of the middle of that where it is larger than 512 x 512 pixels; \
                     or of 128 x 128 pixels around the pinned one. Fewer pixels cost less, and tell fewer frequencies apart.";
/// Why there is no part around the pin.
const NO_PIN: &str = "No pixel is pinned: pin one by a right click in the picture.";
/// Why no part can be chosen of a texture.
const NO_PART: &str = "That of a texture is of a whole mip level, or of 512 x 512 texels of it around what the pixel reads, whatever \
                       part of the frame is chosen.";

/// The name of a part where panels leave this much of the frame free, which may be all of it.
fn words_of(part: SpectrumPart, (free, is_all): (Region, bool)) -> &'static str {
    match part {
        SpectrumPart::Whole => match (SpectrumAnalysis::middle_of(free) == free, is_all) {
            (true, true) => "whole frame",
            (true, false) => "free picture",
            (false, true) => "frame's middle",
            (false, false) => "free middle",
        },
        SpectrumPart::Pin => "around the pin",
    }
}

/// Two lines below the plot: the wave that is pointed at, or what was transformed.
fn words(ui: &mut Ui, viewer: &Viewer, found: &SpectrumFound, reading: Option<&SpectrumReading>) {
    let whole = || {
        let region = found.analysis.region();
        let size = format!("{} \u{d7} {}", region.width, region.height);
        let first = match &found.level {
            Some(level) => format!("{level}: {size} texels"),
            None => format!("{size} pixels from {}, {}", region.x, region.y),
        };
        let second = match (found.analysis.constant(), found.analysis.of()) {
            (Some(0.0), SpectrumOf::Difference) if viewer.spectrum().is_of_a() => "A is the truth here: no error",
            (Some(0.0), SpectrumOf::Difference) => "The frame is the truth here: no error",
            (Some(_), SpectrumOf::Difference) => "All differs from the truth by the same: no waves",
            (Some(_), _) => "All is of one colour: no waves",
            // Of what was to be seen a moment ago.
            (None, _) if !viewer.spectrum().is_current() => "Computing \u{2026}",
            (None, _) => "Point at a frequency to see its wave",
        };
        // Texels have colours of their own.
        let false_colors = picture::false_colors(viewer.settings()).filter(|_| found.level.is_none());
        let second = false_colors.map_or(second.to_owned(), |words| format!("{} {second}", told_of_all(&words)));
        [first, second]
    };
    for line in reading.map_or_else(whole, |reading| told(found, reading)) {
        ui.add(egui::Label::new(RichText::new(line).small().weak()).truncate());
    }
}

/// What is told of a wave.
fn told(found: &SpectrumFound, reading: &SpectrumReading) -> [String; 2] {
    let wave = &reading.wave;
    let [x, y] = wave.frequency;
    let is_texture = found.analysis.of() == SpectrumOf::Texture;
    let unit = if is_texture { "texel" } else { "px" };
    let length = wave.wavelength();
    let digits = if length < 10.0 { 2 } else { 1 };
    let length = if length.is_finite() {
        format!("{length:.digits$} {unit} at {}\u{b0}", number(wave.angle(), 0))
    } else {
        "no wave".to_owned()
    };
    let [x, y] = [x, y].map(|frequency| number(frequency, 3));
    let first = format!("{x}, {y} /{unit}: {length}, {} dB", number(wave.decibels(), 0));
    let place = |at: [f64; 2]| at.map(|frequency| number(frequency, 2)).join(", ");
    let second = match (reading.lands, reading.alias()) {
        (Some(lands), _) if is_texture => format!(
            "{} /px: too fine for pixels, seen at {}",
            place(reading.in_pixels),
            place(lands)
        ),
        (Some(lands), _) => format!("Too fine for pixels: seen at {}", place(lands)),
        (None, Some((source, part))) => format!(
            "{:.0} % alias of finer waves, most of {}",
            part * 100.0,
            place(source.frequency)
        ),
        (None, None) if is_texture => format!("{} /px", place(reading.in_pixels)),
        (None, None) if found.analysis.of() == SpectrumOf::Difference => {
            "Error that no single wave of the scene makes".to_owned()
        }
        (None, None) => "In the scene as it is".to_owned(),
    };
    [first, second]
}

/// A number with so many digits behind its point; nothing has no sign.
fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|digit| matches!(digit, '0' | '.')) => rest.to_owned(),
        _ => text,
    }
}

/// What lightness and hues mean.
fn legend(ui: &mut Ui, of: SpectrumOf) {
    let tip = match of {
        SpectrumOf::Scene => {
            "Lighter is stronger, in dB: a wave from black to white has 0. In colours are the waves outside of the box, which are \
             too fine for pixels, and where they land in it with one sample for each."
        }
        SpectrumOf::Texture => {
            "Lighter is stronger, in dB: a wave from black to white has 0. The box holds what pixels can show of the texels; what \
             is outside is in colours."
        }
        SpectrumOf::Frame | SpectrumOf::Difference => {
            "Lighter is stronger, in dB: a wave from black to white has 0. In colours is what the scene has too fine for pixels, and \
             lands here."
        }
    };
    let [low, high] = DECIBELS;
    let response = ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.label(RichText::new(format!("{low:.0}")).small().weak());
        let (rect, _) = ui.allocate_exact_size(vec2(45.0, LEGEND_HEIGHT), Sense::hover());
        let columns = 22_u8;
        for column in 0..columns {
            let part = f64::from(column) / f64::from(columns - 1);
            let left = rect.left() + f32::from(column) * 2.0;
            // The next one covers what is too wide, so that no seam is between them.
            let bar = Rect::from_min_size(egui::pos2(left, rect.top()), vec2(3.0, LEGEND_HEIGHT));
            let color = rgb(scale_color(low + (high - low) * part, None));
            ui.painter().rect_filled(bar, 0.0, color);
        }
        ui.label(RichText::new(format!("{high:.0} dB")).small().weak());
        ui.add_space(4.0);
        ui.label(RichText::new("too fine:").small().weak());
        for (band, name) in Band::ALL.into_iter().zip(["across", "down", "both"]) {
            let (rect, _) = ui.allocate_exact_size(vec2(9.0, LEGEND_HEIGHT), Sense::hover());
            let swatch = Rect::from_center_size(rect.center(), vec2(9.0, 9.0));
            ui.painter().rect_filled(swatch, 1.0, rgb(band.color()));
            ui.label(RichText::new(name).small().weak());
        }
    });
    response.response.on_hover_text(tip);
}

/// An opaque `0xAARRGGBB`.
pub(super) fn rgb(color: u32) -> Color32 {
    let [_, r, g, b] = color.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_nothing_have_no_sign() {
        for (value, digits, text) in [
            (-0.001, 2, "0.00"),
            (-0.2, 0, "0"),
            (-0.25, 2, "-0.25"),
            (-10.0, 0, "-10"),
        ] {
            assert_eq!(number(value, digits), text);
        }
    }
}
