//! Mechanics of a blade against independent ways to the same numbers: particles, differences, conserved energy.

mod beam_support;

use std::f64::consts::PI;
use wakeflight::airfoil::span::StationAirfoils;
use wakeflight::airfoil::{Airfoil, AirfoilTables};
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::aerodynamics::Air;
use wakeflight::blade::hub_loads::BladeLoads;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::model::{Blade, Discretisation};
use wakeflight::blade::section::BladeProperties;
use wakeflight::blade::stations::StructuralPoint;
use wakeflight::blade::strain::add_strain_gradient;
use wakeflight::blade::surroundings::{BladeEnvironment, BladeInflow};
use wakeflight::numerics::frames::Vec3;
use wakeflight::numerics::scalar::{Dual, Real};
use wakeflight::numerics::tables::Grid;

const OMEGA: f64 = 27.0;
const N: usize = 5;
type V = [f64; 3];

fn blade_with(properties: &BladeProperties, n_gauss: usize) -> Blade {
    let d = Discretisation { n_elements: 4, n_modes: N, n_gauss, n_stations: 20, reference_pitch: 0.3 };
    Blade::new(properties, OMEGA, 1.0, &d).unwrap()
}

/// The UH-60A blade with a constant section, so that every quadrature weight is positive and particles can stand for it.
fn smooth() -> BladeProperties {
    let mut p = beam_support::uh60a();
    let s = &mut p.structure;
    for (list, value) in [
        (&mut s.mass, 14.0),
        (&mut s.ei_flap, 2.0e5),
        (&mut s.ei_lag, 5.0e6),
        (&mut s.gj, 1.5e5),
        (&mut s.i_theta, 0.3),
        (&mut s.x_cg, -0.02),
    ] {
        *list = vec![value];
    }
    (s.r_in, s.r_out) = (vec![p.root_station], vec![p.radius]);
    p.structural_damping_ratio = 0.0;
    p.precone = 0.03;
    p
}

fn airfoil() -> Airfoil {
    let grid = |f: fn(f64) -> f64| {
        let x: Vec<f64> = (0..=360).map(|i| -PI + PI * f64::from(i) / 180.0).collect();
        let values = x.iter().map(|&a| vec![f(a), f(a)]).collect();
        Grid { x, y: vec![0.0, 1.0], values }
    };
    let tables =
        AirfoilTables { cl: grid(f64::sin), cd: grid(|_| 0.01), cm: grid(|_| 0.0), cd_increment: 0.0 };
    Airfoil::new(&tables).unwrap()
}

fn modal_motion(q: &[f64; N], q_dot: &[f64; N], q_ddot: &[f64; N]) -> ModalMotion<f64> {
    let wide = |v: &[f64; N]| std::array::from_fn(|i| if i < N { v[i] } else { 0.0 });
    ModalMotion { q: wide(q), q_dot: wide(q_dot), q_ddot: wide(q_ddot) }
}

fn vacuum_loads(
    blade: &Blade,
    hub: &HubMotion<f64>,
    psi: f64,
    m: &ModalMotion<f64>,
    pitch: &PitchMotion<f64>,
) -> BladeLoads<f64> {
    let airfoils = StationAirfoils::uniform(airfoil(), blade.stations.len());
    let air = Air { density: 1.0, speed_of_sound: 340.0 };
    let environment = BladeEnvironment { airfoils: &airfoils, air, rotor_speed: OMEGA, yawed_drag: false };
    blade.loads(&environment, hub, psi, m, pitch, &BladeInflow::Vacuum)
}

fn still_hub() -> HubMotion<f64> {
    HubMotion {
        velocity: Vec3::zero(),
        acceleration_less_gravity: Vec3::zero(),
        omega: Vec3::zero(),
        omega_dot: Vec3::zero(),
    }
}

/// Strain energy and the control spring's, and their gradient.
fn potential(blade: &Blade, q: &[f64; N], theta: f64) -> (f64, [f64; N]) {
    let m = modal_motion(q, &[0.0; N], &[0.0; N]);
    let (mut energy, mut gradient) = (0.0, [0.0; MAX_MODES]);
    for p in &blade.structure {
        energy += add_strain_gradient(&p.shapes, &p.stiffness, N, &m.q, theta + p.twist, &mut gradient);
    }
    let wind_up: f64 = (0..N).map(|i| blade.root_twist[i] * q[i]).sum();
    energy += 0.5 * blade.control_stiffness * wind_up * wind_up;
    (energy, std::array::from_fn(|i| gradient[i] + blade.control_stiffness * wind_up * blade.root_twist[i]))
}

/// Modal coordinates of a few degrees or centimetres: five numbers of order one become a deflection a blade may have.
fn coordinates(blade: &Blade, parts: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| {
        let tip = blade.tip.w[0][i].abs().max(blade.tip.v[0][i].abs()).max(blade.tip.theta[i].abs());
        parts[i] / tip
    })
}

fn add(a: V, b: V, k: f64) -> V {
    std::array::from_fn(|i| a[i] + k * b[i])
}

fn dot(a: V, b: V) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rotation by the vector `phi` (Rodrigues).
fn turned(phi: V, v: V) -> V {
    let angle = dot(phi, phi).sqrt();
    if angle < 1e-300 {
        return v;
    }
    let axis = phi.map(|p| p / angle);
    let (s, c) = angle.sin_cos();
    let along = dot(axis, v) * (1.0 - c);
    let across = cross(axis, v);
    std::array::from_fn(|i| c * v[i] + s * across[i] + along * axis[i])
}

/// Four particles with the mass, first moment and moments of inertia of a point: (chordwise, normal) offsets [m], mass [kg].
fn particles(p: &StructuralPoint) -> [(f64, f64, f64); 4] {
    let at = p.first_moment / p.mass;
    let d = (p.inertia[2] / p.mass - at * at).sqrt();
    let h = (p.inertia[1] / p.mass).sqrt();
    let quarter = p.mass / 4.0;
    [(at + d, h, quarter), (at + d, -h, quarter), (at - d, h, quarter), (at - d, -h, quarter)]
}

/// Particles of the whole blade in blade axes (x along the undeflected span), geometry alone.
fn geometry(blade: &Blade, q: &[f64; N], theta: f64) -> Vec<(V, f64)> {
    let m = modal_motion(q, &[0.0; N], &[0.0; N]);
    let mut all = Vec::new();
    for p in &blade.structure {
        let pitch = PitchMotion { theta: theta + p.twist, theta_dot: 0.0, theta_ddot: 0.0 };
        let s = p.shapes.motion(N, &m, &pitch);
        for (chordwise, normal, mass) in particles(p) {
            all.push((add(add(s.position.array(), s.c.array(), chordwise), s.n.array(), normal), mass));
        }
    }
    all
}

/// The same in hub axes, blade at azimuth `psi`.
fn in_hub(blade: &Blade, v: V, psi: f64) -> V {
    turned([0.0, 0.0, psi], turned([0.0, -blade.precone, 0.0], v))
}

#[test]
fn strain_force_is_the_gradient_of_the_strain_energy() {
    let blade = blade_with(&beam_support::uh60a(), 8);
    let q = coordinates(&blade, [-0.9, 0.8, 0.25, 0.06, 0.1]);
    for theta in [0.0, 0.3] {
        let (_, gradient) = potential(&blade, &q, theta);
        let scale = gradient.iter().fold(0.0f64, |m, g| m.max(g.abs()));
        for i in 0..N {
            let h = 1e-5 * q[i].abs().max(1e-3);
            let (mut up, mut down) = (q, q);
            up[i] += h;
            down[i] -= h;
            let difference =
                (potential(&blade, &up, theta).0 - potential(&blade, &down, theta).0) / (2.0 * h);
            assert!(
                (gradient[i] - difference).abs() < 1e-6 * scale,
                "mode {i}: {} against {difference}",
                gradient[i]
            );
        }
    }
}

#[test]
fn inertia_and_hub_loads_are_those_of_particles() {
    // d'Alembert on particles whose accelerations are differences of their positions, hub in arbitrary motion
    let blade = blade_with(&smooth(), 8);
    let (q, q_dot, q_ddot) = (
        coordinates(&blade, [-0.8, 0.7, 0.15, 0.05, 0.06]),
        coordinates(&blade, [9.0, 14.0, 6.0, 3.0, 2.0]),
        coordinates(&blade, [200.0, -350.0, 500.0, 300.0, 150.0]),
    );
    let (velocity, acceleration) = ([40.0, 3.0, -5.0], [2.0, -7.0, 11.0]);
    let (rates, rates_dot) = ([0.4, -0.3, 0.5], [3.0, 2.0, -4.0]);
    let (psi, pitch) = (0.9, PitchMotion { theta: 0.27, theta_dot: 2.1, theta_ddot: -50.0 });
    let place = |t: f64, q_t: &[f64; N]| -> Vec<(V, V, f64)> {
        let theta = pitch.theta + pitch.theta_dot * t + 0.5 * pitch.theta_ddot * t * t;
        let hub = add(add([0.0; 3], velocity, t), acceleration, 0.5 * t * t);
        let turn = add(add([0.0; 3], rates, t), rates_dot, 0.5 * t * t);
        geometry(&blade, q_t, theta)
            .into_iter()
            .map(|(v, mass)| {
                let arm = turned(turn, in_hub(&blade, v, psi + OMEGA * t));
                (add(hub, arm, 1.0), arm, mass)
            })
            .collect()
    };
    let path =
        |t: f64| -> [f64; N] { std::array::from_fn(|i| q[i] + q_dot[i] * t + 0.5 * q_ddot[i] * t * t) };
    let h = 2e-4;
    let at: Vec<Vec<(V, V, f64)>> =
        [-2.0, -1.0, 0.0, 1.0, 2.0].iter().map(|k| place(k * h, &path(k * h))).collect();
    let weights = [-1.0, 16.0, -30.0, 16.0, -1.0];
    let (mut force, mut moment, mut work) = ([0.0; 3], [0.0; 3], [0.0; N]);
    let step = 1e-5;
    let shifted: Vec<[Vec<(V, V, f64)>; 2]> = (0..N)
        .map(|i| {
            let moved = |sign: f64| {
                let mut q_i = q;
                q_i[i] += sign * step;
                place(0.0, &q_i)
            };
            [moved(1.0), moved(-1.0)]
        })
        .collect();
    for p in 0..at[2].len() {
        let mut a = [0.0; 3];
        for (positions, w) in at.iter().zip(weights) {
            a = add(a, positions[p].0, w / (12.0 * h * h));
        }
        let (_, arm, mass) = at[2][p];
        let inertia = a.map(|x| -mass * x);
        force = add(force, inertia, 1.0);
        moment = add(moment, cross(arm, inertia), 1.0);
        for i in 0..N {
            let motion = add(shifted[i][0][p].0, shifted[i][1][p].0, -1.0).map(|x| x / (2.0 * step));
            work[i] += dot(inertia, motion);
        }
    }
    let hub = HubMotion {
        velocity: Vec3::from_array(velocity),
        acceleration_less_gravity: Vec3::from_array(acceleration),
        omega: Vec3::from_array(rates),
        omega_dot: Vec3::from_array(rates_dot),
    };
    let loads = vacuum_loads(&blade, &hub, psi, &modal_motion(&q, &q_dot, &q_ddot), &pitch);
    let (_, gradient) = potential(&blade, &q, pitch.theta);
    let scale = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    for (ours, theirs) in [(loads.force.array(), force), (loads.moment.array(), moment)] {
        for (a, b) in ours.iter().zip(theirs) {
            assert!((a - b).abs() < 2e-6 * scale(&theirs), "{ours:?} against {theirs:?}");
        }
    }
    for i in 0..N {
        let inertial = loads.modal[i] + gradient[i];
        assert!((inertial - work[i]).abs() < 2e-6 * scale(&work), "mode {i}: {inertial} against {}", work[i]);
    }
}

#[test]
fn gravity_alone_in_free_fall_leaves_the_blade_as_without_gravity() {
    let blade = blade_with(&beam_support::uh60a(), 8);
    let m = modal_motion(&coordinates(&blade, [-0.5, 0.4, 0.1, 0.0, 0.0]), &[0.0; N], &[0.0; N]);
    let pitch = PitchMotion { theta: 0.2, theta_dot: 0.0, theta_ddot: 0.0 };
    let rest = vacuum_loads(&blade, &still_hub(), 0.4, &m, &pitch);
    // the hub falls with gravity: its acceleration less gravity is nothing
    let falling = HubMotion { velocity: Vec3::from_array([0.0, 0.0, -30.0]), ..still_hub() };
    let fall = vacuum_loads(&blade, &falling, 0.4, &m, &pitch);
    for i in 0..N {
        assert!((rest.modal[i] - fall.modal[i]).abs() < 1e-9 * rest.modal[i].abs().max(1.0));
    }
    // held against gravity, the hub carries the blade's weight
    let held = HubMotion { acceleration_less_gravity: Vec3::from_array([0.0, 0.0, 9.81]), ..still_hub() };
    let carried = vacuum_loads(&blade, &held, 0.4, &m, &pitch).force.z - rest.force.z;
    assert!((carried + 9.81 * blade.mass).abs() < 1e-9 * blade.mass);
}

/// Largest departure of the linearised blade's squared frequencies from the eigenproblem's, relative.
fn frequency_error(n_gauss: usize) -> f64 {
    type D = Dual<N>;
    let blade = blade_with(&beam_support::uh60a(), n_gauss);
    let airfoils = StationAirfoils::uniform(airfoil(), blade.stations.len());
    let air = Air { density: 1.0, speed_of_sound: 340.0 };
    let environment = BladeEnvironment { airfoils: &airfoils, air, rotor_speed: OMEGA, yawed_drag: false };
    let hub: HubMotion<D> = still_hub().constant();
    let c = D::cst;
    let pitch = PitchMotion { theta: c(0.3), theta_dot: c(0.0), theta_ddot: c(0.0) };
    let zero = [c(0.0); MAX_MODES];
    let seeded = || {
        let mut q = zero;
        (0..N).for_each(|i| q[i] = D::variable(0.0, i));
        q
    };
    let by_q = ModalMotion { q: seeded(), q_dot: zero, q_ddot: zero };
    let by_acceleration = ModalMotion { q: zero, q_dot: zero, q_ddot: seeded() };
    let loads =
        |m: &ModalMotion<D>| blade.loads(&environment, &hub, c(0.0), m, &pitch, &BladeInflow::Vacuum).modal;
    let (stiffness, mass) = (loads(&by_q), loads(&by_acceleration));
    let mut worst = 0.0f64;
    for i in 0..N {
        for j in 0..N {
            let scale = blade.modes.frequency[i] * blade.modes.frequency[j];
            let expected = if i == j { blade.modes.frequency[i].powi(2) } else { 0.0 };
            worst = worst.max((-stiffness[i].eps[j] - expected).abs() / scale);
            let unit = if i == j { 1.0 } else { 0.0 };
            worst = worst.max((-mass[i].eps[j] - unit).abs());
        }
    }
    worst
}

#[test]
fn linearised_at_rest_the_equations_of_motion_have_the_modes_of_the_eigenproblem() {
    // mass matrix one, stiffness diag(omega^2): what is left is the quadrature of twist and steps of the properties
    let errors = [4, 6, 8, 12].map(frequency_error);
    println!("largest departure with 4, 6, 8, 12 points per element: {errors:?}");
    assert!(errors[2] < 1e-4, "{errors:?}");
    assert!(errors[3] < errors[0], "{errors:?}");
}

#[test]
fn the_energy_of_a_blade_turning_steadily_in_vacuum_is_conserved() {
    // Jacobi's integral T(relative) - m |Omega x r|^2/2 + U, kinetic energy counted by particles
    let blade = blade_with(&smooth(), 8);
    let pitch = PitchMotion { theta: 0.3, theta_dot: 0.0, theta_ddot: 0.0 };
    let rate = |q: &[f64; N], q_dot: &[f64; N]| -> [f64; N] {
        let f = |q_ddot: &[f64; N]| {
            vacuum_loads(&blade, &still_hub(), 0.0, &modal_motion(q, q_dot, q_ddot), &pitch).modal
        };
        let bias = f(&[0.0; N]);
        let mut mass = nalgebra::SMatrix::<f64, N, N>::zeros();
        for j in 0..N {
            let mut unit = [0.0; N];
            unit[j] = 1.0;
            let column = f(&unit);
            for i in 0..N {
                mass[(i, j)] = bias[i] - column[i];
            }
        }
        let right = nalgebra::SVector::<f64, N>::from_fn(|i, _| bias[i]);
        let solution = mass.lu().solve(&right).unwrap();
        std::array::from_fn(|i| solution[i])
    };
    let integral = |q: &[f64; N], q_dot: &[f64; N]| -> (f64, f64) {
        let h = 1e-5;
        let shifted = |t: f64| geometry(&blade, &std::array::from_fn(|i| q[i] + q_dot[i] * t), pitch.theta);
        let (ahead, here, behind) = (shifted(h), shifted(0.0), shifted(-h));
        let (mut relative, mut centrifugal) = (0.0, 0.0);
        for p in 0..here.len() {
            let v = add(ahead[p].0, behind[p].0, -1.0).map(|x| x / (2.0 * h));
            let r = in_hub(&blade, here[p].0, 0.0);
            relative += 0.5 * here[p].1 * dot(v, v);
            centrifugal += 0.5 * here[p].1 * OMEGA * OMEGA * (r[0] * r[0] + r[1] * r[1]);
        }
        let (strain, _) = potential(&blade, q, pitch.theta);
        (relative - centrifugal + strain, relative)
    };
    let mut q = coordinates(&blade, [-0.6, 0.5, 0.1, 0.02, 0.03]);
    let mut q_dot = [0.0; N];
    let (start, _) = integral(&q, &q_dot);
    let (steps, mut swing) = (1200, 0.0f64);
    let dt = 2.0 * PI / OMEGA / f64::from(steps);
    let along = |a: &[f64; N], b: &[f64; N], k: f64| -> [f64; N] { std::array::from_fn(|i| a[i] + k * b[i]) };
    for _ in 0..steps {
        let k1 = (q_dot, rate(&q, &q_dot));
        let k2 = (
            along(&q_dot, &k1.1, dt / 2.0),
            rate(&along(&q, &k1.0, dt / 2.0), &along(&q_dot, &k1.1, dt / 2.0)),
        );
        let k3 = (
            along(&q_dot, &k2.1, dt / 2.0),
            rate(&along(&q, &k2.0, dt / 2.0), &along(&q_dot, &k2.1, dt / 2.0)),
        );
        let k4 = (along(&q_dot, &k3.1, dt), rate(&along(&q, &k3.0, dt), &along(&q_dot, &k3.1, dt)));
        for i in 0..N {
            q[i] += dt / 6.0 * (k1.0[i] + 2.0 * k2.0[i] + 2.0 * k3.0[i] + k4.0[i]);
            q_dot[i] += dt / 6.0 * (k1.1[i] + 2.0 * k2.1[i] + 2.0 * k3.1[i] + k4.1[i]);
        }
        swing = swing.max(q_dot.iter().map(|x| 0.5 * x * x).sum());
    }
    let (end, _) = integral(&q, &q_dot);
    println!(
        "Jacobi's integral changes by {:.2e} J, largest relative kinetic energy {swing:.3e} J",
        end - start
    );
    assert!(swing > 100.0);
    assert!((end - start).abs() < 1e-6 * swing, "{start} to {end}, swing {swing}");
}
