//! The places of an aircraft that feel a wind: origin of the body, hub, tail, blade stations; what the wind is to it there.

use super::spread::{Spread, Triple, dot};
use crate::numerics::frames::{Body, Inertial, Rotation, Vec3, rot_ib};
use crate::rotor::hub::Rotor;

/// A wind where an aircraft is, held over a coupling step; velocities in inertial axes [m/s].
#[derive(Clone, Debug, Default)]
pub struct Air {
    /// At the origin of the body.
    pub origin: Triple,
    /// At the hub of the first rotor.
    pub at_hub: Triple,
    /// Rates at which it turns about the airframe [rad/s], body axes.
    pub turn: Triple,
    /// Along the shaft at the stations of the first rotor less that at its hub, as inflow, positive down (n_blades, n_stations); none
    /// where the air is the same everywhere.
    pub stations: Option<Vec<f64>>,
    /// Largest component anywhere; not a number where one is none.
    pub largest: f64,
}

impl Air {
    /// The same everywhere.
    pub fn uniform(velocity: Triple) -> Self {
        Self { origin: velocity, at_hub: velocity, largest: largest(&[velocity]), ..Self::default() }
    }

    /// Adds what the stations have to rows of held inflow, of thin sections along both lines of the chord.
    pub fn on(&self, n_stations: usize, held: &mut [f64]) {
        let Some(stations) = self.stations.as_ref().filter(|rows| !rows.is_empty()) else { return };
        let width = held.len() * n_stations / stations.len();
        if width == 0 {
            return;
        }
        for (row, felt) in held.chunks_mut(width).zip(stations.chunks(n_stations)) {
            row.iter_mut().zip(felt.iter().cycle()).for_each(|(inflow, more)| *inflow += more);
        }
    }

    /// Velocity against it in the states `y` of an airframe [m/s], body axes.
    pub fn against(&self, y: &[f64]) -> Triple {
        let moved = to_inertial(y).transposed() * Vec3::cst(self.origin);
        [y[0] - moved.x, y[1] - moved.y, y[2] - moved.z]
    }
}

/// Places of one aircraft in its own axes.
#[derive(Clone, Debug)]
pub struct Places {
    hub: Triple,
    behind: Triple,
    /// Axes of the hub in the body, y in the sense of rotation.
    axes: [Vec3<f64, Body>; 3],
    n_blades: usize,
    reach: Vec<f64>,
    tip_speed: f64,
}

fn to_inertial(y: &[f64]) -> Rotation<f64, Inertial, Body> {
    rot_ib([y[6], y[7], y[8], y[9]])
}

fn largest(found: &[Triple]) -> f64 {
    found.iter().flatten().fold(0.0, |most, v| if v.abs() <= most { most } else { v.abs() })
}

impl Places {
    /// Of an airframe with this rotor and something `behind` that feels gradients.
    pub fn of(rotor: &Rotor, behind: Triple) -> Self {
        let [x, y, z] = rotor.rot_hb::<f64>().rows.map(Vec3::from_array);
        Self {
            hub: rotor.position,
            behind,
            axes: [x, y.scaled(rotor.sense.hand()), z],
            n_blades: rotor.n_blades,
            reach: rotor.blade.stations.iter().map(|station| station.shapes.x).collect(),
            tip_speed: rotor.tip_speed(),
        }
    }

    /// Number of blade stations.
    pub fn n_stations(&self) -> usize {
        self.reach.len()
    }

    /// Where they are `ahead` [s] of the states `y`, the first blade then at `azimuth` [rad]; blades straight and without flap.
    pub fn spread(&self, y: &[f64], azimuth: f64, ahead: f64) -> Spread {
        let turn = to_inertial(y);
        let pace = (turn * Vec3::new(y[0], y[1], y[2])).array();
        let origin: Triple = std::array::from_fn(|i| y[10 + i] + ahead * pace[i]);
        let place = |p: Triple| {
            let from = (turn * Vec3::cst(p)).array();
            std::array::from_fn(|i| origin[i] + from[i])
        };
        let [aft, side, _] = self.axes.map(|axis| (turn * axis).array());
        let spoke = |b: usize| {
            let (s, c) = (azimuth + std::f64::consts::TAU * b as f64 / self.n_blades as f64).sin_cos();
            std::array::from_fn(|i| c * aft[i] + s * side[i])
        };
        Spread {
            fixed: [origin, place(self.hub), place(self.behind)],
            spokes: (0..self.n_blades).map(spoke).collect(),
            reach: self.reach.clone(),
        }
    }

    /// What an aircraft with the states `y` feels of velocities that were `found` there, in the order of the points.
    pub fn felt(&self, y: &[f64], found: &[Triple]) -> Air {
        let [origin, at_hub, tail] = [found[0], found[1], found[2]];
        let whole = Air { origin, at_hub, largest: largest(found), ..Air::default() };
        if found.iter().all(|velocity| *velocity == origin) {
            return whole;
        }
        let turn = to_inertial(y);
        let shaft = (turn * self.axes[2]).array();
        let less = |a: &Triple, b: &Triple| -> Triple { std::array::from_fn(|i| a[i] - b[i]) };
        let inflow = |v: &Triple| dot(&less(v, &at_hub), &shaft) / -self.tip_speed;
        // gradients of the line to the tail: w by x turns as a rate of pitch, v by x as one of yaw
        let along = if self.behind[0] == 0.0 { 1.0 } else { self.behind[0] };
        let gradient = turn.transposed() * Vec3::cst(less(&tail, &origin));
        Air {
            turn: [0.0, -gradient.z / along, gradient.y / along],
            stations: Some(found[3..].iter().map(inflow).collect()),
            ..whole
        }
    }
}
