//! The textures a document refers to: each address once, read and decoded in parallel, within a budget of texels.

use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use data_url::DataUrl;
use rayon::prelude::*;

use super::cut_off::is_cut_off;
use super::report::{quote, shorten};
use super::turned::is_turned;
use super::{FileDigest, Report, ResourceError, Resources, SourceLocation, TextureId, unreadable};
use crate::memory::{self, OutOfMemory};
use crate::texture::{Memory, PixelSampling, Texture};

/// Most bytes that all images of a scene may take together, encoded and as textures.
const MAX_HELD: u64 = 1_200 << 20;
/// Most bytes that decoding may take besides at any time.
const MAX_PASSING: u64 = 600 << 20;
/// Most bytes of all encoded images of a scene.
const MAX_BYTES: u64 = 512 << 20;
/// Most characters of an address that is kept with its digest.
const MAX_ADDRESS: usize = 400;
/// Most different textures of a scene.
const MAX_TEXTURES: usize = 4_096;
/// The textures that the document refers to so far: read as they are asked for, decoded all together in the end.
pub(super) struct TextureTable<'doc> {
    resources: &'doc dyn Resources,
    alpha: Alpha,
    ids: HashMap<Key<'doc>, TextureId>,
    /// Checkers by the names of textures that the document does not have.
    undefined: HashMap<&'doc str, TextureId>,
    /// The checker of all that are too many.
    beyond: Option<TextureId>,
    entries: Vec<Entry<'doc>>,
    bytes_left: u64,
    held_left: u64,
    /// Whether a file could be read but for the memory.
    starved: Result<(), OutOfMemory>,
    /// Files that are documents.
    documents: Vec<(String, FileDigest)>,
}

/// What tells textures apart: their address, and how they are to be read.
type Key<'doc> = (Cow<'doc, str>, Option<PixelSampling>);

/// Whether a texture's transparency counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Alpha {
    /// As SVG has it.
    Keep,
    /// The course's reader forgets it.
    Drop,
}

/// One texture.
#[derive(Debug)]
struct Entry<'doc> {
    address: Cow<'doc, str>,
    /// How it is to be read, whatever the settings say.
    asks: Option<PixelSampling>,
    /// Where it is first asked for.
    location: SourceLocation,
    /// Its file, or why there is none.
    file: Result<EncodedImage, String>,
}

/// A PNG or JPEG.
#[derive(Debug)]
struct EncodedImage {
    bytes: Vec<u8>,
    /// Width and height in texels.
    size: [u32; 2],
    memory: Memory,
}

impl<'doc> TextureTable<'doc> {
    pub(super) fn new(resources: &'doc dyn Resources, alpha: Alpha) -> Self {
        Self {
            resources,
            alpha,
            ids: HashMap::new(),
            undefined: HashMap::new(),
            beyond: None,
            entries: Vec::new(),
            bytes_left: MAX_BYTES,
            held_left: MAX_HELD,
            starved: Ok(()),
            documents: Vec::new(),
        }
    }

    /// The bytes of an image that is a document.
    ///
    /// # Errors
    /// One line that says why they are not there.
    pub(super) fn document(&mut self, address: &str) -> Result<Vec<u8>, String> {
        let bytes = self.bytes(address.trim())?;
        self.bytes_left = self.bytes_left.saturating_sub(bytes.len() as u64);
        if !is_data(address) {
            let name = shorten(address.trim(), MAX_ADDRESS);
            self.documents.push((name, FileDigest::of(&bytes)));
        }
        Ok(bytes)
    }

    /// The texture at `address`, asked for at `location`; the same checker for all that are too many.
    pub(super) fn request(&mut self, address: impl Into<Cow<'doc, str>>, location: SourceLocation) -> TextureId {
        self.request_as((address.into(), None), location)
            .unwrap_or_else(|| self.beyond(location))
    }

    /// A checker for the texture that the document calls `name` and does not have; the `trouble` is told once.
    pub(super) fn undefined(
        &mut self,
        name: &'doc str,
        location: SourceLocation,
        trouble: impl FnOnce() -> String,
    ) -> TextureId {
        if let Some(&id) = self.undefined.get(name) {
            return id;
        }
        if self.entries.len() >= MAX_TEXTURES {
            return self.beyond(location);
        }
        let id = self.push(Entry {
            address: Cow::Borrowed(name),
            asks: None,
            location,
            file: Err(trouble()),
        });
        self.undefined.insert(name, id);
        id
    }

    /// The checker of all that are too many.
    fn beyond(&mut self, location: SourceLocation) -> TextureId {
        if let Some(id) = self.beyond {
            return id;
        }
        let id = self.push(Entry {
            address: Cow::Owned(format!("beyond the first {MAX_TEXTURES}")),
            asks: None,
            location,
            file: Err("a scene has no more textures than that; put several into one file".to_owned()),
        });
        self.beyond = Some(id);
        id
    }

    fn push(&mut self, entry: Entry<'doc>) -> TextureId {
        self.entries.push(entry);
        // Their number has a ceiling.
        TextureId(u32::try_from(self.entries.len() - 1).unwrap_or(u32::MAX))
    }

    /// The same texture, to be read by the nearest texel whatever the settings say; itself where there are too many.
    pub(super) fn pixelated(&mut self, id: TextureId) -> TextureId {
        let Some(entry) = self.entries.get(id.0 as usize) else {
            return id;
        };
        let (key, location) = ((entry.address.clone(), Some(PixelSampling::Nearest)), entry.location);
        self.request_as(key, location).unwrap_or(id)
    }

    fn request_as(&mut self, key: Key<'doc>, location: SourceLocation) -> Option<TextureId> {
        if let Some(&id) = self.ids.get(&key) {
            return Some(id);
        }
        if self.entries.len() >= MAX_TEXTURES {
            return None;
        }
        let (address, asks) = key.clone();
        let file = self.read(&address);
        let id = self.push(Entry {
            address,
            asks,
            location,
            file,
        });
        self.ids.insert(key, id);
        Some(id)
    }

    /// Width and height in texels, unless the texture is missing.
    pub(super) fn size(&self, id: TextureId) -> Option<[u32; 2]> {
        let entry = self.entries.get(id.0 as usize)?;
        entry.file.as_ref().ok().map(|file| file.size)
    }

    /// The addresses of the files that could be read, with their digests.
    pub(super) fn digests(&self) -> Vec<(String, FileDigest)> {
        // What is read in two ways is one file.
        let is_file = |entry: &&Entry<'_>| !is_data(&entry.address) && entry.asks.is_none();
        let files = self.entries.par_iter().filter(is_file);
        let digest = |entry: &Entry<'_>| {
            let file = entry.file.as_ref().ok()?;
            Some((shorten(entry.address.trim(), MAX_ADDRESS), FileDigest::of(&file.bytes)))
        };
        let textures: Vec<_> = files.filter_map(digest).collect();
        [textures, self.documents.clone()].concat()
    }

    /// Whether the system has room for everything that [`TextureTable::load`] decodes.
    ///
    /// # Errors
    /// When it does not, or when a file could not be read for that reason.
    pub(super) fn ask_for_room(&self) -> Result<(), OutOfMemory> {
        let images = || self.entries.iter().filter_map(|entry| entry.file.as_ref().ok());
        let held: u64 = images().map(|image| image.memory.held).sum();
        let passing: u64 = images().map(|image| image.memory.passing).sum();
        self.starved?;
        memory::ask_for(held.saturating_add(passing.min(MAX_PASSING)))
    }

    /// Decodes everything. What fails becomes the checker of [`Texture::missing`] and a warning.
    pub(super) fn load(self, report: &mut Report) -> Arc<[Arc<Texture>]> {
        let alpha = self.alpha;
        let (places, files): (Vec<_>, Vec<_>) = self
            .entries
            .into_iter()
            .map(|entry| ((name_of(&entry.address), entry.location, entry.asks), entry.file))
            .unzip();
        let mut textures = Vec::with_capacity(places.len());
        let mut places = places.into_iter();
        for batch in batches(files) {
            let named: Vec<_> = batch.into_iter().zip(places.by_ref()).collect();
            let decoded: Vec<_> = named
                .into_par_iter()
                .map(|(file, place)| {
                    let oddity = file.as_ref().ok().and_then(|file| oddity(&file.bytes));
                    let texture = file.and_then(|file| decode(&place.0, &file.bytes, alpha));
                    (texture, oddity, place)
                })
                .collect();
            for (result, oddity, (name, location, asks)) in decoded {
                // What is read in two ways is one file.
                if let Some(oddity) = oddity.filter(|_| asks.is_none() && result.is_ok()) {
                    report.warn(location, format!("texture {name}: {oddity}"));
                }
                let (texture, dropped) = result.unwrap_or_else(|trouble| {
                    report.warn(location, format!("texture {name}: {trouble}; a checker is drawn"));
                    (Texture::missing(&name), false)
                });
                if dropped {
                    let message = format!(
                        "texture {name}: its transparency has no effect; the dialect svg keeps it (--dialect svg)"
                    );
                    report.warn(location, message);
                }
                textures.push(Arc::new(texture.asking(asks)));
            }
        }
        textures.into()
    }

    /// The image, if it fits what is left of the ceilings.
    fn read(&mut self, address: &str) -> Result<EncodedImage, String> {
        let bytes = self.bytes(address.trim())?;
        let length = bytes.len() as u64;
        let fits = length <= self.bytes_left;
        // What turns out to be no image was read all the same.
        self.bytes_left = self.bytes_left.saturating_sub(length);
        if !fits {
            return Err(too_many_bytes());
        }
        let (width, height) = Texture::size_of_encoded(&bytes).map_err(|error| unreadable::told(&bytes, &error))?;
        let size = [width, height];
        let memory = Texture::memory_of_encoded(&bytes, size);
        if memory.passing > MAX_PASSING {
            return Err(format!(
                "to decode its {width} x {height} texels takes {} MB besides what they fill, and one image may take {} MB; \
                 make it smaller",
                megabytes(memory.passing),
                MAX_PASSING >> 20
            ));
        }
        let taken = length + memory.held;
        let Some(left) = self.held_left.checked_sub(taken) else {
            return Err(format!(
                "with its {width} x {height} texels the images of the scene would fill {} MB, and they may fill {} MB; make \
                 it smaller",
                megabytes(MAX_HELD - self.held_left + taken),
                MAX_HELD >> 20
            ));
        };
        self.held_left = left;
        Ok(EncodedImage { bytes, size, memory })
    }

    fn bytes(&mut self, address: &str) -> Result<Vec<u8>, String> {
        if !is_data(address) && is_elsewhere(address) {
            return Err(
                "network addresses are not fetched; save the file beside the document and name that".to_owned(),
            );
        }
        if self.bytes_left == 0 {
            return Err(too_many_bytes());
        }
        if is_data(address) {
            embedded(address)
        } else if address.is_empty() {
            Err("its <image> names no file; write href=\"FILE.png\" there".to_owned())
        } else {
            linked(address, self.resources).map_err(|error| {
                if error.is_of_memory() {
                    self.starved = Err(OutOfMemory { megabytes: 1 });
                }
                error.to_string()
            })
        }
    }
}

impl fmt::Debug for TextureTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list()
            .entries(self.entries.iter().map(|entry| name_of(&entry.address)))
            .finish()
    }
}

/// What is said where the files of images have no more room.
fn too_many_bytes() -> String {
    let most = MAX_BYTES >> 20;
    format!("the files of all images together have more than {most} MB; make them smaller")
}

/// Bytes in megabytes of 2^20, rounded up, so that what is too much never looks like enough.
const fn megabytes(bytes: u64) -> u64 {
    bytes.div_ceil(1 << 20)
}

/// A texture's name in messages and tool tips.
pub(super) fn name_of(address: &str) -> String {
    match address.trim() {
        "" => "without a name".to_owned(),
        data if is_data(data) => "in the document".to_owned(),
        address => quote(address),
    }
}

/// The images in their order, in groups that may be decoded at the same time.
fn batches(files: Vec<Result<EncodedImage, String>>) -> Vec<Vec<Result<EncodedImage, String>>> {
    let mut batches = Vec::new();
    let mut batch = Vec::new();
    let mut passing = 0;
    for file in files {
        let more = file.as_ref().map_or(0, |file| file.memory.passing);
        if passing + more > MAX_PASSING {
            batches.push(std::mem::take(&mut batch));
            passing = 0;
        }
        passing += more;
        batch.push(file);
    }
    batches.push(batch);
    batches
}

/// What is to be said of a file of which a picture is read.
fn oddity(file: &[u8]) -> Option<&'static str> {
    if is_cut_off(file) {
        Some("the file ends before its picture does, which is drawn as far as it goes; copy or save it again")
    } else if is_turned(file) {
        Some("Exif wants it turned or mirrored, which has no effect; save it as it shall lie")
    } else {
        None
    }
}

/// The texture, and whether it lost its transparency.
fn decode(name: &str, bytes: &[u8], alpha: Alpha) -> Result<(Texture, bool), String> {
    let texture = match alpha {
        Alpha::Keep => Texture::decode(name, bytes).map(|texture| (texture, false)),
        Alpha::Drop => Texture::decode_opaque(name, bytes),
    };
    texture.map_err(|error| unreadable::told(bytes, &error))
}

pub(super) fn is_data(address: &str) -> bool {
    address
        .trim_start()
        .get(..5)
        .is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// Whether an address, as written or decoded, names something on another machine: by a scheme, or as a share of one.
fn is_elsewhere(address: &str) -> bool {
    let is_share = |path: &str| path.starts_with("//") || path.starts_with("\\\\");
    let decoded = percent_decoded(address);
    [address, &decoded]
        .into_iter()
        .any(|address| match address.split_once("://") {
            Some((scheme, path)) if scheme.eq_ignore_ascii_case("file") => is_share(path),
            Some((scheme, _)) => !scheme.is_empty() && scheme.bytes().all(|byte| byte.is_ascii_alphanumeric()),
            None => is_share(address),
        })
}

/// The bytes in a `data:` address.
pub(super) fn embedded(address: &str) -> Result<Vec<u8>, String> {
    let url = DataUrl::process(address).map_err(|_| "this is not a data: address".to_owned())?;
    let (bytes, _) = url
        .decode_to_vec()
        .map_err(|_| "the base64 text is damaged".to_owned())?;
    Ok(bytes)
}

/// The bytes of a file, under the name as it stands or with its `%20`s and `file://` resolved.
fn linked(address: &str, resources: &dyn Resources) -> Result<Vec<u8>, ResourceError> {
    let as_written = resources.read(address);
    if let Err(ResourceError::NotFound) = as_written {
        let resolved = resolved(address);
        if resolved != address {
            return resources.read(&resolved);
        }
    }
    as_written
}

/// The path that an address means where nothing has its name as it stands: without `file://`, with its `%20`s resolved.
pub(super) fn resolved(address: &str) -> String {
    percent_decoded(address.strip_prefix("file://").unwrap_or(address))
}

/// `%20` and the like as the bytes that they stand for; what is no such thing stays.
fn percent_decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        let code = after.get(..2).and_then(|hex| std::str::from_utf8(hex).ok());
        let code = code
            .and_then(|hex| u8::from_str_radix(hex, 16).ok())
            .filter(|_| *first == b'%');
        if let Some(byte) = code {
            bytes.push(byte);
            rest = &after[2..];
        } else {
            bytes.push(*first);
            rest = after;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::NoResources;

    const HERE: SourceLocation = SourceLocation { line: 1, column: 2 };

    /// Warnings of a table with these addresses.
    fn warnings(addresses: &[&'static str]) -> Vec<String> {
        let mut table = TextureTable::new(&NoResources, Alpha::Keep);
        for address in addresses {
            table.request(*address, HERE);
        }
        let mut report = Report::default();
        assert_eq!(
            table.load(&mut report).len(),
            addresses.len(),
            "one texture per address"
        );
        report.lines().collect()
    }

    #[test]
    fn texture_table_asks_once_per_address() {
        let mut table = TextureTable::new(&NoResources, Alpha::Keep);
        let first = table.request("a.png", HERE);
        assert_eq!(table.request("a.png", HERE), first, "the same");
        assert_ne!(table.request("b.png", HERE), first, "another file");
    }

    #[test]
    fn texture_table_warns_in_one_line_each() {
        let lines = warnings(&[
            "no.png",
            "http://x/y.png",
            "data:image/png;base64,@@@",
            "data:nothing",
            "",
            "data:,x",
        ]);
        assert_eq!(lines.len(), 6, "{lines:?}");
        assert_eq!(
            lines[0], "1:2: texture no.png: there is no such file; a checker is drawn",
            "missing"
        );
        assert!(lines[1].contains("not fetched"), "{}", lines[1]);
        assert!(lines.iter().all(|line| !line.contains('\n')), "{lines:?}");
    }

    #[test]
    fn texture_table_has_one_checker_for_all_that_are_too_many() {
        let mut table = TextureTable::new(&NoResources, Alpha::Keep);
        for i in 0..MAX_TEXTURES {
            table.request(i.to_string(), HERE);
        }
        let beyond = table.request("one more", HERE);
        assert_eq!(table.request("and one", HERE), beyond, "the same");
        assert_eq!(table.undefined("t", HERE, String::new), beyond, "without a name, too");
        assert_eq!(table.pixelated(beyond), beyond, "however it is read");
        let mut report = Report::default();
        assert_eq!(table.load(&mut report).len(), MAX_TEXTURES + 1, "one more");
        assert_eq!(
            report.unlisted, 3997,
            "each that is missing, and those that are too many once"
        );
    }

    #[test]
    fn texture_table_tells_once_of_each_that_is_not_there() {
        let mut table = TextureTable::new(&NoResources, Alpha::Keep);
        let first = table.undefined("t", HERE, || "told".to_owned());
        assert_eq!(table.undefined("t", HERE, || panic!("known")), first, "the same");
        assert_ne!(table.undefined("u", HERE, || "told".to_owned()), first, "another");
        assert_ne!(table.request("t", HERE), first, "a file of that name is none");
        let mut report = Report::default();
        let textures = table.load(&mut report);
        assert_eq!(textures[0].name, "t", "its name");
        let lines: Vec<String> = report.lines().collect();
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert_eq!(lines[0], "1:2: texture t: told; a checker is drawn");
    }

    /// Every name is a PNG of so many texels a side, of which only the header is there.
    struct Headers(u32);

    impl Resources for Headers {
        fn read(&self, _address: &str) -> Result<Vec<u8>, ResourceError> {
            let side = self.0.to_be_bytes();
            let mut header = [b"IHDR", &side, &side, b"\x10\x06\0\0\0".as_slice()].concat();
            let rest = header.iter().fold(u32::MAX, |rest, byte| {
                (0..8).fold(rest ^ u32::from(*byte), |rest, _| {
                    if rest & 1 == 1 {
                        (rest >> 1) ^ 0xEDB8_8320
                    } else {
                        rest >> 1
                    }
                })
            });
            header.extend((!rest).to_be_bytes());
            Ok([b"\x89PNG\r\n\x1a\n\0\0\0\x0d".as_slice(), &header].concat())
        }
    }

    #[test]
    fn texture_table_counts_all_images_together_before_it_decodes() {
        let headers = Headers(8192);
        let mut table = TextureTable::new(&headers, Alpha::Keep);
        let names: Vec<String> = (0..16).map(|i| format!("{}a.png", "./".repeat(i))).collect();
        let names: &'static [String] = names.leak();
        let sizes: Vec<_> = names
            .iter()
            .map(|name| {
                let id = table.request(name, HERE);
                table.size(id)
            })
            .collect();
        let fit = sizes.iter().flatten().count();
        assert_eq!(fit, 3, "358 MB each, of 1200");
        assert!(sizes[..3].iter().all(Option::is_some), "the first ones: {sizes:?}");
        let refusals: Vec<&String> = table
            .entries
            .iter()
            .filter_map(|entry| entry.file.as_ref().err())
            .collect();
        assert_eq!(refusals.len(), 13, "the others are refused");
        assert!(
            refusals[0].contains("8192 x 8192 texels")
                && refusals[0].contains("fill 1366 MB, and they may fill 1200 MB"),
            "{}",
            refusals[0]
        );
        let together = table.entries.iter().filter_map(|entry| entry.file.as_ref().ok());
        let passing: u64 = together.map(|file| file.memory.passing).sum();
        let files = table.entries.into_iter().map(|entry| entry.file).collect();
        assert!(passing > MAX_PASSING, "all at once would be too much: {passing}");
        assert_eq!(batches(files).len(), 3, "one after the other");
    }

    #[test]
    fn texture_table_tells_what_a_single_image_takes_too_much_of() {
        for (side, words) in [
            (
                11_500,
                "takes 631 MB besides what they fill, and one image may take 600 MB",
            ),
            (16_384, "takes 1280 MB besides"),
            (16_385, "more than 16384 a side"),
        ] {
            let headers = Headers(side);
            let mut table = TextureTable::new(&headers, Alpha::Keep);
            table.request("a.png", HERE);
            let told = table.entries[0].file.as_ref().expect_err("too large");
            assert!(
                told.contains(words) && told.ends_with("make it smaller"),
                "{side}: {told}"
            );
        }
        let headers = Headers(11_100);
        let mut table = TextureTable::new(&headers, Alpha::Keep);
        let id = table.request("a.png", HERE);
        assert_eq!(table.size(id), Some([11_100; 2]), "one that fits");
    }

    /// Names of a file that is large and no image.
    struct Junk(std::sync::atomic::AtomicU64);

    impl Resources for Junk {
        fn read(&self, _address: &str) -> Result<Vec<u8>, ResourceError> {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            Ok(vec![b'x'; 200 << 20])
        }
    }

    #[test]
    fn texture_table_reads_no_more_than_it_may_keep() {
        let junk = Junk(0.into());
        let mut table = TextureTable::new(&junk, Alpha::Keep);
        for name in ["a", "b", "c", "d", "e", "f"] {
            table.request(name, HERE);
        }
        assert_eq!(junk.0.into_inner(), 3, "600 MB of names is enough");
    }

    #[test]
    fn percent_decoded_only_codes() {
        assert_eq!(percent_decoded("my%20map%2.png%"), "my map%2.png%", "whole codes only");
        assert_eq!(percent_decoded("%C3%A9"), "\u{e9}", "UTF-8");
    }
}
