//! Potential flow about a spheroid longer than it is thick: a fuselage as the rotor's air meets it [lamb1932].

use serde::{Deserialize, Serialize};

/// A body of revolution in air, moving without turning.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Spheroid {
    /// Centre [m, `_h`].
    pub centre: [f64; 3],
    /// Unit vector along it [`_h`].
    pub axis: [f64; 3],
    /// Half its length [m].
    pub half_length: f64,
    /// Half its thickness, less than half its length [m].
    pub half_width: f64,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Along the axis and across it: h(zeta) = ln((zeta + 1)/(zeta - 1))/2 - 1/zeta, g(zeta) = ln(...)/2 - zeta/(zeta^2 - 1), each with
/// its derivative.
fn potentials(zeta: f64) -> [(f64, f64); 2] {
    let (half_log, square) = (0.5 * ((zeta + 1.0) / (zeta - 1.0)).ln(), zeta * zeta - 1.0);
    [
        (half_log - 1.0 / zeta, -1.0 / (zeta * zeta * square)),
        (half_log - zeta / square, 2.0 / (square * square)),
    ]
}

impl Spheroid {
    /// Velocity [m/s, `_h`] of the air at `point` [m, `_h`], at rest far away, as the body moves through it at `motion` [m/s, `_h`]; none
    /// inside.
    ///
    /// With the coordinate zeta of confocal spheroids, c the distance of the foci from the centre, x along the axis and y across it
    /// in the direction of the motion: phi = A x h(zeta) + B y g(zeta), A and B such that no air passes zeta_0 = a/c, the body.
    pub fn velocity(&self, motion: [f64; 3], point: [f64; 3]) -> [f64; 3] {
        let focus = (self.half_length.powi(2) - self.half_width.powi(2)).sqrt();
        let from = std::array::from_fn(|i| point[i] - self.centre[i]);
        let x = dot(from, self.axis);
        let beside: [f64; 3] = std::array::from_fn(|i| from[i] - x * self.axis[i]);
        let beside_square = dot(beside, beside);
        let [r1, r2] = [x + focus, x - focus].map(|along| (along * along + beside_square).sqrt());
        let (zeta, body) = (0.5 * (r1 + r2) / focus, self.half_length / focus);
        if zeta < body {
            return [0.0; 3];
        }
        let along = dot(motion, self.axis);
        let across: [f64; 3] = std::array::from_fn(|i| motion[i] - along * self.axis[i]);
        let [(h_0, h_0_slope), (g_0, g_0_slope)] = potentials(body);
        let a = along / (h_0 + body * h_0_slope);
        let b = 1.0 / (g_0 + g_0_slope * (body * body - 1.0) / body);
        let [(h, h_slope), (g, g_slope)] = potentials(zeta);
        // gradient of zeta: along the axis, and per length across it
        let zeta_along = 0.5 * ((x + focus) / r1 + (x - focus) / r2) / focus;
        let zeta_across = 0.5 * (1.0 / r1 + 1.0 / r2) / focus;
        let y = dot(across, beside);
        let steep = a * x * h_slope + b * y * g_slope;
        std::array::from_fn(|i| {
            (a * h + steep * zeta_along) * self.axis[i] + b * g * across[i] + steep * zeta_across * beside[i]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: Spheroid =
        Spheroid { centre: [0.4, -0.3, -1.5], axis: [0.8, 0.0, 0.6], half_length: 4.0, half_width: 1.2 };
    const MOTION: [f64; 3] = [-30.0, 4.0, -6.0];

    /// A point of the surface and the normal there.
    fn surface(along: f64, angle: f64) -> ([f64; 3], [f64; 3]) {
        let (up, side) = ([-0.6, 0.0, 0.8], [0.0, 1.0, 0.0]);
        let (x, r) = (along * BODY.half_length, BODY.half_width * (1.0 - along * along).sqrt());
        let beside: [f64; 3] = std::array::from_fn(|i| angle.cos() * side[i] + angle.sin() * up[i]);
        let point = std::array::from_fn(|i| BODY.centre[i] + x * BODY.axis[i] + r * beside[i]);
        let (nx, nr) = (x / BODY.half_length.powi(2), r / BODY.half_width.powi(2));
        (point, std::array::from_fn(|i| nx * BODY.axis[i] + nr * beside[i]))
    }

    #[test]
    fn no_air_passes_the_body() {
        for k in 0..40 {
            let (point, normal) = surface(-0.97 + 0.05 * f64::from(k), 0.7 * f64::from(k));
            // a hair outside
            let outside = std::array::from_fn(|i| point[i] + 1e-9 * normal[i]);
            let v = BODY.velocity(MOTION, outside);
            let slip: [f64; 3] = std::array::from_fn(|i| v[i] - MOTION[i]);
            assert!(dot(slip, normal).abs() < 1e-6 * dot(normal, normal).sqrt() * 30.0, "{k}");
        }
    }

    #[test]
    fn air_has_neither_sources_nor_rotation() {
        let point = [2.0, 1.0, 1.1];
        let step = 1e-4;
        let slope = |axis: usize| -> [f64; 3] {
            let at = |sign: f64| {
                let mut p = point;
                p[axis] += sign * step;
                BODY.velocity(MOTION, p)
            };
            let (ahead, behind) = (at(1.0), at(-1.0));
            std::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * step))
        };
        let d = [slope(0), slope(1), slope(2)];
        assert!((d[0][0] + d[1][1] + d[2][2]).abs() < 1e-6);
        assert!((d[0][1] - d[1][0]).abs() < 1e-6 && (d[0][2] - d[2][0]).abs() < 1e-6);
        assert!((d[1][2] - d[2][1]).abs() < 1e-6);
    }

    #[test]
    fn a_nearly_round_body_is_a_sphere_and_air_inside_is_none() {
        let ball = Spheroid { half_length: 1.0, half_width: 0.999_999, ..BODY };
        let from = [1.5, -2.0, 1.0];
        let r = dot(from, from).sqrt();
        let point = std::array::from_fn(|i| ball.centre[i] + from[i]);
        let v = ball.velocity(MOTION, point);
        let outward = dot(MOTION, from);
        for i in 0..3 {
            // dipole of a sphere: (3 (U.r) r/r^2 - U) / (2 r^3)
            let exact = (3.0 * outward * from[i] / (r * r) - MOTION[i]) / (2.0 * r.powi(3));
            assert!((v[i] - exact).abs() < 1e-3, "{v:?}");
        }
        assert_eq!(BODY.velocity(MOTION, BODY.centre), [0.0; 3]);
    }
}
