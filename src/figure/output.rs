//! The one way to write files: whole or not at all, and never over something that would be missed.
//!
//! | what has the name already | a file that the user named | a file that the program named |
//! |---|---|---|
//! | nothing, or an empty file | is written | is written |
//! | a file that is read for it | is refused | is refused |
//! | a picture, for a picture | is replaced | only one with our record, or with `force` |
//! | a text, for one | only one of our making, or with `force` | the same |
//! | a table, for one | only one of the same command, or with `force` | the same |
//! | what the new file begins with | is replaced | is replaced |
//! | a link | leads to what is asked | the same |
//! | a link to nothing, a folder, a device, a pipe | is refused | is refused |

use std::fs::{File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::{Record, RecordError};
use crate::scene::{FileDigest, FolderResources};

/// What texts of ours carry in their head, as a comment or as HTML's generator.
pub(super) const MARK: &str = "made by rasterscope";
/// So much of a file is searched for them, in bytes.
const HEAD: u64 = 1024;
/// Names that are tried for a file that is not whole yet.
const ATTEMPTS: u32 = 100;

/// Held while files are written; what ends the program takes it first.
static WRITING: Mutex<()> = Mutex::new(());

/// Who chose the name of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// The user, by writing the path.
    ByUser,
    /// The program, such as `01.png` in a folder that the user named.
    ByProgram,
}

/// Whose table it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableOf {
    /// What a sweep measured, also as Markdown.
    Sweep,
    /// The colours along a line.
    Profile,
    /// The waves of a picture.
    Spectrum,
    /// What each frame of the window cost.
    FrameLog,
}

impl TableOf {
    const ALL: [Self; 4] = [Self::Sweep, Self::Profile, Self::Spectrum, Self::FrameLog];

    /// One of these stands in its first line.
    fn heads(self) -> &'static [&'static str] {
        match self {
            Self::Sweep => &["median_ms,min_ms,", "median_ms | min_ms |"],
            Self::Profile => &["distance,x,y,red,green,"],
            Self::Spectrum => &["across,down,wavelength,"],
            Self::FrameLog => &["at,shows,behind,draw,"],
        }
    }

    /// What people call what it tells.
    fn name(self) -> &'static str {
        match self {
            Self::Sweep => "a sweep",
            Self::Profile => "a profile",
            Self::Spectrum => "a spectrum",
            Self::FrameLog => "a window's frames",
        }
    }

    /// Of the table that begins so.
    fn of_head(head: &str) -> Option<Self> {
        let first = head.lines().next().unwrap_or("");
        let is_of = |table: &Self| table.heads().iter().any(|known| first.contains(known));
        Self::ALL.into_iter().find(is_of)
    }
}

/// Where a file is to be written, and who chose its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Destination<'a> {
    /// Where.
    pub path: &'a Path,
    /// Who chose that name.
    pub named: Named,
}

impl<'a> Destination<'a> {
    /// A file that the user named.
    pub fn by_user(path: &'a Path) -> Self {
        let named = Named::ByUser;
        Self { path, named }
    }

    /// A file that the program named.
    pub fn by_program(path: &'a Path) -> Self {
        let named = Named::ByProgram;
        Self { path, named }
    }
}

/// A file to be written.
#[derive(Clone, Debug)]
pub struct NewFile {
    /// Where.
    pub path: PathBuf,
    /// All that will be in it.
    pub bytes: Vec<u8>,
    /// Who chose the name.
    pub named: Named,
}

impl NewFile {
    /// A file whose name the user gave.
    pub fn by_user(path: &Path, bytes: Vec<u8>) -> Self {
        let (path, named) = (path.to_owned(), Named::ByUser);
        Self { path, bytes, named }
    }

    /// A file whose name the program chose.
    pub fn by_program(path: PathBuf, bytes: Vec<u8>) -> Self {
        let named = Named::ByProgram;
        Self { path, bytes, named }
    }
}

/// A file or folder that could not be written, and why.
pub type Unwritable = (PathBuf, io::Error);

/// What must not be replaced.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    inputs: Vec<PathBuf>,
    /// Of files that are read by names which only documents know.
    contents: Vec<FileDigest>,
    /// Whose tables are written, if any are.
    tables: Option<TableOf>,
    force: bool,
}

impl Guard {
    /// Protects what others made, unless the user's `force` gives it up.
    pub fn new(force: bool) -> Self {
        Self {
            force,
            ..Self::default()
        }
    }

    /// Protects a file that is read, even against `force`.
    pub fn protect(&mut self, input: impl Into<PathBuf>) {
        self.inputs.push(input.into());
    }

    /// As [`Guard::protect`].
    #[must_use]
    pub fn with(mut self, input: impl Into<PathBuf>) -> Self {
        self.protect(input);
        self
    }

    /// The same where the texts that are written are such tables: those of other commands are protected.
    #[must_use]
    pub fn of_tables(self, tables: TableOf) -> Self {
        let tables = Some(tables);
        Self { tables, ..self }
    }

    /// Protects every file with these contents, even against `force`: a texture has many addresses.
    pub fn protect_contents(&mut self, digests: impl IntoIterator<Item = FileDigest>) {
        self.contents.extend(digests);
    }

    /// Whether a file may be written: where it will lie, which is another place when `path` is a link.
    ///
    /// # Errors
    /// When something is there that must stay.
    pub fn target(&self, path: &Path, named: Named) -> io::Result<PathBuf> {
        let refused = |why: &str| Err(io::Error::new(io::ErrorKind::AlreadyExists, why));
        if path == Path::new("-") {
            return refused(
                "`-` is not a file, and nothing goes to standard output instead of one; ./- is a file of that name",
            );
        }
        let about = match std::fs::metadata(path) {
            Ok(about) => about,
            Err(_) if path.is_symlink() => return refused("a link of that name leads nowhere"),
            // Where there is no folder either, opening will say so.
            Err(_) => return Ok(path.to_owned()),
        };
        if !about.is_file() {
            return refused("there is something of that name that is not a file");
        }
        let target = std::fs::canonicalize(path)?;
        if self.is_read(&target) {
            return refused("this file is read for it and would be lost");
        }
        if about.len() == 0 || self.force {
            return Ok(target);
        }
        let there = if is_picture(&target) {
            Maker::of_picture(&target, named)
        } else {
            Maker::of_text(&target)
        };
        match there {
            Maker::Replaceable if self.tables.is_none() || is_picture(&target) => Ok(target),
            Maker::Table(table) if self.tables == Some(table) => Ok(target),
            Maker::Table(table) => refused(&format!(
                "the table of {} is there, which only --force replaces",
                table.name()
            )),
            Maker::Replaceable => refused("another text of rasterscope is there, which only --force replaces"),
            Maker::Stranger => {
                refused("a file of that name is there that rasterscope did not make, and only --force replaces it")
            }
        }
    }

    fn is_read(&self, target: &Path) -> bool {
        let digest = || {
            FolderResources::read_file(target)
                .ok()
                .map(|bytes| FileDigest::of(&bytes))
        };
        let has_contents = || digest().is_some_and(|digest| self.contents.contains(&digest));
        self.inputs.iter().any(|input| is_same(input, target)) || (!self.contents.is_empty() && has_contents())
    }
}

/// Writes files, all under other names first: none is moved to its place before all of them are written, so that no half
/// file is ever seen and a full disk leaves none of them. The moves follow one another; where one fails, or the program is
/// killed, those before it are done.
///
/// # Errors
/// When one cannot be written, or must not.
pub fn save_files(files: &[NewFile], guard: &Guard) -> Result<(), Unwritable> {
    let _writing = writing();
    let mut staged: Vec<(PathBuf, PathBuf)> = Vec::new();
    let written = files.iter().try_for_each(|file| {
        let at = |error| (file.path.clone(), error);
        let target = match guard.target(&file.path, file.named) {
            Err(_) if keeps_all(file) && !guard.is_read(&file.path) => std::fs::canonicalize(&file.path),
            target => target,
        };
        let target = target.map_err(at)?;
        let partial = write_partial(&target, &file.bytes).map_err(at)?;
        staged.push((partial, target));
        Ok(())
    });
    let moved = written.and_then(|()| {
        let mut moves = staged.iter();
        moves.try_for_each(|(from, to)| std::fs::rename(from, to).map_err(|error| (to.clone(), error)))
    });
    if moved.is_err() {
        for (partial, _) in &staged {
            // The first error is the one to tell; there may be nothing to remove.
            let _ = std::fs::remove_file(partial);
        }
    }
    moved
}

/// Writes a file that did not exist before; one that could not be written whole is removed.
///
/// # Errors
/// When it cannot be written, and when anything of that name is there, a link to nothing too.
pub fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let _writing = writing();
    create_whole(path, bytes)
}

/// Opens a file for lines that come one by one. A pipe or a device may take them too.
///
/// # Errors
/// When it cannot be opened, or must not be.
pub fn open_log(path: &Path, guard: &Guard) -> io::Result<File> {
    let is_stream = std::fs::metadata(path).is_ok_and(|about| !about.is_file() && !about.is_dir());
    if is_stream {
        return OpenOptions::new().write(true).open(path);
    }
    File::create(guard.target(path, Named::ByUser)?)
}

/// Waits until no file is half-written; none is begun while this is held.
pub fn writing() -> MutexGuard<'static, ()> {
    // There is nothing inside that could be damaged.
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whether nothing is lost: the file begins with all that was there.
fn keeps_all(file: &NewFile) -> bool {
    FolderResources::read_file(&file.path).is_ok_and(|before| file.bytes.starts_with(&before))
}

/// Writes the bytes under a name beside `target` that nothing had.
fn write_partial(target: &Path, bytes: &[u8]) -> io::Result<PathBuf> {
    if target.file_name().is_none() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "this is not a file name"));
    }
    let id = std::process::id();
    for attempt in 1..=ATTEMPTS {
        let partial = target.with_file_name(format!(".rasterscope-{id}-{attempt}.part"));
        match create_whole(&partial, bytes) {
            Ok(()) => return Ok(partial),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

fn create_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
    // A disk may tell only now that it is full; and a name must not outlive its bytes.
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    if written.is_err() {
        drop(file);
        // The first error is the one to tell.
        let _ = std::fs::remove_file(path);
    }
    written
}

/// Whether both paths lead to one file.
fn is_same(input: &Path, target: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        // Names of one file may differ, even without links.
        let id = |path: &Path| std::fs::metadata(path).ok().map(|about| (about.dev(), about.ino()));
        id(input).is_some_and(|input| Some(input) == id(target))
    }
    #[cfg(not(unix))]
    {
        std::fs::canonicalize(input).is_ok_and(|input| input == target)
    }
}

/// Who made a file that is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Maker {
    /// This program, or the user, who named a picture that may go.
    Replaceable,
    /// This program, as a table.
    Table(TableOf),
    /// Somebody else.
    Stranger,
}

impl Maker {
    fn of_picture(target: &Path, named: Named) -> Self {
        // A record of a later version is one of ours as well, and so is a damaged one.
        let has_record = || !matches!(Record::of_file(target), Ok(None) | Err(RecordError::Io(_)));
        if named == Named::ByUser || has_record() {
            Self::Replaceable
        } else {
            Self::Stranger
        }
    }

    fn of_text(target: &Path) -> Self {
        let mut head = Vec::new();
        let read = File::open(target).and_then(|file| file.take(HEAD).read_to_end(&mut head));
        if read.is_err() {
            return Self::Stranger;
        }
        let head = String::from_utf8_lossy(&head);
        match TableOf::of_head(&head) {
            Some(table) => Self::Table(table),
            None if head.contains(MARK) => Self::Replaceable,
            None => Self::Stranger,
        }
    }
}

/// Whether a file's name is that of a picture.
fn is_picture(target: &Path) -> bool {
    let has_ending = |ending| {
        target
            .extension()
            .is_some_and(|known| known.eq_ignore_ascii_case(ending))
    };
    ["png", "jpg", "jpeg"].into_iter().any(has_ending)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::encode_png;
    use super::*;
    use crate::raster::Framebuffer;

    fn saved(path: &Path, named: Named, guard: &Guard) -> Result<(), String> {
        let (path, bytes) = (path.to_owned(), b"new".to_vec());
        save_files(&[NewFile { path, bytes, named }], guard).map_err(|(_, error)| error.to_string())
    }

    #[test]
    fn output_replaces_what_it_made_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        let foreign = encode_png(&Framebuffer::new(2, 1), None).expect("it has pixels");
        let own = encode_png(&Framebuffer::new(2, 1), Some(&Record::default())).expect("it has pixels");
        let texts: [(&str, &[u8], Named, bool); 8] = [
            ("a.png", &foreign, Named::ByUser, true),
            ("a.png", b"no picture", Named::ByUser, true),
            ("a.png", &foreign, Named::ByProgram, false),
            ("a.png", &own, Named::ByProgram, true),
            ("a.md", b"# My notes\n", Named::ByProgram, false),
            ("a.md", b"<!-- made by rasterscope -->\n", Named::ByProgram, true),
            ("a.csv", b"name,points\r\nme,9\r\n", Named::ByUser, false),
            ("a.html", b"", Named::ByProgram, true),
        ];
        for (name, bytes, named, may) in texts {
            fs::write(at(name), bytes).expect("a small file");
            let saved_it = saved(&at(name), named, &Guard::new(false));
            assert_eq!(saved_it.is_ok(), may, "{name}, {named:?}: {saved_it:?}");
            let kept = fs::read(at(name)).expect("still there");
            assert_eq!(kept, if may { b"new" } else { bytes }, "{name}");
            let forced = saved(&at(name), named, &Guard::new(true));
            assert_eq!(forced, Ok(()), "{name} with force");
        }
    }

    #[test]
    fn output_replaces_tables_of_its_own_kind_only() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.csv");
        let sweep: &[u8] = b"sample_rate,median_ms,min_ms,peak_mb\r\n";
        let markdown: &[u8] = b"| sample_rate | median_ms | min_ms | peak_mb |\n";
        let waves: &[u8] = b"across,down,wavelength,angle\r\n";
        let page: &[u8] = b"<!-- made by rasterscope -->\n";
        for (bytes, tables, may) in [
            (sweep, Some(TableOf::Sweep), true),
            (markdown, Some(TableOf::Sweep), true),
            (sweep, Some(TableOf::Profile), false),
            (waves, Some(TableOf::Profile), false),
            (waves, Some(TableOf::Spectrum), true),
            (sweep, None, false),
            (page, Some(TableOf::Sweep), false),
        ] {
            fs::write(&path, bytes).expect("a small file");
            let guard = |force| {
                let guard = Guard::new(force);
                tables.map_or(guard.clone(), |tables| guard.of_tables(tables))
            };
            let saved_it = saved(&path, Named::ByUser, &guard(false));
            assert_eq!(saved_it.is_ok(), may, "{tables:?}: {saved_it:?}");
            let told = saved_it.err().is_none_or(|why| why.contains("only --force"));
            assert!(told, "{tables:?} says the cure");
            assert_eq!(saved(&path, Named::ByUser, &guard(true)), Ok(()), "with force");
        }
    }

    #[test]
    fn output_is_never_an_input() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a.png"), "texture").expect("a small file");
        let guard = Guard::new(true).with(at("a.png"));
        let way = folder.path().join(".").join("a.png");
        let refused = saved(&way, Named::ByUser, &guard).expect_err("another name of it");
        assert!(refused.contains("is read"), "{refused}");
        assert_eq!(fs::read(at("a.png")).expect("there"), b"texture", "untouched");
        assert_eq!(saved(&at("b.png"), Named::ByUser, &guard), Ok(()), "another file");
    }

    #[test]
    fn output_may_add_to_what_is_there() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("pins.toml");
        fs::write(&path, "# mine\n").expect("a small file");
        let added = NewFile::by_user(&path, b"# mine\na = 1\n".to_vec());
        save_files(&[added], &Guard::default()).expect("nothing is lost");
        let other = NewFile::by_user(&path, b"a = 1\n".to_vec());
        save_files(&[other], &Guard::default()).expect_err("a comment would be");
        assert_eq!(fs::read(&path).expect("there"), b"# mine\na = 1\n", "kept");
    }

    #[cfg(unix)]
    #[test]
    fn output_follows_links_or_refuses_them() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("target.png"), "old").expect("a small file");
        symlink(at("target.png"), at("link.png")).expect("a link");
        symlink(at("none.png"), at("dangling.png")).expect("a link");
        symlink("/dev/null", at("device.png")).expect("a link");
        let guard = Guard::default();
        assert_eq!(saved(&at("link.png"), Named::ByUser, &guard), Ok(()), "followed");
        assert!(at("link.png").is_symlink(), "the link stays");
        assert_eq!(fs::read(at("target.png")).expect("there"), b"new", "what it leads to");
        for name in ["dangling.png", "device.png"] {
            assert!(saved(&at(name), Named::ByUser, &guard).is_err(), "{name}");
            assert!(at(name).is_symlink(), "{name} stays");
        }
        assert!(!at("none.png").exists(), "nothing where the link leads");
        assert!(
            write_new(&at("dangling.png"), b"x").is_err(),
            "new files go through no link"
        );
        let protected = Guard::default().with(at("target.png"));
        assert!(
            saved(&at("link.png"), Named::ByUser, &protected).is_err(),
            "a link to an input"
        );
    }

    #[test]
    fn output_half_written_by_others_is_left_alone() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let stale = folder
            .path()
            .join(format!(".rasterscope-{}-1.part", std::process::id()));
        fs::write(&stale, "stale").expect("a small file");
        assert_eq!(
            saved(&folder.path().join("a.md"), Named::ByUser, &Guard::default()),
            Ok(()),
            "saved"
        );
        assert_eq!(fs::read(&stale).expect("there"), b"stale", "not ours");
    }
}
