//! Trim of a rotor on a stand: pitch controls given, or found for thrust, torque, flapping, hub moments.

use super::host::{Balances, Carried, Head, Host, RotorMean};
use crate::blade::aerodynamics::Air;
use crate::blade::kinematics::PitchMotion;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use crate::rotor::stand::Stand;

impl Host for Stand {
    fn controls(&self) -> &'static [(&'static str, &'static str)] {
        &[("theta_0", "rad"), ("theta_1c", "rad"), ("theta_1s", "rad")]
    }

    fn flies(&self) -> bool {
        false
    }

    fn has_tail_rotor(&self) -> bool {
        false
    }

    fn rotor(&self) -> &Rotor {
        &self.rotor
    }

    fn air(&self) -> Air {
        self.air
    }

    fn pitt_peters(&self) -> &PittPeters {
        &self.pitt_peters
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

    fn pitch<S: Real>(&self, [theta_0, theta_1c, theta_1s, none]: [S; 4]) -> [S; 4] {
        [theta_1c, theta_1s, theta_0, none]
    }

    fn blade_pitch<S: Real>(&self, pitch: &[S; 4], psi: f64) -> PitchMotion<S> {
        Stand::pitch(self, [pitch[2], pitch[0], pitch[1]], psi)
    }

    fn carried<S: Real>(&self, _: &Head<S>) -> Carried<S> {
        Carried { y: Vec::new(), hub: self.hub(self.velocity, self.rates).constant() }
    }

    fn balances<S: Real>(&self, _: &Head<S>, _: &Carried<S>, _: &RotorMean<S>) -> Option<Balances<S>> {
        None
    }
}
