//! What is measured.

use manylights_gpu::{Error, Operations, Reflectances, operations};
use manylights_hvl::{Hvl, LobeKinds};
use manylights_method::Method;
use manylights_reflectance::Form;
use manylights_reflectance::ReceiverKinds;
use manylights_virtual_lights::VirtualLights;
use manylights_vpl::Vpl;
use manylights_vsgl::Vsgl;
use manylights_vsl::{Sampling, Vsl};

const CELLS: [u32; 3] = [100, 400, 1600];
const BANDS: [usize; 5] = [3, 5, 10, 15, 20];
const DIRECTIONS: u32 = 25;

/// Names of the columns, each once.
pub(crate) const NAMES: [&str; 6] =
    ["vpl", "vsl sampling=brdf", "vsl sampling=cone", "vsgl", "hvl", "hvl form=zonal"];

/// A method with its parameters.
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) method: &'static dyn Method,
    pub(crate) parameters: Vec<(&'static str, String)>,
    pub(crate) cells: u32,
    pub(crate) bands: Option<usize>,
    /// Of a pair; none where it depends on chance.
    pub(crate) operations: Option<Operations>,
}

/// For a scene that is glossy all over or nowhere.
pub(crate) fn columns(glossy: bool) -> Vec<Column> {
    let kinds = Reflectances { specular: glossy, ..Reflectances::default() };
    let column = |name, method, cells: u32, more: &[(&'static str, String)], operations| {
        let parameters = more.iter().cloned().chain([("lights", cells.to_string())]).collect();
        Column { name, method, parameters, cells, bands: None, operations }
    };
    let vsl = |sampling: &str| {
        [("directions", DIRECTIONS.to_string()), ("sampling", sampling.to_owned())]
    };
    let hvl = |name, form, cells, bands: usize| {
        let word = if form == Form::Full { "full" } else { "zonal" };
        let more = [("bands", bands.to_string()), ("form", word.to_owned())];
        let operations = of_hvl(glossy, form, bands).expect("a shader");
        Column {
            bands: Some(bands),
            ..column(name, &VirtualLights(Hvl), cells, &more, Some(operations))
        }
    };
    let points = of_vpl(&kinds).expect("a shader");
    let cones = of_vsl(&kinds).expect("a shader");
    let gaussians = of_vsgl(&kinds).expect("a shader");
    let mut columns = Vec::new();
    columns.extend(CELLS.map(|cells| column("vpl", &VirtualLights(Vpl), cells, &[], Some(points))));
    columns.extend(
        CELLS.map(|cells| {
            column("vsl sampling=brdf", &VirtualLights(Vsl), cells, &vsl("brdf"), None)
        }),
    );
    columns.extend(CELLS.map(|cells| {
        column("vsl sampling=cone", &VirtualLights(Vsl), cells, &vsl("cone"), Some(cones))
    }));
    columns.extend(
        CELLS.map(|cells| column("vsgl", &VirtualLights(Vsgl), cells, &[], Some(gaussians))),
    );
    for (name, form) in [("hvl", Form::Full), ("hvl form=zonal", Form::Zonal)] {
        columns.extend(BANDS.map(|bands| hvl(name, form, 400, bands)));
        columns.extend([100, 1600].map(|cells| hvl(name, form, cells, 5)));
    }
    columns
}

/// What a light adds to a pixel, as linking names it.
const CONTRIBUTION: &str = "package_estimator_contribution";

fn of_vpl(kinds: &Reflectances) -> Result<Operations, Error> {
    let settings = manylights_vpl::Settings::default();
    let shader = manylights_vpl::linked_shader(kinds, kinds.specular, false, &settings)?;
    operations(&shader.wgsl, CONTRIBUTION, 1)
}

/// Every direction of a cone is evaluated.
fn of_vsl(kinds: &Reflectances) -> Result<Operations, Error> {
    let settings = manylights_vsl::Settings {
        directions: DIRECTIONS,
        sampling: Sampling::Cone,
        ..manylights_vsl::Settings::default()
    };
    let shader = manylights_vsl::linked_shader(kinds, kinds.specular, false, &settings)?;
    operations(&shader.wgsl, CONTRIBUTION, DIRECTIONS.into())
}

/// A light on a glossy surface is two Gaussians.
fn of_vsgl(kinds: &Reflectances) -> Result<Operations, Error> {
    let settings = manylights_vsgl::Settings::default();
    let shader = manylights_vsgl::linked_shader(kinds, kinds.specular, false, &settings)?;
    let lobes = if kinds.specular { 2 } else { 1 };
    operations(&shader.wgsl, CONTRIBUTION, 1).map(|of_lobe| of_lobe * lobes)
}

fn of_hvl(glossy: bool, form: Form, bands: usize) -> Result<Operations, Error> {
    let settings = manylights_hvl::Settings { form, bands, ..manylights_hvl::Settings::default() };
    // `trio` has a coloured metal.
    let receivers = ReceiverKinds { specular: glossy, colored: glossy, ..ReceiverKinds::default() };
    let lobes = LobeKinds { receivers, lights: glossy };
    let shader = manylights_hvl::linked_shader(lobes, false, &settings)?;
    operations(&shader.wgsl, CONTRIBUTION, 1)
}
