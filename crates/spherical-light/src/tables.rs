//! What further frames reuse.

use manylights_area_lights::SceneTables;
use manylights_gpu::Gpu;
use manylights_interpolation::Interpolation;
use manylights_method::{Error, Parameters};
use manylights_reflectance::{Materials, Tables};
use manylights_scene::Scene;

use crate::{Coefficients, Narrow, Product, Settings};

/// The lobes of a scene's materials, and the coefficients of caps where they are tabulated.
pub(crate) fn tables(
    gpu: &Gpu,
    scene: &Scene,
    parameters: &Parameters,
) -> Result<SceneTables, Error> {
    let settings = Settings::new(parameters);
    if Interpolation::new(parameters).is_some() {
        refuse_interpolated(&settings)?;
    }
    refuse_long_products(&settings)?;
    refuse_transformed_products(&settings)?;
    settings.narrow.check(scene)?;
    let (materials, receivers) = (Materials::of_scene(scene), Tables::new());
    let on_gpu = crate::gather::tables(gpu, &materials, &settings, &receivers)?;
    let of_caps = u64::from(settings.coefficients == Coefficients::Tabulated);
    Ok(SceneTables { on_gpu, count: receivers.count() + of_caps })
}

/// What a grid holds are analytic coefficients, which the whole lobe meets.
fn refuse_interpolated(settings: &Settings) -> Result<(), Error> {
    let set = match settings {
        Settings { product: Product::Cosine(_), .. } => "product=full",
        Settings { coefficients: Coefficients::Tabulated, .. } => "coefficients=analytic",
        Settings { narrow: Narrow::Transformed, .. } => "narrow=decline, or keep",
        _ => return Ok(()),
    };
    Err(Error::Declined(format!(
        "interpolates analytic coefficients against whole lobes: --set {set}"
    )))
}

/// Light by light alone a lobe is met as it is.
fn refuse_transformed_products(settings: &Settings) -> Result<(), Error> {
    if settings.narrow != Narrow::Transformed || settings.product == Product::Full {
        return Ok(());
    }
    Err(Error::Declined("transforms narrow lobes light by light: --set product=full".into()))
}

fn refuse_long_products(settings: &Settings) -> Result<(), Error> {
    let Settings { product: Product::Cosine(product), bands, .. } = *settings else {
        return Ok(());
    };
    let most = product.most_bands();
    if bands <= most {
        return Ok(());
    }
    Err(Error::Declined(format!(
        "multiplies at most {most} bands by the cosine's expansion, whose integrals grow as bands⁵: --set \
         bands={most}, or product=4.6"
    )))
}
