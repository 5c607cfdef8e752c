//! Linear filters and lags with limits, advanced exactly while their input goes along a straight line.
//!
//! An input is known where it is sampled; between two samples it is taken as straight. That is exact for an input that is, and of
//! second order in the time between samples for any other.

use serde::{Deserialize, Serialize};

/// State of tau dx/dt = u - x after `dt`, from `x`, while u goes from `u[0]` to `u[1]`.
pub fn lagged(x: f64, u: [f64; 2], dt: f64, tau: f64) -> f64 {
    let slope = (u[1] - u[0]) / dt;
    u[1] - slope * tau + (x - u[0] + slope * tau) * (-dt / tau).exp()
}

/// A signal behind a lag, a washout, or both: y = T s / ((tau s + 1)(T s + 1)) u with both.
///
/// Both are the difference of two lags of the same input, times T/(T - tau), and so are exact too: the constants must differ.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Smoothed {
    /// Time constant tau [s].
    pub lag: Option<f64>,
    /// Time constant T [s].
    pub washout: Option<f64>,
    /// Input, lagged by `lag`, lagged by `washout`, at the last sample.
    pub memory: [f64; 3],
}

impl Smoothed {
    /// At rest.
    pub fn new(lag: Option<f64>, washout: Option<f64>) -> Self {
        Self { lag, washout, memory: [0.0; 3] }
    }

    /// Output at a sample that shows `u`, `dt` after the last one; `dt` may be 0.
    pub fn advance(&mut self, u: f64, dt: f64) -> f64 {
        let [before, mut fast, mut slow] = self.memory;
        if dt > 0.0 {
            let over = |x, tau: Option<f64>| tau.map_or(u, |tau| lagged(x, [before, u], dt, tau));
            (fast, slow) = (over(fast, self.lag), over(slow, self.washout));
        } else if self.lag.is_none() {
            fast = u;
        }
        self.memory = [u, fast, slow];
        match (self.lag, self.washout) {
            (_, None) => fast,
            (None, Some(_)) => fast - slow,
            (Some(lag), Some(washout)) => (fast - slow) * (washout / (washout - lag)),
        }
    }
}

/// State of dx/dt = (u - x)/tau within +-rate after `dt`, from `x`, while u goes from `u[0]` to `u[1]`; whether the rate held it.
///
/// Exact: piece by piece of straight motion at the limit and of the lag inside it. tau may be 0: then x is u but for the rate.
pub fn limited_lag(mut x: f64, u: [f64; 2], dt: f64, tau: f64, rate: f64) -> (f64, bool) {
    if dt <= 0.0 {
        return (x, false);
    }
    let slope = (u[1] - u[0]) / dt;
    if rate.is_infinite() {
        return (if tau > 0.0 { lagged(x, u, dt, tau) } else { u[1] }, false);
    }
    let (band, mut error, mut left, mut limited) = (tau * rate, u[0] - x, dt, false);
    let mut at_limit = error.abs() > band || (tau == 0.0 && slope.abs() > rate);
    let mut sign = 1f64.copysign(if error == 0.0 { slope } else { error });
    while left > 0.0 {
        let step;
        if at_limit {
            limited = true;
            let closing = sign * (sign * rate - slope);
            let until = if closing > 0.0 { (error.abs() - band) / closing } else { f64::INFINITY };
            step = left.min(until);
            x += sign * rate * step;
            error += (slope - sign * rate) * step;
            if step == until {
                (error, at_limit) = (sign * band, false);
                if tau == 0.0 && slope.abs() > rate {
                    (at_limit, sign) = (true, 1f64.copysign(slope));
                }
            }
        } else {
            (step, error) = inside(error, slope, left, tau, rate);
            x = u[1] - slope * (left - step) - error;
            at_limit = step < left;
            sign = 1f64.copysign(slope);
        }
        left -= step;
    }
    (x, limited)
}

/// How long the lag stays within its rate, at most `left`, and its error then; it leaves where the input is the faster.
fn inside(error: f64, slope: f64, left: f64, tau: f64, rate: f64) -> (f64, f64) {
    if tau == 0.0 {
        return (left, 0.0);
    }
    let settled = tau * slope;
    if slope.abs() > rate {
        let edge = (tau * rate).copysign(slope);
        // from error to settled the edge lies between: met once
        let step = if error == settled { left } else { -tau * ((edge - settled) / (error - settled)).ln() };
        if step < left {
            return (step.max(0.0), edge);
        }
    }
    (left, settled + (error - settled) * (-left / tau).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_with_a_washout_is_their_product_to_a_step() {
        // y = T/(T - tau) (exp(-t/T) - exp(-t/tau)) from rest, however the time is cut
        let (tau, washout) = (0.1, 1.5);
        let mut filter = Smoothed::new(Some(tau), Some(washout));
        filter.memory[0] = 1.0;
        let (mut t, mut found) = (0.0, 0.0);
        for dt in [0.01, 0.3, 0.0, 0.07] {
            t += dt;
            found = filter.advance(1.0, dt);
        }
        let closed = washout / (washout - tau) * ((-t / washout).exp() - (-t / tau).exp());
        assert!((found - closed).abs() < 1e-14, "{found} {closed}");
    }

    #[test]
    fn a_step_beyond_the_rate_is_met_in_closed_form() {
        let (tau, rate): (f64, f64) = (0.05, 2.0);
        let (x, limited) = limited_lag(0.0, [1.0, 1.0], 0.62, tau, rate);
        let turn = (1.0 - tau * rate) / rate;
        assert!(limited && (x - (1.0 - tau * rate * (-(0.62 - turn) / tau).exp())).abs() < 1e-14);
        assert_eq!(limited_lag(0.3, [1.0, 2.0], 0.0, tau, rate), (0.3, false));
    }
}
