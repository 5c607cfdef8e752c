//! Exact derivatives of F by what acts: controls, their rates, stabilator, held inflow.

use super::instant::{HeldInflow, Inputs, Instant};
use super::model::System;
use crate::numerics::scalar::{Dual, Real};

/// Directions carried at once.
const LANES: usize = 16;
type D = Dual<LANES>;

/// dF/du, row-major, a column for every number of what acts.
#[derive(Clone, Debug)]
pub struct InputSlopes {
    /// Name and unit of every column.
    pub names: Vec<(String, &'static str)>,
    /// Entries (n, columns).
    pub values: Vec<f64>,
}

/// Every number of what acts, in the order of the columns; disk means follow the stations they are of.
fn numbers<U>(inputs: &mut Inputs<U>) -> Vec<&mut U> {
    let mut all: Vec<&mut U> = inputs.stick.iter_mut().chain(inputs.stick_rate.iter_mut()).collect();
    all.push(&mut inputs.stabilator_incidence);
    for held in &mut inputs.inflow {
        if let HeldInflow::Stations { inflow, mean } = held {
            all.extend(inflow.iter_mut());
            all.push(mean);
        }
    }
    all
}

fn constant(inputs: &Inputs) -> Inputs<D> {
    let inflow = inputs.inflow.iter().map(|held| match held {
        HeldInflow::Dynamic => HeldInflow::Dynamic,
        HeldInflow::Vacuum => HeldInflow::Vacuum,
        HeldInflow::Stations { inflow, mean } => {
            HeldInflow::Stations { inflow: inflow.iter().map(|&v| D::cst(v)).collect(), mean: D::cst(*mean) }
        }
    });
    Inputs {
        stick: inputs.stick.map(D::cst),
        stick_rate: inputs.stick_rate.map(D::cst),
        t_start: inputs.t_start,
        inflow: inflow.collect(),
        stabilator_incidence: D::cst(inputs.stabilator_incidence),
    }
}

impl System {
    /// dF/du at an instant. Held inflow on a lifting line: thin sections are not differentiated by theirs.
    pub fn input_slopes(&self, at: &Instant<f64>) -> InputSlopes {
        let lifted = |v: &[f64]| -> Vec<D> { v.iter().map(|&x| D::cst(x)).collect() };
        let (y, y_dot) = (lifted(at.y), lifted(at.y_dot));
        let names = self.input_names(at.inputs);
        let (n, columns) = (at.y.len(), names.len());
        let mut values = vec![0.0; n * columns];
        let mut f = vec![D::zero(); n];
        for first in (0..columns).step_by(LANES) {
            let lanes = LANES.min(columns - first);
            let mut inputs = constant(at.inputs);
            for (lane, number) in numbers(&mut inputs)[first..first + lanes].iter_mut().enumerate() {
                number.eps[lane] = 1.0;
            }
            self.residual(&Instant { t: at.t, y: &y, y_dot: &y_dot, inputs: &inputs }, &mut f);
            for (row, value) in values.chunks_exact_mut(columns).zip(&f) {
                row[first..first + lanes].copy_from_slice(&value.eps[..lanes]);
            }
        }
        InputSlopes { names, values }
    }

    fn input_names(&self, inputs: &Inputs) -> Vec<(String, &'static str)> {
        let controls: [(&str, &str, &str); 4] = if self.layout.free {
            ["lateral", "longitudinal", "collective", "pedal"].map(|name| (name, "m", "m/s"))
        } else {
            ["theta_0", "theta_1c", "theta_1s", "none"].map(|name| (name, "rad", "rad/s"))
        };
        let mut names: Vec<(String, &'static str)> =
            controls.iter().map(|(name, unit, _)| ((*name).to_string(), *unit)).collect();
        names.extend(controls.iter().map(|(name, _, unit)| (format!("{name}_rate"), *unit)));
        names.push(("stabilator".into(), "rad"));
        for (held, (_, rotor, l)) in inputs.inflow.iter().zip(self.each_rotor()) {
            if let HeldInflow::Stations { inflow, .. } = held {
                let width = inflow.len() / rotor.n_blades;
                let of = |k: usize| {
                    let (b, j) = (k / width, k % width);
                    (format!("rotor.{}.blade_{b}.inflow_{j}", l.name), "1")
                };
                names.extend((0..inflow.len()).map(of));
                names.push((format!("rotor.{}.inflow_mean", l.name), "1"));
            }
        }
        names
    }
}
