//! What a reflectance is expanded in, and how its bands are damped.

use manylights_harmonics::window::Window;

/// What the reflectance of the shaded point is expanded in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Spherical harmonics: any isotropic lobe.
    Full,
    /// Zonal harmonics about the lobe's own axis: one circular lobe, and the Lambertian one in closed
    /// form (thesis 5.2.7).
    Zonal,
}

/// What the bands of the reflectance are damped by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Nothing.
    None,
    /// A window as wide as the expansion.
    Window(Window),
    /// For each row of a table the weakest [`Window::SincFourth`] under which it is not negative
    /// ([`manylights_harmonics::dering`]).
    Weakest,
}
