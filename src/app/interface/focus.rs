//! The keyboard in panels: a key goes from panel to panel, Tab from control to control inside them, and what has the focus is
//! outlined and scrolled into sight.
//!
//! Every panel begins with a head that is not to be seen and can have the focus, as `Sense::focusable_noninteractive` is for:
//! from there Tab finds the panel's first control.

use egui::accesskit::{Action, ActionRequest, TreeId};
use egui::{
    Color32, Context, CornerRadius, Event, EventFilter, Id, LayerId, Order, Painter, Rect, Response, Role, Sense,
    Stroke, StrokeKind, Ui, Vec2, WidgetInfo, vec2,
};

use super::look;
use crate::viewer::{Key, KeyPress, Modifiers};

/// Width of the outline of what has the focus, in points; a second line of half that width tells it from any ground.
const OUTLINE: f32 = 2.0;

/// A panel that the keyboard can go to, in the order of the key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FocusPanel {
    Lesson,
    Explanation,
    Comparison,
    Side,
    Status,
    Words,
    Board,
    Profile,
    Spectrum,
}

impl FocusPanel {
    const ALL: [Self; 9] = [
        Self::Lesson,
        Self::Explanation,
        Self::Comparison,
        Self::Side,
        Self::Status,
        Self::Words,
        Self::Board,
        Self::Profile,
        Self::Spectrum,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Lesson => "Panel: lesson",
            Self::Explanation => "Panel: explanation",
            Self::Comparison => "Panel: comparison",
            Self::Side => "Panel: settings",
            Self::Status => "Panel: status",
            Self::Words => "Panel: scene's words",
            Self::Board => "Panel: board",
            Self::Profile => "Panel: edge profile",
            Self::Spectrum => "Panel: spectrum",
        }
    }

    fn id(self) -> Id {
        Id::unique(self.name())
    }

    /// Begins the panel: to be called before anything else in it.
    pub(super) fn head(self, ui: &Ui) {
        let whole = ui.max_rect().expand(f32::from(look::MARGIN)).intersect(ui.clip_rect());
        self.place_head(ui, whole);
    }

    /// Begins what floats over the picture in the area of this id. It has no place in the first pass, which finds its size.
    pub(super) fn head_of_area(self, ui: &Ui, area: Id) {
        if let Some(whole) = ui.ctx().memory(|memory| memory.area_rect(area)) {
            self.place_head(ui, whole);
        }
    }

    fn place_head(self, ui: &Ui, whole: Rect) {
        let response = ui.interact(whole, self.id(), Sense::focusable_noninteractive());
        response.widget_info(|| WidgetInfo::labeled(Role::Pane, true, self.name()));
    }

    /// Where the panel was in the last pass; `None` while it is not to be seen.
    fn place(self, ctx: &Context) -> Option<Place> {
        ctx.read_response(self.id()).map(Place::of)
    }
}

/// Where a control or a panel is: what floats lies over the places of others.
#[derive(Clone, Copy, Debug)]
struct Place {
    layer: LayerId,
    rect: Rect,
    /// What of it is in sight: an area that scrolls cuts off the rest.
    seen: Rect,
}

impl Place {
    #[expect(clippy::needless_pass_by_value, reason = "for `map`")]
    fn of(response: Response) -> Self {
        Self {
            layer: response.layer_id,
            rect: response.rect,
            seen: response.interact_rect,
        }
    }

    fn holds(self, other: Self) -> bool {
        self.layer == other.layer && self.rect.contains(other.rect.center())
    }
}

/// Gives the focus to the head of the next panel, or of the one before; behind the last the picture has the keys again.
pub(super) fn step(ctx: &Context, back: bool) {
    let mut panels: Vec<(FocusPanel, Place)> = FocusPanel::ALL
        .into_iter()
        .filter_map(|panel| Some((panel, panel.place(ctx)?)))
        .collect();
    if back {
        panels.reverse();
    }
    let now = focused(ctx);
    let next = match now.and_then(|now| panels.iter().position(|(_, place)| place.holds(now))) {
        Some(at) => panels.get(at + 1),
        None => panels.first(),
    };
    match next {
        Some((panel, _)) => ctx.memory_mut(|memory| memory.request_focus(panel.id())),
        None => leave(ctx),
    }
}

/// Where the button is noted that opened the last list.
fn opener() -> Id {
    Id::unique("opener of a list")
}

/// Notes the button of a list that a click opens.
pub(super) fn note_opener(button: &Response) {
    if button.clicked() {
        button.ctx.data_mut(|data| data.insert_temp(opener(), button.id));
    }
}

/// Gives the focus to the button of the list that is open, so that keys go from there into the list; not where something has it
/// already.
pub(super) fn enter_list(ctx: &Context) {
    if focused(ctx).is_none()
        && let Some(button) = ctx.data(|data| data.get_temp(opener()))
    {
        ctx.memory_mut(|memory| memory.request_focus(button));
    }
}

/// Takes the focus from panels.
pub(super) fn leave(ctx: &Context) {
    ctx.memory_mut(|memory| {
        if let Some(id) = memory.focused() {
            memory.surrender_focus(id);
        }
    });
}

/// Where what has the focus lies; `None` while the picture has the keys.
fn focused(ctx: &Context) -> Option<Place> {
    let id = ctx.memory(egui::Memory::focused)?;
    ctx.read_response(id).map(Place::of)
}

/// Whether nothing has the focus, not even what is gone.
pub(super) fn is_free(ctx: &Context) -> bool {
    ctx.memory(|memory| memory.focused().is_none())
}

/// The focus keeps to the controls of this layer, of which this is the first.
pub(super) fn keep_in(ctx: &Context, layer: LayerId, first: Id) {
    if focused(ctx).is_some_and(|place| place.layer != layer) {
        ctx.memory_mut(|memory| memory.request_focus(first));
    }
}

/// Whether a panel wants this key: those that go from control to control and press them, while one has the focus.
pub(super) fn takes(ctx: &Context, press: &KeyPress) -> bool {
    let is_plain = !press.modifiers.contains(Modifiers::CTRL) && !press.modifiers.contains(Modifiers::ALT);
    let steers = matches!(
        press.logical,
        Some(Key::Tab | Key::Space | Key::Enter | Key::Escape | Key::Left | Key::Right | Key::Up | Key::Down)
    );
    is_plain && steers && focused(ctx).is_some()
}

/// The steps of the arrows that were pressed while this control has the focus: they are its own then, and lead to no neighbour.
pub(super) fn arrows_in(ui: &Ui, control: &Response) -> Vec<Vec2> {
    if !control.has_focus() {
        return Vec::new();
    }
    let arrows = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(control.id, arrows));
    let keys = [
        (egui::Key::ArrowLeft, vec2(-1.0, 0.0)),
        (egui::Key::ArrowRight, vec2(1.0, 0.0)),
        (egui::Key::ArrowUp, vec2(0.0, -1.0)),
        (egui::Key::ArrowDown, vec2(0.0, 1.0)),
    ];
    let pressed = |(key, step)| {
        let times = ui.input_mut(|input| input.count_and_consume_key(egui::Modifiers::NONE, key));
        std::iter::repeat_n(step, times)
    };
    keys.into_iter().flat_map(pressed).collect()
}

/// What scrolls to the control that a key gave the focus since the last pass, where an area that scrolls hides a part of it: the
/// request that screen readers make, as egui finds the area. A press of the mouse scrolls nothing away from below it.
pub(super) fn scroll_to(ctx: &Context) -> Option<Event> {
    /// Passes that may ask for it: one may be discarded, and the next one places what the last one scrolled.
    const TRIES: u8 = 4;
    let wanted = Id::unique("what had the focus in the last pass, and how often it may ask");
    let id = ctx.memory(egui::Memory::focused);
    let (before, tries) = ctx
        .data(|data| data.get_temp::<(Option<Id>, u8)>(wanted))
        .unwrap_or_default();
    let by_mouse = ctx.input(|input| input.pointer.any_down() || input.pointer.any_released());
    let tries = if by_mouse {
        0
    } else if before == id {
        tries
    } else {
        TRIES
    };
    let place = id.and_then(|id| ctx.read_response(id)).map(Place::of);
    // Half a point is a matter of rounding.
    let is_cut = place.is_some_and(|place| !place.seen.expand(0.5).contains_rect(place.rect));
    let tries = if is_cut { tries } else { 0 };
    ctx.data_mut(|data| data.insert_temp(wanted, (id, tries.saturating_sub(1))));
    let id = id.filter(|_| tries > 0)?;
    ctx.request_repaint();
    Some(Event::AccessKitActionRequest(ActionRequest {
        action: Action::ScrollIntoView,
        target_tree: TreeId::ROOT,
        target_node: id.accesskit_id(),
        data: None,
    }))
}

/// Whether Tab left the last control, so that the next pass gives the focus to the first.
pub(super) fn goes_round(ctx: &Context) -> bool {
    focused(ctx).is_none() && ctx.input(|input| input.key_pressed(egui::Key::Tab))
}

/// Outlines what has the focus, above everything but not where it is cut off.
pub(super) fn outline(ctx: &Context) {
    let Some(place) = focused(ctx).filter(|place| place.seen.is_positive() && !ctx.text_edit_focused()) else {
        return;
    };
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("focus")));
    let place = place.seen.expand(OUTLINE).intersect(ctx.content_rect().shrink(OUTLINE));
    ring(&painter, place);
}

/// Outlines what arrows chose, inside its edge.
pub(super) fn ring_inside(painter: &Painter, place: Rect) {
    ring(painter, place.shrink(OUTLINE));
}

/// Two lines that are to be seen on any ground.
fn ring(painter: &Painter, place: Rect) {
    let style = painter.ctx().global_style();
    let (accent, ground) = if style.visuals.dark_mode {
        (Color32::from_rgb(120, 178, 255), Color32::BLACK)
    } else {
        (style.visuals.selection.bg_fill, Color32::WHITE)
    };
    for (width, color) in [(2.0 * OUTLINE, ground), (OUTLINE, accent)] {
        painter.rect_stroke(
            place,
            CornerRadius::same(4),
            Stroke::new(width, color),
            StrokeKind::Middle,
        );
    }
}
