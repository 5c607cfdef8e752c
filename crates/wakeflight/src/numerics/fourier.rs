//! Fields of Fourier modes: sums of a_m cos(k_m.x + f_m) over many modes at many points.
//!
//! Points go four side by side, each with the bits it has alone. The cosine is counted in turns, whose whole part is dropped
//! exactly: cos(2 pi t) = 1 - 2 sin(pi f)^2 with f the distance of t from the nearest whole number.

use super::four::{Four, FourTask, four_at_once};
use super::scalar::Real;

/// Added and taken off again, rounds what is below 2^51 to a whole number.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Coefficients of sin(pi f)/f in powers of f^2: (-1)^n pi^(2n+1)/(2n+1)!.
const SINE: [f64; 11] = {
    let mut all = [std::f64::consts::PI; 11];
    let mut n = 1;
    while n < 11 {
        let (even, odd) = (2.0 * n as f64, 2.0 * n as f64 + 1.0);
        all[n] = -all[n - 1] * (std::f64::consts::PI * std::f64::consts::PI) / (even * odd);
        n += 1;
    }
    all
};

/// A mode: wave vector in turns [1/m], phase in turns, amplitude [m/s].
#[derive(Clone, Copy, Debug)]
struct Mode {
    wave: [f64; 3],
    phase: f64,
    size: [f64; 3],
}

/// Velocities that are sums of modes.
#[derive(Clone, Debug)]
pub struct FourierField {
    modes: Vec<Mode>,
}

impl FourierField {
    /// Of wave vectors [rad/m], amplitudes and phases [rad], mode by mode.
    pub fn new(waves: &[[f64; 3]], sizes: &[[f64; 3]], phases: &[f64]) -> Self {
        let turns = |radians: f64| radians / std::f64::consts::TAU;
        let modes = waves.iter().zip(sizes).zip(phases);
        let mode = |((wave, &size), &phase): ((&[f64; 3], &[f64; 3]), &f64)| Mode {
            wave: wave.map(turns),
            phase: turns(phase),
            size,
        };
        Self { modes: modes.map(mode).collect() }
    }

    /// At points, into `found`, one after the other.
    pub fn at(&self, points: &[[f64; 3]], found: &mut [[f64; 3]]) {
        for (points, found) in points.chunks(4).zip(found.chunks_mut(4)) {
            // fewer than four left: the last stands in for those that are not there
            let four = std::array::from_fn(|k| points[k.min(points.len() - 1)]);
            let task = Sum { field: self, points: four };
            let values = four_at_once(task)
                .unwrap_or_else(|task| std::array::from_fn(|k| sum(&self.modes, task.points[k])));
            found.copy_from_slice(&values[..points.len()]);
        }
    }
}

/// The sum at four points.
struct Sum<'a> {
    field: &'a FourierField,
    points: [[f64; 3]; 4],
}

impl FourTask for Sum<'_> {
    type Output = [[f64; 3]; 4];
    #[inline(always)]
    fn run<S: Four>(self) -> Self::Output {
        let p = &self.points;
        let side = [
            S::of([p[0][0], p[1][0], p[2][0], p[3][0]]),
            S::of([p[0][1], p[1][1], p[2][1], p[3][1]]),
            S::of([p[0][2], p[1][2], p[2][2], p[3][2]]),
        ];
        let [x, y, z] = sum(&self.field.modes, side);
        let (x, y, z) = (x.values(), y.values(), z.values());
        [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]], [x[3], y[3], z[3]]]
    }
}

#[inline(always)]
fn sum<S: Real>(modes: &[Mode], [x, y, z]: [S; 3]) -> [S; 3] {
    let (mut u, mut v, mut w) = (S::zero(), S::zero(), S::zero());
    for mode in modes {
        let turns = x * mode.wave[0] + y * mode.wave[1] + z * mode.wave[2] + mode.phase;
        let whole = (turns + ROUNDING) - ROUNDING;
        let f = turns - whole;
        let squared = f * f;
        let mut ratio = S::cst(SINE[10]);
        for n in (0..10).rev() {
            ratio = ratio * squared + SINE[n];
        }
        let sine = ratio * f;
        let cosine = -(sine * sine * 2.0) + 1.0;
        u += cosine * mode.size[0];
        v += cosine * mode.size[1];
        w += cosine * mode.size[2];
    }
    [u, v, w]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_that_of_cosines_and_each_point_has_the_bits_it_has_alone() {
        let number = |k: usize| ((k * 7919 % 1000) as f64 / 500.0 - 1.0) * 6.0;
        let three = |k: usize| [number(3 * k), number(3 * k + 1), number(3 * k + 2)];
        let (waves, sizes): (Vec<_>, Vec<_>) = (0..60).map(|k| (three(k), three(k + 100))).unzip();
        let phases: Vec<f64> = (0..60).map(|k| number(k + 900)).collect();
        let points: Vec<_> = (0..7).map(|k| three(k + 333).map(|v| 100.0 * v)).collect();
        let field = FourierField::new(&waves, &sizes, &phases);
        let mut found = vec![[0.0; 3]; 7];
        field.at(&points, &mut found);
        for (point, found) in points.iter().zip(&found) {
            let mut expected = [0.0; 3];
            for ((k, size), phase) in waves.iter().zip(&sizes).zip(&phases) {
                let cosine = (k[0] * point[0] + k[1] * point[1] + k[2] * point[2] + phase).cos();
                (0..3).for_each(|i| expected[i] += size[i] * cosine);
            }
            let mut alone = [[0.0; 3]];
            field.at(&[*point], &mut alone);
            assert_eq!(alone[0], *found);
            assert_eq!(sum(&field.modes, *point), *found);
            for (a, b) in expected.iter().zip(found) {
                // angles of some thousand radians
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }

    #[test]
    fn the_cosine_is_that_of_the_library() {
        for k in 0..4000 {
            let angle = (k as f64 - 2000.0) * 0.00731;
            let field = FourierField::new(&[[0.0; 3]], &[[1.0, 0.0, 0.0]], &[angle]);
            let mut found = [[0.0; 3]];
            field.at(&[[0.0; 3]], &mut found);
            // the angle is rounded once in turns, the cosine a few times
            let bound = 5e-16 + f64::EPSILON * angle.abs();
            assert!((found[0][0] - angle.cos()).abs() < bound, "{angle}: {} {}", found[0][0], angle.cos());
        }
    }
}
