//! Declarations in their plain form. What is none is passed over, up to the next semicolon (CSS Syntax 3, section 5.5.5).

use std::borrow::Cow;
use std::ops::Range;

use super::inherited::is_inherited;
use super::plain::Plain;
use super::tokens::{Brackets, Kind, Token, Tokens, inside, unescaped};
use super::{letter_case, selectors};

/// Words that every property knows (CSS Cascading 5, section 7.3).
const EVERYWHERE: [&str; 5] = ["inherit", "initial", "unset", "revert", "revert-layer"];

/// A word that every property knows, as `inherit` or `initial`: nobody else gave the element a style, so these are all.
pub(in crate::scene) fn plain_word(property: &str, value: &str) -> Option<&'static str> {
    let word = EVERYWHERE.into_iter().find(|word| value.eq_ignore_ascii_case(word))?;
    Some(match word {
        "inherit" => "inherit",
        "initial" => "initial",
        _ if is_inherited(property) => "inherit",
        _ => "initial",
    })
}

/// The declarations of an attribute `style` in their plain form.
pub(in crate::scene) fn style(css: &str) -> Plain {
    let mut plain = Plain::default();
    write(css, 0..css.len(), &mut plain);
    plain
}

/// Writes the declarations in a part of `css`. Where rules stand between them, it answers with their places.
pub(super) fn write(css: &str, part: Range<usize>, plain: &mut Plain) -> Vec<usize> {
    let mut nested = Vec::new();
    let mut brackets = Brackets::default();
    let mut piece: Vec<Token> = Vec::new();
    for token in Tokens::of(css, part) {
        let is_end = token.kind == Kind::Semicolon && brackets.are_closed();
        if is_end {
            declaration(css, &piece, &brackets, plain);
            piece.clear();
            continue;
        }
        let has_closed = brackets.pass(css, &token);
        let is_void = matches!(token.kind, Kind::Blank | Kind::Comment);
        if is_void && piece.is_empty() {
            continue;
        }
        let is_block = has_closed && css[token.place.clone()].starts_with('}') && brackets.are_closed();
        piece.push(token);
        if is_block && !is_custom(css, &piece) {
            let text = &css[piece[0].place.start..piece[piece.len() - 1].place.end];
            let body = text.split_once('{').map_or("", |(_, body)| body);
            nested.extend(body.contains(':').then(|| piece[0].place.start));
            piece.clear();
        }
    }
    declaration(css, &piece, &brackets, plain);
    nested
}

/// Whether a declaration is that of a custom property.
fn is_custom(css: &str, piece: &[Token]) -> bool {
    piece
        .first()
        .is_some_and(|name| css[name.place.clone()].starts_with("--"))
}

/// Writes one declaration, if it is one, and closes its brackets.
fn declaration(css: &str, piece: &[Token], brackets: &Brackets, plain: &mut Plain) {
    let is_void = |token: &&Token| matches!(token.kind, Kind::Blank | Kind::Comment);
    let Some((name, rest)) = piece.split_first() else {
        return;
    };
    let between = rest.iter().take_while(is_void).count();
    let Some((colon, value)) = rest[between..].split_first() else {
        return;
    };
    let value = &value[value.iter().take_while(is_void).count()..];
    let value = &value[..value.len() - value.iter().rev().take_while(is_void).count()];
    if name.kind != Kind::Name || colon.kind != Kind::Colon || value.is_empty() {
        return;
    }
    let mut name_text = unescaped(&css[name.place.clone()]);
    let is_custom = name_text.starts_with("--");
    if !is_custom {
        name_text.to_mut().make_ascii_lowercase();
        if !selectors::is_plain(&name_text) {
            return;
        }
    }
    let (value, is_important) = without_mark(css, value);
    let text = value_text(css, value, letter_case::has_names(&name_text))
        .map(|text| text + &brackets.closers().collect::<String>());
    let Some(text) = text.filter(|text| !text.is_empty()) else {
        return;
    };
    let text = plain_word(&name_text, &text).map_or(text, str::to_owned);
    plain.come_from(name.place.start);
    plain.text += &name_text;
    plain.text.push(':');
    plain.come_from(value[0].place.start);
    plain.text += &text;
    if is_important {
        plain.text += "!important";
    }
    plain.text.push(';');
}

/// A value without `!important`, and whether that was there.
fn without_mark<'t>(css: &str, value: &'t [Token]) -> (&'t [Token], bool) {
    let is_void = |token: &&Token| matches!(token.kind, Kind::Blank | Kind::Comment);
    let Some((last, rest)) = value.split_last() else {
        return (value, false);
    };
    let rest = &rest[..rest.len() - rest.iter().rev().take_while(is_void).count()];
    let is_word = unescaped(&css[last.place.clone()]).eq_ignore_ascii_case("important");
    match rest.split_last() {
        Some((sign, rest)) if is_word && &css[sign.place.clone()] == "!" => (
            &rest[..rest.len() - rest.iter().rev().take_while(is_void).count()],
            true,
        ),
        _ => (value, false),
    }
}

/// The text of a value, whose words may be anybody's names; `None` where it is none.
fn value_text(css: &str, value: &[Token], has_names: bool) -> Option<String> {
    let mut written = String::new();
    let mut brackets = Brackets::default();
    for token in value {
        let text = &css[token.place.clone()];
        let has_closed = brackets.pass(css, token);
        match token.kind {
            Kind::Bad => return None,
            Kind::Close if !has_closed => return None,
            Kind::Blank | Kind::Comment => written.push(' '),
            Kind::Quoted => written += &string(text),
            kind => {
                let is_word = matches!(kind, Kind::Name | Kind::Function | Kind::Hash | Kind::Number | Kind::At);
                let plain = if is_word { word(text) } else { Cow::Borrowed(text) };
                let usual = letter_case::usual(kind, &plain).filter(|_| !has_names);
                written += usual.as_deref().unwrap_or(&plain);
                written += if kind == Kind::Url && !text.ends_with(')') {
                    ")"
                } else {
                    ""
                };
            }
        }
    }
    Some(written)
}

/// A word without escapes, if the reader of styles takes it as one word then.
fn word(text: &str) -> Cow<'_, str> {
    let plain = unescaped(text);
    let inner = plain.trim_start_matches(['#', '@']).trim_end_matches('(');
    let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_') || !c.is_ascii();
    if text.contains('\\') && inner.chars().all(is_word) {
        plain
    } else {
        Cow::Borrowed(text)
    }
}

/// A string without escapes, which the reader of styles does not know.
fn string(text: &str) -> Cow<'_, str> {
    if !text.contains('\\') && text.len() > 1 && text.ends_with(&text[..1]) {
        return Cow::Borrowed(text);
    }
    let held = inside(text);
    // Of two marks one has to be another: no name of a typeface has both.
    let plain = selectors::quoted(&held).unwrap_or_else(|| format!("\"{}\"", held.replace(['"', '\\'], "'")));
    Cow::Owned(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(css: &str) -> (String, Vec<usize>) {
        let mut plain = Plain::default();
        let nested = write(css, 0..css.len(), &mut plain);
        (plain.text, nested)
    }

    #[test]
    fn declarations_are_written_plainly() {
        for (css, expected) in [
            ("fill: gre\\65n ; f\\69ll:r\\000065 d", "fill:green;fill:red;"),
            (
                "FILL:red ! /**/ IMPORTANT;a : b c!important",
                "fill:red!important;a:b c!important;",
            ),
            (
                "fill:UNSET;opacity:Unset;stroke:Inherit;x:REVERT",
                "fill:inherit;opacity:initial;stroke:inherit;x:initial;",
            ),
            ("font-family:\"a}b\";fill:green", "font-family:\"a}b\";fill:green;"),
            ("a:\"b\\\"c\";d:'it\\'s }';e:'\"\\''", "a:'b\"c';d:\"it's }\";e:\"''\";"),
            ("stroke:none; /* c */ fill:/**/red/**/", "stroke:none;fill:red;"),
            ("undefined;12px;a:;:b;a:b);c:'d\ne:f;g:url(a b);fill:red", "fill:red;"),
            ("--X:{a:b};c:rgb(1,2", "--X:{a:b};c:rgb(1,2);"),
            (
                "display:NONE;stroke:RGB(1,2,3);r:2PX;mask:URL(#Ab)",
                "display:none;stroke:rgb(1,2,3);r:2px;mask:url(#Ab);",
            ),
            (
                "fill:CurrentColor;font:2PX Ab;content:'A';--x:B",
                "fill:currentColor;font:2PX Ab;content:'A';--x:B;",
            ),
            (
                "*zoom:1;fill:url(#a;b) red;b:url( \"c;d\" )",
                "fill:url(#a;b) red;b:url( \"c;d\" );",
            ),
        ] {
            assert_eq!(written(css).0, expected, "{css}");
        }
    }

    #[test]
    fn names_and_values_come_from_where_they_stood() {
        let css = "x; A : /**/ b; c:d";
        let plain = style(css);
        let places = plain
            .places
            .iter()
            .map(|place| (&plain.text[place.at..=place.at], &css[place.from..=place.from]));
        assert_eq!(
            places.collect::<Vec<_>>(),
            [("a", "A"), ("b", "b"), ("c", "c"), ("d", "d")]
        );
    }

    #[test]
    fn rules_between_declarations_are_found() {
        let css = "a:b; c:hover{d:e} f:g; @media x{h{i:j}} k{} l:m";
        let (text, nested) = written(css);
        assert_eq!(text, "a:b;f:g;l:m;");
        assert_eq!(nested, ["c:hover", "@media"].map(|rule| css.find(rule).unwrap_or(0)));
    }
}
