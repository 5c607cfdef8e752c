//! One section in harmonic pitch or plunge until its cycle repeats.

use super::model::Model;
use super::{Coefficients, Flow, MAX_STATES, Section, Separation, States};
use crate::airfoil::Airfoil;
use std::f64::consts::TAU;
use thiserror::Error;

/// How the section moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// It turns about a point this share of the chord behind the leading edge.
    Pitch {
        /// The point.
        axis: f64,
    },
    /// It goes up and down; the amplitude is that of the angle of attack.
    Plunge,
}

/// A harmonic motion: angle = mean + amplitude sin(phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// Mean angle [rad].
    pub mean: f64,
    /// Amplitude [rad].
    pub amplitude: f64,
    /// Reduced frequency omega c/(2 V).
    pub reduced_frequency: f64,
    /// Mach number of the free stream.
    pub mach: f64,
    /// Pitch or plunge.
    pub motion: Motion,
    /// Steps of a cycle.
    pub steps: usize,
}

/// The cycle that repeats, step by step.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// Phase [rad].
    pub phase: Vec<f64>,
    /// Pitch or plunge angle [rad].
    pub alpha: Vec<f64>,
    /// Coefficients.
    pub coefficients: Vec<Coefficients<f64>>,
    /// Normal force coefficient.
    pub cn: Vec<f64>,
    /// States; those that the model has come first.
    pub states: Vec<States<f64>>,
    /// Work of the air on the section in a cycle, over rho V^2 c^2/2 per span; negative damps the motion.
    pub work: f64,
    /// Cycles until the states repeated.
    pub cycles: usize,
}

/// Why there is no cycle.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CycleError {
    /// A number out of range.
    #[error("{field} = {value}: {allowed}")]
    Value {
        /// Name.
        field: &'static str,
        /// Value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// States that do not repeat.
    #[error(
        "the states of the section change by {change:.2e} from one cycle to the next after {cycles} cycles"
    )]
    NotPeriodic {
        /// Largest change relative to the states.
        change: f64,
        /// Cycles made.
        cycles: usize,
    },
}

/// Change of the states over a cycle, relative to their largest value, at which it repeats.
const REPEATS: f64 = 1e-12;
/// Most cycles.
const MOST_CYCLES: usize = 2000;
/// The result depends on k and M alone: any chord [m] and speed of sound [m/s] will do.
const CHORD: f64 = 1.0;
const SPEED_OF_SOUND: f64 = 340.0;

impl Oscillation {
    /// Refuses what is no motion, naming the number.
    pub fn check(&self) -> Result<(), CycleError> {
        let axis = match self.motion {
            Motion::Pitch { axis } => axis,
            Motion::Plunge => 0.25,
        };
        let within = |x: f64, low: f64, high: f64| (low..=high).contains(&x);
        let steps = self.steps as f64;
        let fields = [
            (
                "mean",
                self.mean.to_degrees(),
                "must lie between -180 and 180 deg",
                within(self.mean, -TAU / 2.0, TAU / 2.0),
            ),
            (
                "amplitude",
                self.amplitude.to_degrees(),
                "must lie above 0 and at most 90 deg",
                self.amplitude > 0.0 && self.amplitude <= TAU / 4.0,
            ),
            (
                "k",
                self.reduced_frequency,
                "must lie between 0.0001 and 10",
                within(self.reduced_frequency, 1e-4, 10.0),
            ),
            ("mach", self.mach, "must lie between 0.001 and 1", within(self.mach, 1e-3, 1.0)),
            ("pitch_axis", axis, "must lie between -2 and 3 chords", within(axis, -2.0, 3.0)),
            ("steps", steps, "must lie between 36 and 100000", within(steps, 36.0, 1e5)),
        ];
        match fields.into_iter().find(|(.., good)| !good) {
            Some((field, value, allowed, _)) => Err(CycleError::Value { field, value, allowed }),
            None => Ok(()),
        }
    }

    fn speed(&self) -> f64 {
        self.mach * SPEED_OF_SOUND
    }

    /// Angular frequency [rad/s].
    fn frequency(&self) -> f64 {
        2.0 * self.reduced_frequency * self.speed() / CHORD
    }

    fn angle(&self, phase: f64) -> f64 {
        self.mean + self.amplitude * phase.sin()
    }

    fn flow(&self, phase: f64) -> Flow<f64> {
        let angle = self.angle(phase);
        let (axis, pitch_rate) = match self.motion {
            Motion::Pitch { axis } => (axis, self.amplitude * self.frequency() * phase.cos()),
            Motion::Plunge => (0.25, 0.0),
        };
        let turned = pitch_rate * CHORD / self.speed();
        Flow {
            alpha: angle + turned * (0.75 - axis),
            alpha_quarter: angle + turned * (0.25 - axis),
            pitch_rate,
            turn_rate: pitch_rate,
            speed: self.speed(),
            speed_of_sound: SPEED_OF_SOUND,
        }
    }
}

impl Cycle {
    /// The cycle of `airfoil` by `model`, from rest until it repeats.
    pub fn of(airfoil: &Airfoil, model: Model, motion: &Oscillation) -> Result<Self, CycleError> {
        motion.check()?;
        let separation = Separation::of(airfoil);
        let section = Section { airfoil, separation: &separation, chord: CHORD };
        let n = motion.steps;
        let phase: Vec<f64> = (0..n).map(|i| TAU * i as f64 / n as f64).collect();
        let flows: Vec<Flow<f64>> = phase.iter().map(|&p| motion.flow(p)).collect();
        let dt = TAU / (n as f64 * motion.frequency());
        let mut states = model.equilibrium(&section, &flows[0]);
        let mut history = vec![states; n];
        let (mut cycles, mut change) = (0, f64::INFINITY);
        while change > REPEATS {
            if cycles == MOST_CYCLES {
                return Err(CycleError::NotPeriodic { change, cycles });
            }
            let start = states;
            for (i, kept) in history.iter_mut().enumerate() {
                *kept = states;
                states = model.advanced(&section, [&flows[i], &flows[(i + 1) % n]], dt, &states);
            }
            change = relative_change(&start, &states, &history);
            cycles += 1;
        }
        let coefficients: Vec<_> =
            flows.iter().zip(&history).map(|(flow, x)| model.coefficients(&section, flow, x)).collect();
        let cn = coefficients
            .iter()
            .zip(&flows)
            .map(|(c, flow)| {
                let (sin, cos) = flow.alpha_quarter.sin_cos();
                c.cl * cos + c.cd * sin
            })
            .collect::<Vec<_>>();
        let alpha: Vec<f64> = phase.iter().map(|&p| motion.angle(p)).collect();
        let work = work(motion, &phase, &coefficients, &cn);
        Ok(Self { phase, alpha, coefficients, cn, states: history, work, cycles })
    }
}

fn relative_change(before: &States<f64>, after: &States<f64>, history: &[States<f64>]) -> f64 {
    (0..MAX_STATES)
        .map(|k| {
            let largest = history.iter().map(|x| x[k].abs()).fold(f64::MIN_POSITIVE, f64::max);
            (after[k] - before[k]).abs() / largest
        })
        .fold(0.0, f64::max)
}

/// Moment about the axis by the angle, or force by the way: the trapezoidal rule of a periodic function.
fn work(motion: &Oscillation, phase: &[f64], coefficients: &[Coefficients<f64>], cn: &[f64]) -> f64 {
    let width = TAU / phase.len() as f64;
    let terms = phase.iter().zip(coefficients).zip(cn).map(|((&p, c), &cn)| match motion.motion {
        Motion::Pitch { axis } => (c.cm + cn * (axis - 0.25)) * motion.amplitude * p.cos(),
        // up is against the angle of attack: d(h/c) = -alpha V dt/c, V dt/c = d(phase)/(2 k)
        Motion::Plunge => -cn * motion.amplitude * p.sin() / (2.0 * motion.reduced_frequency),
    });
    terms.sum::<f64>() * width
}
