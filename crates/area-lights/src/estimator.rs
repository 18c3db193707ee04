//! What an estimator is.

use manylights_gpu::{Buffer, Gpu};
use manylights_interpolation::{Grid, GridCoefficients, Held, Interpolation};
use manylights_method::{Error, ParameterInfo, Parameters, PassTime};
use manylights_scene::{AreaLight, Scene};

use crate::gather::LightRecords;
use crate::gather_shader::GatherShader;

/// The name of the parameter that time and accuracy grow with.
pub const BANDS: &str = "bands";

/// What a light with a surface contributes to a pixel, on the adapter. All else is alike for all of them,
/// and [`AreaLights`](crate::AreaLights) makes them a [`Method`](manylights_method::Method) of it: direct light
/// of all lights at every pixel, or of those that are not near from a grid, without shadows; time and accuracy
/// grow with the parameter [`BANDS`]; nothing is left to chance; and half of the lights is half of the light, so
/// that only the last picture estimates anything.
pub trait Estimator: Sync + 'static {
    /// As [`Method::id`](manylights_method::Method::id).
    const ID: &'static str;
    /// As [`Method::title`](manylights_method::Method::title).
    const TITLE: &'static str;
    /// As [`Method::version`](manylights_method::Method::version).
    const VERSION: u32;
    /// As [`Method::parameters`](manylights_method::Method::parameters), those of [`Interpolation`] among them
    /// where there is a projection.
    const PARAMETERS: &'static [ParameterInfo];
    /// The kind of light that it takes, in the plural.
    const TAKES: &'static str;
    /// How its lights are projected, where a grid may hold them.
    const PROJECT: Option<Project> = None;

    /// Whether a light is of that kind.
    fn takes(light: &AreaLight) -> bool;

    /// Makes all tables anew.
    ///
    /// # Errors
    /// [`Error::Declined`] with a reason where the scene or the parameters are not the method's.
    fn tables(gpu: &Gpu, scene: &Scene, parameters: &Parameters) -> Result<SceneTables, Error>;

    /// How these lights, which are of its kind, are gathered.
    ///
    /// # Errors
    /// Where the shader does not link.
    fn gather(
        scene: &Scene,
        lights: &[AreaLight],
        parameters: &Parameters,
    ) -> Result<Gathering, Error>;
}

/// Makes the coefficients of lights at the vertices of a grid, and tells the time of each pass.
pub type Project = fn(
    &Gpu,
    Grid<f32>,
    Interpolation,
    &Parameters,
    &Held<'_>,
) -> Result<(GridCoefficients, Vec<PassTime>), manylights_gpu::Error>;

/// What an estimator tabulates of the materials of a scene and of its own formulas.
pub struct SceneTables {
    /// In the order of its [`PointBindings`](manylights_gpu::PointBindings).
    pub on_gpu: Vec<Buffer>,
    /// How many were made.
    pub count: u64,
}

/// Lights and how they meet the pixels.
pub struct Gathering {
    /// The kernel.
    pub shader: GatherShader,
    /// Of all lights at once, since lights may share edges.
    pub records: Box<dyn LightRecords>,
    /// What a pixel and a record take, about, as [`manylights_gpu::operations`] counts them.
    pub operations: usize,
}
