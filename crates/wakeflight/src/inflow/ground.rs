//! Ground under a rotor with dynamic inflow.

use super::momentum::TINY;
use crate::numerics::scalar::Real;

/// Least height over R that the law is taken at: below it is beyond what it was compared with.
const LEAST_HEIGHT: f64 = 0.4;

/// Mean inflow at the same thrust over that away from the ground; `height` of the hub over R, `total` inflow through the disk.
///
/// The rotor's image as a source takes the share s = (R/4z)^2/(1 + (mu/lambda)^2) off the inflow [cheeseman1955]; at constant power
/// the thrust grows by 1/(1 - s), which is what that source states. Power goes with thrust^(3/2), so that at constant thrust the
/// inflow is (1 - s)^(3/2) of that away from the ground. Not modelled: what the ground does to its harmonics.
pub fn ground_factor<S: Real>(height: S, mu_squared: S, total: S) -> S {
    let height = if height.re() < LEAST_HEIGHT { S::cst(LEAST_HEIGHT) } else { height };
    let flow = total.squared() + TINY;
    let share = flow / ((height * 4.0).squared() * (flow + mu_squared));
    let rest = S::one() - share;
    rest * rest.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thrust_at_constant_power_grows_as_published() {
        for (height, ratio) in [(0.5_f64, 4.0 / 3.0), (1.0, 16.0 / 15.0), (2.0, 64.0 / 63.0)] {
            let factor = ground_factor(height, 0.0, 0.05);
            // T^(3/2) factor = constant
            assert!((factor.powf(-2.0 / 3.0) - ratio).abs() < 1e-12, "{height}");
        }
        // the wind of forward flight takes the image away
        assert!(ground_factor(1.0, 0.07_f64.powi(2), 0.02) > 0.99);
        assert!(ground_factor(4.0, 0.0, 0.05) > 0.994);
        assert_eq!(ground_factor(0.1, 0.0, 0.05), ground_factor(0.4, 0.0, 0.05));
    }
}
