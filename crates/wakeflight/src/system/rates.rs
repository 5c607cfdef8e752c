//! y_dot in closed form where the blades do not bend.
//!
//! F is linear in y_dot, with ones on all rows but those of the accelerations. There, with a = (v_dot, omega_dot) of the
//! body and N, H the inertia that a blade's hinges share with the body and have alone,
//! M a + sum N q_ddot = g, N^T a + H q_ddot = g_q, where g is F without accelerations. Blades are eliminated one by one.

use super::carrier::Carrier;
use super::instant::{Inputs, Instant};
use super::layout::{Layout, body_vector};
use super::model::System;
use crate::blade::rigid::RigidInertia;
use crate::numerics::frames::{Hub, Vec3};
use crate::rotor::hub::Rotor;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use thiserror::Error;

/// Most modes of a blade that does not bend: lag and flap.
const MOST_HINGES: usize = 2;

/// The inertia of hinges or body has no inverse: a state that is not finite, or a blade without mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the inertia of blades and body has no inverse")]
pub struct NoInertia;

/// Inertia of one blade in motion: N column by column, H^-1.
#[derive(Clone, Copy, Debug)]
struct BladeInertia {
    shared: [Vector6<f64>; MOST_HINGES],
    own_inverse: [[f64; MOST_HINGES]; MOST_HINGES],
}

/// Finds y_dot of a system whose blades do not bend, with the room it needs.
#[derive(Clone, Debug)]
pub struct RigidRates {
    /// Airframe: force and moment of inertia by (v_dot, omega_dot); none on a stand.
    airframe: Option<Matrix6<f64>>,
    rotors: Vec<RotorInertia>,
    no_rate: Vec<f64>,
}

/// Inertia of a rotor's blades in motion.
#[derive(Clone, Debug)]
struct RotorInertia {
    /// Acceleration of the hub in hub axes by that of the carrier.
    to_hub: Matrix6<f64>,
    blades: Vec<BladeInertia>,
}

impl RigidRates {
    /// For `system`; none where blades bend or the speed of a rotor is a state.
    pub fn new(system: &System) -> Option<Self> {
        // a speed that is a state shares the inertia of all: the implicit steps have it
        let rigid =
            |r: &Rotor| r.blade.rigid.is_some() && r.blade.n_modes <= MOST_HINGES && !r.speed.is_state();
        if !system.rotors.iter().all(rigid) {
            return None;
        }
        let nothing = Vec3::zero();
        let airframe = system.carrier.airframe().map(|airframe| {
            let mut inertia = Matrix6::zeros();
            for k in 0..6 {
                let mut unit = [0.0; 6];
                unit[k] = 1.0;
                let (v_dot, omega_dot) = (body_vector(&unit, 0..3), body_vector(&unit, 3..6));
                let (force, moment) =
                    airframe.mass.inertial_residual(nothing, nothing, v_dot, omega_dot, nothing);
                inertia.set_column(k, &-joined(force.array(), moment.array()));
            }
            inertia
        });
        let none = BladeInertia {
            shared: [Vector6::zeros(); MOST_HINGES],
            own_inverse: [[0.0; MOST_HINGES]; MOST_HINGES],
        };
        let rotors = system.each_rotor().map(|(r, rotor, _)| {
            let by_carrier = system.hub_by_carrier(r);
            let to_hub = Matrix6::from_fn(|i, k| by_carrier[i][k]);
            RotorInertia { to_hub, blades: vec![none; rotor.n_blades] }
        });
        Some(Self { airframe, rotors: rotors.collect(), no_rate: vec![0.0; system.layout.len()] })
    }

    /// y_dot at (t, y) into `rate`.
    pub fn find(
        &mut self,
        system: &System,
        (t, y): (f64, &[f64]),
        inputs: &Inputs,
        rate: &mut [f64],
    ) -> Result<(), NoInertia> {
        let at = Instant { t, y, y_dot: &self.no_rate, inputs };
        system.residual_of_four(&at, rate);
        // ones on the rows of kinematics and inflow; the rows of accelerations hold g, scaled
        let mut g = match &system.carrier {
            Carrier::Airframe(airframe) => Vector6::from_fn(|i, _| match i {
                0..3 => rate[i] * airframe.gross_mass,
                _ => rate[i] * airframe.reference_inertia[i - 3],
            }),
            Carrier::Stand(_) => Vector6::zeros(),
        };
        for value in &mut rate[system.layout.carrier_motion().end..] {
            *value = -*value;
        }
        let mut whole = self.airframe;
        for ((r, rotor, l), found) in system.each_rotor().zip(&mut self.rotors) {
            let (m, spin) = (l.n_modes, system.spin(r, &at));
            let mut hub_inertia = Matrix6::zeros();
            let mut hub_load = Vector6::zeros();
            for b in 0..l.n_blades {
                let psi = rotor.azimuth(spin.psi, b);
                let modal = system.modal_motion(r, y, at.y_dot, b);
                let control = system.blade_pitch(r, inputs, (t, &spin), b);
                let inertia = rotor.blade.inertia_about_hinge(psi, &modal, &control).ok_or(NoInertia)?;
                let blade = &mut found.blades[b];
                *blade = BladeInertia::of(&inertia, m).ok_or(NoInertia)?;
                hub_inertia += about_hub(&inertia);
                let s = l.modal_rate(b).start;
                for i in 0..m {
                    for j in 0..m {
                        let weight = blade.own_inverse[i][j];
                        hub_inertia -= blade.shared[i] * blade.shared[j].transpose() * weight;
                        // g_q has changed its sign above
                        hub_load += blade.shared[i] * (weight * rate[s + j]);
                    }
                }
            }
            if let Some(whole) = &mut whole {
                g += found.to_hub.transpose() * hub_load;
                *whole += found.to_hub.transpose() * hub_inertia * found.to_hub;
            }
        }
        let mut a = Vector6::zeros();
        if let Some(whole) = whole {
            a = whole.cholesky().ok_or(NoInertia)?.solve(&g);
            for (value, found) in rate[Layout::VELOCITY.start..Layout::RATES.end].iter_mut().zip(a.iter()) {
                *value = *found;
            }
        }
        for (found, l) in self.rotors.iter().zip(&system.layout.rotors) {
            let (a_hub, m) = (found.to_hub * a, l.n_modes);
            for (b, blade) in found.blades.iter().enumerate() {
                let s = l.modal_rate(b).start;
                let mut left = [0.0; MOST_HINGES];
                for i in 0..m {
                    left[i] = -rate[s + i] - blade.shared[i].dot(&a_hub);
                }
                for i in 0..m {
                    rate[s + i] = (0..m).map(|j| blade.own_inverse[i][j] * left[j]).sum();
                }
            }
        }
        Ok(())
    }
}

fn joined(a: [f64; 3], b: [f64; 3]) -> Vector6<f64> {
    Vector6::new(a[0], a[1], a[2], b[0], b[1], b[2])
}

impl BladeInertia {
    /// Of a blade with `m` hinges; none where they have no inertia.
    fn of(blade: &RigidInertia, m: usize) -> Option<Self> {
        let mut shared = [Vector6::zeros(); MOST_HINGES];
        let mut own = [[0.0; MOST_HINGES]; MOST_HINGES];
        for i in 0..m {
            let turn = blade.turns[i];
            let momentum = turned(&blade.inertia, turn);
            let force = turn.cross(blade.first_moment);
            let moment = blade.hinge.cross(force) + momentum;
            shared[i] = joined(force.array(), moment.array());
            for j in 0..m {
                own[i][j] = blade.turns[j].dot(momentum);
            }
        }
        let own_inverse = match m {
            0 => own,
            1 => [[1.0 / own[0][0], 0.0], [0.0, 0.0]],
            _ => {
                let det = own[0][0] * own[1][1] - own[0][1] * own[1][0];
                [[own[1][1] / det, -own[0][1] / det], [-own[1][0] / det, own[0][0] / det]]
            }
        };
        own_inverse.iter().flatten().all(|v| v.is_finite()).then_some(Self { shared, own_inverse })
    }
}

fn turned(inertia: &[Vec3<f64, Hub>; 3], v: Vec3<f64, Hub>) -> Vec3<f64, Hub> {
    inertia[0].scaled(v.x) + inertia[1].scaled(v.y) + inertia[2].scaled(v.z)
}

/// Force and moment of a blade by acceleration and angular acceleration of the hub, hub axes about its centre.
fn about_hub(blade: &RigidInertia) -> Matrix6<f64> {
    let vector = |v: Vec3<f64, Hub>| Vector3::from(v.array());
    let (p, s) = (vector(blade.hinge), vector(blade.first_moment));
    let first = p * blade.mass + s;
    let at_hinge = Matrix3::from_columns(&blade.inertia.map(vector));
    let unit = Matrix3::identity();
    let inertia = at_hinge + (unit * p.dot(&p) - p * p.transpose()) * blade.mass + unit * (2.0 * p.dot(&s))
        - p * s.transpose()
        - s * p.transpose();
    let cross = first.cross_matrix();
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&(unit * blade.mass));
    whole.fixed_view_mut::<3, 3>(0, 3).copy_from(&-cross);
    whole.fixed_view_mut::<3, 3>(3, 0).copy_from(&cross);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
    whole
}
