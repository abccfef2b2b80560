//! How wide the panels are. The edge between a panel and the picture can be dragged:
//!
//! ```text
//! ┌───────┬┬─────────────┐
//! │ panel ││   picture   │   a double click on the edge gives the first width back
//! └───────┴┴─────────────┘
//! ```
//!
//! What fits into a window is decided by these widths and the window alone, never by what a panel holds.

use egui::{CursorIcon, Id, Rect, Sense, Stroke, Ui};
use serde::{Deserialize, Serialize};

use super::{explanation, lesson, look};

/// Points on either side of an edge that take the pointer.
const GRAB: f32 = 3.0;
/// Widest a panel may be, as a part of the window.
const MOST: f32 = 0.45;
/// Widest a panel may be, in points.
const WIDEST: f32 = 640.0;

/// A panel beside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum SizedPanel {
    Side,
    Comparison,
    Lesson,
    Explanation,
}

/// The widths that a hand gave to panels, in whole points; the others have their first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(in crate::app) struct PanelWidths {
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    comparison: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lesson: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    explanation: Option<u16>,
}

impl SizedPanel {
    /// Width where no hand gave another, in points.
    pub(super) const fn first(self) -> f32 {
        match self {
            Self::Side | Self::Comparison => look::PANEL_WIDTH,
            Self::Lesson => lesson::WIDTH,
            Self::Explanation => explanation::WIDTH,
        }
    }

    /// Its text and controls need that much.
    const fn least(self) -> f32 {
        match self {
            Self::Explanation => explanation::LEAST_WIDTH,
            other => other.first(),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Side => "side panel",
            Self::Comparison => "comparison",
            Self::Lesson => "lesson",
            Self::Explanation => "explanation",
        }
    }
}

impl PanelWidths {
    /// The width of a panel in a window that is `window` points wide.
    pub(super) fn of(self, panel: SizedPanel, window: f32) -> f32 {
        let chosen = match panel {
            SizedPanel::Side => self.side,
            SizedPanel::Comparison => self.comparison,
            SizedPanel::Lesson => self.lesson,
            SizedPanel::Explanation => self.explanation,
        };
        let most = (window * MOST).min(WIDEST).max(panel.least());
        chosen.map_or(panel.first(), f32::from).clamp(panel.least(), most)
    }

    fn set(&mut self, panel: SizedPanel, width: Option<f32>) {
        let place = match panel {
            SizedPanel::Side => &mut self.side,
            SizedPanel::Comparison => &mut self.comparison,
            SizedPanel::Lesson => &mut self.lesson,
            SizedPanel::Explanation => &mut self.explanation,
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let whole = width.map(|width| width.round().clamp(0.0, WIDEST) as u16);
        *place = whole;
    }

    /// The edge of a `panel` that lies at `rect` on the left or the right of the picture. What of the picture it covers.
    pub(super) fn edge(&mut self, ui: &Ui, panel: SizedPanel, is_left: bool, rect: Rect) -> Rect {
        let x = if is_left { rect.right() } else { rect.left() };
        let grip = Rect::from_x_y_ranges(x - GRAB..=x + GRAB, rect.y_range());
        let window = ui.ctx().content_rect().width();
        let response = ui
            .interact(grip, Id::unique(("edge", panel)), Sense::click_and_drag())
            .on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
        if response.double_clicked() {
            self.set(panel, None);
        } else if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let wanted = if is_left {
                at.x - rect.left()
            } else {
                rect.right() - at.x
            };
            self.set(panel, Some(wanted));
            self.set(panel, Some(self.of(panel, window)));
        }
        if response.hovered() || response.dragged() {
            let color = ui.visuals().selection.bg_fill;
            ui.painter().vline(x, rect.y_range(), Stroke::new(2.0, color));
        }
        response.accessible_name(format!("Edge of the {}", panel.name()));
        grip
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_stays_within_what_panel_and_window_allow() {
        let mut widths = PanelWidths::default();
        for panel in [
            SizedPanel::Side,
            SizedPanel::Comparison,
            SizedPanel::Lesson,
            SizedPanel::Explanation,
        ] {
            let at = |widths: &PanelWidths, window: f32| widths.of(panel, window);
            assert!(
                (at(&widths, 1280.0) - panel.first()).abs() < 0.1,
                "{panel:?} as at first"
            );
            widths.set(panel, Some(1.0));
            assert!(
                (at(&widths, 1280.0) - panel.least()).abs() < 0.1,
                "{panel:?}: all of it to be read"
            );
            widths.set(panel, Some(5000.0));
            assert!(
                (at(&widths, 1280.0) - 576.0).abs() < 0.1,
                "{panel:?}: the picture keeps the most"
            );
            assert!(
                (at(&widths, 9000.0) - 640.0).abs() < 0.1,
                "{panel:?}: a long line is hard to read"
            );
            assert!(
                (at(&widths, 320.0) - panel.least()).abs() < 0.1,
                "{panel:?} in a small window"
            );
            widths.set(panel, None);
        }
        assert_eq!(widths, PanelWidths::default(), "and back");
    }
}
