//! Figures in the words of documents: Markdown, HTML and LaTeX, with captions and alternative text.

use std::fmt::Write as _;

use super::output::MARK;
use crate::plain;

/// A picture and what is said about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// The file, from where the document lies, with `/` between folders.
    pub file: String,
    /// What stands below the picture.
    pub caption: String,
    /// What is to be seen, for those who cannot see it.
    pub alternative: String,
    /// The command line that makes it again.
    pub command_line: String,
}

/// As Markdown.
pub fn markdown(figures: &[Figure]) -> String {
    let mut text = format!("<!-- {MARK} -->\n\n");
    for figure in figures {
        let (alternative, caption) = (in_markdown(&figure.alternative), in_markdown(&figure.caption));
        // Writing to a `String` cannot fail.
        let _ = writeln!(
            text,
            "![{alternative}](<{}>)\n\n*{caption}*\n",
            in_address(&figure.file)
        );
    }
    text
}

/// As HTML: a whole page that reads on light and dark screens.
pub fn html(title: &str, figures: &[Figure]) -> String {
    let title = in_html(title);
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"generator\" content=\"{MARK}\">\n<title>{title}</title>\n<style>\n\
         :root {{ color-scheme: light dark; }}\n\
         body {{ font: 16px/1.5 sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }}\n\
         figure {{ margin: 2rem 0; }}\nimg {{ max-width: 100%; height: auto; }}\n\
         figcaption {{ margin-top: .5rem; }}\ncode {{ display: block; font-size: 12px; overflow-wrap: anywhere; opacity: .7; }}\n\
         </style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    for figure in figures {
        let file = in_html(&in_address(&figure.file));
        let [alternative, caption, line] =
            [&figure.alternative, &figure.caption, &figure.command_line].map(|part| in_html(part));
        let _ = writeln!(
            text,
            "<figure>\n<img src=\"{file}\" alt=\"{alternative}\">\n<figcaption>{caption}<code>{line}</code></figcaption>\n</figure>"
        );
    }
    text.push_str("</body>\n</html>\n");
    text
}

/// As LaTeX, for `graphicx`; `Description` is that of `acmart`, and does nothing elsewhere.
pub fn latex(figures: &[Figure]) -> String {
    let mut text = format!("% {MARK}\n\\providecommand{{\\Description}}[1]{{}}\n");
    for figure in figures {
        let (caption, alternative) = (in_latex(&figure.caption), in_latex(&figure.alternative));
        let file = plain::line(&figure.file);
        let picture = if is_name_for_latex(&figure.file) {
            // Other signs are taken as they stand.
            format!("\\includegraphics[width=\\linewidth]{{\\detokenize{{{file}}}}}")
        } else {
            format!(
                "% LaTeX cannot take this file name; rename the file, and name it here:\n  \
                 % \\includegraphics[width=\\linewidth]{{{file}}}"
            )
        };
        // Writing to a `String` cannot fail.
        let _ = writeln!(
            text,
            "\n\\begin{{figure}}\n  \\centering\n  {picture}\n  \
             \\caption{{{caption}}}\n  \\Description{{{alternative}}}\n\\end{{figure}}"
        );
    }
    text
}

/// A file name as an address: signs that would end it or start something else are written by their codes.
fn in_address(file: &str) -> String {
    let mut escaped = String::new();
    for character in file.chars() {
        match character {
            '%' | '#' | '?' | '<' | '>' | '"' | '\\' | '&' | '`' => {
                // Writing to a `String` cannot fail.
                let _ = write!(escaped, "%{:02X}", u32::from(character));
            }
            other if plain::is_plain(other) => escaped.push(other),
            other => {
                for byte in other.encode_utf8(&mut [0; 4]).bytes() {
                    let _ = write!(escaped, "%{byte:02X}");
                }
            }
        }
    }
    escaped
}

/// Whether LaTeX finds a file of this name: no sign that it reads on its own before it knows that a name begins.
fn is_name_for_latex(file: &str) -> bool {
    let is_taken = |character: char| plain::is_plain(character) && !"%#{}\\^~\"".contains(character);
    file.chars().all(is_taken)
}

/// A text in which no sign means anything to Markdown.
pub fn in_markdown(text: &str) -> String {
    let mut escaped = String::new();
    for character in plain::line(text).chars() {
        if "\\`*_[]<>#|!".contains(character) {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

fn in_html(text: &str) -> String {
    let mut escaped = String::new();
    for character in plain::line(text).chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// A text as LaTeX prints it: also in the encoding OT1, whose letters have other signs in the places of `<`, `>` and `|`.
fn in_latex(text: &str) -> String {
    let mut escaped = String::new();
    // A straight quotation mark closes what the one before it opened.
    let mut is_open = false;
    for character in plain::line(text).chars() {
        match character {
            '<' => escaped.push_str("\\textless{}"),
            '>' => escaped.push_str("\\textgreater{}"),
            '|' => escaped.push_str("\\textbar{}"),
            '"' => {
                escaped.push_str(if is_open { "''" } else { "``" });
                is_open = !is_open;
            }
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '\u{d7}' => escaped.push_str("$\\times$"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(character);
            }
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure() -> Figure {
        Figure {
            file: "a b_1.png".to_owned(),
            caption: "50 % of <b> & {x}_1 #2 \\ 8\u{d7}".to_owned(),
            alternative: "a \"star\" [1]".to_owned(),
            command_line: "rasterscope render 'a & b.svg'".to_owned(),
        }
    }

    #[test]
    fn snippets_steer_no_terminal_and_no_page() {
        let name = "cod\u{202e}gvs\u{1b}]0;x\u{7}";
        let figure = Figure {
            file: format!("{name}.png"),
            caption: name.to_owned(),
            alternative: name.to_owned(),
            command_line: name.to_owned(),
        };
        for text in [
            markdown(std::slice::from_ref(&figure)),
            html(name, std::slice::from_ref(&figure)),
            latex(&[figure]),
        ] {
            assert_eq!(plain::lines(&text), text, "nothing left to escape");
            assert!(
                text.contains("202e") && text.contains(MARK),
                "visible, and marked: {text}"
            );
        }
    }

    #[test]
    fn snippets_escape_what_means_something() {
        let text = markdown(&[figure()]);
        assert!(text.contains("![a \"star\" \\[1\\]](<a b_1.png>)"), "{text}");
        assert!(text.contains("*50 % of \\<b\\> & {x}\\_1 \\#2 \\\\ 8\u{d7}*"), "{text}");
        let text = html("T & co", &[figure()]);
        assert!(text.contains("<title>T &amp; co</title>"), "{text}");
        assert!(
            text.contains("src=\"a b_1.png\" alt=\"a &quot;star&quot; [1]\""),
            "{text}"
        );
        assert!(text.contains("50 % of &lt;b&gt; &amp; {x}_1"), "{text}");
        let text = latex(&[figure()]);
        assert!(text.contains("{\\detokenize{a b_1.png}}"), "{text}");
        assert_eq!(
            in_address("50%/a #1?.png"),
            "50%25/a %231%3F.png",
            "an address that is the file's"
        );
        assert!(
            text.contains("50 \\% of \\textless{}b\\textgreater{} \\& \\{x\\}\\_1 \\#2 \\textbackslash{} 8$\\times$"),
            "{text}"
        );
        assert!(text.contains("{a ``star'' [1]}"), "{text}");
        assert_eq!(in_latex("a|b"), "a\\textbar{}b", "a bar");
    }

    #[test]
    fn snippets_name_any_file() {
        for (name, address) in [
            ("task#1.png", "task%231.png"),
            ("what?.png", "what%3F.png"),
            ("a%20b.png", "a%2520b.png"),
            ("a&copy;b.png", "a%26copy;b.png"),
            ("a<b>c.png", "a%3Cb%3Ec.png"),
            ("50% of it.png", "50%25 of it.png"),
            ("a{b.png", "a{b.png"),
            ("a\nb`.png", "a%0Ab%60.png"),
        ] {
            let file = name.to_owned();
            let figure = [Figure { file, ..figure() }];
            let text = markdown(&figure);
            assert!(text.contains(&format!("](<{address}>)")), "{name}: {text}");
            let text = html("", &figure);
            assert!(text.contains(&format!("src=\"{address}\"")), "{name}: {text}");
            let text = latex(&figure);
            let lines = || text.lines().map(str::trim_start);
            let includes = lines().filter(|line| line.starts_with("\\includegraphics")).count();
            if name.contains(['%', '#', '{', '\n']) {
                assert!(
                    includes == 0 && lines().any(|line| line.starts_with("% LaTeX")),
                    "{name}: {text}"
                );
            } else {
                assert!(
                    includes == 1 && text.contains(&format!("\\detokenize{{{name}}}")),
                    "{name}: {text}"
                );
            }
        }
    }
}
