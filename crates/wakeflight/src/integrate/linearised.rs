//! F linearised at one instant: its two matrices, and the rate of state that satisfies F = 0 there.

use super::blocks::{Factor, Singular};
use crate::system::instant::{Inputs, Instant};
use crate::system::layout::Layout;
use crate::system::model::System;
use crate::system::slopes::Slopes;

/// dF/dy and dF/dy_dot at the instant last asked for, with the room to find them.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// Derivatives, in blocks.
    pub slopes: Slopes,
    mass: Factor<f64>,
    f: Vec<f64>,
}

impl Linearised {
    /// Room for a system with this layout.
    pub fn new(layout: &Layout) -> Self {
        let slopes = Slopes::new(layout);
        Self { mass: Factor::new(&slopes), slopes, f: vec![0.0; layout.len()] }
    }

    /// Finds dF/dy_dot at an instant, and dF/dy (`whole`) or leaves that as it was.
    pub fn renew(&mut self, system: &System, at: &Instant<f64>, whole: bool) {
        if whole {
            system.slopes(at, &mut self.slopes);
        } else {
            system.mass_slopes(at, &mut self.slopes);
        }
    }

    /// Renews the derivatives at (t, y) and corrects `y_dot` so that F = 0: F is linear in it and dF/dy_dot is that of this
    /// state, so one correction is exact. Fails where the mass matrix is singular, which no blade with mass has.
    pub fn consistent(
        &mut self,
        system: &System,
        (t, y): (f64, &[f64]),
        y_dot: &mut [f64],
        inputs: &Inputs,
        whole: bool,
    ) -> Result<(), Singular> {
        let at = Instant { t, y, y_dot, inputs };
        self.renew(system, &at, whole);
        self.correct(system, &at)?;
        self.take_off(y_dot);
        Ok(())
    }

    /// What F = 0 asks to take off y_dot, by the matrix of this state.
    fn correct(&mut self, system: &System, at: &Instant<f64>) -> Result<(), Singular> {
        system.residual_of_four(at, &mut self.f);
        self.mass.mass(&self.slopes)?;
        self.mass.solve(&self.slopes, &mut self.f);
        Ok(())
    }

    fn take_off(&self, y_dot: &mut [f64]) {
        for (rate, correction) in y_dot.iter_mut().zip(&self.f) {
            *rate -= correction;
        }
    }
}

impl System {
    /// Rate of state that satisfies F = 0 at (t, y): F is linear in it, so one solve with its matrix gives it.
    ///
    /// Fails where the mass matrix is singular, which no blade with mass has.
    pub fn consistent_rate(&self, t: f64, y: &[f64], inputs: &Inputs) -> Result<Vec<f64>, Singular> {
        let still = vec![0.0; y.len()];
        let at = Instant { t, y, y_dot: &still, inputs };
        let mut slopes = Slopes::new(&self.layout);
        self.mass_slopes(&at, &mut slopes);
        let mut mass = Factor::new(&slopes);
        mass.mass(&slopes)?;
        let mut rate = vec![0.0; y.len()];
        self.residual_of_four(&at, &mut rate);
        mass.solve(&slopes, &mut rate);
        rate.iter_mut().for_each(|r| *r = -*r);
        Ok(rate)
    }
}
