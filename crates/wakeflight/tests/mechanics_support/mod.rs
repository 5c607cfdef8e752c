//! Blades, aircraft and random motions of the mechanics tests.
#![allow(dead_code)]

#[path = "../beam_support/mod.rs"]
pub mod beam_support;
#[path = "../data_files/mod.rs"]
pub mod data_files;

use beam_support::uh60a;
use data_files::{Csv, INCH};
use wakeflight::airfoil::span::SpanSections;
use wakeflight::airfoil::unsteady::Model;
use wakeflight::airfoil::{Airfoil, AirfoilTables};
use wakeflight::airframe::mass::MassProperties;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::memory_rows::MemoryRows;
use wakeflight::blade::model::{Blade, Discretisation};
use wakeflight::blade::section::BladeProperties;
use wakeflight::blade::sections_in_time::SectionLaw;
use wakeflight::blade::stations::StructuralPoint;
use wakeflight::blade::strain::add_strain_gradient;
use wakeflight::numerics::frames::Vec3;
use wakeflight::numerics::scalar::{Dual, Real};
use wakeflight::numerics::tables::Grid;
use wakeflight::rotor::circulation::BladeInstant;
use wakeflight::rotor::drive::{Drive, Governor};
use wakeflight::rotor::lag_damper::LagDamper;
use wakeflight::rotor::sense::Sense;
use wakeflight::rotor::speed::{RotorSpeed, SpeedHistory};
use wakeflight::rotor::swashplate::Rigging;
use wakeflight::system::carrier::Stand;
use wakeflight::system::data::{AircraftData, RiggedRotor, RotorData};
use wakeflight::system::instant::{EngineInput, HeldInflow, HeldMemory, Inputs, Instant};
use wakeflight::system::model::{Setting, System};

pub const OMEGA: f64 = 27.0;
pub const AIR: Air = Air { density: 1.046, speed_of_sound: 334.0 };
/// Mid collective stick without cyclic.
pub const REFERENCE_PITCH: f64 = 17.93 * std::f64::consts::PI / 180.0;

/// Numbers between -1 and 1, always the same.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

pub fn discretisation(n_modes: usize, n_gauss: usize) -> Discretisation {
    Discretisation { n_elements: 4, n_modes, n_gauss, n_stations: 15, reference_pitch: REFERENCE_PITCH }
}

/// The UH-60A blade with five modes.
pub fn blade() -> Blade {
    Blade::new(&uh60a(), OMEGA, 0.97, &discretisation(5, 8)).unwrap()
}

/// A blade that has everything: precone, pitch-flap coupling, centre of gravity off the axis.
pub fn general_blade() -> Blade {
    let mut properties = uh60a();
    properties.precone = 0.05;
    properties.delta3 = 0.2;
    for (i, x) in properties.structure.x_cg.iter_mut().enumerate() {
        *x += 0.02 - 0.05 * (i % 3) as f64 / 3.0;
    }
    Blade::new(&properties, OMEGA, 0.97, &discretisation(5, 8)).unwrap()
}

/// Modal coordinate that makes an angle of one radian of tip deflection over span, or of tip twist.
pub fn per_radian(blade: &Blade, i: usize) -> f64 {
    let span = blade.radius - blade.root_station;
    let tip = &blade.tip;
    1.0 / (tip.w[0][i].abs() / span).max(tip.v[0][i].abs() / span).max(tip.theta[i].abs())
}

/// Random modal coordinates; `angle` [rad] for the hinge modes, falling with the square of frequency as deflections do.
pub fn random_modal(blade: &Blade, angle: f64, random: &mut Random) -> [f64; MAX_MODES] {
    let mut q = [0.0; MAX_MODES];
    for (i, q) in q.iter_mut().enumerate().take(blade.n_modes) {
        let relative = (1.5 * OMEGA / blade.modes.frequency[i]).min(1.0);
        *q = random.next() * angle * relative * per_radian(blade, i);
    }
    q
}

pub fn still<S: Real>(theta: f64) -> PitchMotion<S> {
    PitchMotion { theta: S::cst(theta), theta_dot: S::zero(), theta_ddot: S::zero() }
}

pub fn modal_at<S: Real>(q: [S; MAX_MODES]) -> ModalMotion<S> {
    ModalMotion { q, q_dot: [S::zero(); MAX_MODES], q_ddot: [S::zero(); MAX_MODES] }
}

pub fn hub_at_rest<S: Real>() -> HubMotion<S> {
    HubMotion {
        velocity: Vec3::zero(),
        acceleration_less_gravity: Vec3::zero(),
        omega: Vec3::zero(),
        omega_dot: Vec3::zero(),
    }
}

/// Strain energy of the blade [J] and its gradient, pitch-link spring included.
pub fn strain_energy<S: Real>(blade: &Blade, q: &[S; MAX_MODES], pitch: f64) -> (S, [S; MAX_MODES]) {
    let mut gradient = [S::zero(); MAX_MODES];
    let mut energy = S::zero();
    for p in &blade.structure {
        energy += add_strain_gradient(
            &p.shapes,
            &p.stiffness,
            blade.n_modes,
            q,
            S::cst(pitch + p.twist),
            &mut gradient,
        );
    }
    let mut wind_up = S::zero();
    for i in 0..blade.n_modes {
        wind_up += q[i] * blade.root_twist[i];
    }
    for i in 0..blade.n_modes {
        gradient[i] += wind_up * (blade.control_stiffness * blade.root_twist[i]);
    }
    (energy + wind_up * wind_up * (0.5 * blade.control_stiffness), gradient)
}

/// Tables without kinks: lift cl_alpha alpha (1 + 0.4 M), drag and moment bilinear.
pub fn smooth_airfoil(lift_slope: f64, by_mach: f64, drag: f64, moment: f64) -> Airfoil {
    let pi = std::f64::consts::PI;
    let grid = |f: &dyn Fn(f64, f64) -> f64| Grid {
        x: vec![-pi, pi],
        y: vec![0.0, 2.0],
        values: [-pi, pi].iter().map(|&a| [0.0, 2.0].iter().map(|&m| f(a, m)).collect()).collect(),
    };
    Airfoil::new(&AirfoilTables {
        cl: grid(&|a, m| lift_slope * a * (1.0 + by_mach * m)),
        cd: grid(&|_, m| drag * (1.0 + by_mach * m)),
        cm: grid(&|a, m| moment * (1.0 + by_mach * m) * (1.0 + 0.3 * a)),
        cd_increment: 0.0,
    })
    .unwrap()
}

pub fn lag_damper() -> LagDamper {
    let force = Csv::read("lag_damper_force.csv").table("rate_m_s", 1.0, "force_N", 1.0);
    LagDamper {
        a: 0.0057658,
        b: 0.0823468,
        c: 0.305816,
        d: 0.25425908,
        r: 0.1752092,
        theta_geo: 0.0,
        zeta_geo: 7f64.to_radians(),
        force,
        spring_rate: 0.0,
    }
}

/// The UH-60A's gains, per metre of stick.
pub fn rigging() -> Rigging {
    let degrees_per_inch = [
        [-1.590228, 0.0, 0.250330, 0.0],
        [0.0, 2.960917, -0.452432, -1.838067],
        [0.0, 0.0, 1.563612, 0.0],
        [0.0, 0.0, 1.583530, -5.543861f64],
    ];
    Rigging {
        matrix: degrees_per_inch.map(|row| row.map(|v| v.to_radians() / INCH)),
        offset: [7.973828, -9.728045, 10.111127, 21.98f64].map(f64::to_radians),
        phase: (-9.7f64).to_radians(),
    }
}

/// Collective only: stick [m] equals pitch [rad].
pub fn collective_rigging() -> Rigging {
    let mut matrix = [[0.0; 4]; 4];
    matrix[2][2] = 1.0;
    Rigging { matrix, offset: [0.0; 4], phase: 0.0 }
}

pub fn aircraft_data(blade: BladeProperties, airfoil: Airfoil) -> AircraftData {
    AircraftData {
        rotor: RotorData {
            n_blades: 4,
            omega: OMEGA,
            position: data_files::position(341.25, 0.0, 315.0),
            shaft_tilt_forward: 3f64.to_radians(),
            shaft_tilt_lateral: 0.0,
            tip_loss_factor: 0.97,
            blade,
            airfoil: SpanSections::uniform(airfoil),
            lag_damper: Some(lag_damper()),
            rotation: Sense::CounterClockwise,
        },
        rigging: rigging(),
        mass: MassProperties { gross_mass: 7257.4779, inertia: [6316.7558, 52215.261, 49888.677, 2551.6494] },
        fuselage: Some(data_files::fuselage()),
        stabilator: Some(data_files::stabilator()),
        stabilator_schedule: Some(data_files::schedule()),
        fin: Some(data_files::fin()),
        tail_rotor: Some(data_files::tail_rotor()),
        interference: Some(data_files::interference()),
        accessory_power: 0.0,
        further_rotors: Vec::new(),
        mirrored: false,
    }
}

pub fn setting(free_wake: bool, gravity: f64) -> Setting {
    Setting {
        air: AIR,
        gravity,
        free_wake,
        discretisation: discretisation(5, 8),
        lift: None,
        unsteady: Model::QuasiSteady,
        yawed_drag: false,
    }
}

pub fn build(data: &AircraftData, free_wake: bool, gravity: f64) -> System {
    System::aircraft(data, &setting(free_wake, gravity)).unwrap()
}

/// The aircraft with a second rotor behind the first: other coupling of pitch and flap, clockwise, tilted, no tail rotor.
pub fn tandem(data: &AircraftData) -> AircraftData {
    let mut data = data.clone();
    data.tail_rotor = None;
    let mut rotor = data.rotor.clone();
    rotor.position = data_files::position(700.0, 12.0, 330.0);
    rotor.rotation = Sense::Clockwise;
    rotor.n_blades = 3;
    rotor.shaft_tilt_lateral = -0.02;
    rotor.blade.delta3 = 0.1;
    data.further_rotors = vec![RiggedRotor { rotor, rigging: data.rigging.clone() }];
    data
}

/// The rotor of the aircraft on a stand in forward flight that turns.
pub fn on_stand(data: &AircraftData, free_wake: bool) -> System {
    let setting = setting(free_wake, 9.80665);
    let rotor = setting.rotor(&data.rotor, &data.rigging).unwrap();
    System::on_stand(Stand { velocity: [-38.0, 3.0, 2.0], rates: [0.1, -0.2, 0.05] }, vec![rotor], &setting)
}

/// Airframe and blades alone: no air, no lag damper, no structural damping, collective only.
pub fn conservative_aircraft(blade: BladeProperties, gravity: f64) -> System {
    let mut data = aircraft_data(blade, smooth_airfoil(6.0, 0.0, 0.01, 0.0));
    data.rotor.lag_damper = None;
    data.rotor.shaft_tilt_lateral = 0.03;
    data.rotor.blade.structural_damping_ratio = 0.0;
    data.rigging = collective_rigging();
    data.tail_rotor = None;
    build(&data, true, gravity)
}

/// The system with the speed of every rotor going to `share` of its own in `seconds` from time zero.
pub fn changing_speed(mut system: System, share: f64, seconds: f64) -> System {
    for rotor in &mut system.rotors {
        let corners = [(0.0, rotor.omega), (seconds, share * rotor.omega)];
        rotor.speed = RotorSpeed::Prescribed(SpeedHistory::new(&corners).unwrap());
    }
    system
}

/// The same turned by a drive: with a governor, or by a torque that is given.
pub fn driven(system: System, governed: bool) -> System {
    let governor = Governor { power: 1.2e6, gains: [2.6e6, 3.3e6, 6.5e5], lag: 1.25 };
    let drive = Drive { inertia: 1474.0, hub_inertia: 57.0, governor: governed.then_some(governor) };
    system.with_drive(drive).unwrap()
}

pub fn inputs(stick: [f64; 4], inflow: HeldInflow) -> Inputs {
    Inputs {
        stick,
        stick_rate: [0.0; 4],
        t_start: 0.0,
        inflow: vec![inflow],
        wash: None,
        sections: Vec::new(),
        stabilator_incidence: 0.1,
        engine: EngineInput::default(),
        disturbance: None,
    }
}

pub fn at<'a, S>(t: f64, y: &'a [S], y_dot: &'a [S], inputs: &'a Inputs) -> Instant<'a, S> {
    Instant { t, y, y_dot, inputs }
}

/// The system with sections that answer in time by `model`.
pub fn in_time(mut system: System, model: Model) -> System {
    for rotor in &mut system.rotors {
        rotor.sections = SectionLaw::of(model, &rotor.airfoils);
    }
    system
}

/// Inputs of a step that began at `begun` [s], the sections then at rest in the flow of a random state.
pub fn remembering(system: &System, inputs: &Inputs, begun: f64, random: &mut Random) -> Inputs {
    let (y, y_dot) = random_state(system, random);
    let held = system.each_rotor().map(|(r, rotor, _)| {
        let spin = system.spin(r, &Instant { t: begun, y: &y[..], y_dot: &y_dot[..], inputs });
        let hub = system.felt_hub(r, &y, inputs, (system.hub_motion(r, &y, &y_dot), &spin.turning));
        let rows: Vec<MemoryRows> = (0..rotor.n_blades)
            .map(|b| {
                let psi = system.azimuth(r, begun, &y, b);
                let control = system.blade_pitch(r, inputs, (begun, &spin), b);
                let blade = BladeInstant { psi, modal: system.modal_motion(r, &y, &y_dot, b), control };
                let inflow = |_| system.blade_inflow(r, (begun, &y[..]), inputs, b);
                // a turn of one azimuth stays where it is
                rotor.periodic_memory(system.air, &hub, (&[blade], rotor.nominal_step(1)), inflow)
            })
            .collect();
        HeldMemory { memory: MemoryRows::joined(rows.iter()), begun }
    });
    Inputs { sections: held.collect(), ..inputs.clone() }
}

/// A state of flight: moderate speeds and rates, blades deflected and moving.
pub fn random_state(system: &System, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let layout = &system.layout;
    let (mut y, mut y_dot) = (vec![0.0; layout.len()], vec![0.0; layout.len()]);
    if layout.free {
        random_flight(&mut y, &mut y_dot, random);
    }
    for (rotor, l) in system.rotors.iter().zip(&layout.rotors) {
        for b in 0..l.n_blades {
            let blade = &rotor.blade;
            let (q, rate) = (random_modal(blade, 0.06, random), random_modal(blade, 0.06, random));
            let ddot = random_modal(blade, 0.06, random);
            for i in 0..l.n_modes {
                y[l.modal(b).start + i] = q[i];
                y[l.modal_rate(b).start + i] = OMEGA * rate[i];
                y_dot[l.modal(b).start + i] = OMEGA * rate[i] * 1.1;
                y_dot[l.modal_rate(b).start + i] = OMEGA * OMEGA * ddot[i];
            }
        }
        for i in l.inflow() {
            y[i] = 0.02 + 0.01 * random.next();
            y_dot[i] = 0.1 * random.next();
        }
        if let Some(place) = l.spin() {
            (y[place.azimuth], y_dot[place.azimuth]) = (3.3, 0.94 * OMEGA);
            (y[place.speed], y_dot[place.speed]) = (0.95 * OMEGA, -0.7);
        }
        if let Some(place) = l.engine() {
            (y[place.integral], y_dot[place.integral]) = (-0.02, -1.3);
            (y[place.power], y_dot[place.power]) = (1.1e6, 3e5);
        }
    }
    for i in layout.closed_inflow() {
        y[i] = 0.05;
        y_dot[i] = 0.2;
    }
    (y, y_dot)
}

/// Fourth-order central difference of `f` at `t`.
pub fn time_derivative<const N: usize>(t: f64, h: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let at = [-2.0, -1.0, 1.0, 2.0].map(|k| f(t + k * h));
    std::array::from_fn(|i| (at[0][i] - 8.0 * at[1][i] + 8.0 * at[2][i] - at[3][i]) / (12.0 * h))
}

pub type Matrix3<S> = [[S; 3]; 3];

pub fn product<S: Real>(a: &Matrix3<S>, b: &Matrix3<S>) -> Matrix3<S> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
    })
}

pub fn transposed<S: Real>(a: &Matrix3<S>) -> Matrix3<S> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]))
}

pub fn times<S: Real>(a: &Matrix3<S>, v: [S; 3]) -> [S; 3] {
    std::array::from_fn(|i| a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2])
}

pub fn cross<S: Real>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn dot<S: Real>(a: [S; 3], b: [S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn add<S: Real>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Turn about axis 0, 1, 2 by the right-hand rule.
pub fn turn<S: Real>(axis: usize, angle: S) -> Matrix3<S> {
    let (s, c) = angle.sin_cos();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = [[S::zero(); 3]; 3];
    m[axis][axis] = S::one();
    (m[i][i], m[j][j], m[i][j], m[j][i]) = (c, c, -s, s);
    m
}

/// Largest difference over the largest value of `expected`.
pub fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    assert!(found.len() == expected.len() && found.iter().chain(expected).all(|v| v.is_finite()));
    let scale = expected.iter().fold(0f64, |m, v| m.max(v.abs()));
    found.iter().zip(expected).fold(0f64, |m, (a, b)| m.max((a - b).abs())) / scale
}

pub fn scaled<S: Real>(v: [S; 3], k: f64) -> [S; 3] {
    v.map(|x| x * k)
}

/// Elastic axis, chord and normal of a section in inertial axes, from the shapes by plain rotations; the columns of
/// `hub_attitude` are the hub axes.
pub fn section_place<S: Real>(
    blade: &Blade,
    p: &StructuralPoint,
    q: &[S; 5],
    control: S,
    psi: S,
    hub_place: [S; 3],
    hub_attitude: &Matrix3<S>,
) -> [[S; 3]; 3] {
    let sum = |shape: &[f64]| (0..5).fold(S::zero(), |a, i| a + q[i] * shape[i]);
    let mut slopes_squared = S::zero();
    for i in 0..5 {
        slopes_squared += q[i] * sum(&p.shapes.shortening[i]);
    }
    // the length inboard seen along the span: exact for a rigid turn about the hinge
    let length = p.shapes.length;
    let kept = ((S::one() - slopes_squared / length) * (length * length)).sqrt();
    let shortening = sum(&p.shapes.shortening_twist) + (-kept + length);
    let flap = sum(&p.shapes.w[1]).asin();
    let lead = (sum(&p.shapes.v[1]) / flap.sin_cos().1).asin();
    let theta = control + p.twist + sum(&p.shapes.theta);
    let carrier = product(&product(hub_attitude, &turn(2, psi)), &turn(1, S::cst(-blade.precone)));
    let place = [-shortening + p.shapes.x, sum(&p.shapes.v[0]), sum(&p.shapes.w[0])];
    let triad = product(&carrier, &product(&product(&turn(2, lead), &turn(1, -flap)), &turn(0, theta)));
    let column = |j: usize| [triad[0][j], triad[1][j], triad[2][j]];
    [add(hub_place, times(&carrier, place)), column(1), column(2)]
}

/// Kinetic energy, momentum, and moment of momentum about a point.
#[derive(Clone, Copy, Default)]
pub struct Momentum {
    pub kinetic: f64,
    pub momentum: [f64; 3],
    pub moment: [f64; 3],
}

/// Of a section with place (axis, chord, normal) and rates in inertial axes, moment about `centre`.
///
/// A section is a flat body of points r + xi c + eta n, so that T = 1/2 m |r'|^2 + S r'.c' + 1/2 J_n |c'|^2 + 1/2 J_c |n'|^2.
pub fn section_momentum(p: &StructuralPoint, centre: [f64; 3], place: [[Dual<1>; 3]; 3]) -> Momentum {
    let [r, c, n] = place.map(|v| v.map(|x| x.re));
    let [r_dot, c_dot, n_dot] = place.map(|v| v.map(|x| x.eps[0]));
    let (m, s, [_, j_c, j_n]) = (p.mass, p.first_moment, p.inertia);
    let arm = [r[0] - centre[0], r[1] - centre[1], r[2] - centre[2]];
    let moments = [
        scaled(cross(arm, r_dot), m),
        scaled(add(cross(arm, c_dot), cross(c, r_dot)), s),
        scaled(cross(c, c_dot), j_n),
        scaled(cross(n, n_dot), j_c),
    ];
    Momentum {
        kinetic: 0.5 * (m * dot(r_dot, r_dot) + j_n * dot(c_dot, c_dot) + j_c * dot(n_dot, n_dot))
            + s * dot(r_dot, c_dot),
        momentum: add(scaled(r_dot, m), scaled(c_dot, s)),
        moment: moments.into_iter().fold([0.0; 3], add),
    }
}

fn random_flight(y: &mut [f64], y_dot: &mut [f64], random: &mut Random) {
    let speeds = [41.0, 2.0, -3.0];
    for i in 0..3 {
        y[i] = speeds[i] + random.next();
        y[3 + i] = 0.3 * random.next();
        y_dot[i] = 2.0 * random.next();
        y_dot[3 + i] = random.next();
    }
    let attitude = wakeflight::numerics::frames::quaternion(0.2, -0.1, 0.7);
    for i in 0..4 {
        y[6 + i] = attitude[i];
        y_dot[6 + i] = 0.1 * random.next();
    }
    for i in 10..13 {
        y[i] = 100.0 * random.next();
        y_dot[i] = 40.0 * random.next();
    }
}
