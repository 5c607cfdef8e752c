//! Fuselage, tail surfaces, tail rotor and interference with the tables of a UH-60A-like helicopter.

mod data_files;

use data_files::*;
use wakeflight::airframe::interference::{FuselageWash, Interference};
use wakeflight::airframe::tail_rotor::ClosedFormState;
use wakeflight::numerics::frames::{Body, Vec3};
use wakeflight::numerics::scalar::{Dual, Real};

type V = Vec3<f64, Body>;
const FT2: f64 = FOOT * FOOT;
const FT3: f64 = FOOT * FOOT * FOOT;

/// Velocity of a point that meets the air at an angle of attack and a sideslip [deg].
fn stream(speed: f64, alpha: f64, beta: f64) -> V {
    let ((sa, ca), (sb, cb)) = (alpha.to_radians().sin_cos(), beta.to_radians().sin_cos());
    Vec3::new(speed * ca * cb, speed * sb, speed * sa * cb)
}

#[test]
fn at_zero_angles_fuselage_loads_are_the_table_entries() {
    let (rho, v) = (1.2, 40.0);
    let q = 0.5 * rho * v * v;
    let l = fuselage().loads(stream(v, 0.0, 0.0), rho);
    // drag 23.58 ft2, lift 1 ft2, pitching moment -90 ft3 at zero angles
    for (value, reference) in [
        (l.force.x / q, -23.58 * FT2),
        (l.force.y / q, 0.0),
        (l.force.z / q, -FT2),
        (l.moment.x / q, 0.0),
        (l.moment.y / q, -90.0 * FT3),
        (l.moment.z / q, 0.0),
    ] {
        assert!((value - reference).abs() < 1e-7, "{value} {reference}");
    }
}

#[test]
fn wind_from_the_right_pushes_the_fuselage_left_and_turns_its_nose_away() {
    let f = fuselage();
    let l = f.loads(stream(40.0, 0.0, 20.0), 1.2);
    let q = 0.5 * 1.2 * 1600.0;
    let at = |g: &wakeflight::numerics::tables::Grid| g.at(0.0, 20f64.to_radians());
    assert!((at(&f.side) / FT2 + 50.0).abs() < 0.5);
    assert!((at(&f.yawing) / FT3 + 240.0).abs() < 0.5);
    assert!((at(&f.rolling) / FT3 - 75.0).abs() < 0.5);
    assert!(l.force.y < -40.0 * FT2 * q);
    assert!(l.moment.z < 0.0);
    assert!(l.moment.x > 0.0);
}

/// The rows of T as printed, with trigonometric functions, against the code without them.
#[test]
fn fuselage_loads_are_the_published_rotation_of_the_tables() {
    let f = fuselage();
    let (rho, speed) = (1.05, 35.0);
    let q = 0.5 * rho * speed * speed;
    for alpha in [-85.0, -40.0, -7.0, 0.0, 13.0, 60.0f64] {
        for beta in [-80.0, -22.0, 0.0, 3.0, 45.0f64] {
            let (a, b) = (alpha.to_radians(), beta.to_radians());
            let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
            let t = [[ca * cb, ca * sb, -sa], [sb, -cb, 0.0], [sa * cb, sa * sb, ca]];
            let turn = |v: [f64; 3]| t.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2]);
            let force = turn([-q * f.drag.at(a, b), -q * f.side.at(a, b), -q * f.lift.at(a, b)]);
            let moment = turn([q * f.rolling.at(a, b), -q * f.pitching.at(a, b), q * f.yawing.at(a, b)]);
            let l = f.loads(stream(speed, alpha, beta), rho);
            for k in 0..3 {
                assert!((l.force.array()[k] - force[k]).abs() < 1e-5 * q);
                assert!((l.moment.array()[k] - moment[k]).abs() < 1e-5 * q);
            }
            assert!((l.alpha - a).abs() < 1e-6 && (l.beta - b).abs() < 1e-6);
        }
    }
}

#[test]
fn fuselage_drag_opposes_the_motion_also_in_rearward_flight() {
    let f = fuselage();
    for (alpha, beta) in [(0.0, 0.0), (0.0, 90.0), (170.0, 0.0), (180.0, 5.0), (-90.0, 0.0), (95.0, 0.0)] {
        let v = stream(15.0, alpha, beta);
        assert!(f.loads(v, 1.2).force.dot(v) < 0.0, "{alpha} {beta}");
    }
    // hover: the wash pushes the fuselage down, and nothing jumps where the forward speed changes sign
    let hover = |u: f64| f.loads(Vec3::new(u, 0.0, -12.0), 1.2).force;
    assert!(hover(0.0).z > 0.0);
    assert!((hover(1e-6) - hover(-1e-6)).norm() < 1e-3);
}

#[test]
fn fuselage_loads_at_rest_are_zero_with_finite_derivatives() {
    for v in [[0.0; 3], [0.0, 5.0, 0.0], [0.0, 0.0, -10.0], [1e-9, 0.0, 0.0]] {
        let d = variables(v);
        let l = fuselage().loads(Vec3::from_array(d), 1.2);
        for s in l.force.array().into_iter().chain(l.moment.array()).chain([l.alpha, l.beta]) {
            assert!(s.re.is_finite() && s.eps.iter().all(|e| e.is_finite()));
        }
        if v == [0.0; 3] {
            assert!(l.force.norm().re < 1e-4);
        }
    }
}

#[test]
fn fuselage_derivatives_equal_central_differences() {
    let f = fuselage();
    for x in [[40.0, 3.0, 2.0], [0.3, -4.0, -12.0], [-9.0, 2.0, 3.0]] {
        let pack = |l: wakeflight::airframe::fuselage::FuselageLoads<f64>| {
            [l.force.x, l.force.y, l.force.z, l.moment.x, l.moment.y, l.moment.z, l.alpha, l.beta]
        };
        let l = f.loads(Vec3::from_array(variables(x)), 1.1);
        let dual = [l.force.x, l.force.y, l.force.z, l.moment.x, l.moment.y, l.moment.z, l.alpha, l.beta];
        assert_derivatives(x, dual, 1e4, |x| pack(f.loads(Vec3::from_array(x), 1.1)));
    }
}

#[test]
fn rotor_wash_is_the_table_times_the_induced_velocity() {
    let i = interference();
    // chi = 30 deg, no flapping: ekx 0.32 and ekz 1.12 at the fuselage, 0.12 and 1.91 at the tail
    let (lambda_0, mu_z, tip_speed) = (0.04, -0.01, 220.0);
    let mu_x = 0.05 * 30f64.to_radians().tan();
    let wash = i.rotor_wash(lambda_0, mu_x, mu_z, 0.0, tip_speed);
    let v_i = lambda_0 * tip_speed;
    assert!((wash.fuselage.x - 0.32 * v_i).abs() < 1e-6 && (wash.fuselage.z + 1.12 * v_i).abs() < 1e-6);
    assert!((wash.fin.x - 0.12 * v_i).abs() < 1e-6 && (wash.stabilator.z + 1.91 * v_i).abs() < 1e-6);
    // disk forward 6 deg at skew 36 deg: the row of 30 deg, first column
    let mu_x = 0.05 * 36f64.to_radians().tan();
    let wash = i.rotor_wash(lambda_0, mu_x, mu_z, 6f64.to_radians(), tip_speed);
    assert!((wash.fuselage.x - 0.43 * v_i).abs() < 1e-6 && (wash.fuselage.z + 1.065 * v_i).abs() < 1e-6);
    // constant factors push down only, and not on the fin
    let f = Interference::Factors { fuselage: 1.0, stabilator: 1.5 };
    let wash = f.rotor_wash(lambda_0, mu_x, mu_z, 0.1, tip_speed);
    assert_eq!(wash.fuselage.array(), [0.0, 0.0, -v_i]);
    assert_eq!(wash.stabilator.array(), [0.0, 0.0, v_i * -1.5]);
    assert_eq!(wash.fin.array(), [0.0; 3]);
    assert_eq!(f.fuselage_wash(0.3, 0.2).speed_ratio_fin, 1.0);
}

#[test]
fn fuselage_wash_in_the_stated_order() {
    let w = interference().fuselage_wash(0.0, 5f64.to_radians());
    // downwash 0.45 deg at zero incidence, sidewash 0.88 deg and q ratio 0.64 at psi = -5 deg, 0.76 at the stabilator
    assert!((w.downwash.to_degrees() - 0.45).abs() < 1e-12);
    assert!((w.sidewash.to_degrees() - 0.88).abs() < 1e-12);
    let v = V::new(40.0, 3.0, 1.0);
    let s = w.at_stabilator(v);
    assert!((s.x - 40.0 * 0.76f64.sqrt()).abs() < 1e-12 && s.y == 3.0);
    assert!((s.z - (1.0 - 40.0 * 0.45f64.to_radians()) * 0.76f64.sqrt()).abs() < 1e-12);
    let f = w.at_fin(v);
    assert!((f.x - 32.0).abs() < 1e-12 && f.z == 1.0);
    assert!((f.y - (3.0 - 40.0 * 0.88f64.to_radians())).abs() < 1e-12);
    let t = w.at_tail_rotor(v);
    assert!(
        (t.y - f.y * 0.8).abs() < 1e-12 && (t.z - 0.8 * (1.0 - 40.0 * 0.45f64.to_radians())).abs() < 1e-12
    );
    let none = FuselageWash::<f64>::none();
    for local in [none.at_stabilator(v), none.at_fin(v), none.at_tail_rotor(v)] {
        assert_eq!(local.array(), v.array());
    }
}

#[test]
fn interference_derivatives_equal_central_differences() {
    let i = interference();
    let x = [0.021, 0.17, -0.012, 0.05, 0.03, -0.06, 40.0, 2.0, -3.0];
    fn evaluate<S: Real>(i: &Interference, x: [S; 9]) -> [S; 12] {
        let w = i.rotor_wash(x[0], x[1], x[2], x[3], 220.0);
        let f = i.fuselage_wash(x[4], x[5]);
        let v = Vec3::new(x[6], x[7], x[8]);
        let (s, n, t) = (f.at_stabilator(v), f.at_fin(v), f.at_tail_rotor(v));
        [w.fuselage.x, w.fuselage.z, w.stabilator.x, w.fin.z, s.x, s.z, n.x, n.y, t.x, t.y, t.z, f.sidewash]
    }
    assert_derivatives(x, evaluate(&i, variables(x)), 40.0, |x| evaluate(&i, x));
}

#[test]
fn a_stabilator_lifts_with_incidence_and_drags_against_the_wind() {
    let (s, rho, v) = (stabilator(), 1.2, 40.0);
    let q = 0.5 * rho * v * v * s.area;
    let f = s.stabilator_force(V::new(v, 0.0, 0.0), 5f64.to_radians(), rho);
    assert!((f.z / q + 0.356).abs() < 1e-9 && (f.x / q + 0.022).abs() < 1e-9 && f.y == 0.0);
    // the same angle from the flow: lift stands across it
    let a = 5f64.to_radians();
    let f = s.stabilator_force(V::new(v * a.cos(), 7.0, v * a.sin()), 0.0, rho);
    assert!((f.z / q + 0.356 * a.cos() + 0.022 * a.sin()).abs() < 1e-9);
    assert!((f.x / q - 0.356 * a.sin() + 0.022 * a.cos()).abs() < 1e-9);
    // rearward flight: drag forward
    assert!(s.stabilator_force(V::new(-v, 0.0, 0.0), 0.0, rho).x > 0.0);
}

#[test]
fn a_fin_is_pushed_with_the_wind_and_at_rest_to_starboard() {
    let (s, rho, v) = (fin(), 1.2, 40.0);
    let q = 0.5 * rho * v * v * s.area;
    let f = s.fin_force(V::new(v, 0.0, 0.0), rho);
    assert!((f.y / q - 0.06).abs() < 1e-9 && (f.x / q + 0.018).abs() < 1e-9 && f.z == 0.0);
    // wind from the right: pushed left, nose to the wind (arm aft)
    let b = 10f64.to_radians();
    let f = s.fin_force(V::new(v * b.cos(), v * b.sin(), 0.0), rho);
    assert!((f.y / q + 0.38 + 0.044 * b.sin()).abs() < 1e-9);
    assert!(s.position[0] * f.y > 0.0);
}

#[test]
fn surfaces_at_rest_are_finite_and_their_derivatives_equal_central_differences() {
    let (s, n) = (stabilator(), fin());
    for v in [[0.0; 4], [0.0, 3.0, 0.0, 0.0], [0.0, 0.0, -8.0, 0.1]] {
        let d = variables(v);
        let air = Vec3::new(d[0], d[1], d[2]);
        let forces = [s.stabilator_force(air, d[3], 1.2), n.fin_force(air, 1.2)];
        for f in forces.into_iter().flat_map(Vec3::array) {
            assert!(f.re.is_finite() && f.eps.iter().all(|e| e.is_finite()));
        }
    }
    let x = [38.0, 4.0, -3.0, 0.12];
    fn evaluate<S: Real>(x: [S; 4]) -> [S; 4] {
        let v = Vec3::new(x[0], x[1], x[2]);
        let (a, b) = (stabilator().stabilator_force(v, x[3], 1.2), fin().fin_force(v, 1.2));
        [a.x, a.z, b.x, b.y]
    }
    assert_derivatives(x, evaluate(variables(x)), 4e3, evaluate);
}

#[test]
fn stabilator_schedule_at_its_corners() {
    let s = schedule();
    let at = |v: f64, c: f64, q: f64| s.incidence(v, c, q).to_degrees();
    // low speed: 42 deg cut at the stop
    assert!((at(0.0, 50.0, 0.0) - 39.0).abs() < 1e-6);
    assert!((at(80.0, 50.0, 0.0) - (42.0 - 50.0 * (0.67 + 0.003286 * 20.0))).abs() < 1e-9);
    assert!((at(80.0, 100.0, 0.0) - (42.0 - 50.0 * 0.67)).abs() < 1e-9);
    assert!((at(100.0, 60.0, 0.0) - (42.0 - 50.0 * (0.67 + 0.003286 * 10.0) - 0.1119 * 20.0)).abs() < 1e-9);
    assert!((at(147.0, 0.0, 0.0) - -8.0).abs() < 1e-6);
    // pitching up at 10 deg/s adds 1.6 deg
    assert!((at(80.0, 50.0, 10f64.to_radians()) - at(80.0, 50.0, 0.0) - 1.6).abs() < 1e-9);
    let x = [70.0, 42.0, 0.05];
    let evaluate = |x: [f64; 3]| [s.incidence(x[0], x[1], x[2])];
    let d = variables(x);
    assert_derivatives(x, [s.incidence(d[0], d[1], d[2])], 1.0, evaluate);
}

fn closed<S: Real>(theta: S, inflow: S) -> ClosedFormState<S> {
    ClosedFormState { theta, inflow, speed_ratio: S::cst(1.0) }
}

/// A tail rotor at another speed is the rotor whose nominal speed that is; its inflow counts at the one it had.
#[test]
fn a_tail_rotor_off_its_speed_is_one_of_that_speed() {
    let (ratio, v, theta) = (0.9, V::new(12.0, -3.0, 1.0), 0.28);
    let (own, mut slower) = (tail_rotor(), tail_rotor());
    slower.omega *= ratio;
    let off = own.evaluate(v, ClosedFormState { theta, inflow: 0.04, speed_ratio: ratio }, 1.1, v.x);
    let at = slower.evaluate(v, closed(theta, 0.04 / ratio), 1.1, v.x);
    for (a, b) in [(off.thrust, at.thrust), (off.power, at.power)] {
        assert!((a / b - 1.0).abs() < 1e-13, "{a} {b}");
    }
    assert!((off.lambda_i_dot / (ratio * at.lambda_i_dot) - 1.0).abs() < 1e-12);
}

/// Inflow state at rest for a velocity and a pitch.
fn steady_inflow(v: V, theta: f64, rho: f64) -> f64 {
    let t = tail_rotor();
    let mut x = 0.05;
    for _ in 0..50 {
        let l = t.evaluate(
            Vec3::cst(v.array()),
            closed(Dual::<1>::cst(theta), Dual::<1>::variable(x, 0)),
            rho,
            Dual::<1>::cst(v.x),
        );
        x -= l.lambda_i_dot.re / l.lambda_i_dot.eps[0];
    }
    x
}

#[test]
fn tail_rotor_at_rest_obeys_momentum_theory_and_pushes_right_and_up() {
    let (t, rho) = (tail_rotor(), 1.225);
    let theta = 20f64.to_radians();
    let x = steady_inflow(V::zero(), theta, rho);
    let l = t.evaluate(V::zero(), closed(theta, x), rho, 0.0);
    let unit = rho * std::f64::consts::PI * t.radius.powi(2) * (t.omega * t.radius).powi(2);
    let ct = l.thrust / 0.9 / unit;
    assert!((ct - 2.0 * x * x).abs() < 1e-9);
    assert!(l.force.y > 0.0 && l.force.z < 0.0 && l.force.x == 0.0);
    assert!((l.force.z / l.force.y + t.cant.tan()).abs() < 1e-12);
    // the closed form, with the coning put back in by hand
    let b: f64 = t.tip_loss_factor;
    let pitch = theta + t.pitch_bias - t.pitch_per_thrust * ct * unit;
    let loading = pitch * b.powi(3) / 3.0 + t.twist * b.powi(4) / 4.0 - x * b * b / 2.0;
    assert!((ct - 0.5 * t.lift_curve_slope * t.solidity * loading).abs() < 1e-12);
    // induced plus profile power
    let alpha = 6.0 * ct / (t.lift_curve_slope * t.solidity);
    let cd = 0.0087 - 0.0216 * alpha + 0.4 * alpha * alpha;
    let cp = x * ct + t.solidity * cd / 8.0;
    assert!((l.power / (unit * t.omega * t.radius) - cp).abs() < 1e-12);
}

#[test]
fn tail_rotor_thrust_falls_when_it_moves_along_its_thrust() {
    let t = tail_rotor();
    let at = |v: V| t.evaluate(v, closed(0.3, 0.04), 1.2, v.x).thrust;
    // to the right and up is along the thrust
    assert!(at(V::new(0.0, 5.0, 0.0)) < at(V::zero()));
    assert!(at(V::new(0.0, 0.0, -5.0)) < at(V::zero()));
    // yaw to the right (nose right, tail left) raises it: damping
    assert!(at(V::new(0.0, -5.0, 0.0)) > at(V::zero()));
    // fin blockage 0.9 at rest, none from 30 kt
    let ratio = |u: f64| t.evaluate(V::zero(), closed(0.3, 0.04), 1.2, u).thrust;
    assert!((ratio(0.0) / ratio(30.0 * KNOT) - 0.9).abs() < 1e-12);
    assert!((ratio(15.0 * KNOT) / ratio(60.0) - 0.925).abs() < 1e-12);
}

#[test]
fn tail_rotor_derivatives_equal_central_differences_and_are_finite_at_rest() {
    fn evaluate<S: Real>(x: [S; 7]) -> [S; 5] {
        let state = ClosedFormState { theta: x[3], inflow: x[4], speed_ratio: x[6] };
        let l = tail_rotor().evaluate(Vec3::new(x[0], x[1], x[2]), state, 1.1, x[5]);
        [l.force.y, l.force.z, l.thrust, l.power, l.lambda_i_dot]
    }
    for x in [[40.0, 2.0, -3.0, 0.25, 0.02, 12.0, 0.93], [1.0, -4.0, 3.0, 0.3, 0.05, 3.0, 1.04]] {
        assert_derivatives(x, evaluate(variables(x)), 1e5, evaluate);
    }
    for s in evaluate(variables([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])) {
        assert!(s.re.is_finite() && s.eps.iter().all(|e| e.is_finite()));
    }
}

/// A fuselage with the symmetric part of the tables: mirrored flow gives mirrored loads.
#[test]
fn a_symmetric_fuselage_in_mirrored_flow_has_mirrored_loads() {
    let mut f = fuselage();
    let symmetric = |g: &mut wakeflight::numerics::tables::Grid, sign: f64| {
        for row in &mut g.values {
            let n = row.len();
            *row = (0..n).map(|j| 0.5 * (row[j] + sign * row[n - 1 - j])).collect();
        }
    };
    for g in [&mut f.drag, &mut f.lift, &mut f.pitching] {
        symmetric(g, 1.0);
    }
    for g in [&mut f.side, &mut f.rolling, &mut f.yawing] {
        symmetric(g, -1.0);
    }
    let (a, b) = (f.loads(V::new(30.0, 7.0, -4.0), 1.2), f.loads(V::new(30.0, -7.0, -4.0), 1.2));
    for (x, y) in [
        (a.force.x, b.force.x),
        (a.force.y, -b.force.y),
        (a.force.z, b.force.z),
        (a.moment.x, -b.moment.x),
        (a.moment.y, b.moment.y),
        (a.moment.z, -b.moment.z),
        (a.beta, -b.beta),
    ] {
        assert!((x - y).abs() < 1e-9);
    }
}
