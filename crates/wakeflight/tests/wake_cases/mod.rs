//! Rotors of the free-wake tests: four blades, uniform circulation, no near wake, no flap.
#![allow(dead_code)]

use std::f64::consts::{PI, TAU};
use wakeflight::wake::{
    BladeState, Evaluation, HubMotion, MarchingOptions, RelaxationOptions, RelaxationWake, TimeMarchingWake,
    WakeOptions,
};

pub const RADIUS: f64 = 8.0;
pub const OMEGA: f64 = 27.0;
pub const CUTOUT: f64 = 0.2;

/// Options of marching with a field of the predicted and of the corrected wake in every step.
pub fn two_fields() -> MarchingOptions {
    MarchingOptions { evaluation: Evaluation::Pece, ..MarchingOptions::default() }
}

pub fn options() -> WakeOptions {
    WakeOptions {
        n_stations: 12,
        near_wake_angle: 0.0,
        ..WakeOptions::new(4, RADIUS, CUTOUT * RADIUS, 0.0, 0.065 * RADIUS, OMEGA)
    }
}

/// Hover: five turns and a far wake.
pub fn hover_options() -> WakeOptions {
    WakeOptions { turns: 5.0, far_wake_turns: 2, ..options() }
}

/// Uniform circulation of a thrust coefficient: 2 pi C_T omega R^2 / (n_blades (1 - cutout^2)).
pub fn uniform_circulation(options: &WakeOptions, ct: f64) -> f64 {
    TAU * ct * OMEGA * RADIUS * RADIUS / (options.rotor.n_blades as f64 * (1.0 - CUTOUT * CUTOUT))
}

/// Hub velocity from the advance ratio and the descent, rates p, q, r (nose frame: x forward, y right, z down) over omega.
pub fn hub(mu: f64, descent: f64, p: f64, q: f64, r: f64) -> HubMotion {
    HubMotion {
        velocity: [-mu * OMEGA * RADIUS, 0.0, -descent * OMEGA * RADIUS],
        rates: [-p * OMEGA, q * OMEGA, -r * OMEGA],
    }
}

/// Share of a new geometry taken in a sweep: less where turns are repeated.
pub fn own(options: &WakeOptions) -> RelaxationOptions {
    let relaxation = if options.far_wake_turns > 0 { 0.3 } else { 0.5 };
    RelaxationOptions { relaxation, ..RelaxationOptions::default() }
}

pub fn relaxation(options: &WakeOptions, hub: HubMotion, ct: f64, mean_inflow: f64) -> RelaxationWake {
    let n = options.steps_per_revolution();
    let mut wake = RelaxationWake::new(*options, own(options), hub, mean_inflow).unwrap();
    let gamma = uniform_circulation(options, ct);
    wake.set_state(hub, &vec![(0.0, 0.0); n], &vec![gamma; n * options.n_stations]).unwrap();
    wake
}

/// Sweeps until the RMS change of all markers is below `tolerance`; returns the number of sweeps.
pub fn settle(wake: &mut RelaxationWake, tolerance: f64, most: usize) -> usize {
    for n in 1..=most {
        let norm = wake.sweep(1).unwrap()[0];
        if norm.all < tolerance {
            return n;
        }
    }
    panic!("relaxation did not settle to {tolerance} in {most} sweeps");
}

pub fn blades(options: &WakeOptions, step: usize) -> Vec<BladeState> {
    (0..options.rotor.n_blades)
        .map(|b| BladeState {
            psi: TAU
                * (step as f64 / options.steps_per_revolution() as f64
                    + b as f64 / options.rotor.n_blades as f64),
            ..Default::default()
        })
        .collect()
}

/// One revolution; `start` is the step count so far. Returns the inflow map (n_azimuths, n_stations) of blade 1 and the
/// largest odd-even monitor.
pub fn revolution(wake: &mut TimeMarchingWake, hub: HubMotion, ct: f64, start: usize) -> (Vec<f64>, f64) {
    let options = *wake.options();
    let (n, n_r) = (options.steps_per_revolution(), options.n_stations);
    let circulation = vec![uniform_circulation(&options, ct); options.rotor.n_blades * n_r];
    let mut map = vec![0.0; n * n_r];
    let mut odd_even: f64 = 0.0;
    for step in start + 1..=start + n {
        let report = wake.step(hub, &blades(&options, step), &circulation).unwrap();
        odd_even = odd_even.max(report.odd_even);
        let inflow = wake.inflow_far();
        map[(step % n) * n_r..(step % n + 1) * n_r].copy_from_slice(&inflow[..n_r]);
    }
    (map, odd_even)
}

/// Area mean and first harmonics of an inflow map (n_azimuths, n_stations): lambda_0, lambda_1c, lambda_1s.
pub fn harmonics(wake_grid: &wakeflight::wake::geometry::BladeGrid, map: &[f64]) -> [f64; 3] {
    let n_r = wake_grid.stations.len();
    let n = map.len() / n_r;
    let (mut sums, mut weights) = ([0.0; 3], [0.0; 2]);
    for (l, row) in map.chunks_exact(n_r).enumerate() {
        let psi = TAU * l as f64 / n as f64;
        for (j, lambda) in row.iter().enumerate() {
            let r = wake_grid.stations[j] / RADIUS;
            let area = r * (wake_grid.edges[j + 1] - wake_grid.edges[j]) / RADIUS;
            sums[0] += lambda * area;
            sums[1] += lambda * r * psi.cos() * area;
            sums[2] += lambda * r * psi.sin() * area;
            weights[0] += area;
            weights[1] += r * r * psi.cos().powi(2) * area;
        }
    }
    [sums[0] / weights[0], sums[1] / weights[1], sums[2] / weights[1]]
}

/// Area-weighted RMS of a map.
pub fn disk_rms(grid: &wakeflight::wake::geometry::BladeGrid, map: &[f64]) -> f64 {
    let squares: Vec<f64> = map.iter().map(|v| v * v).collect();
    harmonics(grid, &squares)[0].sqrt()
}

pub fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

/// RMS distance of markers over R.
pub fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(p, q)| (0..3).map(|c| (p[c] - q[c]).powi(2)).sum::<f64>()).sum();
    (sum / a.len() as f64).sqrt() / RADIUS
}

/// Mean induced inflow of momentum theory by fixed-point iteration; `climb` is the inflow of the wind.
pub fn momentum_inflow(ct: f64, mu: f64, climb: f64) -> f64 {
    let mut inflow = (0.5 * ct).sqrt();
    for _ in 0..200 {
        inflow = 0.5 * (inflow + 0.5 * ct / mu.hypot(climb + inflow));
    }
    inflow
}

pub const HALF_TURN: f64 = PI;
