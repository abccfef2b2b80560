//! What code imports: the statements of a file, and the paths that they name.

/// A file's place in its room: `["coverage", "span"]`; a room's own file has none.
pub(super) type Module = Vec<String>;

/// The lines of a text without their comments, each with its number; an import over several lines is one.
pub(super) fn statements(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (number, line) in (1..).zip(text.lines()) {
        let code = line.split("//").next().unwrap_or("");
        match found.last_mut().filter(|_| goes_on) {
            Some((_, statement)) => statement.push_str(code),
            None => found.push((number, code.to_owned())),
        }
        let begins = code.trim_start();
        let is_import = begins.starts_with("use ") || begins.starts_with("pub") && begins.contains(" use ");
        goes_on = (goes_on || is_import) && !code.contains(';');
    }
    found
}

/// The paths in a statement, such as `crate::raster::Framebuffer`; braces after `crate::` are opened.
pub(super) fn paths(code: &str) -> Vec<String> {
    let letters = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = code.split(|c: char| !letters(c));
    let mut found: Vec<String> = words
        .filter(|word| word.trim_start_matches(':').contains("::"))
        .map(str::to_owned)
        .collect();
    for prefix in ["crate::", "rasterscope::"] {
        for (start, braces) in code.match_indices(&format!("{prefix}{{")) {
            let mut inside = Vec::new();
            tree_paths(Vec::new(), &code[start + braces.len() - 1..], &mut inside);
            found.extend(inside.into_iter().map(|path| format!("crate::{}", path.join("::"))));
        }
    }
    found
}

/// The paths of a tree such as `a::{B, c::D}` below `base`; returns what follows it.
pub(super) fn tree_paths<'t>(mut base: Module, mut text: &'t str, found: &mut Vec<Module>) -> &'t str {
    loop {
        text = text.trim_start();
        if let Some(mut list) = text.strip_prefix('{') {
            while !list.trim_start().starts_with('}') && !list.is_empty() {
                let rest = tree_paths(base.clone(), list, found).trim_start();
                if rest.len() == list.len() {
                    return rest;
                }
                list = rest.strip_prefix(',').unwrap_or(rest);
            }
            return list.trim_start().strip_prefix('}').unwrap_or(list);
        }
        let end = text
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(text.len());
        if end == 0 {
            found.push(base);
            return text.strip_prefix('*').unwrap_or(text);
        }
        if &text[..end] != "self" {
            base.push(text[..end].to_owned());
        }
        text = &text[end..];
        let Some(rest) = text.strip_prefix("::") else {
            found.push(base);
            return text;
        };
        text = rest;
    }
}
