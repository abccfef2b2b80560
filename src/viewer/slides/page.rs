//! The page of a slide: where words and picture lie on it, and how the words are set.

use crate::figure::{Anchor, Ground, TextBlock, TextStyle, Typeface};
use crate::raster::Framebuffer;
use crate::viewer::lesson::markdown::{Block, Look, Span};
use crate::viewer::lesson::model::LessonStep;

/// The part of a slide's width that the words have.
const WORDS: f64 = 0.34;

/// Margins, and the gap between words and picture, in parts of the height.
const MARGIN: f64 = 0.045;

/// Height of the letters in parts of the slide's height: the largest that fits is taken.
const SIZES: [f64; 5] = [0.032, 0.029, 0.026, 0.023, 0.02];

/// What a heading's letters are larger by.
const HEADING: f64 = 1.35;

/// The colours of a page.
struct Colors {
    paper: u32,
    ink: u32,
    strong: u32,
    quiet: u32,
    code: u32,
}

const LIGHT: Colors = Colors {
    paper: Ground::Light.color(),
    ink: 0xff20_2428,
    strong: 0xff00_0000,
    quiet: 0xff5c_6670,
    code: 0xff1b_4f8a,
};

const DARK: Colors = Colors {
    paper: Ground::Dark.color(),
    ink: 0xffd8_dade,
    strong: 0xffff_ffff,
    quiet: 0xff9c_a2aa,
    code: 0xff8a_c2ff,
};

/// Where things lie on a slide.
pub(super) struct Page {
    pub(super) size: [u32; 2],
    margin: u32,
    /// Where the words end, and where the picture begins.
    words_end: u32,
    picture: u32,
    colors: &'static Colors,
}

/// A word with its look, ready to be placed.
struct Word<'a> {
    text: &'a str,
    style: TextStyle,
    look: Look,
    after: After,
}

/// What comes before a word.
#[derive(Clone, Copy, PartialEq, Eq)]
enum After {
    /// Another word, from which it must not be parted.
    Word,
    Blank,
    LineBreak,
}

/// Where the next word goes.
struct Pen {
    left: i64,
    at: [i64; 2],
    /// Whether a blank was met since the last word.
    blank: bool,
}

impl Page {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "parts of a picture's size"
    )]
    pub(super) fn new(size: [u32; 2], ground: Ground) -> Self {
        let margin = (f64::from(size[1]) * MARGIN).round() as u32;
        let picture = (f64::from(size[0]) * WORDS).round() as u32;
        Self {
            size,
            margin,
            words_end: picture.saturating_sub(margin),
            picture,
            colors: match ground {
                Ground::Light => &LIGHT,
                Ground::Dark => &DARK,
            },
        }
    }

    pub(super) fn picture_size(&self) -> [u32; 2] {
        [
            self.size[0].saturating_sub(self.picture + self.margin).max(1),
            self.size[1].saturating_sub(2 * self.margin).max(1),
        ]
    }

    /// The page with nothing on it.
    pub(super) fn blank(&self) -> Framebuffer {
        let mut slide = Framebuffer::new(self.size[0], self.size[1]);
        slide.pixels_mut().fill(self.colors.paper);
        slide
    }

    /// Puts the picture in its place.
    pub(super) fn paste(&self, picture: &Framebuffer, slide: &mut Framebuffer) {
        let (from, to) = (picture.width() as usize, self.size[0] as usize);
        if from == 0 || to == 0 {
            return;
        }
        let rows = slide.pixels_mut().chunks_exact_mut(to).skip(self.margin as usize);
        let left = self.picture as usize;
        for (row, source) in rows.zip(picture.pixels().chunks_exact(from)) {
            if let Some(place) = row.get_mut(left..left + from) {
                place.copy_from_slice(source);
            }
        }
    }

    /// Writes a line below the picture.
    pub(super) fn caption(&self, slide: &mut Framebuffer, text: &str) {
        let style = TextStyle::new(self.margin as f32 * 0.4, self.colors.quiet);
        let block = TextBlock::new(text, style, None);
        let top = i64::from(self.size[1].saturating_sub(self.margin)) + i64::from(self.margin / 6);
        block.draw(slide, [i64::from(self.picture), top], Anchor::Left);
    }

    /// Writes what a step says; false where it does not fit. Nothing of it is written then.
    pub(super) fn write(&self, slide: &mut Framebuffer, step: &LessonStep, of: &str) -> bool {
        let fits = SIZES.into_iter().find(|size| self.words(step, of, *size, None));
        fits.is_some_and(|size| self.words(step, of, size, Some(slide)))
    }

    /// Writes the words in letters of one size, or only sees whether they fit.
    fn words(&self, step: &LessonStep, of: &str, size: f64, mut slide: Option<&mut Framebuffer>) -> bool {
        #[expect(clippy::cast_possible_truncation, reason = "a size of letters")]
        let size = (size * f64::from(self.size[1])) as f32;
        let body = TextStyle::new(size, self.colors.ink);
        let gap = i64::from(body.line_height()) / 2;
        let margin = i64::from(self.margin);
        let mut top = margin;
        let small = TextStyle::new(size * 0.75, self.colors.quiet);
        let head = TextBlock::new(of, small, Some(self.words_end.saturating_sub(self.margin)));
        if let Some(slide) = slide.as_deref_mut() {
            head.draw(slide, [margin, top], Anchor::Left);
        }
        top += i64::from(head.size()[1]) + gap;
        let title = [Span {
            text: step.title.clone(),
            look: Look::Bold,
        }];
        if !step.title.is_empty() {
            top = self.spans(&title, heading(body), [margin, top], slide.as_deref_mut()) + gap;
        }
        for block in &step.text {
            top = match block {
                Block::Heading(words) => self.spans(words, heading(body), [margin, top], slide.as_deref_mut()),
                Block::Paragraph(words) => self.spans(words, body, [margin, top], slide.as_deref_mut()),
                Block::Item { depth, marker, words } => {
                    let indent = i64::from(body.line_height()) * i64::try_from(*depth).unwrap_or(0).min(4);
                    let left = margin + indent;
                    if let Some(slide) = slide.as_deref_mut() {
                        TextBlock::new(marker, body, None).draw(slide, [left, top], Anchor::Left);
                    }
                    let words_left = left + i64::from(body.line_height());
                    self.spans(words, body, [words_left, top], slide.as_deref_mut()) - gap / 2
                }
                Block::Code(code) => {
                    let style = code_style(body, self.colors);
                    let block = TextBlock::new(code, style, Some(self.words_end.saturating_sub(self.margin)));
                    if let Some(slide) = slide.as_deref_mut() {
                        block.draw(slide, [margin, top], Anchor::Left);
                    }
                    top + i64::from(block.size()[1])
                }
            } + gap;
        }
        top - gap <= i64::from(self.size[1]) - margin
    }

    /// Writes spans from the corner `at` on; where the next block begins.
    fn spans(&self, spans: &[Span], style: TextStyle, at: [i64; 2], mut slide: Option<&mut Framebuffer>) -> i64 {
        let mut pen = Pen {
            left: at[0],
            at,
            blank: false,
        };
        let blank = i64::from(TextBlock::new("n n", style, None).size()[0])
            - i64::from(TextBlock::new("nn", style, None).size()[0]);
        for word in spans.iter().flat_map(|span| words_of(span, style, self.colors)) {
            pen.blank |= word.after == After::Blank;
            if word.text.is_empty() && word.after != After::LineBreak {
                continue;
            }
            let spaced = std::mem::take(&mut pen.blank);
            let block = TextBlock::new(word.text, word.style, None);
            let width = i64::from(block.size()[0]);
            let before = if spaced && pen.at[0] > pen.left { blank } else { 0 };
            let beyond = pen.at[0] + before + width > i64::from(self.words_end) && pen.at[0] > pen.left;
            if word.after == After::LineBreak || (beyond && spaced) {
                pen.at = [pen.left, pen.at[1] + i64::from(style.line_height())];
            } else {
                pen.at[0] += before;
            }
            if let Some(slide) = slide.as_deref_mut() {
                block.draw(slide, pen.at, Anchor::Left);
                if word.look == Look::Bold {
                    block.draw(slide, [pen.at[0] + 1, pen.at[1]], Anchor::Left);
                }
            }
            pen.at[0] += width;
        }
        pen.at[1] + i64::from(style.line_height())
    }
}

fn heading(style: TextStyle) -> TextStyle {
    #[expect(clippy::cast_possible_truncation, reason = "a size of letters")]
    let size = (f64::from(style.size) * HEADING) as f32;
    TextStyle { size, ..style }
}

fn code_style(style: TextStyle, colors: &Colors) -> TextStyle {
    TextStyle {
        typeface: Typeface::Code,
        size: style.size * 0.9,
        color: colors.code,
    }
}

/// The words of a span. Between two spans without a blank no line may break.
fn words_of<'a>(span: &'a Span, style: TextStyle, colors: &Colors) -> impl Iterator<Item = Word<'a>> + use<'a> {
    let style = match span.look {
        Look::Code => code_style(style, colors),
        Look::Bold => TextStyle {
            color: colors.strong,
            ..style
        },
        Look::Italic => TextStyle {
            typeface: Typeface::Slanted,
            color: colors.strong,
            ..style
        },
        Look::Plain => style,
    };
    span.text.split('\n').enumerate().flat_map(move |(line, text)| {
        text.split(' ').enumerate().map(move |(i, text)| Word {
            text,
            style,
            look: span.look,
            after: match (line, i) {
                (0, 0) => After::Word,
                (_, 0) => After::LineBreak,
                _ => After::Blank,
            },
        })
    })
}
