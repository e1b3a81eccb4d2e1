//! The file of a piece.
//!
//! # Format of a piece
//! All numbers little-endian: the eight letters `saltuspc`; format version (u32); CRC-32 of the manifest's
//! fingerprint (u32); number of the piece (u32); CRC-32 of the 20 bytes so far and the content (u32);
//! length of the content (u64); the content. CRC-32 is that of PNG and zlib.

use super::work::{FORMAT, text_of};

/// Mark in the header of every piece of one work, looked for in pieces that come back.
///
/// A [`PieceStore`](super::PieceStore) seals what it keeps; where pieces travel in memory, their owner does.
///
/// ```
/// let seal = saltus_results::Seal::of(&[("study", "5f3a9c")]);
/// let bytes = seal.close(7, b"content");
/// assert_eq!(seal.open(7, &bytes), Ok(&b"content"[..]));
/// assert_eq!(seal.open(8, &bytes), Err("it is piece 7".to_owned()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seal(u32);

impl Seal {
    /// Of the work that these names and values describe.
    pub fn of(fingerprint: &[(&str, &str)]) -> Self {
        Self(crc(&[&text_of(fingerprint)]))
    }

    /// The bytes of piece `number`, as in its file.
    pub fn close(self, number: u32, content: &[u8]) -> Vec<u8> {
        [&self.header(number, content), content].concat()
    }

    /// The content of `bytes`, if they are piece `number` as it was made.
    ///
    /// # Errors
    /// The damage, in words.
    pub fn open(self, number: u32, bytes: &[u8]) -> Result<&[u8], String> {
        match problem(self.0, number, bytes) {
            None => Ok(&bytes[HEADER..]),
            Some(problem) => Err(problem),
        }
    }

    /// The 32 bytes before the content; see the module for their meaning.
    pub(super) fn header(self, number: u32, content: &[u8]) -> Vec<u8> {
        header(self.0, number, content)
    }
}

const MAGIC: &[u8; 8] = b"saltuspc";
/// Bytes before the content.
const HEADER: usize = 32;

fn header(fingerprint: u32, number: u32, content: &[u8]) -> Vec<u8> {
    let mut header = Vec::with_capacity(HEADER);
    header.extend(MAGIC);
    for word in [FORMAT, fingerprint, number] {
        header.extend(word.to_le_bytes());
    }
    header.extend(crc(&[&header, content]).to_le_bytes());
    header.extend((content.len() as u64).to_le_bytes());
    header
}

/// Damage of the file of piece `number`, if there is any.
fn problem(fingerprint: u32, number: u32, bytes: &[u8]) -> Option<String> {
    let Some((header, content)) = bytes.split_at_checked(HEADER) else {
        return Some(format!("{} bytes, less than its header", bytes.len()));
    };
    let word = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|i| header[at + i]));
    let length = u64::from(word(24)) | u64::from(word(28)) << 32;
    if !header.starts_with(MAGIC) {
        Some("it does not begin as a piece does".to_owned())
    } else if word(8) != FORMAT {
        Some(format!("format {}, not {FORMAT}", word(8)))
    } else if word(12) != fingerprint {
        Some("it belongs to other work".to_owned())
    } else if word(16) != number {
        Some(format!("it is piece {}", word(16)))
    } else if length != content.len() as u64 {
        Some(format!("{} bytes of content, not {length}", content.len()))
    } else if word(20) != crc(&[&header[..20], content]) {
        Some("its checksum does not match".to_owned())
    } else {
        None
    }
}

/// CRC-32 of the parts, one after the other.
fn crc(parts: &[&[u8]]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    parts.iter().for_each(|part| hasher.update(part));
    hasher.finalize()
}
