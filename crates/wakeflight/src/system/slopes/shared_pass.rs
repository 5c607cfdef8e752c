//! The shared rows differentiated along their states, the carrier's accelerations, and the loads and flapping of every rotor.

use super::{D, N_LOADS, Slopes};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use crate::numerics::wide::DIRECTIONS;
use crate::system::instant::Instant;
use crate::system::layout::Layout;
use crate::system::model::System;
use crate::system::rotor_loads::{RotorLoads, RotorShare};

/// What a direction is.
enum Direction {
    /// A shared state.
    State(usize),
    /// An acceleration of the carrier or of the speed of a rotor.
    Acceleration(usize),
    /// A load of a rotor.
    Load(usize, usize),
    /// The flapping of a rotor.
    Flapping(usize),
}

impl System {
    /// Derivatives of the shared rows by shared states, rates of the carrier's motion and of the speeds, loads and flapping of the rotors.
    pub(super) fn shared_slopes(&self, at: &Instant<f64>, shares: &[RotorShare<f64>], slopes: &mut Slopes) {
        let n = slopes.shared.len();
        let moving = self.layout.carrier_motion().end;
        // rows of kinematics and inflow hold their own rate alone
        for i in moving..n {
            slopes.alone_dot.set(i, i, 1.0);
        }
        // the inertia of carrier and hubs does not change: found once
        let speeds = self.layout.rotors.iter().filter_map(|l| l.spin()).map(|p| slopes.place[p.speed]);
        let accelerated: Vec<usize> =
            if slopes.carrier_known { Vec::new() } else { (0..moving).chain(speeds).collect() };
        // north, east and azimuths are in none of these rows
        let unfelt = self.unfelt();
        let (unfelt, felt): (Vec<usize>, Vec<usize>) =
            (0..n).partition(|&k| unfelt.contains(&slopes.shared[k]));
        for &k in &unfelt {
            (0..n).for_each(|i| slopes.shared_y.set(i, k, 0.0));
        }
        let (n_states, n_rates) = (felt.len(), accelerated.len());
        let direction = |k: usize| {
            if k < n_states {
                return Direction::State(felt[k]);
            }
            if k < n_states + n_rates {
                return Direction::Acceleration(accelerated[k - n_states]);
            }
            let k = k - n_states - n_rates;
            let (r, j) = (k / (N_LOADS + 1), k % (N_LOADS + 1));
            if j < N_LOADS { Direction::Load(r, j) } else { Direction::Flapping(r) }
        };
        let n_directions = n_states + n_rates + self.rotors.len() * (N_LOADS + 1);
        let loads: Vec<[f64; N_LOADS]> = shares.iter().map(|s| loads_array(&s.loads)).collect();
        for first in (0..n_directions).step_by(DIRECTIONS) {
            let lanes = DIRECTIONS.min(n_directions - first);
            let mut loads: Vec<[D; N_LOADS]> = loads.iter().map(|l| l.map(D::cst)).collect();
            let mut flapping: Vec<D> = shares.iter().map(|s| D::cst(s.beta_1c)).collect();
            for lane in 0..lanes {
                match direction(first + lane) {
                    Direction::State(k) => slopes.y[slopes.shared[k]].eps[lane] = 1.0,
                    Direction::Acceleration(k) => slopes.y_dot[slopes.shared[k]].eps[lane] = 1.0,
                    Direction::Load(r, j) => loads[r][j].eps[lane] = 1.0,
                    Direction::Flapping(r) => flapping[r].eps[lane] = 1.0,
                }
            }
            let brought: Vec<RotorShare<D>> = loads
                .iter()
                .zip(&flapping)
                .map(|(loads, &beta_1c)| RotorShare { loads: loads_of(loads), beta_1c })
                .collect();
            let dual = Instant { t: at.t, y: &slopes.y, y_dot: &slopes.y_dot, inputs: at.inputs };
            self.shared_rows(&dual, &brought, &mut slopes.f);
            for lane in 0..lanes {
                let direction = direction(first + lane);
                for i in 0..n {
                    let slope = slopes.f[slopes.shared[i]].eps[lane];
                    match direction {
                        Direction::State(k) => slopes.shared_y.set(i, k, slope),
                        Direction::Acceleration(k) => slopes.alone_dot.set(i, k, slope),
                        Direction::Load(r, j) => slopes.rotors[r].by_loads.set(i, j, slope),
                        Direction::Flapping(r) => slopes.rotors[r].by_flapping[i] = slope,
                    }
                }
                match direction {
                    Direction::State(k) => slopes.y[slopes.shared[k]].eps[lane] = 0.0,
                    Direction::Acceleration(k) => slopes.y_dot[slopes.shared[k]].eps[lane] = 0.0,
                    Direction::Load(..) | Direction::Flapping(_) => {}
                }
            }
        }
        slopes.carrier_known = true;
    }

    /// States that no shared row feels but through the blades: where the carrier is over the ground, and azimuths.
    fn unfelt(&self) -> Vec<usize> {
        let azimuths = self.layout.rotors.iter().filter_map(|l| l.spin()).map(|place| place.azimuth);
        let carried = if self.layout.free { Layout::POSITION.start..Layout::POSITION.end - 1 } else { 0..0 };
        carried.chain(azimuths).collect()
    }
}

fn loads_array(r: &RotorLoads<f64>) -> [f64; N_LOADS] {
    let all = [r.force, r.moment, r.aero_force, r.aero_moment].map(Vec3::array);
    std::array::from_fn(|i| all[i / 3][i % 3])
}

fn loads_of(loads: &[D; N_LOADS]) -> RotorLoads<D> {
    let part = |k: usize| Vec3::new(loads[3 * k], loads[3 * k + 1], loads[3 * k + 2]);
    RotorLoads { force: part(0), moment: part(1), aero_force: part(2), aero_moment: part(3) }
}
