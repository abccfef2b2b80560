//! The textures a document refers to: each address once, read and decoded in parallel, within a budget of texels.

use std::collections::HashMap;
use std::sync::Arc;

use data_url::DataUrl;
use rayon::prelude::*;

use super::report::{quote, shorten};
use super::{Report, ResourceError, Resources, SourceLocation, TextureId};
use crate::texture::Texture;

/// Most texels of all textures of a scene: with pyramids 1.4 GB.
const MAX_TEXELS: u64 = 1 << 28;
/// Most bytes of all encoded images of a scene.
const MAX_BYTES: u64 = 512 << 20;
/// Most characters of the decoder's own message.
const MAX_MESSAGE: usize = 160;
/// Most different textures of a scene.
const MAX_TEXTURES: usize = 4_096;
/// Schemes of addresses elsewhere, which are never fetched.
const REMOTE: [&str; 4] = ["http:", "https:", "ftp:", "//"];

/// What the document refers to so far.
#[derive(Debug, Default)]
pub(super) struct TextureTable<'doc> {
    ids: HashMap<(&'doc str, Alpha), TextureId>,
    requests: Vec<Request<'doc>>,
}

/// Whether a texture's transparency counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Alpha {
    /// As SVG has it.
    Keep,
    /// The course's reader forgets it.
    Drop,
}

/// One texture to be read.
#[derive(Debug)]
struct Request<'doc> {
    address: &'doc str,
    alpha: Alpha,
    /// Where it is first asked for.
    location: SourceLocation,
}

impl<'doc> TextureTable<'doc> {
    /// The texture at `address`, asked for at `location`. `None` when there are too many.
    pub(super) fn request(&mut self, address: &'doc str, alpha: Alpha, location: SourceLocation) -> Option<TextureId> {
        if let Some(&id) = self.ids.get(&(address, alpha)) {
            return Some(id);
        }
        if self.requests.len() >= MAX_TEXTURES {
            return None;
        }
        let id = TextureId(u32::try_from(self.requests.len()).ok()?);
        self.ids.insert((address, alpha), id);
        self.requests.push(Request {
            address,
            alpha,
            location,
        });
        Some(id)
    }

    /// Reads and decodes everything. What fails becomes the checker of [`Texture::missing`] and a warning.
    ///
    /// Files are read in document order, so that the budget falls on the same textures in every run; decoding, which
    /// takes the time, is parallel.
    pub(super) fn load(self, resources: &dyn Resources, report: &mut Report) -> Vec<Arc<Texture>> {
        let mut budget = Budget {
            bytes: MAX_BYTES,
            texels: MAX_TEXELS,
        };
        let files: Vec<_> = self
            .requests
            .iter()
            .map(|request| request.read(resources, &mut budget))
            .collect();
        let results: Vec<Result<Texture, String>> = files
            .into_par_iter()
            .zip(&self.requests)
            .map(|(file, request)| request.decode(&file?))
            .collect();
        let mut textures = Vec::with_capacity(results.len());
        for (result, request) in results.into_iter().zip(&self.requests) {
            let texture = result.unwrap_or_else(|trouble| {
                let name = request.name();
                report.warn(
                    request.location,
                    format!("texture {name}: {trouble}; a checker is drawn"),
                );
                Texture::missing(&name)
            });
            textures.push(Arc::new(texture));
        }
        textures
    }
}

/// What the textures not yet read may still take.
#[derive(Debug)]
struct Budget {
    bytes: u64,
    texels: u64,
}

impl Request<'_> {
    /// For messages and tool tips.
    fn name(&self) -> String {
        match self.address {
            "" => "without a name".to_owned(),
            data if is_data(data) => "in the document".to_owned(),
            address => quote(address),
        }
    }

    /// The bytes of the image, if they fit the budget.
    fn read(&self, resources: &dyn Resources, budget: &mut Budget) -> Result<Vec<u8>, String> {
        let address = self.address.trim();
        let lower = address.get(..8.min(address.len())).unwrap_or("").to_ascii_lowercase();
        if REMOTE.iter().any(|scheme| lower.starts_with(scheme)) {
            return Err("addresses in the net are not fetched".to_owned());
        }
        let bytes = if is_data(address) {
            embedded(address)?
        } else if address.is_empty() {
            return Err("nothing defines it".to_owned());
        } else {
            linked(address, resources)?
        };
        let (width, height) =
            Texture::size_of_encoded(&bytes).map_err(|error| shorten(&error.to_string(), MAX_MESSAGE))?;
        let texels = u64::from(width) * u64::from(height);
        let left = (
            budget.bytes.checked_sub(bytes.len() as u64),
            budget.texels.checked_sub(texels),
        );
        let (Some(bytes_left), Some(texels_left)) = left else {
            return Err(format!(
                "with {width} x {height} texels the scene's textures are too large together"
            ));
        };
        (budget.bytes, budget.texels) = (bytes_left, texels_left);
        Ok(bytes)
    }

    fn decode(&self, bytes: &[u8]) -> Result<Texture, String> {
        let name = self.name();
        let texture = match self.alpha {
            Alpha::Keep => Texture::decode(&name, bytes),
            Alpha::Drop => Texture::decode_opaque(&name, bytes),
        };
        texture.map_err(|error| shorten(&error.to_string(), MAX_MESSAGE))
    }
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
        let mut table = TextureTable::default();
        for address in addresses {
            table.request(address, Alpha::Keep, HERE).expect("few");
        }
        let mut report = Report::default();
        let textures = table.load(&NoResources, &mut report);
        assert!(textures.len() <= addresses.len(), "one texture per address");
        report.lines().collect()
    }

    #[test]
    fn texture_table_asks_once_per_address() {
        let mut table = TextureTable::default();
        let first = table.request("a.png", Alpha::Keep, HERE);
        assert_eq!(table.request("a.png", Alpha::Keep, HERE), first, "the same");
        assert_ne!(table.request("a.png", Alpha::Drop, HERE), first, "other texels");
        assert_ne!(table.request("b.png", Alpha::Keep, HERE), first, "another file");
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
