//! Exact derivatives of F by what acts: controls, their rates, stabilator, held inflow, wind, speed of the rotors.
//!
//! A given speed is differentiated at the azimuths that the blades have: an azimuth of its own is not among what acts. Where the speed
//! is a state, torque and fuel of its engines act; one that is constant over the ground has none.

use super::instant::{Disturbance, EngineInput, HeldInflow, Inputs, Instant};
use super::layout::Layout;
use super::model::System;
use crate::numerics::scalar::{Dual, Real};
use thiserror::Error;

/// Directions carried at once: few, because the compiler unrolls all of F for each of them.
const LANES: usize = 4;
type D = Dual<LANES>;

/// dF/du, row-major, a column for every number of what acts.
#[derive(Clone, Debug)]
pub struct InputSlopes {
    /// Name and unit of every column.
    pub names: Vec<(String, &'static str)>,
    /// Entries (n, columns).
    pub values: Vec<f64>,
}

/// Thin sections hold two inflows and have no derivatives by them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("held inflow of thin sections: F has no derivatives by it")]
pub struct ThinInflow;

/// Every number of what acts, in the order of the columns; disk means follow the stations they are of.
fn numbers<'a, U>(inputs: &'a mut Inputs<U>, layout: &Layout) -> Vec<&'a mut U> {
    let mut all: Vec<&mut U> = inputs.stick.iter_mut().chain(inputs.stick_rate.iter_mut()).collect();
    all.push(&mut inputs.stabilator_incidence);
    for held in &mut inputs.inflow {
        if let HeldInflow::Stations { inflow, mean, .. } = held {
            all.extend(inflow.iter_mut());
            all.push(mean);
        }
    }
    if let Some(disturbance) = &mut inputs.disturbance {
        let given = disturbance.speed.iter_mut().zip(&layout.rotors).filter(|(_, l)| l.spin().is_none());
        all.extend(disturbance.wind.iter_mut().chain(given.flat_map(|(speed, _)| speed.iter_mut())));
    }
    if layout.rotors.iter().any(|l| l.speed.has_engines()) {
        all.extend([&mut inputs.engine.torque, &mut inputs.engine.fuel]);
    }
    all
}

/// Without derivatives, inflow as it is at `t`; a disturbance that is none where there is none, to be differentiated by.
fn constant(inputs: &Inputs, t: f64, n_rotors: usize) -> Inputs<D> {
    let inflow = inputs.inflow.iter().map(|held| match held {
        HeldInflow::Dynamic => HeldInflow::Dynamic,
        HeldInflow::Vacuum => HeldInflow::Vacuum,
        HeldInflow::Stations { inflow, mean, carried } => {
            let more =
                |i: usize| carried.as_ref().map_or(0.0, |on| on.change[i] * ((t - on.begun) / on.lasts));
            let inflow = inflow.iter().enumerate().map(|(i, v)| D::cst(v + more(i))).collect();
            HeldInflow::Stations { inflow, mean: D::cst(*mean), carried: None }
        }
    });
    let disturbance = match &inputs.disturbance {
        None => Disturbance { wind: [D::zero(); 3], gust: None, speed: vec![[D::zero(); 2]; n_rotors] },
        Some(d) => {
            let speed = d.speed.iter().map(|s| s.map(D::cst)).collect();
            Disturbance { wind: d.wind.map(D::cst), gust: d.gust.clone(), speed }
        }
    };
    Inputs {
        stick: inputs.stick.map(D::cst),
        stick_rate: inputs.stick_rate.map(D::cst),
        t_start: inputs.t_start,
        inflow: inflow.collect(),
        wash: inputs.wash,
        sections: inputs.sections.clone(),
        stabilator_incidence: D::cst(inputs.stabilator_incidence),
        engine: EngineInput { torque: D::cst(inputs.engine.torque), fuel: D::cst(inputs.engine.fuel) },
        disturbance: Some(disturbance),
    }
}

impl System {
    /// dF/du at an instant: controls, their rates, stabilator, held inflow, wind, given speed of every rotor and its rate, or what
    /// its engines are given.
    pub fn input_slopes(&self, at: &Instant<f64>) -> Result<InputSlopes, ThinInflow> {
        let held = |r: usize| matches!(at.inputs.inflow[r], HeldInflow::Stations { .. });
        if self.each_rotor().any(|(r, rotor, _)| rotor.thin.is_some() && held(r)) {
            return Err(ThinInflow);
        }
        let lifted = |v: &[f64]| -> Vec<D> { v.iter().map(|&x| D::cst(x)).collect() };
        let (y, y_dot) = (lifted(at.y), lifted(at.y_dot));
        let names = self.input_names(at.inputs);
        let (n, columns) = (at.y.len(), names.len());
        let mut values = vec![0.0; n * columns];
        let mut f = vec![D::zero(); n];
        for first in (0..columns).step_by(LANES) {
            let lanes = LANES.min(columns - first);
            let mut inputs = constant(at.inputs, at.t, self.rotors.len());
            for (lane, number) in
                numbers(&mut inputs, &self.layout)[first..first + lanes].iter_mut().enumerate()
            {
                number.eps[lane] = 1.0;
            }
            self.residual(&Instant { t: at.t, y: &y, y_dot: &y_dot, inputs: &inputs }, &mut f);
            for (row, value) in values.chunks_exact_mut(columns).zip(&f) {
                row[first..first + lanes].copy_from_slice(&value.eps[..lanes]);
            }
        }
        Ok(InputSlopes { names, values })
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
        let wind = if self.layout.free { ["north", "east", "down"] } else { ["x", "y", "z"] };
        names.extend(wind.map(|axis| (format!("wind_{axis}"), "m/s")));
        for l in self.layout.rotors.iter().filter(|l| l.spin().is_none()) {
            names.push((format!("rotor.{}.speed", l.name), "rad/s"));
            names.push((format!("rotor.{}.speed_rate", l.name), "rad/s2"));
        }
        if self.layout.rotors.iter().any(|l| l.speed.has_engines()) {
            names.extend(
                [("engine_torque", "N m"), ("engine_fuel", "1")].map(|(n, unit)| (n.to_string(), unit)),
            );
        }
        names
    }
}
