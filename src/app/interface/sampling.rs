//! The settings of the picture: sample rate, samplings, rules, dialect, pixel zoom.

use egui::Ui;

use super::controls::{choice, drop_down, heading, row, tip};
use super::detail;
use crate::color::ResolveSpace;
use crate::raster::{SamplePattern, SampleRate};
use crate::render::Visualisation;
use crate::rules::Rules;
use crate::scene::{Dialect, DialectChoice};
use crate::texture::{LevelSampling, PixelSampling};
use crate::viewer::{Command, PixelZoom, SceneEntry, Toggle, Viewer};

/// Shows the settings and adds what was changed to `commands`.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let settings = viewer.settings();
    let render = &settings.render;
    heading(ui, "Sampling");
    let rates = sample_rates(render.sample_rate);
    ui.label(egui::RichText::new("Samples per pixel").weak());
    let keys = format!("{}; {}", tip("rate-down"), tip("rate-up"));
    commands.extend(choice(ui, "Samples per pixel", &keys, render.sample_rate, &rates).map(Command::SetSampleRate));
    ui.label(egui::RichText::new("Sample pattern").weak());
    for patterns in SamplePattern::ALL.chunks(3) {
        let values: Vec<_> = patterns.iter().map(|value| (*value, value.name().to_owned())).collect();
        let chosen = choice(ui, "Sample pattern", &tip("pattern"), render.pattern, &values);
        commands.extend(chosen.map(Command::SetPattern));
    }
    row(ui, "Pixel", |ui| {
        let values = PixelSampling::ALL.map(|value| (value, value.name().to_owned()));
        let chosen = choice(
            ui,
            "Pixel sampling",
            &tip("pixel-sampling"),
            render.pixel_sampling,
            &values,
        );
        commands.extend(chosen.map(Command::SetPixelSampling));
    });
    row(ui, "Level", |ui| {
        let values = LevelSampling::ALL.map(|value| (value, value.name().to_owned()));
        let chosen = choice(
            ui,
            "Level sampling",
            &tip("level-sampling"),
            render.level_sampling,
            &values,
        );
        commands.extend(chosen.map(Command::SetLevelSampling));
    });
    detail::show(ui, viewer, commands);
    row(ui, "Resolve", |ui| {
        let values = ResolveSpace::ALL.map(|value| (value, value.name().to_owned()));
        let chosen = choice(ui, "Resolve space", &tip("resolve"), render.resolve, &values);
        commands.extend(chosen.map(Command::SetResolveSpace));
    });
    row(ui, "Show", |ui| {
        let values = Visualisation::ALL.map(|value| (value, value.name()));
        let chosen = drop_down(ui, "Visualisation", &tip("visualise"), render.visualisation, &values);
        commands.extend(chosen.map(Command::SetVisualisation));
    });
    row(ui, "Rules", |ui| {
        let values = Rules::ALL.map(|value| (value, value.name().to_owned()));
        let chosen = choice(ui, "Rules", &tip("rules"), render.rules, &values);
        commands.extend(chosen.map(Command::SetRules));
    });
    reading(ui, viewer, commands);
}

/// How scenes are read and shown, whatever the sampling.
fn reading(ui: &mut Ui, viewer: &Viewer, commands: &mut Vec<Command>) {
    let settings = viewer.settings();
    row(ui, "Dialect", |ui| {
        let values = DialectChoice::ALL.map(|value| (value, value.name().to_owned()));
        let tip = format!("{}\n{}", tip("dialect"), dialect_in_force(viewer));
        commands.extend(choice(ui, "Dialect", &tip, settings.dialect, &values).map(Command::SetDialect));
    });
    // For every choice, so that what is below stays under the pointer.
    row(ui, "", |ui| {
        ui.label(egui::RichText::new(dialect_in_force(viewer)).weak().small())
    });
    row(ui, "Pixel zoom", |ui| {
        let values = PixelZoom::ALL.map(|value| (value, value.factor().to_string()));
        let chosen = choice(ui, "Pixel zoom", &tip("pixel-zoom"), settings.pixel_zoom, &values);
        commands.extend(chosen.map(Command::SetPixelZoom));
    });
    row(ui, "Moving", |ui| {
        let mut on = settings.progressive;
        let response = ui.checkbox(&mut on, "coarse first, then fine");
        let response = response.on_hover_text(tip("progressive"));
        if response.accessible_name("Progressive drawing").changed() {
            commands.push(Command::Progressive(if on { Toggle::On } else { Toggle::Off }));
        }
    });
}

/// The rates that keys reach, and the current one if it lies beyond.
fn sample_rates(current: SampleRate) -> Vec<(SampleRate, String)> {
    let mut rates = vec![SampleRate::ONE];
    while let Some(last) = rates.last()
        && last.higher() != *last
    {
        rates.push(last.higher());
    }
    if !rates.contains(&current) {
        rates.push(current);
    }
    rates
        .into_iter()
        .map(|rate| (rate, rate.samples().to_string()))
        .collect()
}

/// In which dialect the current scene was read.
fn dialect_in_force(viewer: &Viewer) -> &'static str {
    let entry = viewer.current();
    match entry.and_then(|entry| entry.scene()).map(|scene| scene.dialect) {
        Some(Dialect::Course) => "read as course",
        Some(Dialect::Svg) => "read as svg",
        None if entry.is_some_and(SceneEntry::is_reading) => "reading …",
        None => "not read",
    }
}
