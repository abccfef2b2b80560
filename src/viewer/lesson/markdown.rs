//! A lesson's text: headings, paragraphs, lists and code with bold, italic and code words. What Markdown has besides is
//! shown as the text that it holds.

use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};

use crate::plain;

/// A part of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// A heading.
    Heading(Vec<Span>),
    /// A paragraph.
    Paragraph(Vec<Span>),
    /// An item of a list.
    Item {
        /// How deep the list lies in others, from 0.
        depth: usize,
        /// A bullet, or a number with its point.
        marker: String,
        /// Its words.
        words: Vec<Span>,
    },
    /// Lines of code.
    Code(String),
}

/// Words of one look.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// The words; a line break stands where one was asked for.
    pub text: String,
    /// How they look.
    pub look: Look,
}

/// How words look: where several apply, the first of code, bold and italic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Look {
    /// As the others.
    #[default]
    Plain,
    /// Strong.
    Bold,
    /// Emphasised.
    Italic,
    /// Code.
    Code,
}

/// What is being read.
#[derive(Default)]
struct Reader {
    blocks: Vec<Block>,
    words: Vec<Span>,
    bold: usize,
    italic: usize,
    /// The lists that are open: the next number, or none for bullets.
    lists: Vec<Option<u64>>,
    /// The marker of an item that has no words yet.
    marker: Option<String>,
    in_item: bool,
    code: Option<String>,
    heading: bool,
}

/// The blocks of a Markdown text.
pub(in crate::viewer) fn blocks(text: &str) -> Vec<Block> {
    let mut reader = Reader::default();
    for event in Parser::new(text) {
        reader.take(event);
    }
    reader.flush();
    reader.blocks
}

impl Reader {
    fn take(&mut self, event: Event<'_>) {
        match event {
            Event::Start(tag) => self.start(&tag),
            Event::End(tag) => self.end(tag),
            Event::Text(text) | Event::Html(text) | Event::InlineHtml(text) => match &mut self.code {
                Some(code) => code.push_str(&fit(&text)),
                None => self.add(&text, false),
            },
            Event::Code(text) => self.add(&text, true),
            Event::SoftBreak => self.add(" ", false),
            Event::HardBreak => self.add("\n", false),
            _ => {}
        }
    }

    fn start(&mut self, tag: &Tag<'_>) {
        match tag {
            Tag::Strong => self.bold += 1,
            Tag::Emphasis => self.italic += 1,
            Tag::Heading { .. } => {
                self.flush();
                self.heading = true;
            }
            Tag::CodeBlock(CodeBlockKind::Indented | CodeBlockKind::Fenced(_)) => {
                self.flush();
                self.code = Some(String::new());
            }
            Tag::List(first) => {
                self.flush();
                self.lists.push(*first);
            }
            Tag::Item => {
                self.flush();
                self.in_item = true;
                self.marker = Some(match self.lists.last_mut() {
                    Some(Some(number)) => {
                        *number += 1;
                        format!("{}.", *number - 1)
                    }
                    _ => "\u{2022}".to_owned(),
                });
            }
            Tag::Paragraph => self.flush(),
            _ => {}
        }
    }

    fn end(&mut self, tag: TagEnd) {
        match tag {
            TagEnd::Strong => self.bold = self.bold.saturating_sub(1),
            TagEnd::Emphasis => self.italic = self.italic.saturating_sub(1),
            TagEnd::CodeBlock => {
                let code = self.code.take().unwrap_or_default();
                self.blocks.push(Block::Code(code.trim_end().to_owned()));
            }
            TagEnd::List(_) => {
                self.flush();
                self.lists.pop();
            }
            TagEnd::Item => {
                self.flush();
                self.in_item = self.lists.len() > 1;
            }
            TagEnd::Paragraph | TagEnd::Heading(_) | TagEnd::HtmlBlock => self.flush(),
            _ => {}
        }
    }

    fn add(&mut self, text: &str, code: bool) {
        let look = match () {
            () if code => Look::Code,
            () if self.bold > 0 => Look::Bold,
            () if self.italic > 0 => Look::Italic,
            () => Look::Plain,
        };
        let text = fit(text);
        match self.words.last_mut() {
            Some(last) if last.look == look => last.text.push_str(&text),
            _ => self.words.push(Span { text, look }),
        }
    }

    /// Ends the block whose words were read.
    fn flush(&mut self) {
        let words = std::mem::take(&mut self.words);
        let heading = std::mem::take(&mut self.heading);
        if words.iter().all(|span| span.text.trim().is_empty()) {
            return;
        }
        let block = if heading {
            Block::Heading(words)
        } else if self.in_item {
            Block::Item {
                depth: self.lists.len().saturating_sub(1),
                marker: self.marker.take().unwrap_or_default(),
                words,
            }
        } else {
            Block::Paragraph(words)
        };
        self.blocks.push(block);
    }
}

/// Text as it can be shown: tabs are blanks, and nothing steers the direction of writing.
fn fit(text: &str) -> String {
    let blank = text.replace('\t', "    ").replace('\r', "");
    plain::lines(&blank).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(text: &str) -> Span {
        Span {
            text: text.to_owned(),
            ..Span::default()
        }
    }

    #[test]
    fn markdown_becomes_blocks() {
        let text = "# One *thing*\n\nSome **bold** and `code`\nin a row.\n\n1. first\n2. second\n   * inner\n\n```\na\n b\n```\n";
        let bold = Span {
            look: Look::Bold,
            ..plain("bold")
        };
        let italic = Span {
            look: Look::Italic,
            ..plain("thing")
        };
        let code = Span {
            look: Look::Code,
            ..plain("code")
        };
        let item = |depth, marker: &str, words| Block::Item {
            depth,
            marker: marker.to_owned(),
            words: vec![plain(words)],
        };
        let expected = vec![
            Block::Heading(vec![plain("One "), italic]),
            Block::Paragraph(vec![plain("Some "), bold, plain(" and "), code, plain(" in a row.")]),
            item(0, "1.", "first"),
            item(0, "2.", "second"),
            item(1, "\u{2022}", "inner"),
            Block::Code("a\n b".to_owned()),
        ];
        assert_eq!(blocks(text), expected);
    }

    #[test]
    fn markdown_of_any_kind_is_text() {
        let shown = |text: &str| {
            let words = blocks(text).into_iter().flat_map(|block| match block {
                Block::Heading(words) | Block::Paragraph(words) | Block::Item { words, .. } => words,
                Block::Code(code) => vec![plain(&code)],
            });
            words.map(|span| span.text).collect::<String>()
        };
        assert_eq!(
            shown("see [the page](http://example.org) <b>now</b>"),
            "see the page <b>now</b>"
        );
        assert_eq!(shown("![a picture](x.png)"), "a picture", "alternative text");
        assert_eq!(shown(""), "", "nothing");
        assert_eq!(shown("a&#x202e;b `c\u{1b}`"), "a\\u{202e}b c\\u{1b}", "steers nothing");
        let deep = "> ".repeat(2000) + &"* ".repeat(2000) + "end";
        assert!(shown(&deep).ends_with("end"), "however deep it lies");
    }
}
