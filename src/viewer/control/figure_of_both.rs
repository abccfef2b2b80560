//! A and B in one figure, as it is saved: all of the picture that they share, or what of each lies in its half of the window, with
//! magnifiers, tags and legends.

use crate::figure::{Magnifier, PixelRect, add_legends, add_magnifiers, add_tags, magnified, tag_unit};
use crate::raster::{Framebuffer, Region};
use crate::viewer::control::recipes::Recipes;
use crate::viewer::inspector::PlacedInset;
use crate::viewer::view::layout;

impl Recipes<'_> {
    /// What A and B share, with its tags and legends, and with the magnifiers where the window has them. Side by side it is what the
    /// halves of the window show; else it is whole, though a picture from outside may reach beyond the window.
    pub(in crate::viewer) fn picture_of_both(&self) -> Framebuffer {
        let composite = self.both.composite().whole();
        let placed = self.insets().map(|(_, placed)| placed.rect);
        let bounds = composite.bounds();
        // Magnifiers are in window pixels.
        let zoom = if placed.clone().next().is_some() {
            self.both.layout.zoom()
        } else {
            1
        };
        // They may lie beside a picture from outside.
        let area = placed.fold(bounds, |area, inset| area.union(&on_screen(&inset, zoom)));
        let mut picture = magnified(&composite.picture_of(&area), zoom);
        let mut taken = self.draw_magnifiers(&mut picture, &layout::magnified(&area, zoom));
        let unit = tag_unit([picture.width(), picture.height()]);
        let length = |x: i64| ((x - area.x) * i64::from(zoom)) as f32 / unit;
        let line = self.both.wipe_column().map(length);
        let tags = self.both.tags([length(bounds.x), length(bounds.right())], line);
        taken.extend(add_tags(&mut picture, &tags, &taken));
        add_legends(&mut picture, &self.both.legends_of_picture(), &taken);
        picture
    }

    /// The magnifiers in the window, with their letters.
    fn insets(&self) -> impl Iterator<Item = (&'static str, PlacedInset)> + Clone + use<> {
        let inspector = self.pixels.inspector;
        let own = inspector.inset.map(|placed| ("A", placed));
        own.into_iter().chain(inspector.other_inset.map(|placed| ("B", placed)))
    }

    /// Draws them into a picture of the part `area` of the window; what nothing else may hide then.
    fn draw_magnifiers(&self, picture: &mut Framebuffer, area: &PixelRect) -> Vec<PixelRect> {
        let frame = self.both.frames.frame();
        let of_a = |x, y| frame.and_then(|frame| frame.final_rgba(x, y));
        let of_b = |x, y| self.both.ab.other_final_rgba(x, y);
        let inside = |rect: PixelRect| PixelRect {
            x: rect.x - area.x,
            y: rect.y - area.y,
            ..rect
        };
        let magnifiers = self.insets().map(|(letter, placed)| Magnifier {
            letter,
            inset: placed.inset.without_detail(),
            corner: [placed.rect.x - area.x, placed.rect.y - area.y],
            region: self.magnified_region(&placed).map(inside),
            rgba: if letter == "A" { &of_a } else { &of_b },
        });
        add_magnifiers(picture, &magnifiers.collect::<Vec<_>>())
    }

    /// Where the window shows what a magnifier magnifies: in the half where that lies. `None` where it is out of sight.
    fn magnified_region(&self, placed: &PlacedInset) -> Option<PixelRect> {
        let layout = &self.both.layout;
        let seen = placed
            .inset
            .source()
            .intersection(&PixelRect::of_size(layout.frame_size()));
        let region = Region {
            x: u32::try_from(seen.x).ok()?,
            y: u32::try_from(seen.y).ok()?,
            width: seen.width,
            height: seen.height,
        };
        let corner = [placed.rect.x, placed.rect.y];
        let second = layout.panes().second;
        let in_second = second.is_some_and(|pane| layout::magnified(&pane.area, layout.zoom()).contains(corner));
        let place = layout.in_window(region).into_iter().nth(usize::from(in_second));
        place.filter(|place| place.width > 0 && place.height > 0)
    }
}

/// The screen pixels that window pixels are a part of.
fn on_screen(rect: &PixelRect, zoom: u32) -> PixelRect {
    let zoom = i64::from(zoom);
    let [x, y] = [rect.x, rect.y].map(|side| side.div_euclid(zoom));
    let length = |from: i64, end: i64| u32::try_from((end + zoom - 1).div_euclid(zoom) - from).unwrap_or(0);
    PixelRect {
        x,
        y,
        width: length(x, rect.right()),
        height: length(y, rect.bottom()),
    }
}
