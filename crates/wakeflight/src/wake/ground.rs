//! Flat ground: rotor and wake have their mirror images in it, so that no air goes through.

use serde::{Deserialize, Serialize};

/// A plane that no air passes.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Plane {
    /// Unit vector out of the ground [`_h`].
    normal: [f64; 3],
    /// Height of the hub above it [m].
    height: f64,
}

impl Plane {
    /// With the unit vector `normal` out of the ground, the hub at `height` [m] above it.
    pub fn new(normal: [f64; 3], height: f64) -> Self {
        Self { normal, height }
    }

    /// Height of a point above the plane [m].
    pub fn above(&self, point: [f64; 3]) -> f64 {
        self.height + (0..3).map(|i| self.normal[i] * point[i]).sum::<f64>()
    }

    /// Image of a point.
    pub fn image(&self, point: [f64; 3]) -> [f64; 3] {
        self.across(point, self.above(point))
    }

    /// Image of a velocity.
    pub fn reflected(&self, velocity: [f64; 3]) -> [f64; 3] {
        self.across(velocity, (0..3).map(|i| self.normal[i] * velocity[i]).sum())
    }

    /// The point, or where it is below the plane the nearest one in it: there a vortex and its image cancel.
    pub fn held(&self, point: [f64; 3]) -> [f64; 3] {
        let below = self.above(point).min(0.0);
        std::array::from_fn(|i| point[i] - below * self.normal[i])
    }

    fn across(&self, vector: [f64; 3], along: f64) -> [f64; 3] {
        std::array::from_fn(|i| vector[i] - 2.0 * along * self.normal[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_velocities_are_mirrored() {
        let plane = Plane::new([0.6, 0.0, 0.8], 3.0);
        let (point, velocity) = ([1.0, -2.0, 0.5], [3.0, 1.0, -4.0]);
        let image = plane.image(point);
        assert!((plane.above(image) + plane.above(point)).abs() < 1e-14);
        assert_eq!(image[1], point[1]);
        let back = plane.image(image);
        assert!((0..3).all(|i| (back[i] - point[i]).abs() < 1e-14));
        assert!(plane.above(plane.held(image)).abs() < 1e-14 && plane.held(point) == point);
        let turned = plane.reflected(velocity);
        assert!((turned[0] * 0.6 + turned[2] * 0.8 + velocity[0] * 0.6 + velocity[2] * 0.8).abs() < 1e-14);
    }
}
