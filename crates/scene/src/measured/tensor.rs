//! The container of the RGL database's files: named arrays in one file.
//!
//! `tensor_file\0`, version 1.0, the number of fields; for each its name, rank, type, offset and shape;
//! then the data, all little-endian. Files come from anywhere: every length is checked against the
//! bytes that are there before it is used.

use super::fault::broken;
use crate::LoadError;

const MAGIC: &[u8] = b"tensor_file\0";
const VERSION: [u8; 2] = [1, 0];
/// The codes of the two types of element that are read.
const U8: u8 = 1;
const F32: u8 = 10;
/// Of the arrays that are read.
const MAX_RANK: usize = 8;

/// The fields of a file and the bytes behind them.
pub(super) struct TensorFile<'a> {
    bytes: &'a [u8],
    fields: Vec<Field<'a>>,
}

struct Field<'a> {
    name: &'a [u8],
    kind: u8,
    offset: u64,
    shape: Vec<u64>,
}

/// What is left of the head of the file.
struct Head<'a>(&'a [u8]);

impl<'a> Head<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], LoadError> {
        let (part, rest) =
            self.0.split_at_checked(count).ok_or_else(|| broken("the head", "ends too soon"))?;
        self.0 = rest;
        Ok(part)
    }

    fn number<const N: usize>(&mut self) -> Result<u64, LoadError> {
        let mut bytes = [0; 8];
        bytes[..N].copy_from_slice(self.take(N)?);
        Ok(u64::from_le_bytes(bytes))
    }
}

impl<'a> TensorFile<'a> {
    /// Reads the list of fields.
    ///
    /// # Errors
    /// Where the file is of another kind or ends too soon.
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, LoadError> {
        let mut head = Head(bytes);
        if head.take(MAGIC.len()).ok() != Some(MAGIC) {
            return Err(broken("the head", "is not that of a tensor file"));
        }
        if head.take(VERSION.len())? != VERSION {
            return Err(broken("the head", "names another version than 1.0"));
        }
        // A field takes a dozen bytes or more: a count beyond the file ends the loop soon.
        let count = head.number::<4>()?;
        let mut fields = Vec::new();
        for _ in 0..count {
            fields.push(Field::read(&mut head)?);
        }
        Ok(Self { bytes, fields })
    }

    /// Whether there is a field of that name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.field(name).is_some()
    }

    /// An array of floats of the given rank: its shape and its values.
    ///
    /// # Errors
    /// Where the field is missing, of another kind, beyond the file, or not finite.
    pub(super) fn floats<const RANK: usize>(
        &self,
        name: &str,
    ) -> Result<([usize; RANK], Vec<f32>), LoadError> {
        let (shape, bytes) = self.data(name, F32)?;
        let shape = <[usize; RANK]>::try_from(shape)
            .map_err(|shape| broken(name, format!("has rank {}, not {RANK}", shape.len())))?;
        let (words, _) = bytes.as_chunks();
        let values: Vec<f32> = words.iter().copied().map(f32::from_le_bytes).collect();
        if values.iter().any(|value| !value.is_finite()) {
            return Err(broken(name, "is not finite"));
        }
        Ok((shape, values))
    }

    /// A field of one byte.
    ///
    /// # Errors
    /// As [`Self::floats`].
    pub(super) fn flag(&self, name: &str) -> Result<bool, LoadError> {
        match self.data(name, U8)?.1 {
            [byte] => Ok(*byte != 0),
            bytes => Err(broken(name, format!("has {} bytes, not 1", bytes.len()))),
        }
    }

    fn field(&self, name: &str) -> Option<&Field<'a>> {
        self.fields.iter().find(|field| field.name == name.as_bytes())
    }

    /// Shape and bytes of a field, within the file and not empty.
    fn data(&self, name: &str, kind: u8) -> Result<(Vec<usize>, &'a [u8]), LoadError> {
        let field = self.field(name).ok_or_else(|| broken(name, "is missing"))?;
        if field.kind != kind {
            return Err(broken(name, format!("has elements of type {}, not {kind}", field.kind)));
        }
        let size: u64 = if kind == F32 { 4 } else { 1 };
        let beyond = || broken(name, "reaches beyond the file");
        let length = field.shape.iter().try_fold(size, |length, &n| length.checked_mul(n));
        let end = length.and_then(|length| field.offset.checked_add(length)).ok_or_else(beyond)?;
        if end > self.bytes.len() as u64 {
            return Err(beyond());
        }
        if field.shape.contains(&0) {
            return Err(broken(name, "is empty"));
        }
        let shape = field.shape.iter().map(|&n| n as usize).collect();
        Ok((shape, &self.bytes[field.offset as usize..end as usize]))
    }
}

impl<'a> Field<'a> {
    fn read(head: &mut Head<'a>) -> Result<Self, LoadError> {
        let length = head.number::<2>()? as usize;
        let name = head.take(length)?;
        let rank = head.number::<2>()? as usize;
        let kind = head.number::<1>()? as u8;
        let offset = head.number::<8>()?;
        if rank > MAX_RANK {
            let name = String::from_utf8_lossy(name);
            return Err(broken(name, format!("has rank {rank}, more than {MAX_RANK}")));
        }
        let shape: Result<_, _> = (0..rank).map(|_| head.number::<8>()).collect();
        Ok(Self { name, kind, offset, shape: shape? })
    }
}
