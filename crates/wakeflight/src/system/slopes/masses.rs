//! What acts by accelerations: mass matrices of the blades, their dampers, and what attitude does by the weight.

use super::{BladeSlopes, N_LOADS, Slopes};
use crate::blade::mass_matrix::BladeMass;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::system::instant::Instant;
use crate::system::layout::Layout;
use crate::system::model::System;

/// Motion of a hub by that of its carrier.
struct HubByCarrier {
    /// Acceleration of the hub less gravity and angular acceleration, hub axes, by (v_dot, omega_dot).
    acceleration: [[f64; 6]; 6],
    /// Its acceleration less gravity by the attitude quaternion.
    by_attitude: [[f64; 3]; 4],
    /// Columns of the carrier's motion and attitude: none on a stand.
    moving: usize,
    turning: usize,
}

impl System {
    /// Mass matrices of the blades, their dampers, and what attitude does by the weight.
    pub(super) fn masses(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        // accelerations are in none of it
        let still = at.y;
        let mut offset = 0;
        for (r, rotor, _) in self.each_rotor() {
            let acceleration = *slopes.rotors[r].hub_by_carrier.get_or_insert_with(|| self.hub_by_carrier(r));
            let hub = HubByCarrier {
                acceleration,
                by_attitude: self.weight_by_attitude(r, at.y),
                moving: self.layout.carrier_motion().len(),
                turning: self.layout.attitude().len(),
            };
            let (n, mass, spin) = (rotor.n_blades, rotor.blade.mass, self.spin(r, at));
            let turned_by = self.layout.rotors[r].spin().map(|place| slopes.place[place.speed]);
            for first in (0..n).step_by(4) {
                // fewer than four left: the last stands in for those that are not there
                let blade = |k: usize| (first + k).min(n - 1);
                let poses = std::array::from_fn(|k| {
                    let b = blade(k);
                    let psi = rotor.azimuth(spin.psi, b);
                    (
                        psi,
                        self.modal_motion(r, at.y, still, b),
                        self.blade_pitch(r, at.inputs, (at.t, &spin), b),
                    )
                });
                let pitched = self.pitched_by_turn(r, at, std::array::from_fn(blade));
                let (masses, turned) = rotor.four_mass_matrices(&poses, pitched);
                for (b, (blade, (_, modal, control))) in (first..n).zip(masses.iter().zip(&poses)) {
                    let slopes = &mut slopes.blades[offset + b];
                    slopes.keep_mass(mass, blade, &hub);
                    slopes.add_damper(&rotor.damper_slopes(modal, control));
                }
                if let (Some(column), Some(turned)) = (turned_by, &turned) {
                    for (b, mass) in (first..n).zip(turned) {
                        slopes.blades[offset + b].keep_turn(column, mass);
                    }
                }
            }
            offset += n;
        }
        self.engines_by_turn(at, slopes);
    }

    /// Derivatives of the acceleration of hub `r` less gravity by the attitude quaternion; zero on a stand.
    fn weight_by_attitude(&self, r: usize, y: &[f64]) -> [[f64; 3]; 4] {
        if !self.layout.free {
            return [[0.0; 3]; 4];
        }
        let no_rate = [Dual::<4>::zero(); Layout::RATES.end];
        let carrier: [Dual<4>; Layout::POSITION.end] = std::array::from_fn(|i| {
            if Layout::ATTITUDE.contains(&i) {
                Dual::variable(y[i], i - Layout::ATTITUDE.start)
            } else {
                Dual::cst(y[i])
            }
        });
        let acceleration = self.hub_motion(r, &carrier, &no_rate).acceleration_less_gravity.array();
        std::array::from_fn(|k| acceleration.map(|a| a.eps[k]))
    }

    /// Acceleration of hub `r` less gravity and angular acceleration, hub axes, by (v_dot, omega_dot) of the carrier.
    pub(in crate::system) fn hub_by_carrier(&self, r: usize) -> [[f64; 6]; 6] {
        let mut by_carrier = [[0.0; 6]; 6];
        if !self.layout.free {
            return by_carrier;
        }
        let nothing = Vec3::zero();
        for k in 0..6 {
            let mut unit = [0.0; 6];
            unit[k] = 1.0;
            let (v_dot, omega_dot) =
                (Vec3::new(unit[0], unit[1], unit[2]), Vec3::new(unit[3], unit[4], unit[5]));
            let hub = self.rotors[r].hub_motion(nothing, nothing, v_dot, omega_dot, nothing);
            let (a, w) = (hub.acceleration_less_gravity.array(), hub.omega_dot.array());
            for i in 0..3 {
                by_carrier[i][k] = a[i];
                by_carrier[3 + i][k] = w[i];
            }
        }
        by_carrier
    }
}

impl BladeSlopes {
    /// Keeps what the blade's mass says: loads are minus its products with the accelerations.
    fn keep_mass(&mut self, mass: f64, blade_mass: &BladeMass<f64>, by_carrier: &HubByCarrier) {
        let m = self.n_modes();
        let [x, y, z] = blade_mass.first_moment.array();
        // force by angular acceleration, -first x, and its transpose
        let cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
        let inertia = blade_mass.inertia.map(Vec3::array);
        // rows force, moment by columns acceleration, angular acceleration of the hub
        let mut hub = [[0.0; 6]; 6];
        for i in 0..3 {
            hub[i][i] = mass;
            for j in 0..3 {
                hub[i][3 + j] = cross[i][j];
                hub[3 + j][i] = cross[i][j];
                hub[3 + i][3 + j] = inertia[j][i];
            }
        }
        for k in 0..by_carrier.moving {
            for (i, row) in hub.iter().enumerate() {
                let sum: f64 = (0..6).map(|j| row[j] * by_carrier.acceleration[j][k]).sum();
                self.loads_by_shared_dot.set(i, k, -sum);
            }
        }
        let attitude = by_carrier.by_attitude.iter().enumerate().take(by_carrier.turning);
        for (k, by_acceleration) in attitude.clone() {
            // the share of the air has no part in the weight
            for i in hub.len()..N_LOADS {
                self.loads_by_shared.set(i, Layout::ATTITUDE.start + k, self.loads_by_wind.at(i, k));
            }
            for (i, row) in hub.iter().enumerate() {
                let sum: f64 = (0..3).map(|j| row[j] * by_acceleration[j]).sum();
                self.loads_by_shared.set(i, Layout::ATTITUDE.start + k, self.loads_by_wind.at(i, k) - sum);
            }
        }
        for i in 0..m {
            let (force, moment) = (blade_mass.force[i].array(), blade_mass.moment[i].array());
            let shared: [f64; N_LOADS / 2] =
                std::array::from_fn(|k| if k < 3 { force[k] } else { moment[k - 3] });
            for j in 0..m {
                self.own_dot.set(i, j, -blade_mass.own[i][j]);
            }
            for (k, value) in shared.iter().enumerate() {
                self.loads_dot.set(k, i, -value);
            }
            for k in 0..by_carrier.moving {
                let sum: f64 = (0..6).map(|j| shared[j] * by_carrier.acceleration[j][k]).sum();
                self.by_shared_dot.set(i, k, -sum);
            }
            for (k, by_acceleration) in attitude.clone() {
                let sum: f64 = (0..3).map(|j| shared[j] * by_acceleration[j]).sum();
                self.by_shared.set(i, Layout::ATTITUDE.start + k, self.by_wind.at(i, k) - sum);
            }
        }
    }
}
