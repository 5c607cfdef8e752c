//! Blade pitch from the pilot's sticks.

use super::speed::Turning;
use crate::blade::kinematics::PitchMotion;
use crate::numerics::scalar::Real;
use serde::Deserialize;

/// Linear rigging: (theta_1c, theta_1s, theta_0, theta_tr) = offset + matrix (lateral, longitudinal, collective, pedal).
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rigging {
    /// Rows theta_1c, theta_1s, theta_0, theta_tr [rad/m].
    pub matrix: [[f64; 4]; 4],
    /// Pitch with all sticks at zero [rad].
    pub offset: [f64; 4],
    /// Swashplate phase D: theta = theta_0 + theta_1c cos(psi + D) + theta_1s sin(psi + D) [rad].
    pub phase: f64,
}

/// Root pitch of one blade and its exact time derivatives, nose up positive.
#[derive(Clone, Copy, Debug)]
pub struct BladePitch<S> {
    /// Pitch [rad].
    pub theta: S,
    /// Pitch rate relative to the rotating hub [rad/s].
    pub theta_dot: S,
    /// Pitch acceleration [rad/s2].
    pub theta_ddot: S,
}

impl<S> From<BladePitch<S>> for PitchMotion<S> {
    fn from(p: BladePitch<S>) -> Self {
        Self { theta: p.theta, theta_dot: p.theta_dot, theta_ddot: p.theta_ddot }
    }
}

/// Higher harmonic of the blade pitch, cosine cos(n psi) + sine sin(n psi).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchHarmonic {
    /// Multiple n of the rotor speed.
    pub order: usize,
    /// Cosine coefficient [rad].
    pub cosine: f64,
    /// Sine coefficient [rad].
    pub sine: f64,
}

impl PitchHarmonic {
    /// Adds this harmonic at azimuth `psi` [rad] of a rotor that is `turning`.
    #[inline(always)]
    pub fn add_to<S: Real>(&self, pitch: &mut BladePitch<S>, psi: f64, turning: Turning<S>) {
        let order = self.order as f64;
        let w = turning.omega * order;
        let (s, c) = (order * psi).sin_cos();
        let value = self.cosine * c + self.sine * s;
        let by_angle = self.sine * c - self.cosine * s;
        pitch.theta += S::cst(value);
        pitch.theta_dot += w * by_angle;
        pitch.theta_ddot += w * -value * w + turning.omega_dot * (order * by_angle);
    }
}

/// Steady periodic blade pitch, theta_0 + theta_1c cos psi + theta_1s sin psi + higher harmonics.
#[derive(Clone, Copy, Debug)]
pub struct PitchSeries<'a, S> {
    /// Collective [rad].
    pub theta_0: S,
    /// Lateral cyclic [rad].
    pub theta_1c: S,
    /// Longitudinal cyclic [rad].
    pub theta_1s: S,
    /// Higher harmonics, in the order they are added.
    pub higher: &'a [PitchHarmonic],
}

impl<S: Real> PitchSeries<'_, S> {
    /// Pitch at azimuth `psi` [rad] of a rotor turning at `omega` [rad/s], with exact rates.
    pub fn at(&self, psi: f64, omega: f64) -> BladePitch<S> {
        let (s, c) = psi.sin_cos();
        let cyclic = self.theta_1c * c + self.theta_1s * s;
        let mut pitch = BladePitch {
            theta: self.theta_0 + cyclic,
            theta_dot: (self.theta_1s * c - self.theta_1c * s) * omega,
            theta_ddot: -(cyclic * (omega * omega)),
        };
        for harmonic in self.higher {
            harmonic.add_to(&mut pitch, psi, Turning::steady(omega));
        }
        pitch
    }
}

impl Rigging {
    /// Controls that are the pitch itself: theta_0, theta_1c, theta_1s [rad], the fourth nothing.
    pub fn direct() -> Self {
        let mut matrix = [[0.0; 4]; 4];
        (matrix[0][1], matrix[1][2], matrix[2][0]) = (1.0, 1.0, 1.0);
        Self { matrix, offset: [0.0; 4], phase: 0.0 }
    }

    /// Pitch controls (theta_1c, theta_1s, theta_0, theta_tr) [rad] of the sticks [m from the stop].
    #[inline(always)]
    pub fn pitch<S: Real>(&self, stick: [S; 4]) -> [S; 4] {
        let mut pitch = self.pitch_rate(stick);
        for (p, &offset) in pitch.iter_mut().zip(&self.offset) {
            *p = *p + offset;
        }
        pitch
    }

    /// Rates of the pitch controls [rad/s] of the stick rates [m/s].
    #[inline(always)]
    pub fn pitch_rate<S: Real>(&self, stick_rate: [S; 4]) -> [S; 4] {
        let [lateral, longitudinal, collective, pedal] = stick_rate;
        self.matrix.map(|row| lateral * row[0] + longitudinal * row[1] + collective * row[2] + pedal * row[3])
    }

    /// Root pitch of the blade at azimuth `psi` [rad] for sticks that move at constant rate.
    ///
    /// theta = theta_0 + theta_1c cos(psi + D) + theta_1s sin(psi + D), psi_dot and its rate those of `turning`;
    /// stick histories are piecewise linear, so the sticks have no second derivative between their corners.
    #[inline(always)]
    pub fn blade_pitch<S: Real>(
        &self,
        stick: [S; 4],
        stick_rate: [S; 4],
        psi: S,
        turning: Turning<S>,
    ) -> BladePitch<S> {
        let [theta_1c, theta_1s, theta_0, _] = self.pitch(stick);
        let [rate_1c, rate_1s, rate_0, _] = self.pitch_rate(stick_rate);
        let (s, c) = (psi + self.phase).sin_cos();
        let Turning { omega, omega_dot } = turning;
        let cyclic = theta_1c * c + theta_1s * s;
        let by_angle = theta_1s * c - theta_1c * s;
        BladePitch {
            theta: theta_0 + cyclic,
            theta_dot: rate_0 + rate_1c * c + rate_1s * s + by_angle * omega,
            theta_ddot: (rate_1s * c - rate_1c * s) * (omega * 2.0) - cyclic * (omega * omega)
                + by_angle * omega_dot,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    const INCH: f64 = 0.0254;

    fn rigging() -> Rigging {
        Rigging {
            matrix: [
                [-1.0927055, 0.0, 0.17201135, 0.0],
                [0.0, 2.034557, -0.31088289, -1.2630046],
                [0.0, 0.0, 1.0744165, 0.0],
                [0.0, 0.0, 1.0881029, -3.8093948],
            ],
            offset: [0.13916955, -0.16978642, 0.17647246, 0.38362337],
            phase: -0.16929694,
        }
    }

    /// The published combination of linkage, mixing and swashplate gains, sticks in inches.
    #[test]
    fn sticks_give_the_published_pitch() {
        let (lat, lon, coll, ped): (f64, f64, f64, f64) = (4.0, 6.0, 5.0, 2.0);
        let pitch = rigging().pitch([lat, lon, coll, ped].map(|s| s * INCH));
        let published = [
            7.974 - 1.5902 * lat + 0.2503 * coll,
            -9.728 + 2.9609 * lon - 0.4524 * coll - 1.8381 * ped,
            10.111 + 1.5636 * coll,
            21.98 + 1.5835 * coll - 5.5439 * ped,
        ];
        for (value, reference) in pitch.iter().zip(published) {
            assert!((value.to_degrees() - reference).abs() < 1e-3);
        }
    }

    #[test]
    fn pitch_ranges_at_the_stops() {
        let at = |stick: [f64; 4]| rigging().pitch(stick.map(|s| s * INCH)).map(f64::to_degrees);
        assert!((at([0.0, 0.0, 10.0, 0.0])[2] - 25.75).abs() < 0.005);
        let mid = |pedal| at([5.0, 5.0, 5.0, pedal])[3];
        assert!((mid(0.0) - 29.90).abs() < 0.005 && (mid(5.38) - 0.07).abs() < 0.005);
        let lon = |stick| at([5.0, stick, 5.0, 2.69])[1];
        assert!((lon(0.0) + 16.9).abs() < 0.1 && (lon(10.0) - 12.7).abs() < 0.1);
        // right and forward stick: negative cyclic, blade pitch low on the right before the phase lead
        assert!(at([6.0, 5.0, 5.0, 2.0])[0] < at([5.0, 5.0, 5.0, 2.0])[0]);
    }

    #[test]
    fn pitch_rates_are_the_time_derivatives_of_pitch() {
        let r = rigging();
        let stick = [0.12, 0.10, 0.14, 0.05];
        let rate = [0.3, -0.2, 0.25, 0.1];
        let (omega, omega_dot, psi0) = (27.0, -4.0, 1.1);
        let at = |t: f64| {
            let turning = Turning { omega: omega + omega_dot * t, omega_dot };
            let moved = std::array::from_fn(|i| stick[i] + rate[i] * t);
            r.blade_pitch::<f64>(moved, rate, psi0 + t * (omega + 0.5 * omega_dot * t), turning)
        };
        let h = 1e-5;
        let (now, before, after) = (at(0.0), at(-h), at(h));
        assert!((now.theta_dot - (after.theta - before.theta) / (2.0 * h)).abs() < 1e-6);
        assert!((now.theta_ddot - (after.theta_dot - before.theta_dot) / (2.0 * h)).abs() < 1e-4);
    }

    #[test]
    fn steady_pitch_is_the_same_by_sticks_and_by_its_series() {
        let r = rigging();
        let stick = [0.12, 0.10, 0.14, 0.05];
        let [theta_1c, theta_1s, theta_0, _] = r.pitch::<f64>(stick);
        let series = PitchSeries { theta_0, theta_1c, theta_1s, higher: &[] };
        for psi in [0.0, 0.7, 2.9, 5.1] {
            let (a, b) = (
                r.blade_pitch::<f64>(stick, [0.0; 4], psi, Turning::steady(27.0)),
                series.at(psi + r.phase, 27.0),
            );
            assert!((a.theta - b.theta).abs() < 1e-14 && (a.theta_dot - b.theta_dot).abs() < 1e-12);
            assert!((a.theta_ddot - b.theta_ddot).abs() < 1e-10);
        }
    }

    #[test]
    fn rates_of_higher_harmonics_are_time_derivatives() {
        let higher = [PitchHarmonic { order: 3, cosine: 0.007, sine: -0.012 }];
        let series = PitchSeries { theta_0: 0.1, theta_1c: 0.02, theta_1s: -0.05, higher: &higher };
        let (omega, h) = (100.0, 1e-6);
        let at = |t: f64| series.at(0.4 + omega * t, omega);
        let (now, before, after) = (at(0.0), at(-h), at(h));
        assert!((now.theta_dot - (after.theta - before.theta) / (2.0 * h)).abs() < 1e-6);
        assert!((now.theta_ddot - (after.theta_dot - before.theta_dot) / (2.0 * h)).abs() < 1e-3);
    }

    #[test]
    fn derivatives_by_stick_and_azimuth_equal_central_differences() {
        let r = rigging();
        let x = [0.12, 0.10, 0.14, 0.05, 0.3, -0.2, 0.25, 0.1, 2.3];
        let f = |x: [f64; 9]| {
            let p = r.blade_pitch(
                [x[0], x[1], x[2], x[3]],
                [x[4], x[5], x[6], x[7]],
                x[8],
                Turning::steady(27.0),
            );
            [p.theta, p.theta_dot, p.theta_ddot]
        };
        let d: [Dual<9>; 9] = std::array::from_fn(|i| Dual::variable(x[i], i));
        let p =
            r.blade_pitch([d[0], d[1], d[2], d[3]], [d[4], d[5], d[6], d[7]], d[8], Turning::steady(27.0));
        for i in 0..9 {
            let h = 1e-6;
            let (mut up, mut down) = (x, x);
            up[i] += h;
            down[i] -= h;
            let (up, down) = (f(up), f(down));
            for (k, dual) in [p.theta, p.theta_dot, p.theta_ddot].iter().enumerate() {
                let difference = (up[k] - down[k]) / (2.0 * h);
                assert!((dual.eps[i] - difference).abs() < 1e-6 * (1.0 + difference.abs()));
            }
        }
    }
}
