//! A session as the stage of a script: every step goes through the panels, as a hand's would.

use std::path::Path;
use std::time::Duration;

use egui::{Event, vec2};
use glam::DVec2;

use super::{Clock, Session};
use crate::viewer::script::{Stage, save_window};
use crate::viewer::{Command, Key, KeyPress, Modifiers, PointerButton};

/// Rounds until a picture without a window counts as at rest.
const MAX_ROUNDS: u32 = 50;
/// Simulated seconds per round.
const ROUND: f64 = 0.1;

/// Keys and pointer go where a hand would send them.
impl Stage for Session {
    fn command(&mut self, command: Command) {
        self.run(command);
        self.quiet_turn();
    }

    fn settle(&mut self) {
        for _ in 0..MAX_ROUNDS {
            self.viewer.finish_thumbnails();
            self.tell_report();
            let revision = self.viewer.revision();
            if let Clock::Simulated(now) = &mut self.clock {
                *now += ROUND;
            }
            let turn = self.quiet_turn();
            if turn.next > Duration::from_millis(300) && self.viewer.revision() == revision && self.viewer.is_settled()
            {
                return;
            }
        }
    }

    fn shot(&mut self, path: &Path) -> Result<(), String> {
        self.settle();
        save_window(&self.viewer, &self.picture(), path).map_err(|error| {
            format!(
                "{}: cannot write this file: {error}; choose another place",
                path.display()
            )
        })
    }

    fn has_quit(&self) -> bool {
        self.outbox.quit
    }

    fn problems(&self) -> Vec<String> {
        let failure = self.viewer.scene_list().current().and_then(|entry| entry.failure());
        let errors = self.viewer.chrome().errors().iter().map(String::as_str);
        failure.into_iter().chain(errors).map(str::to_owned).collect()
    }

    fn key(&mut self, press: KeyPress) {
        if let Some(command) = self.command_for(&press) {
            self.command(command);
            return;
        }
        let Some(key) = press.logical.and_then(egui_key) else {
            return;
        };
        let modifiers = egui_modifiers(press.modifiers);
        for pressed in [true, false] {
            self.events.push(Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers,
            });
            if let (true, Some(Key::Char(character)), Modifiers::NONE) = (pressed, press.logical, press.modifiers) {
                self.events.push(Event::Text(character.to_string()));
            }
        }
        self.quiet_turn();
    }

    fn type_text(&mut self, text: &str) {
        self.events.push(Event::Text(text.to_owned()));
        self.quiet_turn();
    }

    fn pointer(&mut self, at: Option<DVec2>) {
        self.pointer_at(at);
        self.events.push(match at {
            Some(at) => Event::PointerMoved(self.to_points(at)),
            None => Event::PointerGone,
        });
        self.quiet_turn();
    }

    fn button(&mut self, button: PointerButton, down: bool) {
        self.pointer_button(button, down);
        if let Some(at) = self.pointer {
            self.events.push(Event::PointerButton {
                pos: self.to_points(at),
                button: match button {
                    PointerButton::Primary => egui::PointerButton::Primary,
                    PointerButton::Secondary => egui::PointerButton::Secondary,
                },
                pressed: down,
                modifiers: egui_modifiers(self.modifiers),
            });
        }
        self.quiet_turn();
    }

    fn wheel(&mut self, clicks: f64) {
        if !self.turn_wheel(clicks) {
            #[expect(clippy::cast_possible_truncation, reason = "a few clicks")]
            let delta = vec2(0.0, clicks as f32);
            self.events.push(Event::MouseWheel {
                unit: egui::MouseWheelUnit::Line,
                delta,
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Wheel,
                modifiers: egui_modifiers(self.modifiers),
            });
        }
        self.quiet_turn();
    }

    fn resize(&mut self, size: [u32; 2]) {
        self.set_size(size, self.native_scale);
        self.quiet_turn();
    }

    fn wait(&mut self, time: Duration) {
        if let Clock::Simulated(now) = &mut self.clock {
            *now += time.as_secs_f64();
        }
        self.quiet_turn();
    }
}

/// egui's name of a key.
fn egui_key(key: Key) -> Option<egui::Key> {
    match key {
        Key::Left => Some(egui::Key::ArrowLeft),
        Key::Right => Some(egui::Key::ArrowRight),
        Key::Up => Some(egui::Key::ArrowUp),
        Key::Down => Some(egui::Key::ArrowDown),
        Key::Escape => Some(egui::Key::Escape),
        other => egui::Key::from_name(&other.to_string()),
    }
}

fn egui_modifiers(modifiers: Modifiers) -> egui::Modifiers {
    let ctrl = modifiers.contains(Modifiers::CTRL);
    egui::Modifiers {
        alt: modifiers.contains(Modifiers::ALT),
        ctrl,
        shift: modifiers.contains(Modifiers::SHIFT),
        mac_cmd: false,
        command: ctrl,
    }
}
