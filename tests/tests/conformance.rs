//! What every registered method promises, on every built-in scene and transport, and under lights with a
//! surface.

use std::collections::BTreeSet;

use manylights_harness::registry::METHODS;
use manylights_method::{Amounts, Baking, CounterInfo, Error, Method, Parameters, Run};
use manylights_metrics::RadianceImage;
use manylights_scene::builtin::BUILTINS;
use manylights_scene::{Transport, Visibility};
use manylights_tests::{Stage, under_spheres, under_triangles};

const RESOLUTION: [u32; 2] = [12, 9];

/// One of each kind, with both visibilities of a last segment.
fn transports() -> BTreeSet<Transport> {
    let kinds = ["direct", "indirect-1", "indirect-2", "direct+indirect-1", "all"];
    let kinds = kinds.map(|kind| kind.parse::<Transport>().expect("a transport"));
    for kind in kinds {
        // Who adds a kind adds it above.
        match kind {
            Transport::Direct { .. }
            | Transport::Indirect { .. }
            | Transport::DirectAndIndirect { .. }
            | Transport::All => {}
        }
    }
    let visibilities = [Visibility::Traced, Visibility::Ignored];
    kinds.iter().flat_map(|kind| visibilities.map(|v| kind.with_visibility(v))).collect()
}

/// A run to its end, whose progress only grows and whose counters are those that are documented.
fn finished(mut run: Box<dyn Run + '_>, documented: &[CounterInfo], what: &str) -> RadianceImage {
    let mut before = 0;
    loop {
        let progress = run.step().unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(progress.done > before || progress.finished(), "{what} stands still: {progress:?}");
        assert!(before <= progress.done && progress.done <= progress.total, "{what}: {progress:?}");
        before = progress.done;
        if progress.finished() {
            break;
        }
    }
    // Those that the parameters have a use for, in the order of all.
    let mut documented = documented.iter().map(|info| info.name);
    for (name, _) in run.counters() {
        assert!(documented.any(|known| known == name), "{what} counts {name}");
    }
    run.resolve().unwrap_or_else(|error| panic!("{what}: {error}"))
}

/// The parameters with the cost parameter, where there is one, at the amount that a method allows nearest
/// to this one.
fn work(method: &dyn Method, amount: u32) -> Parameters {
    let defaults = Parameters::defaults(method.parameters());
    let Some(cost) = method.cost() else { return defaults };
    let amounts = Amounts::new(cost, method.parameters()).expect("a cost");
    defaults.with_number(cost.parameter, amounts.nearest(amount.into()))
}

/// The picture of a method with this much work; `None` where it declines, with a reason of one line.
fn picture(
    stage: &Stage,
    method: &dyn Method,
    transport: Transport,
    (amount, seed): (u32, u64),
) -> Option<RadianceImage> {
    let what = format!("{} on {}, {transport:?}", method.id(), stage.scene.name);
    match method.prepare(&stage.frame(transport, seed), &work(method, amount)) {
        Ok(run) => Some(finished(run, method.counters(), &what)),
        Err(Error::Declined(reason)) => {
            assert!(reason.len() > 10 && reason.lines().count() == 1, "{what}: {reason}");
            None
        }
        Err(error) => panic!("{what}: {error}"),
    }
}

/// The picture of [`picture`] with 33 and 1 from what was baked, by one bake for two frames.
fn baked(
    stage: &Stage,
    baking: &dyn Baking,
    method: &dyn Method,
    transport: Transport,
) -> RadianceImage {
    let what = format!("{} on {}, {transport:?}, baked", method.id(), stage.scene.name);
    let parameters = work(method, 33);
    // Of another seed, where it may serve both.
    let first = if baking.depends_on(&parameters).seed { 1 } else { 2 };
    let bake = baking.bake(&stage.frame(transport, first), &parameters).expect("a bake");
    let counters: Vec<_> = bake.counters().iter().map(|(name, _)| *name).collect();
    assert!(baking.counters().iter().map(|info| info.name).eq(counters), "counters of {what}");
    let render = |seed| {
        let run = bake.prepare(&stage.frame(transport, seed), &parameters).expect("a run");
        finished(run, method.counters(), &what)
    };
    render(first);
    render(1)
}

#[test]
fn methods_decline_or_give_a_finite_picture_that_the_seed_decides_where_chance_does() {
    let mut rendered = BTreeSet::new();
    let builtins = BUILTINS.iter().map(|builtin| (builtin.make)());
    for scene in builtins.chain([under_spheres(5), under_triangles(5)]) {
        let stage = Stage::new(scene, RESOLUTION);
        for method in METHODS {
            for transport in transports() {
                let what = format!("{} on {}, {transport:?}", method.id(), stage.scene.name);
                let render = |amount, seed| picture(&stage, *method, transport, (amount, seed));
                let Some(image) = render(33, 1) else { continue };
                rendered.insert(method.id());
                assert_eq!([image.width, image.height], RESOLUTION, "{what}");
                let values = image.pixels.as_flattened();
                assert!(values.iter().all(|v| v.is_finite() && *v >= 0.0), "{what}");
                assert!(values.iter().any(|v| *v > 0.0), "{what} is black");
                let again = render(33, 1).expect("a picture");
                assert!(again == image, "{what}: the same seed, another picture");
                // What chance has no part in is exact: more work changes nothing either.
                let more = || method.cost().map(|_| render(70, 1).expect("a picture"));
                let exact = || more().is_some_and(|more| more == image);
                let other = render(33, 2).expect("a picture");
                if method.is_random() {
                    assert!(other != image || exact(), "{what}: the seed does not reach it");
                } else {
                    assert!(other == image, "{what}: the seed reaches it");
                }
                if let Some(baking) = method.baking() {
                    let baked = baked(&stage, baking, *method, transport);
                    assert!(baked == image, "{what}: another picture from a bake");
                }
            }
        }
    }
    let all: BTreeSet<_> = METHODS.iter().map(|method| method.id()).collect();
    assert_eq!(rendered, all, "a method declines everything");
}
