//! F linearised at one instant: its two matrices, and the rate of state that satisfies F = 0 there.

use super::blocks::{Factor, Singular};
use crate::aircraft::jacobian::Slopes;
use crate::aircraft::model::{Aircraft, Inputs};
use crate::aircraft::state::Layout;

/// dF/dy and dF/dy_dot at the instant last asked for, with the room to find them.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// Derivatives, in blocks.
    pub slopes: Slopes,
    mass: Factor<f64>,
    f: Vec<f64>,
}

impl Linearised {
    /// Room for an aircraft with this layout.
    pub fn new(layout: Layout) -> Self {
        let slopes = Slopes::new(layout);
        Self { mass: Factor::new(&slopes), slopes, f: vec![0.0; layout.len()] }
    }

    /// Linearises at (t, y, y_dot).
    pub fn renew(&mut self, aircraft: &Aircraft, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs) {
        aircraft.slopes(t, y, y_dot, inputs, &mut self.slopes);
    }

    /// Finds dF/dy_dot at (t, y); dF/dy is left as it was.
    pub fn renew_mass(&mut self, aircraft: &Aircraft, t: f64, y: &[f64], inputs: &Inputs) {
        aircraft.mass_slopes(t, y, inputs, &mut self.slopes);
    }

    /// Finds dF/dy_dot at (t, y), leaves dF/dy as it was, and corrects `y_dot` as `consistent` does.
    pub fn consistent_by_mass(
        &mut self,
        aircraft: &Aircraft,
        t: f64,
        y: &[f64],
        y_dot: &mut [f64],
        inputs: &Inputs,
    ) -> Result<(), Singular> {
        self.renew_mass(aircraft, t, y, inputs);
        self.correct(aircraft, t, y, y_dot, inputs)
    }

    /// Linearises at (t, y) and corrects `y_dot` so that F = 0: F is linear in it and the matrix is that of this state,
    /// so one correction is exact. Fails where the mass matrix is singular, which no blade with mass has.
    pub fn consistent(
        &mut self,
        aircraft: &Aircraft,
        t: f64,
        y: &[f64],
        y_dot: &mut [f64],
        inputs: &Inputs,
    ) -> Result<(), Singular> {
        self.renew(aircraft, t, y, y_dot, inputs);
        self.correct(aircraft, t, y, y_dot, inputs)
    }

    /// Takes off `y_dot` what F = 0 asks for, by the matrix of this state.
    fn correct(
        &mut self,
        aircraft: &Aircraft,
        t: f64,
        y: &[f64],
        y_dot: &mut [f64],
        inputs: &Inputs,
    ) -> Result<(), Singular> {
        aircraft.residual_of_four(t, y, y_dot, inputs, &mut self.f);
        self.mass.mass(&self.slopes)?;
        self.mass.solve(&self.slopes, &mut self.f);
        for (rate, correction) in y_dot.iter_mut().zip(&self.f) {
            *rate -= correction;
        }
        Ok(())
    }
}
