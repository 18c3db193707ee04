//! What further frames reuse.

use manylights_area_lights::{AreaLightFrame, SceneTables};
use manylights_gpu::Buffer;
use manylights_interpolation::{Interpolation, LightGrid, Lit, project};
use manylights_method::{Dependencies, Error, Parameters, PassTime, Processor};
use manylights_reflectance::{Materials, Tables};

use crate::{Coefficients, Narrow, Product, Settings, SphereLight, linked_projection};

/// The lobes of a scene's materials, and the coefficients of caps where they are tabulated, on the adapter, and
/// what a grid holds of the lights: the bake.
pub struct LobeTables {
    pub(crate) on_gpu: Vec<Buffer>,
    count: u64,
    pub(crate) grid: Option<LightGrid>,
}

impl SceneTables for LobeTables {
    fn new(frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<Self, Error> {
        let settings = Settings::new(parameters);
        let interpolation = Interpolation::new(parameters);
        if interpolation.is_some() {
            refuse_interpolated(&settings)?;
        }
        refuse_long_products(&settings)?;
        refuse_transformed_products(&settings)?;
        settings.narrow.check(frame.scene)?;
        let (materials, receivers) = (Materials::of_scene(frame.scene), Tables::new());
        let on_gpu = crate::gather::tables(frame.on_gpu.gpu(), &materials, &settings, &receivers)?;
        let of_caps = u64::from(settings.coefficients == Coefficients::Tabulated);
        let grid = interpolation.map(|how| light_grid(frame, &settings, how)).transpose()?;
        Ok(Self { on_gpu, count: receivers.count() + of_caps, grid })
    }

    fn depends_on(parameters: &Parameters) -> Dependencies {
        let tables = Dependencies { scene: true, amount: true, ..Dependencies::default() };
        Interpolation::new(parameters).map_or(tables, |how| how.depends_on())
    }

    fn processor(parameters: &Parameters) -> Processor {
        Interpolation::new(parameters).map_or(Processor::Cpu, |_| Processor::Gpu)
    }

    fn grow(&mut self, frame: &AreaLightFrame<'_>, parameters: &Parameters) -> Result<(), Error> {
        if let (Some(grid), Some(how)) = (&mut self.grid, Interpolation::new(parameters)) {
            let mut next = light_grid(frame, &Settings::new(parameters), how)?;
            next.follow(grid);
            *grid = next;
        }
        Ok(())
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.grid.as_ref().map_or(Vec::new(), LightGrid::pass_times)
    }

    fn count(&self) -> u64 {
        self.count
    }
}

/// The grid of a picture.
fn light_grid(
    frame: &AreaLightFrame<'_>,
    settings: &Settings,
    how: Interpolation,
) -> Result<LightGrid, Error> {
    let AreaLightFrame { scene, on_gpu, pixels, ref lights, .. } = *frame;
    let gpu = on_gpu.gpu();
    let lit = Lit { gpu, scene, surfaces: (on_gpu.surfaces(), pixels), lights };
    let shader = linked_projection(settings, how.projection())?;
    Ok(LightGrid::new(how, &lit, |grid, far| {
        project(gpu, grid, &shader, &far.iter().filter_map(SphereLight::of).collect::<Vec<_>>())
    })?)
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
