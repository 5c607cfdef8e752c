//! Airframe and blades without air or damping: momentum and moment of momentum change by gravity alone, energy by the
//! work of the shaft, -M_z Omega, that holds the rotor speed or changes it.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use nalgebra::{DMatrix, DVector};
use wakeflight::numerics::frames::{Body, Inertial, Vec3, rot_ib};
use wakeflight::numerics::scalar::{Dual, Real};
use wakeflight::system::instant::{HeldInflow, Inputs};
use wakeflight::system::model::System;

type D = Dual<1>;

/// y_dot that makes F vanish.
fn rates(aircraft: &System, inputs: &Inputs, t: f64, y: &[f64]) -> Vec<f64> {
    let n = y.len();
    let zero = vec![0.0; n];
    let (mut f, mut matrix) = (vec![0.0; n], vec![0.0; n * n]);
    aircraft.residual(&at(t, y, &zero, inputs), &mut f);
    aircraft.jacobian(&at(t, y, &zero, inputs), 0.0, 1.0, &mut matrix);
    let solution = DMatrix::from_row_slice(n, n, &matrix).lu().solve(&-DVector::from_vec(f)).unwrap();
    solution.as_slice().to_vec()
}

/// Energy (strain, kinetic, gravity), momentum, moment of momentum about the ground's origin, first moment of mass.
fn invariants(aircraft: &System, t: f64, y: &[f64], y_dot: &[f64], pitch: f64) -> (f64, [[f64; 3]; 3]) {
    let state: Vec<D> = y.iter().zip(y_dot).map(|(&re, &rate)| D { re, eps: [rate] }).collect();
    let body: Matrix3<D> = rot_ib([state[6], state[7], state[8], state[9]]).rows;
    let origin = [state[10], state[11], state[12]];
    let rotor = aircraft.main();
    let hub = add(origin, times(&body, rotor.position.map(D::cst)));
    let hub_attitude = product(&body, &rotor.rot_hb::<D>().transposed().rows);

    // airframe
    let a = &aircraft.carrier.airframe().unwrap().mass;
    let cg = add(origin, times(&body, a.cg.map(D::cst)));
    let (place, velocity) = (cg.map(|x| x.re), cg.map(|x| x.eps[0]));
    let omega = [y[3], y[4], y[5]];
    let spin = times(&a.inertia_cg, omega);
    let mut kinetic = 0.5 * (a.mass * dot(velocity, velocity) + dot(omega, spin));
    let mut momentum = scaled(velocity, a.mass);
    let mut moment = add(cross(place, momentum), times(&body.map(|row| row.map(|x| x.re)), spin));
    let mut first = scaled(place, a.mass);
    let mut strain = 0.0;
    let speed = aircraft.layout.main().spin().map_or(rotor.turning(t, 0.0).omega, |place| y[place.speed]);
    for b in 0..rotor.n_blades {
        let start = aircraft.layout.main().modal(b).start;
        let q: [D; 5] = std::array::from_fn(|i| state[start + i]);
        let psi = D { re: aircraft.azimuth(0, t, y, b), eps: [speed] };
        for p in &rotor.blade.structure {
            let at = section_place(&rotor.blade, p, &q, D::cst(pitch), psi, hub, &hub_attitude);
            let s = section_momentum(p, [0.0; 3], at);
            kinetic += s.kinetic;
            momentum = add(momentum, s.momentum);
            moment = add(moment, s.moment);
            let [r, c, _] = at.map(|v| v.map(|x| x.re));
            first = add(first, add(scaled(r, p.mass), scaled(c, p.first_moment)));
        }
        let mut all = [0.0; wakeflight::blade::MAX_MODES];
        all[..5].copy_from_slice(&q.map(|q| q.re));
        strain += strain_energy(&rotor.blade, &all, pitch).0;
    }
    (kinetic + strain - aircraft.gravity * first[2], [momentum, moment, first])
}

struct Balance {
    energy: f64,
    exchanged: f64,
    momentum: f64,
    moment: f64,
}

/// Errors after one revolution in `n` Runge-Kutta steps.
fn fly(aircraft: &System, n: usize) -> Balance {
    let pitch = 0.3;
    let inputs = inputs([0.0, 0.0, pitch, 0.0], HeldInflow::Vacuum);
    let (mut y, _) = random_state(aircraft, &mut Random::new(11));
    let h = std::f64::consts::TAU / aircraft.main().omega / n as f64;
    let slope = |t: f64, y: &[f64]| {
        let y_dot = rates(aircraft, &inputs, t, y);
        let power = aircraft.outputs(&at(t, y, &y_dot, &inputs)).rotors[0].power;
        (y_dot, power)
    };
    let at = |t: f64, y: &[f64]| invariants(aircraft, t, y, &slope(t, y).0, pitch);
    let (energy, [momentum, moment, first]) = at(0.0, &y);
    let moved =
        |y: &[f64], k: &[f64], h: f64| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + h * k).collect() };
    let (mut work, mut most_work) = (0.0, 0f64);
    for step in 0..n {
        let t = step as f64 * h;
        let (k1, p1) = slope(t, &y);
        let (k2, p2) = slope(t + h / 2.0, &moved(&y, &k1, h / 2.0));
        let (k3, p3) = slope(t + h / 2.0, &moved(&y, &k2, h / 2.0));
        let (k4, p4) = slope(t + h, &moved(&y, &k3, h));
        for i in 0..y.len() {
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        work += h / 6.0 * (p1 + 2.0 * (p2 + p3) + p4);
        most_work = most_work.max(work.abs());
    }
    let t = n as f64 * h;
    let (energy_end, [momentum_end, moment_end, _]) = at(t, &y);
    // gravity: P grows by M g t, the moment by the first moment of mass along the free path
    let mass = aircraft.carrier.airframe().unwrap().gross_mass;
    let weight = [0.0, 0.0, aircraft.gravity];
    let expected_momentum = add(momentum, scaled(weight, mass * t));
    let path = add(scaled(first, t), scaled(momentum, t * t / 2.0));
    let expected_moment = add(moment, cross(path, weight));
    Balance {
        energy: (energy_end - energy - work).abs() / most_work,
        exchanged: most_work,
        momentum: relative_error(&momentum_end, &expected_momentum),
        moment: relative_error(&moment_end, &expected_moment),
    }
}

#[test]
fn momentum_and_energy_are_conserved_in_vacuum() {
    let mut general = uh60a();
    general.precone = 0.05;
    general.structure.x_cg.iter_mut().for_each(|x| *x += 0.015);
    let cases = [
        (uh60a(), 0.0, 1.0, false),
        (general.clone(), 9.80665, 1.0, false),
        (general.clone(), 9.80665, 0.7, false),
        (general, 9.80665, 1.0, true),
    ];
    for (blade, gravity, share, over_ground) in cases {
        let mut aircraft = conservative_aircraft(blade, gravity);
        if share < 1.0 {
            aircraft = changing_speed(aircraft, share, 0.3);
        }
        if over_ground {
            aircraft = aircraft.over_ground();
        }
        let (coarse, fine) = (fly(&aircraft, 180), fly(&aircraft, 360));
        for b in [&coarse, &fine] {
            println!(
                "gravity {gravity}, speed to {share}, over ground {over_ground}: energy {:.1e} of {:.0} J exchanged, momentum {:.1e}, moment {:.1e}",
                b.energy, b.exchanged, b.momentum, b.moment
            );
        }
        assert!(fine.exchanged > 1e3);
        // fourth order: what is left is the integrator's
        assert!(fine.energy < 1e-6 && fine.energy < coarse.energy / 10.0, "{}", fine.energy);
        assert!(fine.momentum < 1e-8 && fine.momentum < coarse.momentum / 10.0, "{}", fine.momentum);
        assert!(fine.moment < 1e-7 && fine.moment < coarse.moment / 10.0, "{}", fine.moment);
    }
}

/// Blades in balance with the centrifugal force, airframe let go.
#[test]
fn free_fall_is_felt_by_no_part() {
    let aircraft = conservative_aircraft(uh60a(), 9.80665);
    let mut weightless = aircraft.clone();
    weightless.gravity = 0.0;
    let inputs = inputs([0.0, 0.0, 0.3, 0.0], HeldInflow::Vacuum);
    let n = aircraft.layout.len();
    let (mut y, _) = random_state(&aircraft, &mut Random::new(12));
    y[..6].fill(0.0);
    let modal: Vec<usize> = (0..4).flat_map(|b| aircraft.layout.main().modal(b)).collect();
    let rate: Vec<usize> = (0..4).flat_map(|b| aircraft.layout.main().modal_rate(b)).collect();
    for i in modal.iter().chain(&rate) {
        y[*i] = 0.0;
    }
    // balance of the modes at rest, by Newton
    let zero = vec![0.0; n];
    let (mut f, mut slopes) = (vec![0.0; n], vec![0.0; n * n]);
    for _ in 0..20 {
        weightless.residual(&at(0.0, &y, &zero, &inputs), &mut f);
        weightless.jacobian(&at(0.0, &y, &zero, &inputs), 1.0, 0.0, &mut slopes);
        let matrix = DMatrix::from_fn(20, 20, |i, j| slopes[rate[i] * n + modal[j]]);
        let step = matrix.lu().solve(&DVector::from_fn(20, |i, _| f[rate[i]])).unwrap();
        for (i, s) in modal.iter().zip(step.iter()) {
            y[*i] -= s;
        }
    }
    let y_dot = rates(&aircraft, &inputs, 0.0, &y);
    let q = [y[6], y[7], y[8], y[9]];
    let down: Vec3<f64, Body> = rot_ib(q).transposed() * Vec3::<f64, Inertial>::new(0.0, 0.0, 9.80665);
    let fall = relative_error(&y_dot[..3], &down.array());
    let turning = y_dot[3..6].iter().fold(0f64, |m, v| m.max(v.abs()));
    let blades = rate.iter().fold(0f64, |m, i| m.max(y_dot[*i].abs()));
    let loads = aircraft.outputs(&at(0.0, &y, &y_dot, &inputs)).rotors.swap_remove(0);
    println!("fall {fall:.1e}, turning {turning:.1e} rad/s2, blades {blades:.1e} m/s2");
    assert!(fall < 1e-12 && turning < 1e-10 && blades < 1e-8);
    assert!(loads.hub_force.iter().all(|f| f.abs() < 1e-6), "{:?}", loads.hub_force);
    // and held up, the blades weigh
    aircraft.residual(&at(0.0, &y, &zero, &inputs), &mut f);
    assert!(rate.iter().any(|i| f[*i].abs() > 1.0));
    let held = aircraft.outputs(&at(0.0, &y, &zero, &inputs)).rotors[0].hub_force;
    let weight = 4.0 * aircraft.main().blade.mass * 9.80665;
    assert!((held.iter().map(|f| f * f).sum::<f64>().sqrt() / weight - 1.0).abs() < 1e-9);
}
