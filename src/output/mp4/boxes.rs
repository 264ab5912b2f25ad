//! Whether a film is whole, by the boxes that it is made of (ISO/IEC 14496-12, 4.2).

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

/// Boxes that a film with something in it has: what it is, where its frames are, the frames.
const NEEDED: [[u8; 4]; 3] = [*b"ftyp", *b"moov", *b"mdat"];

/// Whether the file is a row of boxes that ends where the last of them does, all needed ones among
/// them.
pub(super) fn is_whole(path: &Path) -> io::Result<bool> {
    let mut file = File::open(path)?;
    let len = file.metadata()?.len();
    let mut found = [false; NEEDED.len()];
    let mut at = 0;
    while at < len {
        let mut head = [0; 16];
        file.seek(SeekFrom::Start(at))?;
        let head_len = (len - at).min(16) as usize;
        if head_len < 8 {
            return Ok(false);
        }
        file.read_exact(&mut head[..head_len])?;
        let [s0, s1, s2, s3, kind @ .., _, _, _, _, _, _, _, _] = head;
        let size = match u32::from_be_bytes([s0, s1, s2, s3]) {
            // To the end of the file.
            0 => len - at,
            // In the eight bytes after the kind.
            1 if head_len == 16 => {
                let (_, long) = head.split_at(8);
                u64::from_be_bytes(long.try_into().unwrap_or_default())
            }
            size => u64::from(size),
        };
        if size < 8 {
            return Ok(false);
        }
        for (needed, found) in NEEDED.iter().zip(&mut found) {
            *found |= *needed == kind;
        }
        at = at.saturating_add(size);
    }
    Ok(at == len && found == [true; NEEDED.len()])
}
