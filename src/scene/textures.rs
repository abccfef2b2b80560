//! The textures a document refers to: each address once, read and decoded in parallel, within a budget of texels.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use data_url::DataUrl;
use rayon::prelude::*;

use super::report::{quote, shorten};
use super::{FileDigest, Report, ResourceError, Resources, SourceLocation, TextureId};
use crate::texture::{DecodeError, Texture};

/// Most texels of all textures of a scene: with pyramids 1.4 GB.
const MAX_TEXELS: u64 = 1 << 28;
/// Most bytes of all encoded images of a scene.
const MAX_BYTES: u64 = 512 << 20;
/// Most characters of the decoder's own message.
const MAX_MESSAGE: usize = 160;
/// Most characters of an address that is kept with its digest.
const MAX_ADDRESS: usize = 400;
/// Most different textures of a scene.
const MAX_TEXTURES: usize = 4_096;
/// Schemes of addresses elsewhere, which are never fetched.
const REMOTE: [&str; 4] = ["http:", "https:", "ftp:", "//"];

/// The textures that the document refers to so far: read as they are asked for, decoded all together in the end.
pub(super) struct TextureTable<'doc> {
    resources: &'doc dyn Resources,
    alpha: Alpha,
    ids: HashMap<&'doc str, TextureId>,
    entries: Vec<Entry<'doc>>,
    bytes_left: u64,
    texels_left: u64,
}

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
    address: &'doc str,
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
}

impl<'doc> TextureTable<'doc> {
    pub(super) fn new(resources: &'doc dyn Resources, alpha: Alpha) -> Self {
        Self {
            resources,
            alpha,
            ids: HashMap::new(),
            entries: Vec::new(),
            bytes_left: MAX_BYTES,
            texels_left: MAX_TEXELS,
        }
    }

    /// The texture at `address`, asked for at `location`. `None` when there are too many.
    pub(super) fn request(&mut self, address: &'doc str, location: SourceLocation) -> Option<TextureId> {
        if let Some(&id) = self.ids.get(address) {
            return Some(id);
        }
        if self.entries.len() >= MAX_TEXTURES {
            return None;
        }
        let id = TextureId(u32::try_from(self.entries.len()).ok()?);
        let file = self.read(address);
        self.ids.insert(address, id);
        self.entries.push(Entry {
            address,
            location,
            file,
        });
        Some(id)
    }

    /// Width and height in texels, unless the texture is missing.
    pub(super) fn size(&self, id: TextureId) -> Option<[u32; 2]> {
        let entry = self.entries.get(id.0 as usize)?;
        entry.file.as_ref().ok().map(|file| file.size)
    }

    /// The addresses of the files that could be read, with their digests.
    pub(super) fn digests(&self) -> Vec<(String, FileDigest)> {
        let files = self.entries.par_iter().filter(|entry| !is_data(entry.address));
        let digest = |entry: &Entry<'_>| {
            let file = entry.file.as_ref().ok()?;
            Some((shorten(entry.address.trim(), MAX_ADDRESS), FileDigest::of(&file.bytes)))
        };
        files.filter_map(digest).collect()
    }

    /// Decodes everything. What fails becomes the checker of [`Texture::missing`] and a warning.
    pub(super) fn load(self, report: &mut Report) -> Vec<Arc<Texture>> {
        let alpha = self.alpha;
        let (places, files): (Vec<_>, Vec<_>) = self
            .entries
            .into_iter()
            .map(|entry| ((name_of(entry.address), entry.location), entry.file))
            .unzip();
        let results: Vec<Result<Texture, String>> = files
            .into_par_iter()
            .zip(&places)
            .map(|(file, (name, _))| decode(name, &file?.bytes, alpha))
            .collect();
        let named = results.into_iter().zip(places);
        let texture = |(result, (name, location)): (Result<Texture, String>, (String, _))| {
            Arc::new(result.unwrap_or_else(|trouble| {
                report.warn(location, format!("texture {name}: {trouble}; a checker is drawn"));
                Texture::missing(&name)
            }))
        };
        named.map(texture).collect()
    }

    /// The bytes of the image, if they fit what is left of the ceilings.
    fn read(&mut self, address: &str) -> Result<EncodedImage, String> {
        let address = address.trim();
        let scheme = address.get(..8.min(address.len())).unwrap_or("").to_ascii_lowercase();
        if REMOTE.iter().any(|remote| scheme.starts_with(remote)) {
            return Err("addresses in the net are not fetched".to_owned());
        }
        let bytes = if is_data(address) {
            embedded(address)?
        } else if address.is_empty() {
            return Err("nothing says which file it is".to_owned());
        } else {
            linked(address, self.resources)?
        };
        let (width, height) = Texture::size_of_encoded(&bytes).map_err(explain)?;
        let texels = u64::from(width) * u64::from(height);
        let bytes_left = self.bytes_left.checked_sub(bytes.len() as u64);
        let (Some(bytes_left), Some(texels_left)) = (bytes_left, self.texels_left.checked_sub(texels)) else {
            return Err(format!(
                "with its {width} x {height} texels the scene's textures are too large"
            ));
        };
        (self.bytes_left, self.texels_left) = (bytes_left, texels_left);
        let size = [width, height];
        Ok(EncodedImage { bytes, size })
    }
}

impl fmt::Debug for TextureTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list()
            .entries(self.entries.iter().map(|entry| name_of(entry.address)))
            .finish()
    }
}

/// A texture's name in messages and tool tips.
fn name_of(address: &str) -> String {
    match address.trim() {
        "" => "without a name".to_owned(),
        data if is_data(data) => "in the document".to_owned(),
        address => quote(address),
    }
}

fn decode(name: &str, bytes: &[u8], alpha: Alpha) -> Result<Texture, String> {
    let texture = match alpha {
        Alpha::Keep => Texture::decode(name, bytes),
        Alpha::Drop => Texture::decode_opaque(name, bytes),
    };
    texture.map_err(explain)
}

#[expect(clippy::needless_pass_by_value, reason = "shaped for map_err")]
fn explain(error: DecodeError) -> String {
    shorten(&error.to_string(), MAX_MESSAGE)
}

fn is_data(address: &str) -> bool {
    address
        .trim_start()
        .get(..5)
        .is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// The bytes in a `data:` address.
fn embedded(address: &str) -> Result<Vec<u8>, String> {
    let url = DataUrl::process(address).map_err(|_| "this is no data: address".to_owned())?;
    let (bytes, _) = url
        .decode_to_vec()
        .map_err(|_| "the base64 text is damaged".to_owned())?;
    Ok(bytes)
}

/// The bytes of a file, under the name as it stands or with its `%20`s and `file://` resolved.
fn linked(address: &str, resources: &dyn Resources) -> Result<Vec<u8>, String> {
    let as_written = resources.read(address);
    if let Err(ResourceError::NotFound) = as_written {
        let path = address.strip_prefix("file://").unwrap_or(address);
        let decoded = percent_decoded(path);
        if decoded != address {
            return resources.read(&decoded).map_err(|error| error.to_string());
        }
    }
    as_written.map_err(|error| error.to_string())
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
            table.request(address, HERE).expect("few");
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
    fn percent_decoded_only_codes() {
        assert_eq!(percent_decoded("my%20map%2.png%"), "my map%2.png%", "whole codes only");
        assert_eq!(percent_decoded("%C3%A9"), "\u{e9}", "UTF-8");
    }
}
