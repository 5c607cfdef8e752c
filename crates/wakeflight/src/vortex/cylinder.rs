//! The semi-infinite vortex cylinder: what a regular helical wake leaves behind, seen from some way off.

use crate::numerics::elliptic::cel;
use std::f64::consts::PI;

/// Vorticity of constant strength around a circular cylinder that begins at `top` and goes down without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexCylinder {
    /// Axis, along z [m].
    pub axis: [f64; 2],
    /// Begin [m].
    pub top: f64,
    /// Radius [m].
    pub radius: f64,
    /// Circulation per length [m/s]; positive moves the air inside down.
    pub strength: f64,
    /// Length over which the edge at `top` is smoothed, so that points on it have a finite radial velocity [m].
    pub smoothing: f64,
}

impl VortexCylinder {
    /// Velocity at `point` [m/s] [branlard2014], the integrals written so that no digits are lost near axis and edge.
    ///
    /// With s the depth below the top, R the radius, q = (R - r)/(R + r), m = 4 r R/((R + r)^2 + s^2): down
    /// gamma/2 [1 inside, 0 outside + s/(pi sqrt((R + r)^2 + s^2)) (K(m) + q Pi(1 - q^2, m))], outward
    /// -gamma R/(pi sqrt((R + r)^2 + s^2)) [(2 - m) K(m) - 2 E(m)]/m.
    pub fn velocity(&self, point: [f64; 3]) -> [f64; 3] {
        let (x, y) = (point[0] - self.axis[0], point[1] - self.axis[1]);
        let (r, s, radius) = (x.hypot(y), self.top - point[2], self.radius);
        let near = (radius - r).powi(2) + s * s;
        let far = (radius + r).powi(2) + s * s;
        let q = (radius - r) / (radius + r);
        let mut down = 0.5 * (1.0 + if q == 0.0 { 0.0 } else { q.signum() });
        if s != 0.0 {
            let kc = (near / far).sqrt();
            let third = if q == 0.0 { 0.0 } else { q * cel(kc, q * q, 1.0, 1.0) };
            down += s / (PI * far.sqrt()) * (cel(kc, 1.0, 1.0, 1.0) + third);
        }
        let smooth = self.smoothing * self.smoothing;
        let edge = cel(((near + smooth) / (far + smooth)).sqrt(), 1.0, -1.0, 1.0) / (far + smooth).sqrt();
        let outward = if r > 0.0 { -self.strength * radius / PI * edge / r } else { 0.0 };
        [outward * x, outward * y, -0.5 * self.strength * down]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vortex::core::{Core, CoreDistance};
    use crate::vortex::induced_velocity::{Segments, add_segments_velocity};

    /// The same by rings of straight segments, close at first, ever farther apart: the rest beyond is a dipole sheet.
    fn by_rings(cylinder: &VortexCylinder, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (mut segments, sides, n) = (Segments::default(), 360, 3000);
        let mut push = |z: f64, gamma: f64| {
            let corner = |i: usize| {
                let angle = -std::f64::consts::TAU * i as f64 / f64::from(sides);
                [cylinder.radius * angle.cos(), cylinder.radius * angle.sin(), z]
            };
            for i in 0..sides as usize {
                segments.start.push(corner(i));
                segments.end.push(corner(i + 1));
                segments.circulation.push(gamma);
                segments.core_radius.push(0.0);
            }
        };
        // depth 200 t^3: middles of n steps in t
        for i in 0..n {
            let t = |i: f64| 200.0 * (i / f64::from(n)).powi(3);
            let (a, b) = (t(f64::from(i)), t(f64::from(i) + 1.0));
            push(cylinder.top - 0.5 * (a + b), cylinder.strength * (b - a));
        }
        let mut velocity = vec![[0.0; 3]; points.len()];
        add_segments_velocity(points, &segments, Core::Vatistas2, CoreDistance::Segment, &mut velocity);
        velocity
    }

    #[test]
    fn verif_cylinder_is_a_stack_of_rings() {
        let cylinder =
            VortexCylinder { axis: [0.0; 2], top: -0.3, radius: 0.8, strength: 1.7, smoothing: 0.0 };
        let points = [
            [0.0, 0.0, 0.4],
            [0.3, 0.1, 0.0],
            [0.0, 0.75, -0.2],
            [0.8, 0.0, 0.0],
            [1.5, 0.0, -0.9],
            [0.2, -0.3, -2.0],
        ];
        for (point, rings) in points.iter().zip(by_rings(&cylinder, &points)) {
            let found = cylinder.velocity(*point);
            for c in 0..3 {
                assert!(
                    (found[c] - rings[c]).abs() < 2e-4 * cylinder.strength,
                    "{point:?}: {found:?} {rings:?}"
                );
            }
        }
        // on the axis, far down, far up
        let axial = |z: f64| -cylinder.velocity([0.0, 0.0, z])[2] / cylinder.strength;
        assert!((axial(-0.3) - 0.5).abs() < 1e-15);
        assert!((axial(-1e4) - 1.0).abs() < 1e-8 && axial(1e4).abs() < 1e-8);
        assert!((axial(0.3) - 0.5 * (1.0 - 0.6 / 0.6f64.hypot(0.8))).abs() < 1e-14);
    }

    #[test]
    fn the_edge_is_finite() {
        let cylinder =
            VortexCylinder { axis: [0.1, 0.2], top: 1.0, radius: 0.5, strength: 2.0, smoothing: 0.05 };
        for point in [[0.6, 0.2, 1.0], [0.1, 0.2, 1.0], [0.6, 0.2, 0.5], [0.6 + 1e-17, 0.2, 1.0 - 1e-16]] {
            assert!(cylinder.velocity(point).iter().all(|v| v.is_finite() && v.abs() < 2.0), "{point:?}");
        }
    }
}
