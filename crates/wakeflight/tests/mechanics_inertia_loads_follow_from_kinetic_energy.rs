//! Inertia and gravity loads of a blade on a hub that moves and turns at will, against Lagrange's equations and the
//! rates of momentum of an independent kinetic energy.

mod mechanics_support;

use mechanics_support::*;
use wakeflight::airfoil::span::StationAirfoils;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::hub_motion::HubMotion;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion};
use wakeflight::blade::model::Blade;
use wakeflight::blade::stations::StructuralPoint;
use wakeflight::blade::surroundings::{BladeEnvironment, BladeInflow};
use wakeflight::numerics::frames::Vec3;
use wakeflight::numerics::scalar::{Dual, Real};

type D = Dual<1>;
const N: usize = 5;

/// Place of the hub in inertial axes (z up).
fn hub_place<S: Real>(t: S) -> [S; 3] {
    let (s, c) = (t * 3.0).sin_cos();
    [s * 2.0 + t * 40.0, c * 3.0 - t * t * 5.0, s * c * 1.5 + t * 2.0]
}

/// Attitude of the hub axes: columns in inertial axes.
fn hub_attitude<S: Real>(t: S) -> Matrix3<S> {
    let (s, c) = (t * 4.0).sin_cos();
    product(&product(&turn(2, t * 0.8 + s * 0.2), &turn(1, c * 0.4)), &turn(0, s * 0.5 + t * 0.6))
}

fn pitch<S: Real>(t: S) -> S {
    (t * OMEGA + 0.5).sin_cos().0 * 0.15 + 0.25
}

fn section<S: Real>(blade: &Blade, p: &StructuralPoint, q: &[S; N], t: S) -> [[S; 3]; 3] {
    section_place(blade, p, q, pitch(t), t * OMEGA, hub_place(t), &hub_attitude(t))
}

/// Kinetic energy, potential of gravity, momentum, and moment of momentum about the hub.
struct Motion {
    kinetic: f64,
    gravity: f64,
    momentum: [f64; 3],
    moment: [f64; 3],
}

fn motion(blade: &Blade, g: f64, q: &[f64; N], q_dot: &[f64; N], t: f64) -> Motion {
    let variables: [D; N] = std::array::from_fn(|i| D { re: q[i], eps: [q_dot[i]] });
    let time = D::variable(t, 0);
    let hub = hub_place(t);
    let mut sum = Motion { kinetic: 0.0, gravity: 0.0, momentum: [0.0; 3], moment: [0.0; 3] };
    for p in &blade.structure {
        let at = section(blade, p, &variables, time);
        let [r, c, _] = at.map(|v| v.map(|x| x.re));
        let found = section_momentum(p, hub, at);
        sum.kinetic += found.kinetic;
        sum.gravity += g * (p.mass * r[2] + p.first_moment * c[2]);
        sum.momentum = add(sum.momentum, found.momentum);
        sum.moment = add(sum.moment, found.moment);
    }
    sum
}

/// Modal motion along which the blade swings.
struct Path {
    a: [f64; MAX_MODES],
    b: [f64; MAX_MODES],
    w: f64,
}

impl Path {
    fn at(&self, t: f64) -> [[f64; N]; 3] {
        let (s, c) = (self.w * t).sin_cos();
        let Self { a, b, w } = self;
        [
            std::array::from_fn(|i| a[i] * s + b[i] * c),
            std::array::from_fn(|i| w * (a[i] * c - b[i] * s)),
            std::array::from_fn(|i| -w * w * (a[i] * s + b[i] * c)),
        ]
    }
}

/// Largest relative errors of modal forces, hub force, hub moment.
fn errors(blade: &Blade, g: f64, path: &Path, t: f64) -> [f64; 3] {
    let h = 2e-4;
    // hub motion in hub axes
    let turned = hub_attitude(t);
    let into_hub = |v: [f64; 3]| times(&transposed(&turned), v);
    let rate = |t: f64| {
        let at = hub_attitude(D::variable(t, 0));
        let m = product(&transposed(&at.map(|row| row.map(|v| v.re))), &at.map(|row| row.map(|v| v.eps[0])));
        [m[2][1], m[0][2], m[1][0]]
    };
    let velocity = |t: f64| hub_place(D::variable(t, 0)).map(|v| v.eps[0]);
    let acceleration = time_derivative(t, h, velocity);
    let hub = HubMotion {
        velocity: Vec3::cst(into_hub(velocity(t))),
        acceleration_less_gravity: Vec3::cst(into_hub(add(acceleration, [0.0, 0.0, g]))),
        omega: Vec3::cst(rate(t)),
        omega_dot: Vec3::cst(time_derivative(t, h, rate)),
    };
    let padded = |x: [f64; N]| std::array::from_fn(|i| if i < N { x[i] } else { 0.0 });
    let [q, q_dot, q_ddot] = path.at(t);
    let modal = ModalMotion { q: padded(q), q_dot: padded(q_dot), q_ddot: padded(q_ddot) };
    let (s, c) = (OMEGA * t + 0.5).sin_cos();
    let control =
        PitchMotion { theta: pitch(t), theta_dot: 0.15 * OMEGA * c, theta_ddot: -0.15 * OMEGA * OMEGA * s };
    let airfoils = StationAirfoils::uniform(smooth_airfoil(6.0, 0.0, 0.01, 0.0), blade.stations.len());
    let environment =
        BladeEnvironment { airfoils: &airfoils, air: AIR, rotor_speed: OMEGA, yawed_drag: false };
    let found = blade.loads(&environment, &hub, OMEGA * t, &modal, &control, &BladeInflow::Vacuum);

    // Q_i = -(d/dt dT/dq_dot - dT/dq) - dV/dq
    let impulse = |t: f64| {
        let [q, q_dot, _] = path.at(t);
        // T is quadratic in the rates: a central difference of any step is exact
        std::array::from_fn::<f64, N, _>(|i| {
            let at = |k: f64| {
                let mut rate = q_dot;
                rate[i] += k;
                motion(blade, g, &q, &rate, t).kinetic
            };
            (at(50.0) - at(-50.0)) / 100.0
        })
    };
    let impulse_rate = time_derivative(t, h, impulse);
    let modal_force: [f64; N] = std::array::from_fn(|i| {
        let step = 1e-3 * per_radian(blade, i);
        let [gradient] = time_derivative(0.0, step, |k| {
            let mut place = q;
            place[i] += k;
            let m = motion(blade, g, &place, &q_dot, t);
            [m.kinetic - m.gravity]
        });
        gradient - impulse_rate[i]
    });
    let of = |v: Motion| [v.momentum, v.moment];
    let rates = time_derivative(t, h, |t| {
        let [q, q_dot, _] = path.at(t);
        let [p, l] = of(motion(blade, g, &q, &q_dot, t));
        [p[0], p[1], p[2], l[0], l[1], l[2]]
    });
    let now = motion(blade, g, &q, &q_dot, t);
    let mass: f64 = blade.structure.iter().map(|p| p.mass).sum();
    let force = [-rates[0], -rates[1], -rates[2] - mass * g];
    let carried = cross(velocity(t), now.momentum);
    // gravity about the hub
    let mut first = [0.0; 3];
    for p in &blade.structure {
        let [r, c, _] = section(blade, p, &q, t);
        let hub = hub_place(t);
        first = std::array::from_fn(|k| first[k] + p.mass * (r[k] - hub[k]) + p.first_moment * c[k]);
    }
    let weight = cross(first, [0.0, 0.0, -g]);
    let moment: [f64; 3] = std::array::from_fn(|k| -rates[3 + k] - carried[k] + weight[k]);
    [
        relative_error(&found.modal[..N], &modal_force),
        relative_error(&found.force.array(), &into_hub(force)),
        relative_error(&found.moment.array(), &into_hub(moment)),
    ]
}

#[test]
fn inertia_loads_follow_from_kinetic_energy() {
    let mut random = Random::new(4);
    let mut worst = [0f64; 3];
    for mut blade in [blade(), general_blade()] {
        // inertia and gravity alone
        for p in &mut blade.structure {
            (p.stiffness.flap, p.stiffness.lag, p.stiffness.torsion) = (0.0, 0.0, 0.0);
        }
        blade.control_stiffness = 0.0;
        blade.damping = [0.0; MAX_MODES];
        for (g, t) in [(0.0, 0.11), (9.80665, 0.11), (9.80665, 0.43)] {
            let path = Path {
                a: random_modal(&blade, 0.25, &mut random),
                b: random_modal(&blade, 0.25, &mut random),
                w: 29.0,
            };
            let found = errors(&blade, g, &path, t);
            for (w, e) in worst.iter_mut().zip(found) {
                *w = w.max(e);
            }
        }
    }
    println!("modal forces {:.1e}, hub force {:.1e}, hub moment {:.1e}", worst[0], worst[1], worst[2]);
    assert!(worst.iter().all(|e| *e < 1e-7), "{worst:?}");
}
