//! Solid harmonics of a cell: moments of its segments, their translation, and the velocity they stand for.
//!
//! With w = x + i y, regular R_n^m and irregular I_n^m (m = 0 ... n) by
//!
//! R_m^m = w / (2 m) R_(m-1)^(m-1),   (n^2 - m^2) R_n^m = (2 n - 1) z R_(n-1)^m - r^2 R_(n-2)^m,
//! I_m^m = (2 m - 1) w / r^2 I_(m-1)^(m-1),   r^2 I_n^m = (2 n - 1) z I_(n-1)^m - ((n - 1)^2 - m^2) I_(n-2)^m,
//!
//! R_0^0 = 1, I_0^0 = 1 / r, the distance of two points is expanded as
//! 1 / |x - y| = sum over n of R_n^0(y) I_n^0(x) + 2 Re sum over m > 0 of conj(R_n^m(y)) I_n^m(x) for |y| < |x|.
//! I_n^m = (-1)^n d_z^(n-m) (d_x + i d_y)^m (1 / r), so that derivatives only shift n and m.

/// Degree at which the vector potential of a cell is cut off.
pub(super) const DEGREE: usize = 4;
/// Degree of the velocity, its curl.
pub(super) const VELOCITY_DEGREE: usize = DEGREE + 1;
/// Harmonics m >= 0 up to `DEGREE`.
const COUNT: usize = (DEGREE + 1) * (DEGREE + 2) / 2;
/// Real coefficients of the velocity of a cell, three components together.
pub(super) const N_COEFFICIENTS: usize = 3 * (VELOCITY_DEGREE * (VELOCITY_DEGREE + 2));

/// Degree n of each of these coefficients, in their order.
pub(super) fn degrees() -> impl Iterator<Item = usize> {
    (0..=VELOCITY_DEGREE).flat_map(|m| {
        let numbers = if m == 0 { 3 } else { 6 };
        (m.max(1)..=VELOCITY_DEGREE).flat_map(move |n| std::iter::repeat_n(n, numbers))
    })
}

/// Complex number: real and imaginary part.
type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Place of the harmonic of degree n and order m.
const fn place(n: usize, m: usize) -> usize {
    n * (n + 1) / 2 + m
}

/// Moments of the vector potential about a centre: sum of circulation dl R_n^m, one entry a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments([[Complex; COUNT]; 3]);

/// Regular harmonics R_n^m at `r`, up to `DEGREE`.
fn regular(r: [f64; 3]) -> [Complex; COUNT] {
    let [x, y, z] = r;
    let r_sq = x * x + y * y + z * z;
    let mut values = [[0.0; 2]; COUNT];
    values[0] = [1.0, 0.0];
    for m in 0..=DEGREE {
        if m > 0 {
            let last = values[place(m - 1, m - 1)];
            values[place(m, m)] = times(last, [x, y]).map(|v| v / (2 * m) as f64);
        }
        for n in m + 1..=DEGREE {
            let before = values[place(n - 1, m)];
            let last = if n >= m + 2 { values[place(n - 2, m)] } else { [0.0; 2] };
            let scale = 1.0 / (n * n - m * m) as f64;
            let slope = (2 * n - 1) as f64 * z;
            values[place(n, m)] = std::array::from_fn(|c| scale * (slope * before[c] - r_sq * last[c]));
        }
    }
    values
}

/// Nodes and weights of Gauss on (0, 1), exact to degree 5.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl Moments {
    /// Of nothing.
    pub fn zero() -> Self {
        Self([[[0.0; 2]; COUNT]; 3])
    }

    /// Adds the segment of given `strength` (circulation over 4 pi) from `end - along` to `end`, seen from the centre.
    pub fn add_segment(&mut self, end: [f64; 3], along: [f64; 3], strength: f64) {
        const { assert!(DEGREE <= 5, "three points of Gauss are exact to degree 5") };
        for (fraction, weight) in GAUSS {
            let values = regular(std::array::from_fn(|c| end[c] - fraction * along[c]));
            for (moments, component) in self.0.iter_mut().zip(along) {
                let source = strength * weight * component;
                for (moment, value) in moments.iter_mut().zip(&values) {
                    moment[0] += source * value[0];
                    moment[1] += source * value[1];
                }
            }
        }
    }

    /// Adds the moments of a part whose centre lies at `offset` from this one.
    ///
    /// R_n^m(a + b) = sum over k, l of R_(n-k)^(m-l)(a) R_k^l(b), with R_n^-m = (-1)^m conj(R_n^m).
    pub fn add_part(&mut self, part: &Moments, offset: [f64; 3]) {
        let shift = regular(offset);
        let signed = |values: &[Complex; COUNT], n: usize, m: i64| {
            let [re, im] = values[place(n, m.unsigned_abs() as usize)];
            if m >= 0 {
                [re, im]
            } else if m % 2 == 0 {
                [re, -im]
            } else {
                [-re, im]
            }
        };
        for (own, other) in self.0.iter_mut().zip(&part.0) {
            for n in 0..=DEGREE {
                for m in 0..=n {
                    let mut sum = [0.0; 2];
                    for k in 0..=n {
                        let (m, rest) = (m as i64, (n - k) as i64);
                        for l in (m - rest).max(-(k as i64))..=(m + rest).min(k as i64) {
                            let product = times(signed(&shift, n - k, m - l), signed(other, k, l));
                            sum = [sum[0] + product[0], sum[1] + product[1]];
                        }
                    }
                    let value = &mut own[place(n, m)];
                    *value = [value[0] + sum[0], value[1] + sum[1]];
                }
            }
        }
    }

    /// Coefficients of the velocity on I_n^m / (2 n - 1)!!, order after order: for m = 0 and each n from 1 the three
    /// components; for m > 0 and each n from m the three factors of the real part, then the three of the imaginary part.
    pub fn velocity(&self) -> [f64; N_COEFFICIENTS] {
        // v = Re sum a I: derivatives of the potential's Re sum a I shift n up and m by one
        let mut v = [[[0.0; 2]; (VELOCITY_DEGREE + 1) * (VELOCITY_DEGREE + 2) / 2]; 3];
        let mut add = |component: usize, n: usize, m: usize, a: Complex, factor: f64| {
            let value = &mut v[component][place(n, m)];
            *value = [value[0] + factor * a[0], value[1] + factor * a[1]];
        };
        for n in 0..=DEGREE {
            for m in 0..=n {
                let potential = self.0.each_ref().map(|moments| {
                    let [re, im] = moments[place(n, m)];
                    if m == 0 { [re, 0.0] } else { [2.0 * re, -2.0 * im] }
                });
                // v = curl A: (component, sign, potential's component, axis of the derivative)
                for (component, sign, of, axis) in [
                    (0, 1.0, 2, 1),
                    (0, -1.0, 1, 2),
                    (1, 1.0, 0, 2),
                    (1, -1.0, 2, 0),
                    (2, 1.0, 1, 0),
                    (2, -1.0, 0, 1),
                ] {
                    let a = potential[of];
                    let turned = [-a[1], a[0]];
                    match (axis, m) {
                        (2, _) => add(component, n + 1, m, a, -sign),
                        (0, 0) => add(component, n + 1, 1, a, -sign),
                        (0, _) => {
                            add(component, n + 1, m + 1, a, -0.5 * sign);
                            add(component, n + 1, m - 1, a, 0.5 * sign);
                        }
                        (_, 0) => add(component, n + 1, 1, turned, sign),
                        (_, _) => {
                            add(component, n + 1, m + 1, turned, 0.5 * sign);
                            add(component, n + 1, m - 1, turned, 0.5 * sign);
                        }
                    }
                }
            }
        }
        let mut coefficients = [0.0; N_COEFFICIENTS];
        let mut next = 0;
        for m in 0..=VELOCITY_DEGREE {
            for n in m.max(1)..=VELOCITY_DEGREE {
                let scale: f64 = (1..=n).map(|k| (2 * k - 1) as f64).product();
                for (part, sign) in [(0, scale), (1, -scale)].into_iter().take(if m == 0 { 1 } else { 2 }) {
                    for component in &v {
                        coefficients[next] = sign * component[place(n, m)][part];
                        next += 1;
                    }
                }
            }
        }
        coefficients
    }
}

/// Bound of what the expansion to degree p leaves out of the velocity of sources of total strength S within radius a, at
/// distance d > a: S / d^2 times this, of ratio = a / d.
///
/// A source's part of degree n is at most (n + 1) a^n / d^(n + 2), since P_n^2 + sin^2 P_n'^2 / (n (n + 1)) <= 1; summed
/// over n > p it is ratio^(p + 1) ((p + 2) - (p + 1) ratio) / (1 - ratio)^2.
pub(super) fn remainder(p: usize, ratio: f64) -> f64 {
    let order = p as f64;
    let power = (0..p).fold(ratio, |power, _| power * ratio);
    power * ((order + 2.0) - (order + 1.0) * ratio) / ((1.0 - ratio) * (1.0 - ratio))
}
