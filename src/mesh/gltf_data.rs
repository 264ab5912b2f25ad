//! The bytes of a glTF's buffers, and the numbers in them, each held against what is there.

use std::collections::HashMap;

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;

use super::build::too_many;
use super::error::MeshError;
use super::{Fetch, MOST_TRIANGLES};

/// Buffers that have been needed up to now.
pub(super) struct Buffers<'a> {
    binary: Option<&'a [u8]>,
    fetched: HashMap<usize, Vec<u8>>,
    /// Bytes that may still be fetched.
    left: u64,
}

impl<'a> Buffers<'a> {
    /// None yet; `binary` is the chunk of a GLB, and no more than `most` bytes will be fetched.
    pub(super) fn new(binary: Option<&'a [u8]>, most: u64) -> Self {
        Self {
            binary,
            fetched: HashMap::new(),
            left: most,
        }
    }

    /// The bytes of a view.
    fn view(&mut self, view: &gltf::buffer::View, fetch: &mut Fetch) -> Result<&[u8], MeshError> {
        let buffer = view.buffer();
        let index = buffer.index();
        let place = || format!("buffers[{index}]");
        let bytes = match buffer.source() {
            Source::Bin => self.binary.ok_or_else(|| {
                let what = format!("buffer {index} has no uri");
                MeshError::new(what, "one, or a GLB with a chunk of bytes").within(place)
            })?,
            Source::Uri(uri) => {
                if !self.fetched.contains_key(&index) {
                    let bytes = fetched(uri, fetch).map_err(|error| error.within(place))?;
                    let left = self.left.checked_sub(bytes.len() as u64);
                    self.left = left.ok_or_else(|| MeshError::too_long().within(place))?;
                    self.fetched.insert(index, bytes);
                }
                &self.fetched[&index]
            }
        };
        let end = view.offset().checked_add(view.length());
        let found = end.and_then(|end| bytes.get(view.offset()..end));
        found.ok_or_else(|| {
            let (from, length) = (view.offset(), view.length());
            let what = format!(
                "view {} is {length} bytes from byte {from} of buffer {index}, which has {}",
                view.index(),
                bytes.len()
            );
            let place = || format!("bufferViews[{}]", view.index());
            MeshError::new(what, "views within their buffers").within(place)
        })
    }
}

/// What a URI of a buffer stands for.
fn fetched(uri: &str, fetch: &mut Fetch) -> Result<Vec<u8>, MeshError> {
    let Some(data) = uri.strip_prefix("data:") else {
        if uri.contains("://") {
            let shown: String = uri.chars().take(80).collect();
            let what = format!("a buffer is at {shown}");
            return Err(MeshError::new(what, "a file, named relative to this one"));
        }
        return fetch(&unescaped(uri));
    };
    let wrong = || {
        let what = "a buffer's `data:` uri is no base64";
        MeshError::new(what, "`data:application/octet-stream;base64,…`")
    };
    let encoded = data.split_once(";base64,").ok_or_else(wrong)?.1;
    let mut bytes = Vec::new();
    let room = encoded.len() / 4 * 3 + 3;
    let reserved = bytes.try_reserve_exact(room);
    reserved.map_err(|_| MeshError::no_memory(room as u64, "bytes of a buffer"))?;
    decode(encoded, &mut bytes).ok_or_else(wrong)?;
    Ok(bytes)
}

/// A path whose spaces and other characters stand as %20 and so on.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, more @ ..] = rest {
        let code = match first {
            b'%' => std::str::from_utf8(more.get(..2).unwrap_or_default())
                .ok()
                .filter(|digits| digits.bytes().all(|it| it.is_ascii_hexdigit()))
                .and_then(|digits| u8::from_str_radix(digits, 16).ok()),
            _ => None,
        };
        bytes.push(code.unwrap_or(*first));
        rest = if code.is_some() { &more[2..] } else { more };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Appends what base64 stands for (RFC 4648, section 4); `None` where it is none.
fn decode(text: &str, bytes: &mut Vec<u8>) -> Option<()> {
    let text = text.trim_end_matches('=').as_bytes();
    let value = |digit: u8| {
        Some(u32::from(match digit {
            b'A'..=b'Z' => digit - b'A',
            b'a'..=b'z' => digit - b'a' + 26,
            b'0'..=b'9' => digit - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        }))
    };
    for four in text.chunks(4) {
        let mut word = 0;
        for digit in four {
            word = word << 6 | value(*digit)?;
        }
        match four.len() {
            4 => bytes.extend(&word.to_be_bytes()[1..]),
            3 => bytes.extend(&(word << 6).to_be_bytes()[1..3]),
            2 => bytes.push((word >> 4) as u8),
            _ => return None,
        }
    }
    Some(())
}

/// The items of an accessor, each of `size` bytes.
fn items<'a>(
    accessor: &Accessor,
    size: usize,
    buffers: &'a mut Buffers,
    fetch: &mut Fetch,
) -> Result<impl Iterator<Item = &'a [u8]>, MeshError> {
    let index = accessor.index();
    let refuse = |why: &str, help: &str| {
        let error = MeshError::new(format!("accessor {index} {why}"), help);
        error.within(|| format!("accessors[{index}]"))
    };
    if accessor.sparse().is_some() {
        return Err(refuse(
            "is sparse",
            "one that is not, as most programs write",
        ));
    }
    let Some(view) = accessor.view() else {
        return Err(refuse(
            "has no buffer view",
            "one with its numbers in a buffer",
        ));
    };
    let stride = view.stride().unwrap_or(size).max(1);
    let bytes = buffers.view(&view, fetch)?;
    let count = accessor.count();
    let needed = count
        .checked_sub(1)
        .map_or(Some(0), |before| {
            before.checked_mul(stride)?.checked_add(size)
        })
        .and_then(|needed| needed.checked_add(accessor.offset()));
    if needed.is_none_or(|needed| needed > bytes.len()) {
        let why = format!("has {count} items, which its view has not room for");
        return Err(refuse(&why, "as many items as there are bytes for"));
    }
    let from = accessor.offset();
    Ok((0..count).map(move |at| &bytes[from + at * stride..][..size]))
}

/// The places in an accessor.
pub(super) fn places(
    accessor: &Accessor,
    buffers: &mut Buffers,
    fetch: &mut Fetch,
) -> Result<impl Iterator<Item = [f32; 3]>, MeshError> {
    let form = (accessor.data_type(), accessor.dimensions());
    if form != (DataType::F32, Dimensions::Vec3) {
        let what = format!("accessor {} of positions is of {form:?}", accessor.index());
        let place = || format!("accessors[{}]", accessor.index());
        return Err(MeshError::new(what, "VEC3 of FLOAT").within(place));
    }
    let number = |bytes: &[u8], at: usize| {
        let four = bytes.get(4 * at..).and_then(|it| it.first_chunk());
        f32::from_le_bytes(four.copied().unwrap_or_default())
    };
    let all = items(accessor, 12, buffers, fetch)?;
    Ok(all.map(move |item| [0, 1, 2].map(|at| number(item, at))))
}

/// The indices in an accessor.
pub(super) fn indices(
    accessor: &Accessor,
    buffers: &mut Buffers,
    fetch: &mut Fetch,
) -> Result<Vec<u32>, MeshError> {
    let place = || format!("accessors[{}]", accessor.index());
    let size = match (accessor.data_type(), accessor.dimensions()) {
        (DataType::U8, Dimensions::Scalar) => 1,
        (DataType::U16, Dimensions::Scalar) => 2,
        (DataType::U32, Dimensions::Scalar) => 4,
        form => {
            let what = format!("accessor {} of indices is of {form:?}", accessor.index());
            return Err(MeshError::new(what, "SCALAR of an unsigned type").within(place));
        }
    };
    if accessor.count() > 3 * MOST_TRIANGLES {
        return Err(too_many().within(place));
    }
    let number = |item: &[u8]| {
        let low_first = item.iter().rev();
        low_first.fold(0, |sum, byte| sum << 8 | u32::from(*byte))
    };
    let mut indices = Vec::new();
    // As many as there are bytes for, once the items are found.
    let items = items(accessor, size, buffers, fetch)?;
    let reserved = indices.try_reserve_exact(accessor.count());
    reserved.map_err(|_| MeshError::no_memory(accessor.count() as u64, "indices"))?;
    indices.extend(items.map(number));
    Ok(indices)
}
