//! Passages of blades: loads on the hub and the air at the stations, instant by instant.

use super::circulation::BladeInstant;
use super::hub::Rotor;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_motion::HubMotion;
use crate::blade::surroundings::BladeInflow;

/// Names of what is kept of the air at every station.
pub const FIELDS: [&str; 8] = ["cl", "cd", "cm", "alpha", "mach", "circulation", "speed", "inflow"];

/// What blades saw and did, instant after instant.
#[derive(Clone, Debug, Default)]
pub struct Passages {
    /// Force and moment on the hub and the shares of the air in both, three components each [N, N m].
    pub loads: [Vec<f64>; 4],
    /// Of [`FIELDS`], station by station.
    pub fields: [Vec<f64>; 8],
}

impl Rotor {
    /// Of blades at their instants, each with its inflow, on a hub in motion.
    pub fn passages<'a>(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blades: impl Iterator<Item = (BladeInstant, BladeInflow<'a, f64>)>,
    ) -> Passages {
        let mut found = Passages::default();
        for (blade, given) in blades {
            let psi = blade.psi;
            let b = self.blade_loads(air, hub, psi, &blade.modal, &blade.control, &given);
            for (all, one) in found.loads.iter_mut().zip([b.force, b.moment, b.aero_force, b.aero_moment]) {
                all.extend(one.array());
            }
            let fields = &mut found.fields;
            for (s, lambda) in self.blade_air(air, hub, psi, &blade.modal, &blade.control, &given) {
                let values = [s.cl, s.cd, s.cm, s.alpha, s.mach, s.circulation, s.speed, lambda];
                for (field, value) in fields.iter_mut().zip(values) {
                    field.push(value);
                }
            }
        }
        found
    }
}
