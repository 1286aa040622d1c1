//! Tensor files: named arrays of numbers, as the RGL material database and Mitsuba write them.
//!
//! `tensor_file\0`, version 1.0, u32 fields; per field a u16-counted name, u16 dimensions, a u8 type, the u64 offset of its
//! data and u64 sizes; little-endian (W. Jakob's `powitacq`, the database's own reader).

use std::collections::BTreeMap;

use super::LARGEST;

/// Bytes that say what the file is.
pub(super) const MAGIC: &[u8] = b"tensor_file\0";
/// More fields, or dimensions of one, are no material.
const MOST_FIELDS: u32 = 64;
const MOST_DIMENSIONS: u16 = 8;
/// Types that are read here.
pub(super) const U8: u8 = 1;
pub(super) const F32: u8 = 10;

/// Why bytes are no tensor file.
#[derive(Debug, thiserror::Error)]
pub enum FieldError {
    /// Another kind of file.
    #[error("expected a tensor file, version 1.0, in bytes 0..14: is it a .bsdf of the RGL database?")]
    Magic,
    /// The file ends too early.
    #[error("expected {what} at bytes {from}..{to}, found the end of the file at {length}: fetch it again")]
    Short {
        /// What should be there.
        what: String,
        /// Its first byte.
        from: u64,
        /// The byte after it.
        to: u64,
        /// Bytes of the file.
        length: usize,
    },
    /// A header that no writer makes.
    #[error("expected {expected} at byte {byte}, found {found}: the file is damaged")]
    Header {
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
        /// Where.
        byte: u64,
    },
    /// A field that is not there.
    #[error("expected a field '{name}', found only {found}")]
    Missing {
        /// Its name.
        name: String,
        /// Names that are there.
        found: String,
    },
    /// A field of another type or shape.
    #[error("field '{name}': expected {expected}, found {found}")]
    Field {
        /// Its name.
        name: String,
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
}

/// The fields of a file, still as bytes.
pub(super) struct Fields<'a> {
    fields: BTreeMap<String, Field<'a>>,
}

struct Field<'a> {
    shape: Vec<usize>,
    kind: u8,
    data: &'a [u8],
}

/// Numbers and their shape.
pub(super) struct Tensor {
    pub shape: Vec<usize>,
    pub values: Vec<f32>,
}

/// Reads forwards, never beyond the end.
struct Cursor<'a> {
    bytes: &'a [u8],
    at: u64,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: u64, what: &str) -> Result<&'a [u8], FieldError> {
        let data = slice(self.bytes, self.at, count, what)?;
        self.at += count;
        Ok(data)
    }

    fn number<const N: usize>(&mut self, what: &str) -> Result<u64, FieldError> {
        let mut wide = [0; 8];
        wide[..N].copy_from_slice(self.take(N as u64, what)?);
        Ok(u64::from_le_bytes(wide))
    }
}

fn slice<'a>(bytes: &'a [u8], from: u64, count: u64, what: &str) -> Result<&'a [u8], FieldError> {
    let to = from.saturating_add(count);
    let range = usize::try_from(from).ok().zip(usize::try_from(to).ok());
    range.and_then(|(from, to)| bytes.get(from..to)).ok_or_else(|| FieldError::Short {
        what: what.to_owned(),
        from,
        to,
        length: bytes.len(),
    })
}

impl<'a> Fields<'a> {
    /// Reads the headers; nothing is copied.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, FieldError> {
        let rest = bytes.strip_prefix(MAGIC).and_then(|rest| rest.strip_prefix(&[1, 0]));
        if rest.is_none() {
            return Err(FieldError::Magic);
        }
        let mut cursor = Cursor { bytes, at: MAGIC.len() as u64 + 2 };
        let count = cursor.number::<4>("the number of fields")?;
        if count > u64::from(MOST_FIELDS) {
            let expected = format!("{MOST_FIELDS} fields at most");
            return Err(FieldError::Header { expected, found: count.to_string(), byte: cursor.at - 4 });
        }
        let mut fields = BTreeMap::new();
        for _ in 0..count {
            let length = cursor.number::<2>("the length of a name")?;
            let name = String::from_utf8_lossy(cursor.take(length, "a name")?).into_owned();
            fields.insert(name.clone(), Field::parse(&mut cursor, &name)?);
        }
        Ok(Self { fields })
    }

    /// A field of f32; no number is beyond ±[`LARGEST`].
    pub fn floats(&self, name: &str) -> Result<Tensor, FieldError> {
        let field = self.field(name)?;
        if field.kind != F32 {
            return Err(mismatch(name, "32-bit floats", format!("type {}", field.kind)));
        }
        let (numbers, _) = field.data.as_chunks::<4>();
        let values: Vec<f32> = numbers.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect();
        if let Some(index) = values.iter().position(|value| value.is_nan() || value.abs() > LARGEST) {
            return Err(mismatch(name, "finite numbers below 1e30", format!("{} as number {index}", values[index])));
        }
        Ok(Tensor { shape: field.shape.clone(), values })
    }

    /// A field of bytes.
    pub fn bytes(&self, name: &str) -> Result<&'a [u8], FieldError> {
        let field = self.field(name)?;
        if field.kind == U8 { Ok(field.data) } else { Err(mismatch(name, "bytes", format!("type {}", field.kind))) }
    }

    fn field(&self, name: &str) -> Result<&Field<'a>, FieldError> {
        self.fields.get(name).ok_or_else(|| FieldError::Missing {
            name: name.to_owned(),
            found: self.fields.keys().map(String::as_str).collect::<Vec<_>>().join(", "),
        })
    }
}

impl<'a> Field<'a> {
    fn parse(cursor: &mut Cursor<'a>, name: &str) -> Result<Self, FieldError> {
        let what = format!("the header of field '{name}'");
        let start = cursor.at;
        let dimensions = cursor.number::<2>(&what)?;
        if dimensions > u64::from(MOST_DIMENSIONS) {
            let expected = format!("{MOST_DIMENSIONS} dimensions at most of field '{name}'");
            return Err(FieldError::Header { expected, found: dimensions.to_string(), byte: start });
        }
        let kind = cursor.number::<1>(&what)? as u8;
        let offset = cursor.number::<8>(&what)?;
        let shape = (0..dimensions).map(|_| cursor.number::<8>(&what)).collect::<Result<Vec<u64>, _>>()?;
        // Types that are not read here may be of any size: they are kept without their data.
        let size = match kind {
            U8 => 1,
            F32 => 4,
            _ => 0,
        };
        let bytes = shape.iter().fold(size, |product: u64, &length| product.saturating_mul(length));
        let data = slice(cursor.bytes, offset, bytes, &format!("the data of field '{name}'"))?;
        // Sizes that the data confirms fit; others have no data and are never asked for.
        let shape = shape.into_iter().map(|length| usize::try_from(length).unwrap_or(usize::MAX)).collect();
        Ok(Self { shape, kind, data })
    }
}

/// A field that is not as it should be.
pub(super) fn mismatch(name: &str, expected: &str, found: String) -> FieldError {
    FieldError::Field { name: name.to_owned(), expected: expected.to_owned(), found }
}
