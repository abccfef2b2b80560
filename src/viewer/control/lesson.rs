//! Walking through a lesson: every step sets scene, settings, view, pin and comparison, whatever was changed before.

use glam::DVec2;

use crate::geometry::View;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::viewer::LessonCommand;
use crate::viewer::ab::comparison::Comparison;
use crate::viewer::ab::other::Against;
use crate::viewer::ab::requests::ComparisonContext;
use crate::viewer::chrome::Chrome;
use crate::viewer::chrome::messages::{NO_ROOM, no_such};
use crate::viewer::inspector::Reveal;
use crate::viewer::inspector::state::Inspection;
use crate::viewer::lesson::model::{Lesson, LessonStep};
use crate::viewer::lesson::source::LessonSource;
use crate::viewer::lesson::walk::{Before, Walk};
use crate::viewer::library;
use crate::viewer::library::state::SceneList;
use crate::viewer::library::{SceneEntry, SceneState};
use crate::viewer::settings::{PixelZoom, Settings, picture};
use crate::viewer::view::camera::Camera;

/// The open lesson, and what its steps set.
#[derive(Debug)]
pub(in crate::viewer) struct Lessons<'a> {
    pub(in crate::viewer) lesson: &'a mut Option<Walk>,
    pub(in crate::viewer) settings: &'a mut Settings,
    pub(in crate::viewer) chrome: &'a mut Chrome,
    pub(in crate::viewer) scene_list: &'a mut SceneList,
    pub(in crate::viewer) ab: &'a mut Comparison,
    pub(in crate::viewer) inspector: &'a mut Inspection,
}

impl Lessons<'_> {
    pub(in crate::viewer) fn apply(&mut self, command: LessonCommand) {
        match command {
            LessonCommand::Open(source) => self.open(&source),
            LessonCommand::Step(step) => {
                let wrong = match self.lesson {
                    Some(walk) if step < walk.lesson.steps.len() => None,
                    Some(walk) => Some(no_such("step", step, "the lesson", walk.lesson.steps.len())),
                    None => Some("no lesson is open that has steps; open one first".to_owned()),
                };
                match wrong {
                    None => self.take_step(step),
                    Some(wrong) => self.chrome.messages.error(wrong),
                }
            }
            LessonCommand::Close => {
                self.close();
            }
        }
    }

    /// Opens a lesson at its first step; where it cannot be read, the user is told.
    pub(in crate::viewer) fn open(&mut self, source: &LessonSource) {
        match source.read() {
            Ok(lesson) => self.begin(lesson, Some(source.clone())),
            Err(error) => self.chrome.messages.error(error.to_string()),
        }
    }

    /// Reads the open lesson again and stays at its step; where it cannot be read any more, it stays as it is and the user is
    /// told.
    pub(in crate::viewer) fn reload(&mut self) {
        let Some(Walk {
            at,
            source: Some(source),
            ..
        }) = &self.lesson
        else {
            return;
        };
        let (at, source) = (*at, source.clone());
        match source.read() {
            Ok(lesson) => {
                let last = lesson.steps.len().saturating_sub(1);
                self.chrome.messages.forget_problems_of(&source.address());
                self.begin(lesson, Some(source));
                self.take_step(at.min(last));
            }
            Err(error) => self.chrome.messages.error(error.to_string()),
        }
    }

    /// Shows a lesson from its first step on; what was there before comes back when it is closed.
    pub(in crate::viewer) fn begin(&mut self, lesson: Lesson, source: Option<LessonSource>) {
        let before = match self.lesson.take() {
            Some(walk) => self.with_opened(walk),
            None => Before {
                comparison: self.ab.keep(),
                pin: self.pinned_place(),
                inspector: self.inspector.magnifier.open,
                scenes: std::mem::take(&mut self.scene_list.scenes),
                current: self.scene_list.current,
                settings: *self.settings,
                explanation: self.chrome.shown.explanation,
            },
        };
        let mut entries: Vec<SceneEntry> = Vec::new();
        let mut scenes = Vec::new();
        for step in &lesson.steps {
            let known = entries.iter().position(|entry| entry.source == step.scene);
            scenes.push(known.unwrap_or(entries.len()));
            if known.is_none() {
                entries.push(library::entry_of(step.scene.clone()));
            }
        }
        self.scene_list.replace(entries);
        *self.lesson = Some(Walk {
            lesson,
            source,
            at: 0,
            scenes,
            view_pending: false,
            shown: None,
            opened: None,
            before,
        });
        self.take_step(0);
    }

    /// Goes on or back by one step; false where no lesson is open.
    pub(in crate::viewer) fn step(&mut self, forward: bool) -> bool {
        let Some(walk) = &*self.lesson else { return false };
        let last = walk.lesson.steps.len() - 1;
        match (forward, walk.at) {
            (true, at) if at < last => self.take_step(at + 1),
            (true, _) => self
                .chrome
                .messages
                .done("that was the last step; Close ends the lesson".to_owned()),
            (false, at) => self.take_step(at.saturating_sub(1)),
        }
        true
    }

    /// Shows a step, counted from 0, as its author meant it; nothing happens where there is none.
    pub(in crate::viewer) fn take_step(&mut self, at: usize) {
        let Some(walk) = self.lesson.as_mut().filter(|walk| at < walk.lesson.steps.len()) else {
            return;
        };
        (walk.at, walk.view_pending, walk.shown) = (at, true, None);
        let (scene, step) = (walk.scenes[at], walk.lesson.steps[at].clone());
        self.scene_list.current = scene.min(self.scene_list.scenes.len().saturating_sub(1));
        self.compare(Against::Nothing);
        self.ab.forget_looks();
        self.settings.render = RenderSettings::default();
        self.settings.dialect = DialectChoice::default();
        // Views of steps are in frame pixels.
        self.settings.pixel_zoom = PixelZoom::ONE;
        let LessonStep {
            settings,
            pin,
            explained,
            against,
            ..
        } = step;
        if let Some(remark) = picture::apply_all(&settings, self.settings) {
            self.chrome.messages.error(remark);
        }
        if let Some((against, arrangement)) = against {
            self.compare(against);
            let mut context = ComparisonContext {
                settings: self.settings,
                messages: &mut self.chrome.messages,
            };
            self.ab.arrange(arrangement, &mut context);
        }
        self.chrome.hidden = false;
        self.chrome.shown.explanation = explained;
        self.inspector.magnifier.open = pin.is_some();
        (self.inspector.magnifier.asked, self.inspector.magnifier.kept_view) = (false, None);
        self.inspector.magnifier.pin = None;
        if let Some(place) = pin {
            self.inspector.pin_place(place, self.scene_list);
            self.inspector.magnifier.reveal = Some(Reveal::Jumped);
        }
    }

    /// Sets the view that a step asks for, as soon as its scene was read, and again when another part of the window is free;
    /// without one all of the canvas is shown in that part. Until a hand moves it. True if it was set now.
    pub(in crate::viewer) fn follow(&mut self) -> bool {
        let layout = self.ab.layout(self.settings.pixel_zoom, self.chrome);
        let walk = self.lesson.as_ref().filter(|walk| walk.shows_step(self.scene_list));
        let Some((walk, context)) = walk.zip(self.scene_list.view_context(layout.frame_size())) else {
            return false;
        };
        let part = layout.free_part();
        let is_new = walk.shown.is_none_or(|(_, before)| before != part);
        let numbers = walk.lesson.steps.get(walk.at).and_then(|step| step.view);
        // An explanation takes room: another scale would show other content at the pixel that was asked about.
        let rests = self.inspector.magnifier.asked && self.inspector.explains(self.chrome, self.scene_list, &layout);
        let follows = walk.is_as_set(self.scene_list.camera()) && is_new && !rests;
        if !walk.view_pending && !follows {
            return false;
        }
        if let Some(numbers) = numbers {
            // In frames of odd sides, too, pixels are those that the author saw: none begins in the middle of one of theirs.
            let half = DVec2::from(context.frame.map(|side| f64::from(side % 2) / 2.0));
            self.scene_list.look(context.frame, |camera, _| {
                camera.set(numbers, &context);
                camera.pan(-half, &context);
            });
        } else {
            self.scene_list
                .look(context.frame, |camera, _| *camera = Camera::new(View::Default));
            self.scene_list.fit_view(&layout);
        }
        if let Some(walk) = self.lesson {
            walk.view_pending = false;
            walk.shown = self.scene_list.camera().map(|camera| (camera, part));
        }
        true
    }

    /// Where another scene than the step's is shown, its pin says nothing there: it goes, and the inspector that came with it.
    pub(in crate::viewer) fn let_go_of_pin(&mut self) {
        let Some(walk) = self.lesson.as_ref().filter(|walk| !walk.shows_step(self.scene_list)) else {
            return;
        };
        let step = walk.scenes.get(walk.at).copied();
        let magnifier = &mut self.inspector.magnifier;
        let of_pin = magnifier.pin.and_then(|pin| pin.place);
        if of_pin.is_some_and(|(_, (scene, list))| Some(scene) == step && list == self.scene_list.generation) {
            (magnifier.pin, magnifier.open) = (None, false);
        }
    }

    /// The view of this moment is the one that the step set: a pin was brought into sight.
    pub(in crate::viewer) fn take_view(&mut self) {
        let camera = self.scene_list.camera();
        if let Some((shown, camera)) = self.lesson.as_mut().and_then(|walk| walk.shown.as_mut()).zip(camera) {
            shown.0 = camera;
        }
    }

    /// What comes back behind a lesson, with the scenes that the user opened since it began: that which he looks at, or else the
    /// one that he opened last, is shown then.
    fn with_opened(&mut self, walk: Walk) -> Before {
        let own = walk.own_scenes();
        let is_opened = self.scene_list.current >= own;
        let pin = self.pinned_place().filter(|_| is_opened);
        let current = self.scene_list.current().map(|entry| entry.source.clone());
        let shown = current.filter(|_| is_opened).or(walk.opened);
        let mut before = walk.before;
        let opened = self.scene_list.scenes.drain(own.min(self.scene_list.scenes.len())..);
        // One that is among the lesson's own scenes, too, is not behind them.
        let again = shown.clone().map(library::entry_of);
        for entry in opened.chain(again) {
            if before.scenes.iter().all(|known| known.source != entry.source) {
                before.scenes.push(entry);
            }
        }
        let place = |source| before.scenes.iter().position(|entry| entry.source == source);
        // The scene from before the lesson keeps the pin that it had, unless it has another one now.
        let is_other = |place: &usize| *place != before.current || pin.is_some();
        if let Some(current) = shown.and_then(place).filter(is_other) {
            let inspector = pin.is_some() || (before.inspector && before.pin.is_none());
            (before.current, before.pin, before.inspector) = (current, pin, inspector);
        }
        before
    }

    /// Closes the lesson and brings back what was open before, and what the user opened meanwhile; false where none is open.
    pub(in crate::viewer) fn close(&mut self) -> bool {
        let Some(walk) = self.lesson.take() else {
            return false;
        };
        let before = self.with_opened(walk);
        self.chrome.messages.retract(NO_ROOM);
        self.compare(Against::Nothing);
        self.ab.forget_looks();
        let mut scenes = before.scenes;
        if scenes.is_empty() {
            scenes = library::gallery_entries();
        }
        for entry in &mut scenes {
            if entry.is_reading() {
                entry.state = SceneState::Unread;
            }
            entry.other_state = SceneState::Unread;
            entry.thumbnail_asked = entry.thumbnail.is_some();
        }
        let cameras: Vec<Camera> = scenes.iter().map(|entry| entry.camera).collect();
        self.scene_list.replace(scenes);
        for (entry, camera) in self.scene_list.scenes.iter_mut().zip(cameras) {
            entry.camera = camera;
        }
        self.scene_list.current = before.current.min(self.scene_list.scenes.len().saturating_sub(1));
        *self.settings = before.settings;
        self.chrome.shown.explanation = before.explanation;
        self.ab.take_up(before.comparison);
        // It may have been saved meanwhile.
        self.ab.read_picture_again(&mut self.chrome.messages);
        (self.inspector.magnifier.pin, self.inspector.magnifier.open) = (None, before.inspector);
        if let Some(place) = before.pin {
            self.inspector.pin_place(place, self.scene_list);
        }
        true
    }

    /// The place that is pinned in the current scene, in canvas units.
    fn pinned_place(&self) -> Option<DVec2> {
        let (place, scene) = self.inspector.magnifier.pin?.place?;
        (scene == self.scene_list.identity()).then_some(place)
    }

    fn compare(&mut self, against: Against) {
        let mut context = ComparisonContext {
            settings: self.settings,
            messages: &mut self.chrome.messages,
        };
        self.ab.compare(against, &mut context);
    }
}
