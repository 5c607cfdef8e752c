//! Flow through a disk that descends into its own wake: momentum theory has no answer there, tests have.
//!
//! EMPIRICAL: in axial descent slower than twice the induced velocity of hover v_h the curve of tests is taken,
//! v/v_h = 1 - 1.125 x - 1.372 x^2 - 1.718 x^3 - 0.655 x^4, x = V_c/v_h [leishman2006]. Test points scatter about it by
//! 0.15 v_h and more, and it is a mean: a rotor in its own vortex ring is unsteady.
//!
//! It is written as a change of the flow through the disk, so that the equation of momentum theory stays and has one answer
//! everywhere: lambda_0 = CT/(2 W), W^2 = mu^2 + (lambda_0 - mu_z)^2 + s lambda_0^2 h(mu_z/lambda_0). The excess h is that of
//! the curve between hover and 1.95 v_h, h = (v_h/v)^4 - (1 - r)^2 at r = -x v_h/v, joined smoothly to momentum theory (h = 0)
//! at r = 0 and r = 2, where the windmill brake state begins.
//!
//! ASSUMPTION: s = (1 - mu^2/v_h^2)^2, none from mu = v_h on: a wind across the disk faster than v_h carries the wake away,
//! which is where tests find the vortex ring to end (0.9 to 1.3 v_h).

use super::momentum::momentum_inflow;
use crate::numerics::scalar::Real;
use std::sync::LazyLock;

/// Climb over v_h at which the curve of tests is read.
const READ_AT: [f64; 10] = [-0.25, -0.5, -0.75, -1.0, -1.25, -1.5, -1.625, -1.75, -1.875, -1.95];
const KNOTS: usize = READ_AT.len() + 2;

/// Induced velocity over v_h at a climb over v_h, the fit of tests.
fn curve_of_tests(x: f64) -> f64 {
    1.0 + x * (-1.125 + x * (-1.372 + x * (-1.718 - 0.655 * x)))
}

/// The excess h(r), piecewise cubic and monotone between its knots.
struct Excess {
    ratio: [f64; KNOTS],
    value: [f64; KNOTS],
    slope: [f64; KNOTS],
}

static EXCESS: LazyLock<Excess> = LazyLock::new(Excess::of_tests);

impl Excess {
    fn of_tests() -> Self {
        let (mut ratio, mut value) = ([0.0; KNOTS], [0.0; KNOTS]);
        for (k, x) in READ_AT.into_iter().enumerate() {
            let v = curve_of_tests(x);
            ratio[k + 1] = -x / v;
            value[k + 1] = v.powi(-4) - (1.0 - ratio[k + 1]).powi(2);
        }
        ratio[KNOTS - 1] = 2.0;
        // slopes that keep it monotone between knots: weighted harmonic means [fritsch1984]; level at both ends
        let step = |k: usize| ratio[k + 1] - ratio[k];
        let secant = |k: usize| (value[k + 1] - value[k]) / step(k);
        let mut slope = [0.0; KNOTS];
        for k in 1..KNOTS - 1 {
            let (before, after) = (secant(k - 1), secant(k));
            if before * after > 0.0 {
                let (w_before, w_after) = (2.0 * step(k) + step(k - 1), step(k) + 2.0 * step(k - 1));
                slope[k] = (w_before + w_after) / (w_before / before + w_after / after);
            }
        }
        Self { ratio, value, slope }
    }

    /// h, dh/dr and d2h/dr2 at r = mu_z/lambda_0.
    fn at(&self, r: f64) -> [f64; 3] {
        if !(r > 0.0 && r < 2.0) {
            return [0.0; 3];
        }
        let k = self.ratio.partition_point(|&knot| knot <= r) - 1;
        let step = self.ratio[k + 1] - self.ratio[k];
        let t = (r - self.ratio[k]) / step;
        let rise = self.value[k + 1] - self.value[k];
        let (a, b) = (self.slope[k] * step, self.slope[k + 1] * step);
        // value + a t + c t^2 + d t^3
        let (c, d) = (3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise);
        let h = self.value[k] + t * (a + t * (c + t * d));
        [h, (a + t * (2.0 * c + t * 3.0 * d)) / step, (2.0 * c + 6.0 * d * t) / (step * step)]
    }
}

/// What the flow through the disk has in excess of momentum theory, at one state.
#[derive(Clone, Copy, Debug)]
pub struct DescentFlow<S> {
    /// s lambda_0^2 h, to be added to the square of the flow.
    pub squared: S,
    /// Half its derivative by lambda_0, s (lambda_0 h - mu_z h'/2).
    pub half_slope: S,
}

impl<S: Real> DescentFlow<S> {
    /// At a thrust coefficient, the square of the in-plane speed, the velocity down the shaft and the mean inflow, over the tip
    /// speed; none outside of the range of the tests.
    pub fn at(ct: S, mu_squared: S, mu_z: S, mean: S) -> Option<Self> {
        let hover_squared = ct.abs() * 0.5;
        let ratio = mu_z.re() / mean.re();
        if !(mu_squared.re() < hover_squared.re() && ratio > 0.0 && ratio < 2.0) {
            return None;
        }
        let fade = (S::one() - mu_squared / hover_squared).squared();
        let [h, h_1, h_2] = EXCESS.at(ratio);
        let ratio = mu_z / mean;
        let (excess, slope) = (ratio.chain(h, h_1), ratio.chain(h_1, h_2));
        Some(Self {
            squared: fade * mean.squared() * excess,
            half_slope: fade * (mean * excess - mu_z * slope * 0.5),
        })
    }
}

/// Mean induced inflow lambda_0 = CT/(2 W), down positive, and what stands above: momentum theory, in descent the curve of
/// tests. One answer everywhere, continuous from hover to the windmill brake state.
pub fn descent_inflow<S: Real>(ct: S, mu_squared: S, mu_z: S) -> S {
    if ct.re() < 0.0 {
        return -descent_inflow(-ct, mu_squared, -mu_z);
    }
    let slow = mu_squared.re() < 0.5 * ct.re();
    if !(slow && mu_z.re() > 0.0) {
        return momentum_inflow(ct, mu_squared, mu_z);
    }
    let root = root(ct.re(), mu_squared.re(), mu_z.re());
    let mean = S::cst(root);
    let residual = mean * 2.0 * flow(ct, mu_squared, mu_z, mean) - ct;
    let slope = slope(ct.re(), mu_squared.re(), mu_z.re(), root);
    // at the fold where the windmill brake state begins the derivative does not exist
    if slope.abs() < 1e-9 { mean } else { -residual / slope + root }
}

/// W.
fn flow<S: Real>(ct: S, mu_squared: S, mu_z: S, mean: S) -> S {
    let momentum = mu_squared + (mean - mu_z).squared();
    match DescentFlow::at(ct, mu_squared, mu_z, mean) {
        Some(excess) => (momentum + excess.squared).sqrt(),
        None => momentum.sqrt(),
    }
}

/// d(2 lambda_0 W)/d lambda_0.
fn slope(ct: f64, mu_squared: f64, mu_z: f64, mean: f64) -> f64 {
    let w = flow(ct, mu_squared, mu_z, mean);
    let excess = DescentFlow::at(ct, mu_squared, mu_z, mean).map_or(0.0, |excess| excess.half_slope);
    2.0 * w + 2.0 * mean * (mean - mu_z + excess) / w
}

/// The one root: Newton kept inside a bracket.
fn root(ct: f64, mu_squared: f64, mu_z: f64) -> f64 {
    let residual = |x: f64| 2.0 * x * flow(ct, mu_squared, mu_z, x) - ct;
    let (mut low, mut high) = (0.0, mu_z + (0.5 * ct).sqrt());
    let mut x = high;
    for _ in 0..200 {
        let r = residual(x);
        if r > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - r / slope(ct, mu_squared, mu_z, x);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-16 + 4.0 * f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    const CT: f64 = 0.005;
    const HOVER: f64 = 0.05;

    #[test]
    fn axial_descent_follows_the_curve_of_tests() {
        for x in READ_AT {
            let found: f64 = descent_inflow(CT, 0.0, -x * HOVER);
            assert!((found / HOVER - curve_of_tests(x)).abs() < 1e-9, "{x}: {}", found / HOVER);
        }
    }

    #[test]
    fn hover_climb_and_the_windmill_brake_state_are_those_of_momentum_theory() {
        for climb in [0.0, 0.5, 1.0, 2.0] {
            assert_eq!(
                descent_inflow(CT, 0.0, -climb * HOVER),
                momentum_inflow::<f64>(CT, 0.0, -climb * HOVER)
            );
        }
        for rate in [2.0001, 2.2, 2.5, 3.0, 6.0] {
            let exact = HOVER * (0.5 * rate - (0.25_f64 * rate * rate - 1.0).sqrt());
            let found: f64 = descent_inflow(CT, 0.0, rate * HOVER);
            assert!((found - exact).abs() < 1e-12, "{rate}: {found} {exact}");
        }
        // a wind across the disk as fast as the inflow of hover: nothing but momentum theory
        assert_eq!(descent_inflow(CT, HOVER * HOVER, 0.04), momentum_inflow::<f64>(CT, HOVER * HOVER, 0.04));
        assert_eq!(descent_inflow(-CT, 0.0, 0.01), momentum_inflow::<f64>(-CT, 0.0, 0.01));
    }

    #[test]
    fn there_is_one_answer_at_any_rate_of_descent_and_any_wind() {
        for mu in (0..24).map(|k| 0.05 * k as f64 * HOVER) {
            for mu_z in (1..80).map(|k| 0.05 * k as f64 * HOVER) {
                let thrust = |x: f64| 2.0 * x * flow(CT, mu * mu, mu_z, x) - CT;
                let inflow = (1..2000).map(|k| 0.0025 * k as f64 * HOVER);
                let signs: Vec<bool> = inflow.map(|x| thrust(x) > 0.0).collect();
                let crossings = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
                assert_eq!(crossings, 1, "mu {mu}, mu_z {mu_z}");
                let found: f64 = descent_inflow(CT, mu * mu, mu_z);
                assert!(thrust(found).abs() < 1e-12 * CT.max(1.0), "mu {mu}, mu_z {mu_z}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let of = |x: [f64; 3]| -> f64 { descent_inflow(x[0], x[1], x[2]) };
        for at in [[CT, 0.0004, 0.02], [CT, 0.0001, 0.06], [CT, 0.0016, 0.045], [CT, 1e-5, 0.093]] {
            let dual: Dual<3> =
                descent_inflow(Dual::variable(at[0], 0), Dual::variable(at[1], 1), Dual::variable(at[2], 2));
            for k in 0..3 {
                let h = 1e-6 * at[k];
                let (mut up, mut down) = (at, at);
                up[k] += h;
                down[k] -= h;
                let difference = (of(up) - of(down)) / (2.0 * h);
                assert!((dual.eps[k] - difference).abs() < 1e-6 * difference.abs().max(1.0), "{at:?} {k}");
            }
        }
    }
}
