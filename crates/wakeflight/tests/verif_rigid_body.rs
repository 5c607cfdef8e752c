//! Rigid-body motion of the airframe against solutions integrated to 1e-12 (data file D01_rigid_body.toml).

use wakeflight::airframe::mass::{AirframeMass, BladesAtHub, MassProperties};
use wakeflight::numerics::frames::{Body, Inertial, Vec3, quaternion, rot_ib};
use wakeflight::numerics::scalar::Dual;

type State = [f64; 10]; // u v w, p q r, quaternion
const G: f64 = 32.174;

fn body(blade_mass: f64, hub: [f64; 3]) -> AirframeMass {
    let properties = MassProperties { gross_mass: 500.0, inertia: [4659.0, 38512.0, 36796.0, 1882.0] };
    AirframeMass::new(&properties, &[BladesAtHub { hub, mass: 4.0 * blade_mass }]).unwrap()
}

/// Accelerations that make the residual vanish: it is linear in them, so six directions give the matrix.
fn accelerations(body: &AirframeMass, v: [f64; 3], rates: [f64; 3], gravity: Vec3<f64, Body>) -> [f64; 6] {
    let x: [Dual<6>; 6] = std::array::from_fn(|i| Dual::variable(0.0, i));
    let (force, moment) = body.inertial_residual(
        Vec3::cst(v),
        Vec3::cst(rates),
        Vec3::new(x[0], x[1], x[2]),
        Vec3::new(x[3], x[4], x[5]),
        Vec3::cst(gravity.array()),
    );
    let rows: Vec<Dual<6>> = force.array().into_iter().chain(moment.array()).collect();
    let matrix = nalgebra::Matrix6::from_fn(|i, j| rows[i].eps[j]);
    let right = nalgebra::Vector6::from_fn(|i, _| -rows[i].re);
    let solution = matrix.lu().solve(&right).unwrap();
    std::array::from_fn(|i| solution[i])
}

fn rate(body: &AirframeMass, g: f64, s: &State) -> State {
    let q = [s[6], s[7], s[8], s[9]];
    let down = rot_ib(q).transposed() * Vec3::<f64, Inertial>::new(0.0, 0.0, g);
    let a = accelerations(body, [s[0], s[1], s[2]], [s[3], s[4], s[5]], down);
    let (p, r, y) = (s[3], s[4], s[5]);
    let [w, x, v, z] = q;
    [
        a[0],
        a[1],
        a[2],
        a[3],
        a[4],
        a[5],
        -0.5 * (x * p + v * r + z * y),
        0.5 * (w * p + v * y - z * r),
        0.5 * (w * r + z * p - x * y),
        0.5 * (w * y + x * r - v * p),
    ]
}

fn integrate(body: &AirframeMass, g: f64, start: State, time: f64) -> State {
    let n = (time * 1000.0).round() as usize;
    let h = time / n as f64;
    let mut s = start;
    for _ in 0..n {
        let add = |k: &State, f: f64| -> State { std::array::from_fn(|i| s[i] + f * k[i]) };
        let k1 = rate(body, g, &s);
        let k2 = rate(body, g, &add(&k1, 0.5 * h));
        let k3 = rate(body, g, &add(&k2, 0.5 * h));
        let k4 = rate(body, g, &add(&k3, h));
        s = std::array::from_fn(|i| s[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    s
}

fn start(velocity: [f64; 3]) -> State {
    let q = quaternion(0.0, 0.0, 0.0);
    [velocity[0], velocity[1], velocity[2], 0.5, 0.2, -0.3, q[0], q[1], q[2], q[3]]
}

/// Roll, pitch, yaw [deg] of a quaternion.
fn euler(s: &State) -> [f64; 3] {
    let r = rot_ib([s[6], s[7], s[8], s[9]]).rows;
    [r[2][1].atan2(r[2][2]), (-r[2][0]).asin(), r[1][0].atan2(r[0][0])].map(f64::to_degrees)
}

#[test]
fn verif_torque_free_motion() {
    let b = body(0.0, [0.0; 3]);
    // p, q, r [rad/s]; roll, pitch, yaw [deg]
    for (t, rates, angles) in [
        (1.0, [0.4869792728, 0.0563498938, -0.3573668466], [26.473134, 11.811979, -17.111410]),
        (2.0, [0.4890895905, -0.0945772692, -0.3489359525], [48.874200, 23.676907, -35.004585]),
        (5.0, [0.5219843029, -0.3722819933, 0.0311917131], [91.752405, 43.867848, -108.690721]),
        (10.0, [0.4619370135, 0.2010773028, 0.3554187710], [-178.935635, -8.770293, 135.389047]),
    ] {
        let s = integrate(&b, 0.0, start([0.0; 3]), t);
        for k in 0..3 {
            assert!((s[3 + k] - rates[k]).abs() < 1e-6, "rate {k} at {t}: {} {}", s[3 + k], rates[k]);
        }
        let e = euler(&s);
        for k in 0..3 {
            assert!((e[k] - angles[k]).abs() < 2e-6, "angle {k} at {t}: {} {}", e[k], angles[k]);
        }
    }
}

#[test]
fn verif_free_fall_of_a_turning_body() {
    let b = body(0.0, [0.0; 3]);
    for (t, velocity) in [
        (1.0, [119.70597206, 61.36847259, 34.12560771]),
        (2.0, [75.43047600, 128.77547798, 9.63247970]),
        (5.0, [-142.67183017, 82.04629014, -130.45041989]),
    ] {
        let s = integrate(&b, G, start([135.0, 0.0, 0.0]), t);
        for k in 0..3 {
            assert!((s[k] - velocity[k]).abs() < 1e-6 * 135.0, "{t}: {} {}", s[k], velocity[k]);
        }
        let speed = (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt();
        assert!((speed - (135.0f64.powi(2) + (G * t).powi(2)).sqrt()).abs() < 1e-6);
    }
}

/// Energy and angular momentum of the body whose origin is not its centre of gravity.
#[test]
fn verif_momentum_and_energy_are_kept_with_the_origin_off_the_centre_of_gravity() {
    let b = body(30.0, [0.4, 0.1, -1.7]);
    let invariants = |s: &State| {
        let c = Vec3::<f64, Body>::cst(b.cg);
        let w = Vec3::new(s[3], s[4], s[5]);
        let v = Vec3::new(s[0], s[1], s[2]) + w.cross(c);
        let i = b.inertia_cg.map(|r| r[0] * w.x + r[1] * w.y + r[2] * w.z);
        let spin = Vec3::<f64, Body>::from_array(i);
        let r = rot_ib([s[6], s[7], s[8], s[9]]);
        let (linear, angular) = (r * v.scaled(b.mass), r * spin);
        let energy = b.mass * v.dot(v) + w.dot(spin);
        [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z, energy]
    };
    let first = start([135.0, 10.0, -5.0]);
    let (before, after) = (invariants(&first), invariants(&integrate(&b, 0.0, first, 5.0)));
    for k in 0..7 {
        let scale = if k < 3 {
            5e4
        } else if k < 6 {
            14533.0
        } else {
            before[6]
        };
        assert!((after[k] - before[k]).abs() < 1e-9 * scale, "{k}: {} {}", before[k], after[k]);
    }
}

#[test]
fn verif_the_stated_energy_and_angular_momentum() {
    let b = body(0.0, [0.0; 3]);
    let w = [0.5, 0.2, -0.3];
    let h: [f64; 3] = b.inertia_origin.map(|r| r[0] * w[0] + r[1] * w[1] + r[2] * w[2]);
    let energy: f64 = (0..3).map(|i| h[i] * w[i]).sum();
    assert!((energy - 6581.47).abs() < 0.005);
    assert!((h.iter().map(|x| x * x).sum::<f64>().sqrt() - 14533.35434819).abs() < 1e-6);
}

#[test]
fn verif_coordinated_turns_need_only_lift_along_the_body_z_axis() {
    let b = body(0.0, [0.0; 3]);
    for (phi, q, r, n) in [
        (15.0f64, 0.01652495, 0.06167196, 1.03527618),
        (30.0, 0.06878614, 0.11914109, 1.15470054),
        (45.0, 0.16849094, 0.16849094, std::f64::consts::SQRT_2),
        (60.0, 0.35742326, 0.20635841, 2.00000000),
    ] {
        let down = rot_ib(quaternion(phi.to_radians(), 0.0, 0.0)).transposed();
        let gravity = down * Vec3::<f64, Inertial>::new(0.0, 0.0, G);
        let v = Vec3::new(135.024789, 0.0, 0.0);
        let zero = Vec3::zero();
        let (force, _) = b.inertial_residual(v, Vec3::new(0.0, q, r), zero, zero, gravity);
        let weight = b.mass * G;
        assert!(force.x.abs() < 1e-6 * weight && force.y.abs() < 1e-6 * weight);
        assert!((force.z / weight - n).abs() < 1e-6, "{phi}: {}", force.z / weight);
    }
}
