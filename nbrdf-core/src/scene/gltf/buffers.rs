//! The bytes that a glTF file's numbers are in.

use std::path::{Component, Path};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::{Accessor, Document};

use super::super::SceneProblem;
use super::super::obj::MAX_BYTES;
use crate::bounded;

/// Where other files may be.
#[derive(Clone, Copy)]
pub(super) enum Beside<'a> {
    /// In this folder, or below.
    Folder(&'a Path),
    /// Nowhere.
    Nothing,
}

/// All buffers of a file.
pub(super) struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    /// Those within the file, and those beside it.
    pub fn read(document: &Document, blob: Option<Vec<u8>>, beside: Beside) -> Result<Self, SceneProblem> {
        let (mut blob, mut left) = (blob, MAX_BYTES);
        let mut buffers = Vec::new();
        for buffer in document.buffers() {
            let bytes = match buffer.source() {
                Source::Bin => blob.take().ok_or_else(|| SceneProblem::mesh("a buffer in the file", "none"))?,
                Source::Uri(uri) => match uri.strip_prefix("data:") {
                    Some(data) => within(data)?,
                    None => outside(uri, beside, left)?,
                },
            };
            left = left.saturating_sub(bytes.len() as u64);
            buffers.push(bytes);
        }
        Ok(Self(buffers))
    }

    /// The bytes of each element of an accessor, which must be of one of these kinds.
    pub fn elements(
        &self,
        accessor: &Accessor,
        kinds: &[(DataType, Dimensions)],
    ) -> Result<impl Iterator<Item = &[u8]>, SceneProblem> {
        let own = (accessor.data_type(), accessor.dimensions());
        if !kinds.contains(&own) {
            return Err(SceneProblem::mesh(format!("an accessor of {kinds:?}"), format!("{own:?}")));
        }
        let Some(view) = accessor.view().filter(|_| accessor.sparse().is_none()) else {
            return Err(SceneProblem::mesh("dense accessors", "a sparse one"));
        };
        let (size, count) = (accessor.size(), accessor.count());
        let stride = view.stride().unwrap_or(size);
        let end = view.offset().checked_add(view.length());
        let bytes =
            end.and_then(|end| self.0.get(view.buffer().index())?.get(view.offset()..end)?.get(accessor.offset()..));
        let needed = count.saturating_sub(1).checked_mul(stride).and_then(|last| last.checked_add(size));
        match bytes {
            Some(bytes) if stride >= size && needed.is_some_and(|needed| needed <= bytes.len()) => {
                Ok((0..count).map(move |place| &bytes[place * stride..place * stride + size]))
            }
            _ => {
                let found = format!("{count} elements of {size} bytes, {stride} apart, at {}", accessor.offset());
                Err(SceneProblem::mesh("accessors within their buffers", found))
            }
        }
    }
}

/// After `data:`.
fn within(data: &str) -> Result<Vec<u8>, SceneProblem> {
    let text = data.split_once(";base64,").map(|(_, text)| text);
    let text = text.ok_or_else(|| SceneProblem::mesh("buffers in base64", "another encoding"))?;
    STANDARD.decode(text).map_err(|error| SceneProblem::mesh("buffers in base64", error))
}

/// Only what lies beside the file: nobody who opens a mesh means to read anything else.
fn outside(uri: &str, beside: Beside, limit: u64) -> Result<Vec<u8>, SceneProblem> {
    let name = decoded(uri).ok_or_else(|| SceneProblem::mesh("names of buffers as percent-encoded text", uri))?;
    let is_below = Path::new(&name).components().all(|part| matches!(part, Component::Normal(_)));
    let Beside::Folder(folder) = beside else {
        return Err(SceneProblem::mesh("buffers within the file", format!("one in '{name}'")));
    };
    if !is_below || name.is_empty() {
        return Err(SceneProblem::mesh("buffers beside the file", format!("one in '{name}'")));
    }
    let refused = |found: String| SceneProblem::mesh(format!("its buffer '{name}' beside it"), found);
    let bytes = bounded::read(&folder.join(&name), limit).map_err(|error| refused(error.to_string()))?;
    bytes.ok_or_else(|| refused(format!("more than {limit} bytes")))
}

/// Percent signs and two digits as the bytes that they stand for.
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = uri.bytes();
    let mut plain = Vec::new();
    while let Some(byte) = bytes.next() {
        plain.push(match byte {
            b'%' => {
                let mut digit = || char::from(bytes.next()?).to_digit(16).and_then(|digit| u8::try_from(digit).ok());
                16 * digit()? + digit()?
            }
            byte => byte,
        });
    }
    String::from_utf8(plain).ok()
}
