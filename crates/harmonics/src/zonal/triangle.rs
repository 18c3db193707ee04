//! What a point sees of a triangle of light with a sphere in its stead (thesis 4.2), and how that changes as
//! the point moves.
//!
//! The sphere lies at the centroid and has the triangle's area as its disk's (4.7, 4.8). Whatever the form,
//! the coefficients are c_l Y_lm(ω) about the direction ω to the centroid.

use super::{Cap, cap_rate_stable, cap_stable};
use crate::Real;
use crate::polygon::{cross, difference, dot, solid_angle};

/// How a sphere stands for a triangle; t = r/d of the sphere, γ between the triangle's normal and ω, Ω its
/// solid angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleForm {
    /// The sphere itself.
    Sphere,
    /// |cos γ| times the sphere's (thesis 4.9–4.11).
    Main,
    /// A cap of the triangle's solid angle (thesis 4.14–4.16), without their arc cosine: cos a = 1 − Ω/2π,
    /// sin² a = Ω/π (1 − Ω/4π), ∂c_l/∂Ω = P_l(cos a).
    SolidAngle,
    /// sin a = t |cos γ| (thesis 4.17), whose solid angle is wrong by |cos γ| at any distance.
    Compromise,
    /// sin a = t √|cos γ|, which is right for far triangles.
    CompromiseRoot,
    /// The sphere's, scaled to the triangle's solid angle.
    Scaled,
    /// A point of the triangle's solid angle.
    Point,
}

impl TriangleForm {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Sphere,
        Self::Main,
        Self::SolidAngle,
        Self::Compromise,
        Self::CompromiseRoot,
        Self::Scaled,
        Self::Point,
    ];
}

/// A triangle of radiance one as a point sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleSighting<R> {
    /// Unit vector ω from the point to the centroid.
    pub direction: [R; 3],
    /// Distance d of the centroid.
    pub distance: R,
    /// Of the sphere, √(area/π).
    pub radius: R,
    /// cos γ where the triangle shines to the point, 0 where it does not, or in its plane.
    pub facing: R,
    /// ∇_x of it.
    pub facing_gradient: [R; 3],
    /// Ω where it shines to the point, else 0, sr.
    pub solid_angle: R,
    /// ∇_x of it.
    pub solid_angle_gradient: [R; 3],
    shines: bool,
}

impl<R: Real> TriangleSighting<R> {
    /// Of corners as seen from the point, counter-clockwise from the front. A point at the centroid, which
    /// has no direction there, takes `at_centroid`. `None` for a triangle without area.
    pub fn new(corners: [[R; 3]; 3], two_sided: bool, at_centroid: [R; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let across = cross(difference(b, a), difference(c, a));
        let twice_area = dot(across, across).sqrt();
        if twice_area == R::zero() || !twice_area.is_finite() {
            return None;
        }
        let third = R::of(1.0 / 3.0);
        let offset = [0, 1, 2].map(|axis| (a[axis] + b[axis] + c[axis]) * third);
        let distance = dot(offset, offset).sqrt();
        let direction =
            if distance > R::zero() { offset.map(|c| c / distance) } else { at_centroid };
        // Of the side that the point is on.
        let cosine = -dot(across, offset);
        let side = if cosine > R::zero() { R::one() } else { -R::one() };
        let shines = two_sided || side > R::zero();
        let lit = if shines { side } else { R::zero() };
        let normal = across.map(|c| lit * c / twice_area);
        // Next to the plane the sign of the quotient may be another one than that of the product.
        let facing = if distance > R::zero() { -dot(normal, direction) } else { R::zero() };
        let facing = facing.max(R::zero());
        let turn = |axis: usize| (normal[axis] + facing * direction[axis]) / distance;
        let facing_gradient = if facing > R::zero() { [0, 1, 2].map(turn) } else { [R::zero(); 3] };
        // The sign is positive where corners run clockwise as the point sees them.
        let solid_angle = if shines { solid_angle(&corners).abs() } else { R::zero() };
        Some(Self {
            direction,
            distance,
            radius: (R::of(0.5) * twice_area / R::PI()).sqrt(),
            facing,
            facing_gradient,
            solid_angle,
            solid_angle_gradient: solid_angle_gradient(corners).map(|c| -lit * c),
            shines,
        })
    }

    /// c_l of a form, one a band.
    pub fn scales(&self, form: TriangleForm, scales: &mut [R]) {
        if form == TriangleForm::Point {
            scales.fill(self.solid_angle);
            return;
        }
        let Shape { cap, .. } = self.shape(form);
        cap_stable(cap, scales);
        let factor = match form {
            TriangleForm::Sphere if !self.shines => R::zero(),
            TriangleForm::Main => self.facing,
            TriangleForm::Scaled => self.solid_angle / (R::TAU() * cap.versine()),
            _ => R::one(),
        };
        scales.iter_mut().for_each(|scale| *scale *= factor);
    }

    /// ∇_x c_l, one a band. What is unbounded there is not finite: [`TriangleForm::Compromise`] and
    /// [`TriangleForm::CompromiseRoot`] where the cap is the hemisphere, all that hold a sphere on its
    /// surface.
    pub fn gradients(&self, form: TriangleForm, gradients: &mut [[R; 3]]) {
        let bands = gradients.len();
        if form == TriangleForm::Point {
            gradients.fill(self.solid_angle_gradient);
            return;
        }
        let Shape { cap, cosine_gradient } = self.shape(form);
        // −2π P_l(cos a), the change of c_l with cos a.
        let (mut scales, mut rates) = (vec![R::zero(); bands], vec![R::zero(); bands]);
        cap_stable(cap, &mut scales);
        cap_rate_stable(cap, R::one(), &mut rates);
        let (omega, of_omega) = (self.solid_angle, self.solid_angle_gradient);
        let whole = R::TAU() * cap.versine();
        let bands = scales.iter().zip(&rates).zip(gradients);
        for ((&scale, &rate), gradient) in bands {
            *gradient = [0, 1, 2].map(|axis| {
                let change = rate * cosine_gradient[axis];
                match form {
                    TriangleForm::Sphere if !self.shines => R::zero(),
                    TriangleForm::Main => self.facing * change + scale * self.facing_gradient[axis],
                    TriangleForm::Scaled => {
                        let share = scale / whole;
                        let of_whole = -R::TAU() * cosine_gradient[axis];
                        share * of_omega[axis] + omega * (change - share * of_whole) / whole
                    }
                    _ => change,
                }
            });
        }
    }

    /// ∇_x of the coefficients c_l Y_lm(ω): `values` holds the Y_lm(ω), bands² of them, `gradients` goes in
    /// as their tangential gradients on the unit sphere.
    ///
    /// # Panics
    /// Where the slices are not of one number of bands.
    pub fn coefficient_gradients(
        &self,
        form: TriangleForm,
        values: &[R],
        gradients: &mut [[R; 3]],
    ) {
        let bands = values.len().isqrt();
        assert_eq!([values.len(), gradients.len()], [bands * bands; 2]);
        let (mut scales, mut changes) = (vec![R::zero(); bands], vec![[R::zero(); 3]; bands]);
        self.scales(form, &mut scales);
        self.gradients(form, &mut changes);
        for (l, (&scale, change)) in scales.iter().zip(changes).enumerate() {
            for i in l * l..(l + 1) * (l + 1) {
                let [value, tangential] = [values[i], -scale / self.distance];
                gradients[i] =
                    [0, 1, 2].map(|axis| tangential * gradients[i][axis] + value * change[axis]);
            }
        }
    }

    /// The cap that a form takes and how its cosine changes with the point.
    fn shape(&self, form: TriangleForm) -> Shape<R> {
        let sphere = Cap::of_sphere(self.radius, self.distance);
        let (sine2, cosine2) = (sphere.sine * sphere.sine, sphere.cosine * sphere.cosine);
        // t² grows towards the centroid; within the sphere it is 1.
        let rate =
            if sphere.cosine > R::zero() { R::of(2.0) * sine2 / self.distance } else { R::zero() };
        let sine2_gradient = self.direction.map(|axis| rate * axis);
        let (facing, turn) = (self.facing, self.facing_gradient);
        let [zero, one, two] = [0.0, 1.0, 2.0].map(R::of);
        // cos² a as t² (1 − cos² γ) + (1 − t²), whose terms keep their digits.
        let sine_facing2 = ((one - facing) * (one + facing)).max(zero);
        let (factor, factor_gradient, rest) = match form {
            TriangleForm::SolidAngle => {
                let (omega, pi) = (self.solid_angle, R::PI());
                let sine = (omega / pi * (one - omega / (R::of(4.0) * pi))).sqrt();
                let cosine_gradient = self.solid_angle_gradient.map(|c| -c / R::TAU());
                return Shape {
                    cap: Cap { sine, cosine: one - omega / R::TAU() },
                    cosine_gradient,
                };
            }
            TriangleForm::Compromise => {
                (facing * facing, turn.map(|c| two * facing * c), sine_facing2)
            }
            TriangleForm::CompromiseRoot => (facing, turn, sine_facing2 / (one + facing)),
            _ => (one, [zero; 3], zero),
        };
        let cosine = (cosine2 + sine2 * rest).sqrt();
        let slope = |axis: usize| {
            let change = factor * sine2_gradient[axis] + sine2 * factor_gradient[axis];
            if change == zero { zero } else { -change / (two * cosine) }
        };
        Shape {
            cap: Cap { sine: (sine2 * factor).sqrt(), cosine },
            cosine_gradient: [0, 1, 2].map(slope),
        }
    }
}

struct Shape<R> {
    cap: Cap<R>,
    /// ∇_x cos a.
    cosine_gradient: [R; 3],
}

/// ∇_x of a triangle's signed solid angle: the boundary's Σ_e μ_e tan(γ_e/2) (1/|v_e| + 1/|v_f|) over edges
/// from v_e to v_f. Thesis 4.16 has the other sign, of corners in the other order, and (1 − cos γ)/sin γ, which divides by a
/// small sine.
fn solid_angle_gradient<R: Real>(corners: [[R; 3]; 3]) -> [R; 3] {
    let mut sum = [R::zero(); 3];
    for e in 0..3 {
        let (from, to) = (corners[e], corners[(e + 1) % 3]);
        let [near, far] = [from, to].map(|v| dot(v, v).sqrt());
        let across = cross(from, difference(to, from));
        let weight = (R::one() / near + R::one() / far) / (near * far + dot(from, to));
        sum = [0, 1, 2].map(|axis| sum[axis] + weight * across[axis]);
    }
    sum
}
