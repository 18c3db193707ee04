//! One run of a variant, with what it is baked from.

use manylights_method::{Bake, Error, Frame, Method, Parameters};

use crate::measurement::bakes::{BakeCost, Origin, Wanted};
use crate::measurement::measure::{self, Look, MeasuredRun};
use crate::measurement::scene_run::SceneRun;
use crate::measurement::session::Session;
use crate::measurement::stage::Stage;
use crate::question::plan::{Turn, Variant};

impl SceneRun<'_, '_> {
    /// One run, with the amount of work that a time budget allows where there is one.
    pub(crate) fn measure(
        &mut self,
        turn: Turn,
        amount: Option<f64>,
        look: Look<'_>,
    ) -> Result<MeasuredRun, Error> {
        let mut measured = self.with_bake(turn, amount, false, |method, frame, set, bake| {
            measure::measure(method, frame, set, bake, look)
        })?;
        measured.image = self.stage.completed(measured.image);
        Ok(measured)
    }

    /// What a bake takes that is made for this alone; nothing where the method makes none.
    pub(crate) fn measure_bake(
        &mut self,
        turn: Turn,
        amount: Option<f64>,
    ) -> Result<BakeCost, Error> {
        self.with_bake(turn, amount, true, |_, _, _, bake| {
            Ok(bake.map_or_else(BakeCost::default, |(_, cost)| cost))
        })
    }

    /// Calls with all that a run of a variant needs; the bake is one that is at hand, if there is one
    /// and it need not be made `anew`.
    fn with_bake<T>(
        &mut self,
        turn: Turn,
        amount: Option<f64>,
        anew: bool,
        call: impl FnOnce(
            &dyn Method,
            &Frame<'_>,
            &Parameters,
            Option<(&dyn Bake, BakeCost)>,
        ) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let Session { experiment, bakes, gpu, .. } = &mut *self.session;
        let Variant { method, parameters, visibility, .. } = &experiment.variants[turn.variant];
        let cost = method.cost().map(|cost| cost.parameter);
        let parameters = &match (cost, amount) {
            (Some(cost), Some(amount)) => parameters.with_number(cost, amount),
            _ => parameters.clone(),
        };
        let frame = self.stage.frame(*visibility, turn.seed);
        let Some(baking) = method.baking() else { return call(*method, &frame, parameters, None) };
        let origin = Origin {
            scene: self.hashes.clone(),
            seed: turn.seed,
            amount: cost.map(|cost| parameters.real(cost)),
        };
        let (variant, camera) = (turn.variant, self.camera);
        let wanted = Wanted { variant, baking, parameters, origin, camera };
        if anew {
            bakes.forget(variant);
        }
        let bake = bakes.get(&wanted, &|place, bake| {
            if place == camera {
                return bake(&frame);
            }
            let name = experiment.cameras()[place];
            let (transport, resolution) = (frame.transport, frame.resolution);
            let stage = Stage::new(frame.scene, name, transport, resolution, gpu.as_ref());
            let stage = stage.map_err(|failure| Error::Failed(failure.to_string()))?;
            bake(&stage.frame(*visibility, turn.seed))
        })?;
        call(*method, &frame, parameters, Some(bake))
    }
}
