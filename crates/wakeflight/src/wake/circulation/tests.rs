use super::*;
use crate::wake::motion::{BladeState, HubMotion};
use crate::wake::near_wake::near_wake_matrix;
use crate::wake::options::WakeOptions;

fn rotor() -> (WakeOptions, Vec<f64>) {
    let options = WakeOptions::new(4, 8.0, 1.5, 0.4, 0.5, 27.0);
    let matrix = near_wake_matrix(&options, &HubMotion::default(), &BladeState::default()).unwrap();
    (options, matrix)
}

#[test]
fn thin_sections_are_solved_in_one_step() {
    // Gamma = k (alpha0 - lambda): linear, (1 + k N) Gamma = k (alpha0 - lambda_far)
    let (options, matrix) = rotor();
    let n = options.n_stations;
    let slope = 2.9 * options.rotor.chord * options.tip_speed();
    let far = vec![0.05; n];
    let section = |lambda: &[f64], gamma: &mut [f64], derivative: &mut [f64]| {
        for i in 0..n {
            gamma[i] = slope * (0.12 - lambda[i]);
            derivative[i] = -slope;
        }
    };
    let floor = vec![-3.0 * options.rotor.chord * options.tip_speed(); n];
    let solution = solve_circulation(&far, &matrix, section, &vec![0.0; n], &floor, 1e-9).unwrap();
    assert!(solution.converged() && solution.iterations <= 2, "{solution:?}");
    for i in 0..n {
        let near: f64 = (0..n).map(|j| matrix[i * n + j] * solution.gamma[j]).sum();
        assert!((solution.gamma[i] - slope * (0.12 - 0.05 - near)).abs() < 1e-8);
        assert!((solution.inflow[i] - 0.05 - near).abs() < 1e-12);
    }
    // free edges: less circulation toward tip and root than in the middle
    let crest = solution.gamma.iter().fold(0.0f64, |m, g| m.max(*g));
    assert!(solution.gamma[n - 1] < 0.5 * crest && solution.gamma[0] < crest);
}

#[test]
fn stalled_sections_are_solved() {
    // lift that breaks and recovers: slopes of the wrong sign are clipped
    let (options, matrix) = rotor();
    let n = options.n_stations;
    let k = options.rotor.chord * options.tip_speed();
    let lift = |a: f64| 5.7 * 0.5 * a / (1.0 + (a / 0.25).powi(4)).sqrt();
    let section = |lambda: &[f64], gamma: &mut [f64], derivative: &mut [f64]| {
        for i in 0..n {
            let alpha = 0.35 - 0.2 * i as f64 / n as f64 - lambda[i];
            gamma[i] = k * lift(alpha);
            derivative[i] = -k * (lift(alpha + 1e-6) - lift(alpha - 1e-6)) / 2e-6;
        }
    };
    let solution =
        solve_circulation(&vec![0.04; n], &matrix, section, &vec![0.0; n], &vec![-3.0 * k; n], 1e-9).unwrap();
    assert!(solution.converged(), "{} after {}", solution.residual, solution.iterations);
}

/// Lift coefficient and its slope of a section that stalls at 14 deg and is a flat plate beyond, over the whole circle;
/// kinks at every 2 degrees, as a table has them.
fn kinked_lift(alpha: f64) -> (f64, f64) {
    let node = |i: f64| {
        let a: f64 = i * 2f64.to_radians();
        let plate = 1.1 * (2.0 * a).sin();
        let attached = 6.0 * a.sin() * a.cos();
        if a.cos() > 0.0 && a.sin().abs() < 14f64.to_radians().sin() { attached } else { plate }
    };
    let position = alpha.to_degrees() / 2.0;
    let (low, high) = (node(position.floor()), node(position.floor() + 1.0));
    (low + (high - low) * (position - position.floor()), (high - low) / 2f64.to_radians())
}

#[test]
fn every_problem_within_reach_of_a_helicopter_has_a_solution_and_it_is_found() {
    // advance ratios to 0.6, all azimuths, pitch to 40 deg, far inflow of either sign, starts from far away
    let (options, _) = rotor();
    let (n, tip_speed) = (options.n_stations, options.tip_speed());
    let grid = crate::wake::geometry::BladeGrid::new(&options);
    let mut seed = 1u64;
    let mut random = |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (seed >> 11) as f64 / 9_007_199_254_740_992.0
    };
    let mut found = [0; 5];
    for _ in 0..1000 {
        let mu = random(0.0, 0.6);
        let psi = random(0.0, std::f64::consts::TAU);
        let velocity = [-mu * tip_speed, random(-0.05, 0.05) * tip_speed, random(-0.1, 0.1) * tip_speed];
        let hub = HubMotion { velocity, ..HubMotion::default() };
        let state = BladeState { psi, flap: random(-0.1, 0.2), lead: random(-0.1, 0.1) };
        let near = near_wake_matrix(&options, &hub, &state).unwrap();
        let pitch: Vec<f64> = {
            let root = random(-0.3, 0.7);
            grid.stations.iter().map(|r| root - 0.3 * r / options.rotor.radius).collect()
        };
        let far: Vec<f64> = {
            let mean = random(-0.1, 0.1);
            (0..n).map(|_| mean + random(-0.05, 0.05)).collect()
        };
        let along: Vec<f64> =
            grid.stations.iter().map(|r| options.rotor.omega * r + mu * tip_speed * psi.sin()).collect();
        let speed = |i: usize, lambda: f64| (lambda * tip_speed).hypot(along[i]);
        let section = |lambda: &[f64], gamma: &mut [f64], slope: &mut [f64]| {
            for i in 0..n {
                let (up, v) = (-lambda[i] * tip_speed, speed(i, lambda[i]));
                let (cl, by_alpha) = kinked_lift(pitch[i] + up.atan2(along[i]));
                gamma[i] = 0.5 * options.rotor.chord * v * cl;
                slope[i] = -0.5 * options.rotor.chord * tip_speed * (up * cl + along[i] * by_alpha) / v;
            }
        };
        let far_off = random(0.0, 40.0);
        let start: Vec<f64> = (0..n).map(|_| random(-far_off, far_off)).collect();
        let floor = vec![-3.0 * options.rotor.chord * tip_speed; n];
        let solution = solve_circulation(&far, &near, section, &start, &floor, 1e-5).unwrap();
        assert!(solution.converged(), "mu {mu}, psi {}: {}", psi.to_degrees(), solution.residual);
        found[solution.found_by.unwrap() as usize] += 1;
        for i in 0..n {
            // |cl| is nowhere above 1.41
            let most = 0.5 * options.rotor.chord * speed(i, solution.inflow[i]) * 1.41;
            assert!(solution.gamma[i].abs() <= most + 1e-5, "station {i}: {} of {most}", solution.gamma[i]);
        }
    }
    // the problems are hard enough that Newton alone leaves some, and rest alone some of these
    assert!(found[1] > 0 && found[2..].iter().any(|n| *n > 0), "{found:?}");
}

#[test]
fn circulation_that_lags_behind_its_sections_comes_to_rest_at_them() {
    // sections stalled over half the blade, tables with kinks, starts from far away
    let (options, matrix) = rotor();
    let (n, k) = (options.n_stations, options.rotor.chord * options.tip_speed());
    for (root, first) in [(0.1, 0.0), (0.3, 20.0), (0.45, -20.0)] {
        let mut section = |lambda: &[f64], gamma: &mut [f64], slope: &mut [f64]| {
            for i in 0..n {
                let (cl, by_alpha) = kinked_lift(root - 0.2 * i as f64 / n as f64 - lambda[i]);
                (gamma[i], slope[i]) = (0.5 * k * cl, -0.5 * k * by_alpha);
            }
        };
        let (far, floor) = (vec![0.04; n], vec![-3.0 * k; n]);
        let columns = Columns::new(&matrix, n);
        let mut problem = Problem { far: &far, near: &matrix, columns, floor: &floor, section: &mut section };
        let gamma = problem.lagged(&vec![first; n]).unwrap();
        let mut there = Iterate::new(n);
        there.gamma = gamma;
        let (found, _) = problem.settle(there, 1e-7);
        assert!(problem.solved(&found, 1e-7), "{root}: {}", found.residual);
    }
}

#[test]
fn of_several_solutions_the_one_continuous_with_the_start_is_taken() {
    // one station whose lift falls by its own near wake's upwash: Gamma = f(N Gamma) with three solutions
    let lift = |l: f64| (10.0 * l).tanh() + 0.1 * (l - 0.02);
    let section = |lambda: &[f64], gamma: &mut [f64], slope: &mut [f64]| {
        gamma[0] = lift(lambda[0]);
        slope[0] = (lift(lambda[0] + 1e-7) - lift(lambda[0] - 1e-7)) / 2e-7;
    };
    let solved = |start: f64| {
        let found = solve_circulation(&[0.0], &[0.5], section, &[start], &[-1.0], 1e-10).unwrap();
        assert!(found.converged());
        found.gamma[0]
    };
    assert!(solved(0.8) > 0.9 && solved(-0.8) < -0.9);
}

#[test]
fn values_that_are_not_finite_never_travel() {
    let (options, matrix) = rotor();
    let n = options.n_stations;
    let section = |_: &[f64], gamma: &mut [f64], _: &mut [f64]| gamma.fill(f64::NAN);
    let solution =
        solve_circulation(&vec![0.0; n], &matrix, section, &vec![1.0; n], &vec![-1.0; n], 1e-9).unwrap();
    assert!(!solution.converged() && solution.residual.is_infinite());
    assert!(solution.gamma.iter().chain(&solution.inflow).all(|v| v.is_finite()));
    assert!(
        solve_circulation(&vec![f64::NAN; n], &matrix, section, &vec![1.0; n], &vec![-1.0; n], 1e-9).is_err()
    );
}
