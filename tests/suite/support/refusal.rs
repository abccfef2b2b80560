//! How the program answers a mistake.

use std::process::Output;

/// Exit status 2, nothing on stdout, one line on stderr that holds all of `words`.
pub(crate) fn assert_refused(output: &Output, arguments: &[&str], words: &[&str]) {
    assert_told(output, 2, arguments, words);
}

/// This exit status, nothing on stdout, one line on stderr that holds all of `words`.
pub(crate) fn assert_told(output: &Output, status: i32, arguments: &[&str], words: &[&str]) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?} prints nothing else");
    assert_eq!(
        stderr.trim_end().lines().count(),
        1,
        "{arguments:?}: one line: {stderr}"
    );
    for word in words {
        assert!(stderr.contains(word), "{arguments:?} says {word}: {stderr}");
    }
}
