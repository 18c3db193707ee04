//! The bakes of a run: made by the clock, kept while what they depend on stays as it is.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use manylights_method::{Bake, Baking, Dependencies, Error, Frame, Parameters, Processor};
use manylights_scene::{Camera, Scene};

/// What a bake took.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct BakeCost {
    /// Wall clock; where it grew from an earlier camera's, of the growth alone.
    pub(crate) seconds: f64,
    /// The same for each pass, by the processor's own clock.
    pub(crate) pass_seconds: BTreeMap<String, f64>,
    /// What was counted, earlier cameras included.
    pub(crate) counters: BTreeMap<String, u64>,
    /// Which of the run's bakes it is; 0 where nothing is baked.
    serial: u64,
}

/// What a bake may depend on, but for the camera.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Origin {
    /// Of the scene.
    pub(crate) scene: SceneHashes,
    /// Of the frame.
    pub(crate) seed: u64,
    /// Value of the method's cost parameter, where it has one.
    pub(crate) amount: Option<f64>,
}

/// A scene as bakes depend on it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SceneHashes {
    /// Of all but what emits light.
    unlit: String,
    /// Of all.
    lit: String,
}

impl SceneHashes {
    pub(crate) fn new(scene: &Scene) -> Self {
        // Bakes know the camera by its place in the list.
        let nowhere = Camera {
            name: String::new(),
            position: Default::default(),
            right: Default::default(),
            up: Default::default(),
            forward: Default::default(),
            vertical_fov: 0.0,
        };
        let mut unlit = Scene { lights: Vec::new(), ..scene.clone() };
        for material in &mut unlit.materials {
            material.emission = Default::default();
        }
        let hash = |scene| manylights_scene::content_hash(scene, &nowhere);
        Self { unlit: hash(&unlit), lit: hash(scene) }
    }
}

/// The bake that a frame needs.
pub(crate) struct Wanted<'w> {
    /// Index into the experiment's variants.
    pub(crate) variant: usize,
    /// Of the variant's method.
    pub(crate) baking: &'w dyn Baking,
    /// Of the variant, with the amount of work.
    pub(crate) parameters: &'w Parameters,
    /// What it may depend on.
    pub(crate) origin: Origin,
    /// Index into the cameras, in the order in which bakes grow.
    pub(crate) camera: usize,
}

/// Calls back with the frame of a camera, which is made for that call where it is not at hand.
pub(crate) type WithFrame<'f> =
    &'f dyn Fn(usize, &mut dyn FnMut(&Frame<'_>) -> Result<(), Error>) -> Result<(), Error>;

/// The latest bake of each variant, or of each of its seeds where it depends on them.
#[derive(Default)]
pub(crate) struct Bakes {
    baked: Vec<Baked>,
    /// Variants whose pipelines are compiled, and whether those that grow a bake are.
    warm: BTreeSet<(usize, bool)>,
    /// How many were made.
    made: u64,
    /// Those that a cell has told of.
    told: BTreeSet<u64>,
}

struct Baked {
    variant: usize,
    origin: Origin,
    camera: usize,
    bake: Box<dyn Bake>,
    cost: BakeCost,
}

impl Bakes {
    /// The bake that is wanted: that of an earlier frame where nothing that it depends on changed, one
    /// that grows from an earlier camera's, or a new one.
    ///
    /// # Errors
    /// Those of the method.
    pub(crate) fn get(
        &mut self,
        wanted: &Wanted<'_>,
        with_frame: WithFrame<'_>,
    ) -> Result<(&dyn Bake, BakeCost), Error> {
        let depends = wanted.baking.depends_on(wanted.parameters);
        let earlier = self.take(wanted).filter(|baked| {
            let before = !depends.camera || baked.camera <= wanted.camera;
            before && unchanged(depends, &baked.origin, &wanted.origin)
        });
        let fits = |baked: &Baked| !depends.camera || baked.camera == wanted.camera;
        let baked = match earlier {
            Some(baked) if fits(&baked) => baked,
            earlier => {
                self.warm_up(wanted, with_frame)?;
                self.made += 1;
                let mut baked = make(wanted, earlier, wanted.camera, with_frame)?;
                baked.cost.serial = self.made;
                baked
            }
        };
        self.baked.push(baked);
        let baked = self.baked.last().expect("it was pushed");
        Ok((baked.bake.as_ref(), baked.cost.clone()))
    }

    /// Drops those of a variant: the next one is made anew.
    pub(crate) fn forget(&mut self, variant: usize) {
        self.baked.retain(|baked| baked.variant != variant);
    }

    /// Takes down that a cell tells of a bake; whether an earlier one did.
    pub(crate) fn tell(&mut self, cost: &BakeCost) -> bool {
        cost.serial > 0 && !self.told.insert(cost.serial)
    }

    /// Drops those that a scene cannot use.
    pub(crate) fn keep_for(
        &mut self,
        scene: &SceneHashes,
        depends: impl Fn(usize) -> Dependencies,
    ) {
        self.baked.retain(|baked| {
            let there = Origin { scene: scene.clone(), ..baked.origin };
            unchanged(depends(baked.variant), &baked.origin, &there)
        });
    }

    fn take(&mut self, wanted: &Wanted<'_>) -> Option<Baked> {
        let by_seed = wanted.baking.depends_on(wanted.parameters).seed;
        let place = self.baked.iter().position(|baked| {
            baked.variant == wanted.variant && (!by_seed || baked.origin.seed == wanted.origin.seed)
        })?;
        Some(self.baked.swap_remove(place))
    }

    /// Drivers compile at the first dispatch: what is made then is thrown away.
    fn warm_up(&mut self, wanted: &Wanted<'_>, with_frame: WithFrame<'_>) -> Result<(), Error> {
        let grows = wanted.baking.depends_on(wanted.parameters).camera && wanted.camera > 0;
        if wanted.baking.processor(wanted.parameters) == Processor::Gpu
            && self.warm.insert((wanted.variant, grows))
        {
            make(wanted, None, wanted.camera.min(1), with_frame)?;
        }
        Ok(())
    }
}

fn unchanged(depends: Dependencies, a: &Origin, b: &Origin) -> bool {
    let Dependencies { scene, lights, camera: _, seed, amount } = depends;
    (!scene || a.scene.unlit == b.scene.unlit)
        && (!lights || a.scene.lit == b.scene.lit)
        && (!seed || a.seed == b.seed)
        && (!amount || a.amount == b.amount)
}

/// From `earlier` on, or from the first camera, camera by camera up to the last one.
fn make(
    wanted: &Wanted<'_>,
    earlier: Option<Baked>,
    last: usize,
    with_frame: WithFrame<'_>,
) -> Result<Baked, Error> {
    let Wanted { variant, baking, parameters, .. } = *wanted;
    let by_camera = baking.depends_on(parameters).camera;
    let start = earlier.as_ref().map_or(if by_camera { 0 } else { last }, |baked| baked.camera + 1);
    let mut baked = earlier;
    for camera in start..=last {
        with_frame(camera, &mut |frame| {
            let (bake, cost) = match baked.take() {
                None => once(baking, frame, parameters)?,
                Some(baked) => grown(baked.bake, frame, parameters)?,
            };
            let origin = wanted.origin.clone();
            baked = Some(Baked { variant, origin, camera, bake, cost });
            Ok(())
        })?;
    }
    Ok(baked.expect("there is a camera"))
}

fn grown(
    mut bake: Box<dyn Bake>,
    frame: &Frame<'_>,
    parameters: &Parameters,
) -> Result<(Box<dyn Bake>, BakeCost), Error> {
    let before = passes(bake.as_ref());
    let clock = Instant::now();
    bake.grow(frame, parameters)?;
    let cost = cost(bake.as_ref(), clock.elapsed().as_secs_f64(), &before);
    Ok((bake, cost))
}

fn passes(bake: &dyn Bake) -> BTreeMap<String, f64> {
    bake.pass_times().into_iter().map(|time| (time.pass.to_owned(), time.seconds)).collect()
}

/// Of a bake that took `seconds` since its passes had taken those `before`.
fn cost(bake: &dyn Bake, seconds: f64, before: &BTreeMap<String, f64>) -> BakeCost {
    let mut pass_seconds = passes(bake);
    for (pass, seconds) in &mut pass_seconds {
        *seconds -= before.get(pass).copied().unwrap_or(0.0);
    }
    let counters = bake.counters().into_iter().map(|(name, n)| (name.to_owned(), n)).collect();
    BakeCost { seconds, pass_seconds, counters, serial: 0 }
}

/// A bake for one frame alone, by the clock.
///
/// # Errors
/// Those of the method.
pub(crate) fn once(
    baking: &dyn Baking,
    frame: &Frame<'_>,
    parameters: &Parameters,
) -> Result<(Box<dyn Bake>, BakeCost), Error> {
    let clock = Instant::now();
    let bake = baking.bake(frame, parameters)?;
    let cost = cost(bake.as_ref(), clock.elapsed().as_secs_f64(), &BTreeMap::new());
    Ok((bake, cost))
}
