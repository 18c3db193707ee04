//! A spherical cap and the receiver's horizon, in f64: what `shaders/horizon.wesl` does.

use std::f64::consts::{FRAC_PI_2, PI};

use manylights_harmonics::zonal::Cap;

use crate::Horizon;

/// Below this sine a cap is a planar disc, sin² a of it wrong; above, the closed form keeps 3e-7 of
/// sin a. The shader has a form without a switch.
const PLANAR: f64 = 1e-3;

/// H, the share of a cap above the horizon; `cosine` between the cap's axis and the normal.
pub fn above(horizon: Horizon, cosine: f64, cap: Cap<f64>) -> f64 {
    let cosine = cosine.clamp(-1.0, 1.0);
    let a = cap.sine.asin();
    match horizon {
        Horizon::Smooth => {
            let upper = a + FRAC_PI_2;
            let angle = cosine.acos().clamp(FRAC_PI_2 - a, upper);
            let x = (upper - angle) / (2.0 * a);
            x * x * (3.0 - 2.0 * x)
        }
        Horizon::Exact => {
            let x = (cosine / cap.sine).clamp(-1.0, 1.0);
            let level = ((1.0 - cosine) * (1.0 + cosine)).sqrt().max(1e-12);
            let y = (x * cap.cosine / level).clamp(-1.0, 1.0);
            let chord = x * (1.0 - x * x).sqrt() / level;
            let versine = cap.versine();
            // asin(versine chord) is its argument to 1e-16 where versine is so small.
            let lens =
                if versine < 1e-10 { chord } else { (versine * chord).min(1.0).asin() / versine };
            (0.5 + (lens + y.asin()) / PI).clamp(0.0, 1.0)
        }
    }
}

/// ∫ max(0, n·ω) dω over a cap, over the square of its sine: π cos d where the whole cap is above the
/// horizon. With x = cos d / sin a of a cap that the horizon cuts it is
/// (G + B sin² a cos d − sin a cos a √(1 − x²))/sin² a, tan G = tan a √(1 − x²), tan B = −√(1 − x²)/(x cos a);
/// of a small one sin a (2/3 (1 − x²)^3/2 + x (π/2 + asin x + x √(1 − x²))), a disc's.
pub fn irradiance(cosine: f64, cap: Cap<f64>) -> f64 {
    let x = cosine / cap.sine;
    if x >= 1.0 {
        return PI * cosine;
    }
    if x <= -1.0 {
        return 0.0;
    }
    let chord = ((1.0 - x) * (1.0 + x)).sqrt();
    if cap.sine < PLANAR {
        let segment = FRAC_PI_2 + x.asin() + x * chord;
        return cap.sine * (2.0 / 3.0 * chord.powi(3) + x * segment);
    }
    let g = (cap.sine * chord).atan2(cap.cosine);
    let b = chord.atan2(-x * cap.cosine);
    (g - cap.sine * cap.cosine * chord) / (cap.sine * cap.sine) + b * cosine
}
