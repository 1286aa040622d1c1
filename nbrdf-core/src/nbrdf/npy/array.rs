//! One `.npy` array: header looked at with suspicion, numbers read only after the shape is known to fit.

use npyz::{DType, NpyFile, Order, WriteOptions, WriterBuilder};

use super::NpyError;

/// Longest header read \[bytes\]; numpy writes 118 for these arrays.
const MAX_HEADER: usize = 1024;

/// An array whose header is read and whose numbers are not.
pub(super) struct Array<'a> {
    pub(super) name: String,
    file: NpyFile<&'a [u8]>,
}

impl<'a> Array<'a> {
    /// Reads the header.
    pub(super) fn open(name: &str, bytes: &'a [u8]) -> Result<Self, NpyError> {
        let problem = |found: String| NpyError::Header { array: name.to_owned(), found };
        suspicious(bytes).map_or(Ok(()), |found| Err(problem(found.to_owned())))?;
        let file = NpyFile::new(bytes).map_err(|error| problem(error.to_string()))?;
        Ok(Self { name: name.to_owned(), file })
    }

    /// Its shape, as the file says.
    pub(super) fn shape(&self) -> &[u64] {
        self.file.shape()
    }

    /// Its numbers in C order. Call once the shape is known to be a network's.
    pub(super) fn values(self) -> Result<Vec<f32>, NpyError> {
        let Self { name: array, file } = self;
        let (order, shape, dtype) = (file.order(), file.shape().to_vec(), file.dtype());
        let width = dtype.num_bytes().unwrap_or(0);
        let count = usize::try_from(file.len()).unwrap_or(usize::MAX);
        let bytes = file.into_inner();
        let expected = count.saturating_mul(width);
        if bytes.len() != expected {
            return Err(NpyError::Length { array, expected, found: bytes.len() });
        }
        let Some(values) = floats(&dtype, bytes) else {
            let found = format!("numbers of type {}", dtype.descr());
            return Err(NpyError::Header { array, found });
        };
        match (order, shape.as_slice()) {
            (Order::Fortran, &[rows, columns]) => {
                let (rows, columns) = (rows as usize, columns as usize);
                let row = |r: usize| values.iter().skip(r).step_by(rows).take(columns).copied();
                Ok((0..rows).flat_map(row).collect())
            }
            _ => Ok(values),
        }
    }
}

/// f32 or f64 in either byte order, as f32.
fn floats(dtype: &DType, bytes: &[u8]) -> Option<Vec<f32>> {
    let DType::Plain(kind) = dtype else { return None };
    let (single, _) = bytes.as_chunks::<4>();
    let (double, _) = bytes.as_chunks::<8>();
    Some(match kind.to_string().as_str() {
        "<f4" => single.iter().map(|&b| f32::from_le_bytes(b)).collect(),
        ">f4" => single.iter().map(|&b| f32::from_be_bytes(b)).collect(),
        "<f8" => double.iter().map(|&b| f64::from_le_bytes(b) as f32).collect(),
        ">f8" => double.iter().map(|&b| f64::from_be_bytes(b) as f32).collect(),
        _ => return None,
    })
}

/// What makes a header unfit for the Python-literal parser behind npyz, which recurses on nested brackets,
/// allocates what the header length asks for, and multiplies dimensions without looking for overflow.
fn suspicious(bytes: &[u8]) -> Option<&'static str> {
    let (version, after) = match bytes {
        [0x93, b'N', b'U', b'M', b'P', b'Y', version @ 1..=3, _, rest @ ..] => (*version, rest),
        _ => return Some("the signature of an .npy file is missing"),
    };
    let (length, text) = match (version, after) {
        (1, [a, b, text @ ..]) => (usize::from(u16::from_le_bytes([*a, *b])), text),
        (2.., [a, b, c, d, text @ ..]) => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, text),
        _ => return Some("the file ends within its header"),
    };
    if length > MAX_HEADER {
        return Some("its header is longer than any network's");
    }
    let Some(header) = text.get(..length) else { return Some("the file ends within its header") };
    // {'descr': '<f4', 'fortran_order': False, 'shape': (256, 256), }: one brace, one parenthesis, short numbers.
    let count = |c: u8| header.iter().filter(|&&b| b == c).count();
    if count(b'{') != 1 || count(b'(') != 1 || count(b'[') != 0 {
        return Some("its header is not that of a plain array");
    }
    let dimensions = header.split(|&b| b == b'(').nth(1).and_then(|rest| rest.split(|&b| b == b')').next());
    let plain = |d: &[u8]| d.len() <= 32 && d.iter().all(|b| b.is_ascii_digit() || matches!(b, b',' | b' '));
    let short = |d: &[u8]| d.split(|b| !b.is_ascii_digit()).all(|number| number.len() <= 4);
    let few = |d: &[u8]| d.split(|&b| b == b',').count() <= 4;
    match dimensions {
        Some(d) if plain(d) && short(d) && few(d) => None,
        _ => Some("its shape is not that of a network's array"),
    }
}

/// The bytes of an `.npy` file: little-endian f32, C order.
pub(super) fn bytes(shape: &[usize], values: &[f32]) -> Vec<u8> {
    let shape: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
    let mut out = Vec::new();
    let written = (|| {
        // "<f4" on every machine; the default type would be the machine's own byte order.
        let dtype = DType::new_scalar("<f4".parse().map_err(std::io::Error::other)?);
        let options = WriteOptions::<f32>::new().dtype(dtype).shape(&shape);
        let mut writer = options.writer(&mut out).begin_nd()?;
        writer.extend(values.iter().copied())?;
        writer.finish()
    })();
    debug_assert!(written.is_ok(), "writing to memory does not fail");
    out
}
