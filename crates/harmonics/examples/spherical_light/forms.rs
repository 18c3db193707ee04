//! The whole of a spherical light: position and radius in, coefficients and their gradients out.

use manylights_harmonics::thesis::{SphericalGradients, to_cartesian};
use manylights_harmonics::zonal::{self, Sighting};
use manylights_harmonics::{Basis, Real, convolution, count};

/// Ways to the thesis' (∂θ, ∂φ), for `Light::thesis`.
pub(crate) type Angular<R> = fn(&SphericalGradients<R>, [R; 3], &mut [R], &mut [R], &mut [R]);

/// Tables and room for a number of bands.
pub(crate) struct Light<R> {
    basis: Basis<R>,
    spherical: SphericalGradients<R>,
    scales: Vec<R>,
    rates: Vec<R>,
    theta: Vec<R>,
    phi: Vec<R>,
    pub(crate) coefficients: Vec<R>,
    pub(crate) gradients: [Vec<R>; 3],
}

impl<R: Real> Light<R> {
    pub(crate) fn new(bands: usize) -> Self {
        let band = || vec![R::zero(); bands];
        let all = || vec![R::zero(); count(bands)];
        Self {
            basis: Basis::new(bands),
            spherical: SphericalGradients::new(bands),
            scales: band(),
            rates: band(),
            theta: all(),
            phi: all(),
            coefficients: all(),
            gradients: [all(), all(), all()],
        }
    }

    /// The stable form: what callers should use.
    pub(crate) fn stable(&mut self, offset: [R; 3], radius: R) {
        let sighting = Sighting::of_sphere(offset, radius).expect("a light at a distance");
        zonal::cap_stable(sighting.cap, &mut self.scales);
        zonal::cap_rate_stable(sighting.cap, sighting.cosine_rate, &mut self.rates);
        let slices = self.gradients.each_mut().map(|axis| axis.as_mut_slice());
        let direction = sighting.direction;
        self.basis.evaluate_with_gradient(direction, &mut self.coefficients, slices);
        self.combine(&sighting);
    }

    /// The thesis' analytical form: 3.10, 3.30–3.32, and the basis' gradients by `angular` and 3.15.
    pub(crate) fn thesis(&mut self, angular: Angular<R>, offset: [R; 3], radius: R) {
        let sighting = Sighting::of_sphere(offset, radius).expect("a light at a distance");
        zonal::cap_thesis(sighting.cap, &mut self.scales);
        zonal::cap_rate_thesis(sighting.cap, sighting.cosine_rate, &mut self.rates);
        let (direction, values) = (sighting.direction, &mut self.coefficients);
        angular(&self.spherical, direction, values, &mut self.theta, &mut self.phi);
        let slices = self.gradients.each_mut().map(|axis| axis.as_mut_slice());
        to_cartesian(direction, &self.theta, &self.phi, slices);
        self.combine(&sighting);
    }

    fn combine(&mut self, sighting: &Sighting<R>) {
        let slices = self.gradients.each_mut().map(|axis| axis.as_mut_slice());
        let values = &self.coefficients;
        zonal::light_gradient(sighting, &self.scales, &self.rates, values, slices);
        convolution::convolve(&self.scales, &mut self.coefficients);
    }
}
