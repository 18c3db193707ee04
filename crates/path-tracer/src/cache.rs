//! The store of unfinished and finished references: one file for each set of inputs and number of slices
//! asked for, named by the hash of the inputs and that number, that holds the sums over slices. Files appear whole (written beside, synced, renamed), so a
//! killed run leaves the state after some slice, and two runs at once leave that of one of them.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::picture::Picture;
use crate::sums::Sums;
use crate::{Error, Settings};

/// Of references and of the pictures of the method `reference`: raised whenever the same inputs give
/// other sums.
pub const REFERENCE_VERSION: u32 = 4;

const MAGIC: [u8; 8] = *b"MLREF\0\0\x01";
const HEADER: usize = MAGIC.len() + KEY + size_of::<u32>();
const KEY: usize = 32;
const NUMBERS: usize = size_of::<Sums>() / size_of::<f64>();

/// The file of one reference.
pub(crate) struct CacheFile {
    folder: PathBuf,
    key: [u8; KEY],
    /// As many as were asked for.
    slices: u32,
}

/// What a cache file held.
pub(crate) enum Cached {
    /// There is none.
    Nothing,
    /// Sums over so many slices.
    Sums(Vec<Sums>, u32),
    /// Not what was once written, and why.
    Damaged(String),
}

impl CacheFile {
    /// `content` is the hash of scene and camera.
    pub(crate) fn new(folder: &Path, content: &[u8; KEY], settings: &Settings) -> Self {
        let slices = settings.slices();
        let mut hasher = Sha256::new();
        hasher.update(format!("manylights reference {REFERENCE_VERSION}"));
        hasher.update(content);
        hasher.update(format!("{:?}", (settings.transport, settings.resolution, settings.seed)));
        let key: [u8; KEY] = hasher.finalize().into();
        Self { folder: folder.to_owned(), key, slices }
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.folder.join(format!("{}-{}.reference", hexadecimal(&self.key), self.slices))
    }

    /// The same reference with fewer slices, as many as there are: what its file holds, this one begins
    /// with. More slices than were asked for would be another picture.
    pub(crate) fn smaller(&self) -> Option<Self> {
        let prefix = format!("{}-", hexadecimal(&self.key));
        let slices =
            |name: &str| name.strip_prefix(&prefix)?.strip_suffix(".reference")?.parse().ok();
        let names = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let found = names.filter_map(|entry| slices(entry.file_name().to_str()?));
        let most = found.filter(|&slices: &u32| slices < self.slices).max()?;
        Some(Self { folder: self.folder.clone(), key: self.key, slices: most })
    }

    /// Reads the file for a picture of so many pixels.
    pub(crate) fn load(&self, pixels: usize) -> Cached {
        match fs::read(self.path()) {
            Ok(bytes) => match self.parse(&bytes, pixels) {
                Ok((sums, slices)) => Cached::Sums(sums, slices),
                Err(reason) => Cached::Damaged(reason.to_owned()),
            },
            Err(error) if error.kind() == io::ErrorKind::NotFound => Cached::Nothing,
            Err(error) => Cached::Damaged(error.to_string()),
        }
    }

    fn parse(&self, bytes: &[u8], pixels: usize) -> Result<(Vec<Sums>, u32), &'static str> {
        if bytes.len() != HEADER + pixels * size_of::<Sums>() + KEY {
            return Err("its length is wrong");
        }
        let (body, checksum) = bytes.split_at(bytes.len() - KEY);
        if Sha256::digest(body).as_slice() != checksum {
            return Err("its checksum is wrong");
        }
        let (header, numbers) = body.split_at(HEADER);
        if header[..MAGIC.len()] != MAGIC || header[MAGIC.len()..][..KEY] != self.key {
            return Err("it belongs to another reference");
        }
        let slices = header[MAGIC.len() + KEY..].try_into().expect("four bytes are left");
        let slices = u32::from_le_bytes(slices);
        if slices > self.slices {
            return Err("it holds more samples than its name says");
        }
        let numbers: Vec<f64> = numbers
            .chunks_exact(size_of::<f64>())
            .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("chunks of eight bytes")))
            .collect();
        let sums = numbers
            .chunks_exact(NUMBERS)
            .map(|numbers| bytemuck::cast_slice::<f64, Sums>(numbers)[0])
            .collect();
        Ok((sums, slices))
    }

    /// Replaces the file by the state of a picture, atomically.
    pub(crate) fn store(&self, picture: &Picture<'_>) -> Result<(), Error> {
        let failed = |source| Error::Cache { path: self.path(), source };
        let mut bytes = Vec::with_capacity(HEADER + size_of_val(picture.sums()) + KEY);
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&self.key);
        bytes.extend_from_slice(&picture.slices().to_le_bytes());
        let numbers: &[f64] = bytemuck::cast_slice(picture.sums());
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        let checksum = Sha256::digest(&bytes);
        bytes.extend_from_slice(&checksum);

        fs::create_dir_all(&self.folder).map_err(failed)?;
        let mut file = tempfile::NamedTempFile::new_in(&self.folder).map_err(failed)?;
        file.write_all(&bytes).map_err(failed)?;
        file.as_file().sync_all().map_err(failed)?;
        file.persist(self.path()).map_err(|error| failed(error.error))?;
        Ok(())
    }
}

/// Lower-case hexadecimal digits.
pub(crate) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
