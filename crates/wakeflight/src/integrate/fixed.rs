//! Fixed steps of Radau IIA on F(y_dot, y, u; t) = 0, with exact derivatives.
//!
//! The stages solve F(t_i, y + Z_i, K_i) = 0 by a modified Newton iteration: dF/dy_dot is that of the start of the step,
//! which also gives the consistent rate there, dF/dy may be somewhat older; a secant takes off what they miss. It ends when what it
//! still lacks, |dZ| theta/(1 - theta) with the contraction theta seen, is below a share
//! of the weights rtol |y| + atol in the root mean square [hairer1996, Sec. IV.8]. Where it does not contract, dF/dy is
//! found anew, and where that does not help the step is halved.

use super::blocks::{Factor, Singular};
use super::linearised::Linearised;
use super::radau::{Radau, STAGES};
use super::secant::Secant;
use crate::system::instant::{Inputs, Instant};
use crate::system::layout::Layout;
use crate::system::model::System;
use crate::vortex::threads::share;
use nalgebra::Complex;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Most Newton iterations of one step.
const MAX_ITERATIONS: usize = 20;
/// Most halvings of one step.
const MAX_HALVINGS: u32 = 6;

/// A step that could not be taken.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "fixed step stopped at t = {t:.4} s, azimuth of the first blade {azimuth:.1} deg: {reason}; largest residual \
     {residual:.3e} in the equation of {equation}"
)]
pub struct StepFailure {
    /// Start of the step [s].
    pub t: f64,
    /// Azimuth of the first blade there [deg].
    pub azimuth: f64,
    /// What went wrong.
    pub reason: &'static str,
    /// Largest residual.
    pub residual: f64,
    /// Its equation, by the name of the state.
    pub equation: String,
}

/// Counted work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
pub struct Counters {
    /// Evaluations of F.
    pub residual_evaluations: u64,
    /// Times dF/dy was found.
    pub jacobians: u64,
    /// Factorisations of the pair of systems of a step.
    pub factorisations: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Steps taken, parts of halved ones counted each.
    pub steps: u64,
    /// Steps halved.
    pub halvings: u64,
}

impl Counters {
    /// Residual evaluations, Jacobians, factorisations, Newton iterations, steps, halvings.
    pub fn all(&self) -> [u64; 6] {
        let (found, solved) = (self.residual_evaluations, self.newton_iterations);
        [found, self.jacobians, self.factorisations, solved, self.steps, self.halvings]
    }
}

/// Where dF/dy was found: enough to find it again.
#[derive(Clone, Debug, Deserialize, Serialize)]
struct Origin {
    t: f64,
    y: Vec<f64>,
    y_dot: Vec<f64>,
    inputs: Inputs,
}

/// Everything that the steps to come depend on, between two steps.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct FixedMemory {
    t: f64,
    y: Vec<f64>,
    y_dot: Vec<f64>,
    origin: Option<Origin>,
    rates: [Vec<f64>; STAGES],
    last_step: Option<f64>,
    counters: Counters,
}

impl FixedMemory {
    /// Size of the state it belongs to.
    pub fn size(&self) -> usize {
        self.y.len()
    }
}

/// Integration with steps that the caller sets, and all the room it needs.
#[derive(Clone, Debug)]
pub struct FixedStep {
    layout: Layout,
    method: Radau,
    rtol: f64,
    atol: Vec<f64>,
    /// Share of the weights that the Newton iteration may leave.
    newton_share: f64,
    /// Azimuth over which dF/dy is kept [rad]; dF/dy_dot is found anew for every step.
    kept: f64,
    t: f64,
    y: Vec<f64>,
    y_dot: Vec<f64>,
    /// Whether rate and mass matrix belong to the present state.
    prepared: bool,
    /// Where dF/dy was found.
    origin: Option<Origin>,
    linear: Linearised,
    real: Factor<f64>,
    complex: Factor<Complex<f64>>,
    /// Step that the factors belong to [s].
    factored: Option<f64>,
    /// Rates at the stages of the last step, and its length.
    rates: [Vec<f64>; STAGES],
    last_step: Option<f64>,
    z: [Vec<f64>; STAGES],
    f: [Vec<f64>; STAGES],
    stages: [Vec<f64>; STAGES],
    right_real: Vec<f64>,
    right_complex: Vec<Complex<f64>>,
    /// What Newton asks the stages to change by, and the weight of every state.
    change: [Vec<f64>; STAGES],
    weight: Vec<f64>,
    secant: Secant,
    counters: Counters,
}

impl FixedStep {
    /// At state `y` and time `t` [s]; `atol` is the absolute tolerance of every state.
    pub fn new(layout: &Layout, t: f64, y: &[f64], rtol: f64, atol: &[f64], newton_share: f64) -> Self {
        let n = layout.len();
        let linear = Linearised::new(layout);
        let zeros = || std::array::from_fn(|_| vec![0.0; n]);
        Self {
            layout: layout.clone(),
            method: Radau::default(),
            rtol,
            atol: atol.to_vec(),
            newton_share,
            kept: 0.0,
            t,
            y: y.to_vec(),
            y_dot: vec![0.0; n],
            prepared: false,
            origin: None,
            real: Factor::new(&linear.slopes),
            complex: Factor::new(&linear.slopes),
            linear,
            factored: None,
            rates: zeros(),
            last_step: None,
            z: zeros(),
            f: zeros(),
            stages: zeros(),
            right_real: vec![0.0; n],
            right_complex: vec![Complex::ZERO; n],
            change: zeros(),
            weight: vec![0.0; n],
            secant: Secant::new(n),
            counters: Counters::default(),
        }
    }

    /// The same, keeping dF/dy over an azimuth of `kept` [rad].
    pub fn keeping(self, kept: f64) -> Self {
        Self { kept, ..self }
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.t
    }
    /// State.
    pub fn state(&self) -> &[f64] {
        &self.y
    }
    /// Its rate: consistent with the inputs of the last `prepare`, or that of the end of the last step.
    pub fn rate(&self) -> &[f64] {
        &self.y_dot
    }
    /// Counted work.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// What the steps to come depend on. dF/dy_dot and the factors belong to a step and are found anew by the next.
    pub fn memory(&self) -> FixedMemory {
        FixedMemory {
            t: self.t,
            y: self.y.clone(),
            y_dot: self.y_dot.clone(),
            origin: self.origin.clone(),
            rates: self.rates.clone(),
            last_step: self.last_step,
            counters: self.counters,
        }
    }

    /// Goes on from `memory`, of the same system: dF/dy is found again where it was found, to the same bits.
    pub fn recall(&mut self, system: &System, memory: FixedMemory) {
        if let Some(o) = &memory.origin {
            self.linear.renew(system, &Instant { t: o.t, y: &o.y, y_dot: &o.y_dot, inputs: &o.inputs }, true);
        }
        (self.t, self.y, self.y_dot) = (memory.t, memory.y, memory.y_dot);
        (self.origin, self.rates, self.last_step) = (memory.origin, memory.rates, memory.last_step);
        (self.prepared, self.factored, self.counters) = (false, None, memory.counters);
    }

    /// Finds the rate that satisfies F = 0 with `inputs` from now on, and linearises where dF/dy is too old.
    pub fn prepare(&mut self, system: &System, inputs: &Inputs) -> Result<(), StepFailure> {
        let renew = self.origin.as_ref().is_none_or(|origin| self.outlived(system, origin));
        self.find_rate(system, inputs, renew)
    }

    /// Whether the rotor has turned by more than dF/dy is kept since it was found.
    fn outlived(&self, system: &System, origin: &Origin) -> bool {
        let (rotor, azimuth) = (system.main(), |t, y: &[f64]| system.azimuth(0, t, y, 0));
        // a hair more, so that two steps of ten degrees count as twenty; those of a free rotor miss them by what it gathers speed
        let (turned, hair) = if rotor.speed.is_state() {
            (azimuth(self.t, &self.y) - azimuth(origin.t, &origin.y), 1e-3)
        } else {
            (rotor.turned(self.t) - rotor.turned(origin.t), 1e-6)
        };
        turned > (1.0 + hair) * self.kept
    }

    /// The rate at the present state, with dF/dy there (`renew`) or as it was.
    fn find_rate(&mut self, system: &System, inputs: &Inputs, renew: bool) -> Result<(), StepFailure> {
        let (t, y, y_dot) = (self.t, &self.y, &mut self.y_dot);
        if renew {
            self.origin = Some(Origin { t, y: y.clone(), y_dot: y_dot.clone(), inputs: inputs.clone() });
            self.counters.jacobians += 1;
        }
        let solved = self.linear.consistent(system, (t, y), y_dot, inputs, renew);
        self.counters.residual_evaluations += 1;
        self.factored = None;
        if solved.is_err() {
            return Err(self.failure(system, inputs, "the mass matrix is singular or not finite"));
        }
        if !self.y_dot.iter().all(|v| v.is_finite()) {
            return Err(self.failure(system, inputs, "a rate of state is not finite"));
        }
        self.prepared = true;
        Ok(())
    }

    /// Integrates to `t1` [s] in `parts` equal steps with `inputs` held.
    pub fn advance(
        &mut self,
        system: &System,
        t1: f64,
        inputs: &Inputs,
        parts: usize,
    ) -> Result<(), StepFailure> {
        let t0 = self.t;
        for part in 1..=parts {
            let end = if part == parts { t1 } else { t0 + (t1 - t0) * part as f64 / parts as f64 };
            self.step(system, end, inputs, 0)?;
        }
        Ok(())
    }

    fn step(&mut self, system: &System, t1: f64, inputs: &Inputs, halvings: u32) -> Result<(), StepFailure> {
        if !self.prepared {
            self.prepare(system, inputs)?;
        }
        match self.attempt(system, t1, inputs) {
            Ok(()) => Ok(()),
            // first with the derivatives of this state, then with shorter steps
            Err(_) if self.origin.as_ref().map(|o| o.t) != Some(self.t) => {
                self.find_rate(system, inputs, true)?;
                self.step(system, t1, inputs, halvings)
            }
            Err(reason) if halvings >= MAX_HALVINGS => Err(self.failure(system, inputs, reason)),
            Err(_) => {
                self.counters.halvings += 1;
                self.last_step = None;
                let middle = 0.5 * (self.t + t1);
                self.step(system, middle, inputs, halvings + 1)?;
                self.step(system, t1, inputs, halvings + 1)
            }
        }
    }

    /// One step by Newton's iteration; on an error the state is that of before.
    fn attempt(&mut self, system: &System, t1: f64, inputs: &Inputs) -> Result<(), &'static str> {
        let h = t1 - self.t;
        self.factor(h).map_err(|Singular| "the system of a step is singular or not finite")?;
        self.predict(h);
        self.secant.begin();
        for ((weight, y), atol) in self.weight.iter_mut().zip(&self.y).zip(&self.atol) {
            *weight = 1.0 / (self.rtol * y.abs() + atol);
        }
        let mut before = f64::INFINITY;
        let mut contraction: f64 = 0.5;
        let mut grown = false;
        for iteration in 0..MAX_ITERATIONS {
            let change = self.iterate(system, h, inputs);
            self.counters.newton_iterations += 1;
            if !change.is_finite() {
                return Err("the Newton iteration left the finite numbers");
            }
            if iteration > 0 {
                contraction = change / before;
                if contraction >= 1.0 && change > self.newton_share {
                    if grown {
                        return Err("the Newton iteration does not contract");
                    }
                    // a secant may lead astray once
                    grown = true;
                    self.secant.begin();
                }
            }
            before = change;
            let lacking = if contraction < 1.0 { change * contraction / (1.0 - contraction) } else { change };
            if lacking <= self.newton_share {
                self.accept(h, t1);
                return Ok(());
            }
        }
        Err("the Newton iteration does not converge")
    }

    fn factor(&mut self, h: f64) -> Result<(), Singular> {
        if self.factored != Some(h) {
            let [re, im] = self.method.complex;
            self.real.newton(&self.linear.slopes, self.method.real / h)?;
            self.complex.newton(&self.linear.slopes, Complex::new(re / h, im / h))?;
            self.factored = Some(h);
            self.counters.factorisations += 1;
        }
        Ok(())
    }

    /// Stages to start from: the rates of the last step carried on and moved to the consistent rate at the start.
    fn predict(&mut self, h: f64) {
        let c = self.method.c;
        let n = self.y.len();
        for i in 0..n {
            let mut rate = [self.y_dot[i]; STAGES];
            if let Some(last) = self.last_step {
                let k: [f64; STAGES] = std::array::from_fn(|s| self.rates[s][i]);
                // quadratic through the rates of the last stages, its value at their end taken out
                let newton = [
                    (k[1] - k[0]) / (c[1] - c[0]),
                    ((k[2] - k[1]) / (c[2] - c[1]) - (k[1] - k[0]) / (c[1] - c[0])) / (c[2] - c[0]),
                ];
                let at = |x: f64| newton[0] * (x - c[0]) + newton[1] * (x - c[0]) * (x - c[1]);
                for s in 0..STAGES {
                    rate[s] += at(1.0 + c[s] * h / last) - at(1.0);
                }
            }
            for s in 0..STAGES {
                self.z[s][i] = h * (0..STAGES).map(|j| self.method.a[s][j] * rate[j]).sum::<f64>();
            }
        }
    }

    /// One Newton iteration; returns the RMS of the change that it asks for over the weights.
    fn iterate(&mut self, system: &System, h: f64, inputs: &Inputs) -> f64 {
        let m = &self.method;
        let n = self.y.len();
        for s in 0..STAGES {
            for i in 0..n {
                self.stages[s][i] = self.y[i] + self.z[s][i];
                self.rates[s][i] = (0..STAGES).map(|j| m.inverse[s][j] * self.z[j][i]).sum::<f64>() / h;
            }
        }
        let stages = self.stages.iter().zip(&self.rates).zip(m.c).zip(&mut self.f);
        share(stages, |(((y, y_dot), c), f)| {
            system.residual_of_four(&Instant { t: self.t + c * h, y, y_dot, inputs }, f);
        });
        self.counters.residual_evaluations += STAGES as u64;
        let w = &m.t_inverse;
        for i in 0..n {
            let r: [f64; STAGES] =
                std::array::from_fn(|s| -(0..STAGES).map(|j| w[s][j] * self.f[j][i]).sum::<f64>());
            self.right_real[i] = r[0];
            self.right_complex[i] = Complex::new(r[1], r[2]);
        }
        self.real.solve(&self.linear.slopes, &mut self.right_real);
        self.complex.solve(&self.linear.slopes, &mut self.right_complex);
        let mut sum = 0.0;
        for i in 0..n {
            let dw = [self.right_real[i], self.right_complex[i].re, self.right_complex[i].im];
            for s in 0..STAGES {
                let dz: f64 = (0..STAGES).map(|j| m.t[s][j] * dw[j]).sum();
                self.change[s][i] = dz;
                sum += (dz * self.weight[i]).powi(2);
            }
        }
        self.secant.advance(&mut self.z, &self.change, &self.weight);
        // a stand whose blades are held and whose inflow is given has no state
        if n == 0 { 0.0 } else { (sum / (STAGES * n) as f64).sqrt() }
    }

    /// Takes the last stage as the new state.
    fn accept(&mut self, h: f64, t1: f64) {
        let n = self.y.len();
        for i in 0..n {
            for s in 0..STAGES {
                self.rates[s][i] =
                    (0..STAGES).map(|j| self.method.inverse[s][j] * self.z[j][i]).sum::<f64>() / h;
            }
            self.y[i] += self.z[STAGES - 1][i];
            self.y_dot[i] = self.rates[STAGES - 1][i];
        }
        self.layout.normalise(&mut self.y);
        self.t = t1;
        self.last_step = Some(h);
        self.prepared = false;
        self.counters.steps += 1;
    }

    fn failure(&self, system: &System, inputs: &Inputs, reason: &'static str) -> StepFailure {
        let mut f = vec![0.0; self.y.len()];
        let at = Instant { t: self.t, y: &self.y, y_dot: &self.y_dot, inputs };
        system.residual_of_four(&at, &mut f);
        // a state that is not a number makes every equation one: it is the one to name
        let worst = self.y.iter().position(|v| !v.is_finite()).unwrap_or_else(|| {
            let size = |v: f64| if v.is_nan() { f64::INFINITY } else { v.abs() };
            (0..f.len()).max_by(|&a, &b| size(f[a]).total_cmp(&size(f[b]))).unwrap_or(0)
        });
        StepFailure {
            t: self.t,
            azimuth: system.azimuth(0, self.t, &self.y, 0).to_degrees().rem_euclid(360.0),
            reason,
            residual: f.get(worst).copied().unwrap_or(0.0),
            equation: system.layout.names().into_iter().nth(worst).map_or_else(String::new, |(name, _)| name),
        }
    }
}
