//! Fields of Fourier modes: sums of a_m cos(k_m.x + f_m) over many modes at many points.
//!
//! Modes of one wave vector are one wave, a cos(k.x) + b sin(k.x). Waves go side by side in blocks, so that a point has the bits it has
//! alone. Angles are counted in turns, whose nearest quarter is dropped exactly. Along a straight line through p,
//! k.(p + r e) = k.p + r k.e: waves are turned to p once, and places as far to either side of it share sine and cosine.

use super::compiled::{Loops, compiled};
use super::trig::{ROUNDING, turned};

/// Waves of a block: enough series side by side that none waits for its last product.
const WAVES: usize = 16;

/// A number of each wave of a block.
type Block = [f64; WAVES];

/// Coefficients of sin(q pi/2)/q and of cos(q pi/2) in powers of q^2.
const SINE: [f64; 8] = series(1);
const COSINE: [f64; 9] = series(0);

const fn series<const N: usize>(first: usize) -> [f64; N] {
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut all = [if first == 1 { quarter } else { 1.0 }; N];
    let mut n = 1;
    while n < N {
        let order = (2 * n + first) as f64;
        all[n] = -all[n - 1] * (quarter * quarter) / (order * (order - 1.0));
        n += 1;
    }
    all
}

/// Sine and cosine of angles in turns.
#[inline(always)]
fn sin_cos(turns: &Block) -> (Block, Block) {
    let (mut sines, mut cosines) = ([0.0; WAVES], [0.0; WAVES]);
    for k in 0..WAVES {
        let quarters = 4.0 * turns[k];
        let sum = quarters + ROUNDING;
        let q = quarters - (sum - ROUNDING);
        let squared = q * q;
        let (mut sine, mut cosine) = (SINE[7], COSINE[8]);
        for n in (0..7).rev() {
            sine = sine * squared + SINE[n];
        }
        for n in (0..8).rev() {
            cosine = cosine * squared + COSINE[n];
        }
        (sines[k], cosines[k]) = turned(sine * q, cosine, sum);
    }
    (sines, cosines)
}

/// Sums over the waves of each of three components.
type Sums = [Block; 3];

/// Waves side by side: vectors in turns [1/m], velocities of cosine and sine [m/s].
#[derive(Clone, Debug, Default)]
struct Waves {
    vector: [Block; 3],
    cosine: Sums,
    sine: Sums,
}

impl Waves {
    /// Turns by which they advance along `v`.
    #[inline(always)]
    fn along(&self, v: &[f64; 3]) -> Block {
        let [x, y, z] = &self.vector;
        std::array::from_fn(|k| x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }
}

/// Velocities that are sums of modes.
#[derive(Clone, Debug)]
pub struct FourierField {
    blocks: Vec<Waves>,
}

impl FourierField {
    /// Of wave vectors [rad/m], amplitudes and phases [rad], mode by mode.
    pub fn new(waves: &[[f64; 3]], sizes: &[[f64; 3]], phases: &[f64]) -> Self {
        let (mut blocks, mut last, mut n): (Vec<Waves>, Option<[f64; 3]>, usize) = (Vec::new(), None, 0);
        for ((wave, size), phase) in waves.iter().zip(sizes).zip(phases) {
            if last != Some(*wave) {
                last = Some(*wave);
                if n.is_multiple_of(WAVES) {
                    blocks.push(Waves::default());
                }
                n += 1;
            }
            let (k, (sine, cosine)) = ((n - 1) % WAVES, phase.sin_cos());
            if let Some(block) = blocks.last_mut() {
                for i in 0..3 {
                    block.vector[i][k] = wave[i] / std::f64::consts::TAU;
                    block.cosine[i][k] += size[i] * cosine;
                    block.sine[i][k] -= size[i] * sine;
                }
            }
        }
        Self { blocks }
    }

    /// At points, into `found`, one after the other.
    pub fn at(&self, points: &[[f64; 3]], found: &mut [[f64; 3]]) {
        compiled(AtPoints { field: self, points, found });
    }

    /// On a line through `middle` along the unit vector `along`: at the distances `reach` [m] ahead of it and behind it.
    pub fn on_line(
        &self,
        (middle, along): (&[f64; 3], &[f64; 3]),
        reach: &[f64],
        ahead: &mut [[f64; 3]],
        behind: &mut [[f64; 3]],
    ) {
        compiled(OnLine { field: self, middle, along, reach, ahead, behind });
    }
}

struct AtPoints<'a> {
    field: &'a FourierField,
    points: &'a [[f64; 3]],
    found: &'a mut [[f64; 3]],
}

impl Loops for AtPoints<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        for (point, found) in self.points.iter().zip(self.found) {
            let mut sums: Sums = [[0.0; WAVES]; 3];
            for waves in &self.field.blocks {
                let (sine, cosine) = sin_cos(&waves.along(point));
                for i in 0..3 {
                    for k in 0..WAVES {
                        sums[i][k] += waves.cosine[i][k] * cosine[k] + waves.sine[i][k] * sine[k];
                    }
                }
            }
            *found = sums.map(total);
        }
    }
}

struct OnLine<'a> {
    field: &'a FourierField,
    middle: &'a [f64; 3],
    along: &'a [f64; 3],
    reach: &'a [f64],
    ahead: &'a mut [[f64; 3]],
    behind: &'a mut [[f64; 3]],
}

impl Loops for OnLine<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        // the waves as they are seen from the middle, their turns a metre in place of their vectors
        let turned: Vec<(Block, Sums, Sums)> = self
            .field
            .blocks
            .iter()
            .map(|waves| {
                let (s, c) = sin_cos(&waves.along(self.middle));
                let (mut even, mut odd): (Sums, Sums) = Default::default();
                for i in 0..3 {
                    for k in 0..WAVES {
                        even[i][k] = waves.cosine[i][k] * c[k] + waves.sine[i][k] * s[k];
                        odd[i][k] = waves.sine[i][k] * c[k] - waves.cosine[i][k] * s[k];
                    }
                }
                (waves.along(self.along), even, odd)
            })
            .collect();
        for ((r, ahead), behind) in self.reach.iter().zip(self.ahead).zip(self.behind) {
            let (mut same, mut other): (Sums, Sums) = Default::default();
            for (pace, even, odd) in &turned {
                let (sine, cosine) = sin_cos(&std::array::from_fn(|k| r * pace[k]));
                for i in 0..3 {
                    for k in 0..WAVES {
                        same[i][k] += even[i][k] * cosine[k];
                        other[i][k] += odd[i][k] * sine[k];
                    }
                }
            }
            let (same, other) = (same.map(total), other.map(total));
            for i in 0..3 {
                (ahead[i], behind[i]) = (same[i] + other[i], same[i] - other[i]);
            }
        }
    }
}

/// Of all waves, pair by pair.
#[inline(always)]
fn total(mut sums: Block) -> f64 {
    let mut half = WAVES / 2;
    while half > 0 {
        for k in 0..half {
            sums[k] += sums[k + half];
        }
        half /= 2;
    }
    sums[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(k: usize) -> f64 {
        ((k * 7919 % 1000) as f64 / 500.0 - 1.0) * 6.0
    }

    fn three(k: usize) -> [f64; 3] {
        [number(3 * k), number(3 * k + 1), number(3 * k + 2)]
    }

    /// Modes, of which two and two share a wave.
    fn modes() -> (Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<f64>) {
        let waves = (0..61).map(|k| three(k / 2));
        (
            waves.collect(),
            (0..61).map(|k| three(k + 100)).collect(),
            (0..61).map(|k| number(k + 900)).collect(),
        )
    }

    fn by_cosines(point: [f64; 3]) -> [f64; 3] {
        let (waves, sizes, phases) = modes();
        let mut sum = [0.0; 3];
        for ((k, size), phase) in waves.iter().zip(&sizes).zip(&phases) {
            let cosine = (k[0] * point[0] + k[1] * point[1] + k[2] * point[2] + phase).cos();
            (0..3).for_each(|i| sum[i] += size[i] * cosine);
        }
        sum
    }

    #[test]
    fn the_sum_is_that_of_cosines_and_each_point_has_the_bits_it_has_alone() {
        let (waves, sizes, phases) = modes();
        let points: Vec<_> = (0..7).map(|k| three(k + 333).map(|v| 100.0 * v)).collect();
        let field = FourierField::new(&waves, &sizes, &phases);
        let mut found = vec![[0.0; 3]; 7];
        field.at(&points, &mut found);
        for (point, found) in points.iter().zip(&found) {
            let mut alone = [[0.0; 3]];
            field.at(&[*point], &mut alone);
            assert_eq!(alone[0], *found);
            for (a, b) in by_cosines(*point).iter().zip(found) {
                // angles of some thousand radians
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }

    #[test]
    fn a_line_has_what_its_points_have() {
        let (waves, sizes, phases) = modes();
        let field = FourierField::new(&waves, &sizes, &phases);
        let (middle, along, reach) = (three(17), [0.48, -0.6, 0.64], [0.3, 2.0, 5.5, 8.17]);
        let (mut ahead, mut behind) = ([[0.0; 3]; 4], [[0.0; 3]; 4]);
        field.on_line((&middle, &along), &reach, &mut ahead, &mut behind);
        for (k, r) in reach.iter().enumerate() {
            for (found, r) in [(ahead[k], *r), (behind[k], -r)] {
                let point: [f64; 3] = std::array::from_fn(|i| middle[i] + r * along[i]);
                let expected = by_cosines(point);
                (0..3)
                    .for_each(|i| assert!((found[i] - expected[i]).abs() < 1e-11, "{found:?} {expected:?}"));
            }
        }
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_library() {
        for k in 0..4000 {
            let angle = (f64::from(k) - 2000.0) * 0.00731;
            let (sine, cosine) = sin_cos(&[angle / std::f64::consts::TAU; WAVES]);
            // the angle is rounded once in turns, the rest a few times
            let bound = 5e-16 + f64::EPSILON * angle.abs();
            assert!((sine[3] - angle.sin()).abs() < bound, "{angle}: {} {}", sine[3], angle.sin());
            assert!((cosine[5] - angle.cos()).abs() < bound, "{angle}: {} {}", cosine[5], angle.cos());
        }
    }
}
