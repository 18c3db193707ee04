//! What kernels must know of the reflectances that they meet.

use manylights_scene::{Brdf, Lobe, Measured, Scene};

use crate::{Buffer, Error, Feature, Gpu, Table};

/// The kinds of reflectance in a scene: what it does not contain is not in its kernels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reflectances {
    /// Any specular lobe.
    pub specular: bool,
    /// Any lobe with the exact Fresnel reflectance.
    pub exact_fresnel: bool,
    /// The measurements.
    pub measured: Vec<Measured>,
}

impl Reflectances {
    /// Those of all materials.
    pub fn of_scene(scene: &Scene) -> Self {
        Self::of(scene.materials.iter().map(|material| material.brdf(material.base_color)))
    }

    /// Those of single points.
    pub fn of(brdfs: impl IntoIterator<Item = Brdf>) -> Self {
        let mut kinds = Self::default();
        for brdf in brdfs {
            kinds.specular |= brdf.has_specular();
            match brdf.lobe {
                Lobe::Schlick { .. } => {}
                Lobe::Dielectric { .. } => kinds.exact_fresnel = true,
                Lobe::Measured(measured) if kinds.measured.contains(&measured) => {}
                Lobe::Measured(measured) => kinds.measured.push(measured),
            }
        }
        kinds
    }

    /// Whether all lobes are glTF's: GGX with Schlick's Fresnel term.
    pub fn is_plain(&self) -> bool {
        !self.exact_fresnel && self.measured.is_empty()
    }

    /// The switches of `package::brdf`, for [`link`](crate::link()).
    pub fn features(&self) -> [Feature<'static>; 2] {
        [("exact_fresnel", self.exact_fresnel), ("measured", !self.measured.is_empty())]
    }

    /// What `shaders/measured.wesl` reads, in the order of [`Reflectances::tables`].
    pub fn table_names(&self) -> Vec<Table> {
        let table = Table { name: "measured", element: "u32" };
        self.measured.first().map(|_| table).into_iter().collect()
    }

    /// The tables of `shaders/measured.wesl`; none where nothing is measured.
    ///
    /// # Errors
    /// Where they exceed what the adapter binds.
    pub fn tables(&self, gpu: &Gpu) -> Result<Vec<Buffer>, Error> {
        let Some(last) = self.measured.iter().map(|measured| measured.number()).max() else {
            return Ok(Vec::new());
        };
        let mut words = vec![0; last as usize + 1];
        for measured in &self.measured {
            words[measured.number() as usize] = words.len() as u32;
            words.extend(measured.words());
        }
        Ok(vec![gpu.storage("measurements", &words)?])
    }
}
