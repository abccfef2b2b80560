//! Short messages to the user: what was saved, what went wrong and how to cure it.

use crate::plain;

/// Messages kept; older ones go.
const MOST: usize = 6;
/// Errors remembered after they left the screen; later ones are not.
const MOST_ERRORS: usize = 64;

/// What is said where the explanation that was asked for has no room.
pub const NO_ROOM: &str = "no room here for the explanation of the pixel: make the window wider";

/// One message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Grows with every message; names it in [`crate::viewer::command::parts::WindowCommand::DismissMessage`].
    pub id: u64,
    /// How bad it is.
    pub kind: MessageKind,
    /// One line.
    pub text: String,
}

/// How bad a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MessageKind {
    /// Something was done.
    Done,
    /// Something was saved; its folder can be opened.
    Saved,
    /// Something was taken away that can be brought back.
    TakenAway,
    /// Something could not be done.
    Error,
    /// Waits [`crate::viewer::chrome::ending::ASKS_FOR`] for the same key again.
    Question,
}

/// The messages on the screen, oldest first.
#[derive(Debug, Default)]
pub(in crate::viewer) struct Messages {
    list: Vec<Message>,
    next_id: u64,
    /// What went wrong and was not mended since, oldest first, whether it still stands on the screen or not.
    errors: Vec<String>,
}

/// Said to whoever names the `what` of this index, from 0, where `owner` has only so many, such as "the list".
pub(in crate::viewer) fn no_such(what: &str, index: usize, owner: &str, count: usize) -> String {
    let number = index.saturating_add(1);
    format!("there is no {what} {number}: {owner} has {count}")
}

impl Messages {
    pub(in crate::viewer) fn all(&self) -> &[Message] {
        &self.list
    }

    /// What went wrong so far and was not mended since, oldest first: also what left the screen, which a script may not notice.
    pub(in crate::viewer) fn errors(&self) -> &[String] {
        &self.errors
    }

    /// Adds a message; one with the same text moves to the end instead of standing there twice.
    pub(in crate::viewer) fn add(&mut self, kind: MessageKind, text: String) {
        let text = plain::into_lines(text);
        self.list.retain(|message| message.text != text);
        if self.list.len() == MOST {
            self.list.remove(0);
        }
        if kind == MessageKind::Error && self.errors.len() < MOST_ERRORS && !self.errors.contains(&text) {
            self.errors.push(text.clone());
        }
        let id = self.next_id;
        self.next_id += 1;
        self.list.push(Message { id, kind, text });
    }

    pub(in crate::viewer) fn done(&mut self, text: String) {
        self.add(MessageKind::Done, text);
    }

    pub(in crate::viewer) fn saved(&mut self, text: String) {
        self.add(MessageKind::Saved, text);
    }

    pub(in crate::viewer) fn question(&mut self, text: String) {
        self.add(MessageKind::Question, text);
    }

    pub(in crate::viewer) fn error(&mut self, text: String) {
        self.add(MessageKind::Error, text);
    }

    /// Drops what was wrong with a file that is right by now.
    pub(in crate::viewer) fn forget_problems_of(&mut self, file: &str) {
        let file = plain::lines(file);
        let of_file = |text: &str| text.strip_prefix(&*file).is_some_and(|rest| rest.starts_with(':'));
        self.list
            .retain(|message| message.kind != MessageKind::Error || !of_file(&message.text));
        self.errors.retain(|text| !of_file(text));
    }

    /// Drops what is no longer so: messages that begin like this.
    pub(in crate::viewer) fn retract(&mut self, beginning: &str) {
        self.list.retain(|message| !message.text.starts_with(beginning));
        self.errors.retain(|text| !text.starts_with(beginning));
    }

    pub(in crate::viewer) fn dismiss(&mut self, id: u64) {
        self.list.retain(|message| message.id != id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_outlast_the_screen_until_they_are_mended() {
        let mut messages = Messages::default();
        messages.error("a.svg: broken".to_owned());
        let first = messages.all()[0].id;
        messages.dismiss(first);
        for i in 0..2 * MOST_ERRORS {
            messages.error(format!("{i}.svg: broken"));
        }
        assert_eq!(messages.errors().len(), MOST_ERRORS);
        assert_eq!(messages.errors()[0], "a.svg: broken", "it left the screen first");
        messages.forget_problems_of("a.svg");
        assert_eq!(messages.errors()[0], "0.svg: broken");
        messages.retract("0.svg");
        assert_eq!(messages.errors()[0], "1.svg: broken");
    }

    #[test]
    fn messages_are_few_and_different() {
        let mut messages = Messages::default();
        for i in 0..20 {
            messages.done(format!("saved {i}"));
        }
        messages.error("saved 19".into());
        let texts: Vec<&str> = messages.all().iter().map(|m| m.text.as_str()).collect();
        let expected = ["saved 14", "saved 15", "saved 16", "saved 17", "saved 18", "saved 19"];
        assert_eq!(texts, expected, "the last ones, each once");
        messages.done("a\u{1b}[2J\u{202e}b".into());
        let last = messages.all()[MOST - 1].id;
        assert_eq!(messages.all()[MOST - 1].text, "a\\u{1b}[2J\\u{202e}b", "steers nothing");
        messages.dismiss(last);
        assert_eq!(messages.all().len(), MOST - 1, "dismissed");
        messages.error("a.svg:3:1: broken".into());
        messages.error("a.svg.svg: broken".into());
        messages.forget_problems_of("a.svg");
        let left = messages.all().last().map(|message| message.text.as_str());
        assert_eq!(left, Some("a.svg.svg: broken"), "only that of the file itself is gone");
        assert_eq!(messages.all().len(), MOST - 1, "nothing else");
    }
}
