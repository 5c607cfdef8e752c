//! Four blades at once: the lanes of a register, each blade with the bits it has alone.

use super::hub::Rotor;
use crate::blade::MAX_MODES;
use crate::blade::aerodynamics::Air;
use crate::blade::held_row::HeldRow;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::{Carrier, HubMotion};
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::mass_matrix::{BladeMass, TurnMass};
use crate::blade::surroundings::{BladeEnvironment, BladeInflow};
use crate::numerics::four::{Four, FourTask, four_at_once};
use crate::numerics::frames::{Hub, Vec3};

/// Azimuth, modal motion and pitch of a blade.
pub type BladePose = (f64, ModalMotion<f64>, PitchMotion<f64>);

/// Most stations whose air is found for four blades at once; more are done blade by blade.
const MOST_STATIONS: usize = 64;

/// Air of four blades.
#[derive(Clone, Copy)]
enum FourInflow<'a> {
    /// None, or left to each blade by itself.
    Without,
    /// lambda_0, lambda_s, lambda_c.
    Disk([f64; 3]),
    /// The same, and one value per station on top of it, blade by blade.
    DiskAnd([f64; 3], [&'a [f64]; 4]),
    /// One value per station, blade by blade.
    Stations([HeldRow<'a>; 4]),
}

impl<'a> FourInflow<'a> {
    fn of(inflow: &[BladeInflow<'a, f64>; 4]) -> Self {
        match inflow {
            [BladeInflow::Disk(states), ..] => Self::Disk(*states),
            [
                BladeInflow::DiskAnd(states, a),
                BladeInflow::DiskAnd(_, b),
                BladeInflow::DiskAnd(_, c),
                BladeInflow::DiskAnd(_, d),
            ] if a.len() <= MOST_STATIONS => Self::DiskAnd(*states, [a, b, c, d]),
            [
                BladeInflow::Stations(a),
                BladeInflow::Stations(b),
                BladeInflow::Stations(c),
                BladeInflow::Stations(d),
            ] if a.len() <= MOST_STATIONS => Self::Stations([*a, *b, *c, *d]),
            _ => Self::Without,
        }
    }
}

/// Loads of four blades but for their dampers.
struct FourBlades<'a> {
    rotor: &'a Rotor,
    environment: BladeEnvironment<'a>,
    hub: &'a HubMotion<f64>,
    blades: &'a [BladePose; 4],
    inflow: FourInflow<'a>,
}

impl FourTask for FourBlades<'_> {
    type Output = [BladeLoads<f64>; 4];
    #[inline(always)]
    fn run<S: Four>(self) -> Self::Output {
        let blade = &self.rotor.blade;
        let n = blade.n_modes;
        let (psi, modal, control) = side_by_side::<S>(self.blades, n);
        let hub = self.hub.constant();
        let mut stations = [S::zero(); MOST_STATIONS];
        if let FourInflow::DiskAnd(_, rows) = self.inflow {
            for j in 0..rows[0].len() {
                stations[j] = S::of(rows.map(|row| row[j]));
            }
        }
        if let FourInflow::Stations(rows) = &self.inflow {
            for j in 0..rows[0].len() {
                stations[j] = S::of([rows[0].at(j), rows[1].at(j), rows[2].at(j), rows[3].at(j)]);
            }
        }
        let inflow = match self.inflow {
            FourInflow::Without => BladeInflow::Vacuum,
            FourInflow::Disk([mean, sine, cosine]) => {
                BladeInflow::Disk([S::cst(mean), S::cst(sine), S::cst(cosine)])
            }
            FourInflow::DiskAnd([mean, sine, cosine], [a, ..]) => {
                BladeInflow::DiskAndEach([S::cst(mean), S::cst(sine), S::cst(cosine)], &stations[..a.len()])
            }
            FourInflow::Stations([a, ..]) => BladeInflow::Variable(&stations[..a.len()]),
        };
        split(&blade.loads(&self.environment, &hub, psi, &modal, &control, &inflow), n)
    }
}

/// Four vectors side by side, one by one.
#[inline(always)]
fn apart<S: Four>(v: &Vec3<S, Hub>) -> [Vec3<f64, Hub>; 4] {
    let (x, y, z) = (v.x.values(), v.y.values(), v.z.values());
    [
        Vec3::new(x[0], y[0], z[0]),
        Vec3::new(x[1], y[1], z[1]),
        Vec3::new(x[2], y[2], z[2]),
        Vec3::new(x[3], y[3], z[3]),
    ]
}

/// Loads of four blades side by side, one by one.
#[inline(always)]
fn split<S: Four>(four: &BladeLoads<S>, n_modes: usize) -> [BladeLoads<f64>; 4] {
    let mut loads = [BladeLoads::zero(); 4];
    for i in 0..n_modes {
        let values = four.modal[i].values();
        for k in 0..4 {
            loads[k].modal[i] = values[k];
        }
    }
    let (force, moment) = (apart(&four.force), apart(&four.moment));
    let (aero_force, aero_moment) = (apart(&four.aero_force), apart(&four.aero_moment));
    for k in 0..4 {
        loads[k].force = force[k];
        loads[k].moment = moment[k];
        loads[k].aero_force = aero_force[k];
        loads[k].aero_moment = aero_moment[k];
    }
    loads
}

/// Azimuth, modal motion and pitch of four blades in one.
#[inline(always)]
fn side_by_side<S: Four>(b: &[BladePose; 4], n: usize) -> (S, ModalMotion<S>, PitchMotion<S>) {
    let zero = [S::zero(); MAX_MODES];
    let mut modal = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
    for i in 0..n {
        modal.q[i] = S::of([b[0].1.q[i], b[1].1.q[i], b[2].1.q[i], b[3].1.q[i]]);
        modal.q_dot[i] = S::of([b[0].1.q_dot[i], b[1].1.q_dot[i], b[2].1.q_dot[i], b[3].1.q_dot[i]]);
        modal.q_ddot[i] = S::of([b[0].1.q_ddot[i], b[1].1.q_ddot[i], b[2].1.q_ddot[i], b[3].1.q_ddot[i]]);
    }
    let control = PitchMotion {
        theta: S::of([b[0].2.theta, b[1].2.theta, b[2].2.theta, b[3].2.theta]),
        theta_dot: S::of([b[0].2.theta_dot, b[1].2.theta_dot, b[2].2.theta_dot, b[3].2.theta_dot]),
        theta_ddot: S::of([b[0].2.theta_ddot, b[1].2.theta_ddot, b[2].2.theta_ddot, b[3].2.theta_ddot]),
    };
    let psi = S::of([b[0].0, b[1].0, b[2].0, b[3].0]);
    (psi, modal, control)
}

/// Mass matrices of four blades, and what the rate of the rotor's speed does to them where that is a state.
pub type FourMassesFound = ([BladeMass<f64>; 4], Option<[TurnMass<f64>; 4]>);

/// What the rate of the speed does to four blades side by side, one by one.
#[inline(always)]
fn turns_apart<S: Four>(four: &TurnMass<S>, n: usize) -> [TurnMass<f64>; 4] {
    let (force, moment) = (apart(&four.force), apart(&four.moment));
    let mut own = [[0.0; MAX_MODES]; 4];
    for (i, each) in four.own.iter().enumerate().take(n) {
        for (own, value) in own.iter_mut().zip(each.values()) {
            own[i] = value;
        }
    }
    std::array::from_fn(|k| TurnMass { own: own[k], force: force[k], moment: moment[k] })
}

/// Finds mass matrices.
struct FourMasses<'a> {
    rotor: &'a Rotor,
    blades: &'a [BladePose; 4],
    /// Acceleration of each blade's pitch by the rate of the speed.
    pitched: Option<[f64; 4]>,
}

impl FourTask for FourMasses<'_> {
    type Output = FourMassesFound;
    #[inline(always)]
    fn run<S: Four>(self) -> Self::Output {
        let n = self.rotor.blade.n_modes;
        let (psi, modal, control) = side_by_side::<S>(self.blades, n);
        let (four, turned) = self.rotor.blade.mass_matrix(psi, &modal, &control, self.pitched.map(S::of));
        let nothing = Vec3::zero();
        let none = BladeMass {
            own: [[0.0; MAX_MODES]; MAX_MODES],
            force: [nothing; MAX_MODES],
            moment: [nothing; MAX_MODES],
            first_moment: nothing,
            inertia: [nothing; 3],
        };
        let mut masses = [none; 4];
        for i in 0..n {
            let (force, moment) = (apart(&four.force[i]), apart(&four.moment[i]));
            for k in 0..4 {
                masses[k].force[i] = force[k];
                masses[k].moment[i] = moment[k];
            }
            for j in 0..n {
                let own = four.own[i][j].values();
                for k in 0..4 {
                    masses[k].own[i][j] = own[k];
                }
            }
        }
        let first = apart(&four.first_moment);
        for k in 0..4 {
            masses[k].first_moment = first[k];
        }
        for axis in 0..3 {
            let inertia = apart(&four.inertia[axis]);
            for k in 0..4 {
                masses[k].inertia[axis] = inertia[k];
            }
        }
        (masses, turned.map(|turned| turns_apart(&turned, n)))
    }
}

impl Rotor {
    /// Loads of four blades with their dampers, each with its inflow: the bits of `blade_loads`.
    pub fn four_blade_loads(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blades: &[BladePose; 4],
        inflow: &[BladeInflow<f64>; 4],
    ) -> [BladeLoads<f64>; 4] {
        let environment = self.environment(air);
        let together = FourInflow::of(inflow);
        let task = FourBlades { rotor: self, environment, hub, blades, inflow: together };
        let Ok(mut loads) = four_at_once(task) else {
            return std::array::from_fn(|k| {
                let (psi, modal, control) = &blades[k];
                self.blade_loads(air, hub, *psi, modal, control, &inflow[k])
            });
        };
        for ((loads, (psi, modal, control)), inflow) in loads.iter_mut().zip(blades).zip(inflow) {
            let missing = matches!(together, FourInflow::Without) && !matches!(inflow, BladeInflow::Vacuum);
            if missing {
                let carrier = Carrier::new(hub, *psi, self.blade.precone, environment.rotor_speed);
                self.blade.add_air_loads(&environment, &carrier, modal, control, inflow, loads);
            }
            self.add_damper(modal, control, &mut loads.modal);
        }
        loads
    }

    /// Mass matrices of four blades, and where the speed is a state what its rate does to them, whose pitch it accelerates by `pitched`
    /// each.
    pub fn four_mass_matrices(&self, blades: &[BladePose; 4], pitched: Option<[f64; 4]>) -> FourMassesFound {
        four_at_once(FourMasses { rotor: self, blades, pitched }).unwrap_or_else(|task| {
            let all: [_; 4] = std::array::from_fn(|k| {
                let (psi, modal, control) = &task.blades[k];
                self.blade.mass_matrix(*psi, modal, control, task.pitched.map(|each| each[k]))
            });
            let turned = match all.map(|(_, turned)| turned) {
                [Some(a), Some(b), Some(c), Some(d)] => Some([a, b, c, d]),
                _ => None,
            };
            (all.map(|(mass, _)| mass), turned)
        })
    }
}
