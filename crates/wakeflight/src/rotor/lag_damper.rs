//! Hydraulic lag damper: geometry and force.

use crate::numerics::scalar::Real;
use crate::numerics::tables::Table;
use serde::Deserialize;

/// Geometry [m, rad] and axial force of the damper; letters as in the aircraft data's drawing.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LagDamper {
    /// Offset a [m].
    pub a: f64,
    /// Offset b [m].
    pub b: f64,
    /// Offset c [m].
    pub c: f64,
    /// Offset d [m].
    pub d: f64,
    /// Pitch-horn radius r [m].
    pub r: f64,
    /// Added to the root pitch [rad].
    pub theta_geo: f64,
    /// Added to the lead angle [rad].
    pub zeta_geo: f64,
    /// Axial force [N] against axial rate [m/s], rates >= 0; the function is odd, held beyond its end.
    pub force: Table,
    /// Hinge spring, neutral at lead = -zeta_geo [N m/rad]; zero when off.
    pub spring_rate: f64,
}

impl LagDamper {
    /// Length [m] and its gradient with (lead, flap, pitch) [m/rad] [howlett1981].
    ///
    /// With s = lead + zeta_geo, theta = pitch + theta_geo, beta = flap:
    /// x = a sin beta + c + (b cos s + d sin s) cos beta, y = -r cos theta - b sin s + d cos s,
    /// z = a cos beta - r sin theta - (b cos s + d sin s) sin beta, L = |(x, y, z)|.
    #[inline(always)]
    pub fn length_and_gradient<S: Real>(&self, lead: S, flap: S, pitch: S) -> (S, [S; 3]) {
        let (ss, cs) = (lead + self.zeta_geo).sin_cos();
        let (sb, cb) = flap.sin_cos();
        let (st, ct) = (pitch + self.theta_geo).sin_cos();
        let arm = cs * self.b + ss * self.d;
        // derivative of the arm with lead; also the y offset of the rod end
        let across = cs * self.d - ss * self.b;
        let x = sb * self.a + self.c + arm * cb;
        let y = across - ct * self.r;
        let z = cb * self.a - st * self.r - arm * sb;
        let length = (x * x + y * y + z * z).sqrt();
        let by_lead = x * across * cb - y * arm - z * across * sb;
        let by_flap = x * (cb * self.a - arm * sb) - z * (sb * self.a + arm * cb);
        let by_pitch = y * st * self.r - z * ct * self.r;
        (length, [by_lead / length, by_flap / length, by_pitch / length])
    }

    /// Axial force [N], of the sign of the stroke rate, and the gradient dL/d(lead, flap, pitch) [m/rad].
    ///
    /// The force opposes the stroke: generalised moment on each angle = -force dL/dangle.
    /// Angles [rad], rates [rad/s]; lead forward +, flap up +, root pitch nose up + with the wind-up of the root.
    #[inline(always)]
    pub fn force_and_gradient<S: Real>(
        &self,
        lead: S,
        flap: S,
        pitch: S,
        lead_dot: S,
        flap_dot: S,
        pitch_dot: S,
    ) -> (S, [S; 3]) {
        let (_, gradient) = self.length_and_gradient(lead, flap, pitch);
        let rate = gradient[0] * lead_dot + gradient[1] * flap_dot + gradient[2] * pitch_dot;
        let force = if rate.re() < 0.0 { -self.force.at(-rate) } else { self.force.at(rate) };
        (force, gradient)
    }

    /// Moment of the hinge spring on the lead angle [N m], -spring_rate (lead + zeta_geo).
    #[inline(always)]
    pub fn spring_moment<S: Real>(&self, lead: S) -> S {
        (lead + self.zeta_geo) * -self.spring_rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    const INCH: f64 = 0.0254;

    fn damper() -> LagDamper {
        LagDamper {
            a: 0.0057658,
            b: 0.0823468,
            c: 0.305816,
            d: 0.25425908,
            r: 0.1752092,
            theta_geo: 0.0,
            zeta_geo: 0.12217305,
            force: Table { x: vec![0.0, 0.0254, 0.0508], y: vec![0.0, 13122.3, 16300.0] },
            spring_rate: 20418.618,
        }
    }

    fn deg(angle: f64) -> f64 {
        angle.to_radians()
    }

    /// Published stroke per radian at 4 deg lag and 2.8 deg flap.
    #[test]
    fn stroke_per_angle_is_the_published_one() {
        let g =
            |theta: f64| damper().length_and_gradient(deg(-4.0), deg(2.8), deg(theta)).1.map(|v| v / INCH);
        let at17 = g(17.0);
        // printed as 8.85; 8.856 agrees with the published 9800 ft lb/(rad/s), so the last digit was cut
        assert!((at17[0] - 8.856).abs() < 0.0005, "dL/dlead {}", at17[0]);
        assert!((at17[1] - 0.50).abs() < 0.005, "dL/dflap {}", at17[1]);
        assert!((at17[2] - 1.2).abs() < 0.05, "dL/dpitch {}", at17[2]);
        assert!((g(10.0)[2] - 0.7).abs() < 0.05 && (g(15.0)[2] - 1.06).abs() < 0.005);
    }

    /// 1500 lb/(in/s) times the stroke squared is the published 9800 ft lb/(rad/s).
    #[test]
    fn equivalent_hinge_damping_is_the_published_one() {
        let (_, g) = damper().length_and_gradient(deg(-4.0), deg(2.8), deg(17.0));
        let damping = 262_690.25 * g[0] * g[0];
        assert!((damping / 13_287.016 - 1.0).abs() < 5e-3, "{damping}");
    }

    #[test]
    fn gradient_is_the_derivative_of_length() {
        let d = damper();
        let (length, g) = d.length_and_gradient(
            Dual::<3>::variable(-0.07, 0),
            Dual::<3>::variable(0.05, 1),
            Dual::<3>::variable(0.3, 2),
        );
        for (g, l) in g.iter().zip(length.eps) {
            assert!((g.re - l).abs() < 1e-15);
        }
    }

    #[test]
    fn force_opposes_the_stroke_is_odd_and_dissipates() {
        let d = damper();
        let at = |lead, flap, pitch| d.force_and_gradient(-0.07, 0.05, 0.3, lead, flap, pitch);
        for (l, f, p) in [(0.1, 0.0, 0.0), (0.0, 3.0, -8.0), (-0.2, 1.0, 5.0), (40.0, 0.0, 0.0)] {
            let (force, g) = at(l, f, p);
            let (mirrored, _) = at(-l, -f, -p);
            assert_eq!(force, -mirrored);
            let power = -force * (g[0] * l + g[1] * f + g[2] * p);
            assert!(power < 0.0);
        }
        // held beyond the end of the table
        assert_eq!(at(40.0, 0.0, 0.0).0, 16300.0);
    }

    #[test]
    fn derivatives_of_the_force_equal_central_differences() {
        let d = damper();
        let x = [-0.07, 0.05, 0.3, 0.05, 0.4, -1.0];
        let v: [Dual<6>; 6] = std::array::from_fn(|i| Dual::variable(x[i], i));
        let (force, g) = d.force_and_gradient(v[0], v[1], v[2], v[3], v[4], v[5]);
        for i in 0..6 {
            let h = 1e-6;
            let (mut up, mut down) = (x, x);
            up[i] += h;
            down[i] -= h;
            let f = |x: [f64; 6]| d.force_and_gradient(x[0], x[1], x[2], x[3], x[4], x[5]);
            let ((fu, gu), (fd, gd)) = (f(up), f(down));
            assert!((force.eps[i] - (fu - fd) / (2.0 * h)).abs() < 1e-4);
            for k in 0..3 {
                assert!((g[k].eps[i] - (gu[k] - gd[k]) / (2.0 * h)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_spring_is_neutral_seven_degrees_aft() {
        let d = damper();
        assert!(d.spring_moment(-d.zeta_geo).abs() < 1e-12);
        assert!(d.spring_moment(0.0) < 0.0);
    }
}
