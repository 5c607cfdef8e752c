//! Wakes of the full span that tests begin with.

use crate::wake_cases::*;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use wakeflight::wake::geometry::BladeGrid;
use wakeflight::wake::instant::RotorInstant;
use wakeflight::wake::velocity_field::{FieldWork, VortexSegments, Wanted, field_at};
use wakeflight::wake::{BladeState, RelaxationWake, TimeMarchingWake, Trailers, WakeOptions, WakeRotor};

pub const CT: f64 = 0.006;

/// Inflow at the stations without that of their own near wake (n_blades, n_stations).
pub fn station_inflow(options: &WakeOptions, instant: &RotorInstant) -> Vec<f64> {
    let mut inflow = Vec::new();
    let wanted = Wanted { stations: Some(&mut inflow), ..Wanted::default() };
    field_at(&VortexSegments::new(options), options, instant, &mut FieldWork::default(), wanted);
    inflow
}

/// Two blades, twenty degrees, eight trailers.
pub fn full_span() -> WakeOptions {
    WakeOptions {
        rotor: WakeRotor { n_blades: 2, ..options().rotor },
        trailers: Trailers::FullSpan,
        n_stations: 14,
        n_trailers: 8,
        trailer_core: Some(0.04),
        core_radius: 0.04,
        azimuth_step: TAU / 18.0,
        turns: 3.0,
        ..options()
    }
}

/// Circulation full in the middle and zero at both ends of the blade, of a given thrust coefficient (n_stations) [m2/s].
pub fn rounded_circulation(options: &WakeOptions, ct: f64) -> Vec<f64> {
    let grid = BladeGrid::new(options);
    let (middle, half) = (0.5 * (1.0 + CUTOUT) * RADIUS, 0.5 * (1.0 - CUTOUT) * RADIUS);
    let shape: Vec<f64> = grid.stations.iter().map(|r| 1.0 - ((r - middle) / half).powi(4)).collect();
    // C_T = n_blades / (pi R^2 (omega R)^2) sum of omega r Gamma dr
    let moment: f64 =
        shape.iter().zip(grid.edges.windows(2)).map(|(s, e)| s * 0.5 * (e[1] * e[1] - e[0] * e[0])).sum();
    let scale = ct * PI * RADIUS.powi(4) * OMEGA / (options.rotor.n_blades as f64 * moment);
    shape.iter().map(|s| s * scale).collect()
}

pub fn loaded(options: &WakeOptions, hub: wakeflight::wake::HubMotion, mean_inflow: f64) -> RelaxationWake {
    let n = options.steps_per_revolution();
    let mut wake = RelaxationWake::new(*options, own(options), hub, mean_inflow).unwrap();
    wake.set_state(hub, &vec![(0.0, 0.0); n], &rounded_circulation(options, CT).repeat(n)).unwrap();
    wake
}

/// Circulation that leaves every point minus what arrives there [m2/s].
pub fn divergence(
    instant: &RotorInstant,
    options: &WakeOptions,
    own: Option<usize>,
) -> HashMap<[u64; 3], f64> {
    let segments = instant.segments(options, own);
    let mut nodes = HashMap::new();
    for (i, gamma) in segments.circulation.iter().enumerate() {
        *nodes.entry(segments.start[i].map(f64::to_bits)).or_insert(0.0) += gamma;
        *nodes.entry(segments.end[i].map(f64::to_bits)).or_insert(0.0) -= gamma;
    }
    nodes
}

/// A wake whose circulation changed along the span and from step to step.
pub fn unsteady_wake(options: &WakeOptions) -> TimeMarchingWake {
    let hub = hub(0.15, 0.01, 0.0, 0.0, 0.0);
    let start = loaded(options, hub, 0.03);
    let mut wake = TimeMarchingWake::from_relaxation(&start, 0, two_fields()).unwrap();
    for step in 1..=options.n_segments() + 3 {
        let circulation: Vec<f64> = (0..options.rotor.n_blades * options.n_stations)
            .map(|j| 10.0 + 4.0 * (1.3 * j as f64 + 0.7 * step as f64).sin())
            .collect();
        wake.step(hub, &blades(options, step), &circulation).unwrap();
    }
    wake
}

/// One blade along x from `root` to `tip`, its lattice straight behind it (toward -y) at the distances `behind` [m].
pub fn straight(options: &WakeOptions, behind: impl Fn(usize) -> f64) -> RotorInstant {
    let grid = BladeGrid::new(options);
    let mut instant = RotorInstant::new(options, &grid);
    let none = vec![0.0; options.n_stations];
    instant.place_blade(options, &grid, 0, &BladeState::default(), &none);
    for (t, edge) in grid.trailer_edges.iter().enumerate() {
        for k in 0..=options.n_segments() {
            let m = instant.free.marker(t, k);
            instant.free.position[m] = [grid.edges[*edge], -behind(k), 0.0];
        }
    }
    instant
}

/// Circulation of the markers of every age from that of the stations.
pub fn shed_history(instant: &mut RotorInstant, options: &WakeOptions, gamma: impl Fn(usize) -> Vec<f64>) {
    let grid = BladeGrid::new(options);
    for k in 0..=options.n_segments() {
        let strengths = wakeflight::wake::trailers::strengths(options, &grid, &gamma(k));
        for (t, strength) in strengths.into_iter().enumerate() {
            let m = instant.free.marker(t, k);
            instant.free.circulation[m] = strength;
        }
    }
}
