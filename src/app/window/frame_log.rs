//! A line for every picture that the window shows: what it shows, how old that is, and where the time went.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

use super::super::AppError;
use super::super::session::PanelTimes;
use crate::figure::{Guard, open_log};
use crate::viewer::{PixelRect, Viewer};

/// The columns; all times are milliseconds, the first since 1970.
const HEADER: &str = "at,shows,behind,draw,onto,layout,tessellate,paint,compose,present,parts,pixels";

/// The file that gets the lines.
#[derive(Debug)]
pub(super) struct FrameLog {
    file: File,
    /// Of the picture in the line before.
    revision: u64,
}

/// What the window knows of a picture that it showed.
#[derive(Debug)]
pub(super) struct Shown<'a> {
    /// When the first event came that nothing was shown for.
    pub(super) event: Option<Instant>,
    /// Drawing the frame straight into the surface, where it did.
    pub(super) onto: Duration,
    pub(super) panels: PanelTimes,
    pub(super) compose: Duration,
    pub(super) present: Duration,
    pub(super) parts: &'a [PixelRect],
}

impl FrameLog {
    /// # Errors
    /// When the file cannot be written, or `guard` has something against it.
    pub(super) fn create(path: &Path, guard: &Guard) -> Result<Self, AppError> {
        let begin = || {
            let mut file = open_log(path, guard)?;
            writeln!(file, "{HEADER}").map(|()| file)
        };
        let file = begin().map_err(|error: io::Error| {
            AppError::Input(format!(
                "{}: cannot write this file: {error}; choose another place",
                path.display()
            ))
        })?;
        Ok(Self { file, revision: 0 })
    }

    /// Adds a line for what was shown just now.
    pub(super) fn add(&mut self, viewer: &Viewer, shown: &Shown<'_>) {
        let now = Instant::now();
        let is_panels = std::mem::replace(&mut self.revision, viewer.picture_revision()) == viewer.picture_revision();
        let (shows, since) = if is_panels {
            ("panels".to_owned(), shown.event)
        } else {
            (shows(viewer), Some(viewer.frames().wanted_since()))
        };
        let drawn = viewer
            .frames()
            .frame()
            .filter(|_| !is_panels && !viewer.frames().is_refining());
        let behind = since.map_or(Duration::ZERO, |since| now.saturating_duration_since(since));
        let PanelTimes {
            layout,
            tessellate,
            paint,
        } = shown.panels;
        let times = [
            behind,
            drawn.map_or(Duration::ZERO, |frame| frame.stats.total()),
            shown.onto,
            layout,
            tessellate,
            paint,
            shown.compose,
            shown.present,
        ];
        let times: Vec<String> = times.iter().map(|time| ms(*time)).collect();
        let area = |part: &PixelRect| u64::from(part.width) * u64::from(part.height);
        let at = SystemTime::now()
            .duration_since(SystemTime::UNIX_EPOCH)
            .unwrap_or_default();
        let (times, parts) = (times.join(","), shown.parts.len());
        let pixels: u64 = shown.parts.iter().map(area).sum();
        let line = format!("{},{shows},{times},{parts},{pixels}\n", ms(at));
        // A full disk does not end the session.
        let _ = self.file.write_all(line.as_bytes());
    }
}

/// What the picture is: `final`, `refining`, or how its preview was made.
fn shows(viewer: &Viewer) -> String {
    match viewer.frames().preview() {
        None => "final".to_owned(),
        Some(_) if viewer.frames().is_refining() => "refining".to_owned(),
        Some(quality) => quality.to_string(),
    }
}

fn ms(time: Duration) -> String {
    format!("{:.3}", time.as_secs_f64() * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::TableOf;

    #[test]
    fn frame_log_replaces_no_file_of_another_making() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (scene, log) = (folder.path().join("s.svg"), folder.path().join("log.csv"));
        std::fs::write(&scene, "<svg/>").expect("a small file");
        let refused = FrameLog::create(&scene, &Guard::default()).expect_err("a scene");
        assert!(refused.is_input() && refused.to_string().contains("s.svg"), "{refused}");
        assert_eq!(std::fs::read(&scene).expect("there"), b"<svg/>", "kept");
        for _ in 0..2 {
            let guard = Guard::default().of_tables(TableOf::FrameLog);
            FrameLog::create(&log, &guard).expect("a new file, or an older log");
        }
    }
}
