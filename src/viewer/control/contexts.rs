//! What several parts are together, borrowed from the viewer: to look at for everybody, to change for commands and results.

use crate::viewer::control::both::Both;
use crate::viewer::control::drawings::Drawings;
use crate::viewer::control::hand::Hand;
use crate::viewer::control::open::Opening;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::control::profiled::Profiled;
use crate::viewer::control::recipes::Recipes;
use crate::viewer::control::save::Saving;
use crate::viewer::control::spectral::Spectral;
use crate::viewer::control::window::WindowContent;
use crate::viewer::state::Viewer;

impl Viewer {
    /// A and B at this moment, and where they lie in the window.
    pub fn both(&self) -> Both<'_> {
        Both::new(&self.settings, &self.chrome, &self.scene_list, &self.frames, &self.ab)
    }

    /// Which pixel the user means: the one under the pointer, the pinned one, the one in the inspector.
    pub fn pixels(&self) -> Pointing<'_> {
        Pointing {
            both: self.both(),
            chrome: &self.chrome,
            inspector: &self.inspector,
            pointer: &self.pointer,
        }
    }

    /// The edge profile: its line, and what A, B and the truth have along it.
    pub fn profile(&self) -> Profiled<'_> {
        Profiled {
            both: self.both(),
            chrome: &self.chrome,
            profiling: &self.profiling,
        }
    }

    /// The spectrum: what it is asked of, and what was found.
    pub fn spectrum(&self) -> Spectral<'_> {
        Spectral {
            pixels: self.pixels(),
            chrome: &self.chrome,
            state: &self.spectrum,
        }
    }

    /// The window's pixels below the panels.
    pub fn window(&self) -> WindowContent<'_> {
        WindowContent {
            both: self.both(),
            inspector: &self.inspector,
        }
    }

    /// How the picture in the window is made again.
    pub fn recipes(&self) -> Recipes<'_> {
        Recipes {
            both: self.both(),
            pixels: self.pixels(),
        }
    }

    /// What a hand changes.
    pub(in crate::viewer) fn hand(&mut self) -> Hand<'_> {
        Hand {
            settings: &mut self.settings,
            chrome: &mut self.chrome,
            scene_list: &mut self.scene_list,
            frames: &self.frames,
            ab: &mut self.ab,
            inspector: &mut self.inspector,
            profiling: &mut self.profiling,
            spectrum: &mut self.spectrum,
            pointer: &mut self.pointer,
        }
    }

    /// What opened files change.
    pub(in crate::viewer) fn opening(&mut self) -> Opening<'_> {
        Opening {
            lesson: &mut self.lesson,
            settings: &mut self.settings,
            chrome: &mut self.chrome,
            scene_list: &mut self.scene_list,
            ab: &mut self.ab,
            inspector: &mut self.inspector,
            profiling: &mut self.profiling,
            board: &mut self.board,
            spectrum: &mut self.spectrum,
            export: &mut self.export,
        }
    }

    /// What draws, and decides which frames.
    pub(in crate::viewer) fn drawings(&mut self) -> Drawings<'_> {
        let attention = self.pixels().attention();
        Drawings {
            settings: &self.settings,
            chrome: &mut self.chrome,
            scene_list: &self.scene_list,
            frames: &mut self.frames,
            ab: &mut self.ab,
            attention,
        }
    }

    /// What saves.
    pub(in crate::viewer) fn saving(&mut self) -> Saving<'_> {
        let both = Both::new(&self.settings, &self.chrome, &self.scene_list, &self.frames, &self.ab);
        let pixels = Pointing {
            both,
            chrome: &self.chrome,
            inspector: &self.inspector,
            pointer: &self.pointer,
        };
        Saving {
            recipes: Recipes { both, pixels },
            export: &mut self.export,
            sheet: &mut self.sheet,
        }
    }
}
