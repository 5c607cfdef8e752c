//! Full-span wake: closed vorticity, the limits of a wing and of an oscillating section, momentum, order, symmetry.

#[path = "wake_cases/full_span.rs"]
mod full_span_cases;
mod wake_cases;
use full_span_cases::*;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use wake_cases::*;
use wakeflight::vortex::threads::set_threads;
use wakeflight::wake::geometry::BladeGrid;
use wakeflight::wake::instant::RotorInstant;
use wakeflight::wake::velocity_field::{VortexSegments, point_velocity};
use wakeflight::wake::{
    BladeState, MarchingOptions, Prescribed, RelaxationOptions, RelaxationWake, Scheme, ShedWake, Summation,
    TimeMarchingWake, Trailers, WakeOptions, WakeRotor,
};

#[test]
fn verif_no_vorticity_ends_in_the_fluid() {
    for n_trailers in [0, 5] {
        let options = WakeOptions { n_trailers, turns: 1.0, near_wake_angle: TAU / 9.0, ..full_span() };
        let (wake, n_k, n_t) = (unsteady_wake(&options), options.n_segments(), options.trailers_per_blade());
        let free = &wake.instant().free;
        let at = |nodes: &HashMap<[u64; 3], f64>, i: usize, k: usize| {
            nodes.get(&free.position[free.marker(i, k)].map(f64::to_bits)).copied().unwrap_or(0.0)
        };
        let everything = divergence(wake.instant(), &options, None);
        let ends: f64 = (0..free.n_filaments).map(|i| at(&everything, i, n_k).abs()).sum();
        let all: f64 = everything.values().map(|v| v.abs()).sum();
        // only the old ends are open
        assert!(ends > 1.0 && (all - ends).abs() < 1e-11 * all, "{all} {ends}");
        // a blade sees its near wake, one ring of the present circulation, continued by the lattice
        let own = divergence(wake.instant(), &options, Some(0));
        for i in 0..n_t {
            let arrives = free.circulation[free.marker(i, 0)];
            assert!((at(&own, i, options.near_wake_markers()) - arrives).abs() < 1e-12);
            for k in options.near_wake_markers() + 1..n_k {
                assert!(at(&own, i, k).abs() < 1e-12, "trailer {i} marker {k}");
            }
        }
        // what trails is zero in total at every birth
        for k in 0..=n_k {
            let total: f64 = (0..n_t).map(|i| free.circulation[free.marker(i, k)]).sum();
            assert!(total.abs() < 1e-12);
        }
    }
}

#[test]
fn verif_uniform_circulation_leaves_a_tip_and_a_root_filament() {
    // steady and uniform: the lattice is the tip vortex and a root filament of the opposite strength, whatever lies between
    type Nothing = Prescribed<fn([f64; 3]) -> [f64; 3]>;
    let nothing: fn([f64; 3]) -> [f64; 3] = |_| [0.0; 3];
    let hub = hub(0.15, -0.03, 0.0, 0.0, 0.0);
    let points: Vec<[f64; 3]> =
        (0..30).map(|i| [7.0 * (2.1 * i as f64).cos(), 0.25 * i as f64, -0.6 + 0.03 * i as f64]).collect();
    let field = |options: &WakeOptions| {
        let n = options.steps_per_revolution();
        let mut wake: RelaxationWake<Nothing> =
            RelaxationWake::with_field(*options, own(options), hub, 0.0, Prescribed(nothing)).unwrap();
        wake.set_state(hub, &vec![(0.04, 0.0); n], &vec![12.0; n * options.n_stations]).unwrap();
        wake.sweep(1).unwrap();
        point_velocity(&VortexSegments::new(options), options, &wake.instant(5), &points)
    };
    let base = WakeOptions { trailer_core: Some(0.02), core_radius: 0.02, ..full_span() };
    let reference = {
        let tip = field(&WakeOptions { trailers: Trailers::Tip, ..base });
        // the root filament as the tip vortex of a blade that ends there, without the bound vortex
        let stub_rotor =
            WakeRotor { radius: CUTOUT * RADIUS, root_cutout: 0.5 * CUTOUT * RADIUS, ..base.rotor };
        let stub = WakeOptions { rotor: stub_rotor, ..base };
        let scale = RADIUS / stub.rotor.radius;
        let stub = WakeOptions {
            trailers: Trailers::Tip,
            core_radius: stub.core_radius * scale,
            core_growth: stub.core_growth * scale * scale,
            bound_core: stub.bound_core,
            ..stub
        };
        let mut root = field(&stub);
        let bound = |options: &WakeOptions| {
            let grid = BladeGrid::new(options);
            let mut instant = RotorInstant::new(options, &grid);
            for (b, psi) in [5.0 / 18.0 * TAU, 14.0 / 18.0 * TAU].into_iter().enumerate() {
                let blade = BladeState { psi, flap: 0.04, lead: 0.0 };
                instant.place_blade(options, &grid, b, &blade, &vec![12.0; options.n_stations]);
            }
            point_velocity(&VortexSegments::new(options), options, &instant, &points)
        };
        for (v, b) in root.iter_mut().zip(bound(&stub)) {
            (0..3).for_each(|c| v[c] -= b[c]);
        }
        tip.iter().zip(&root).map(|(t, r)| std::array::from_fn(|c| t[c] - r[c])).collect::<Vec<[f64; 3]>>()
    };
    for n_trailers in [2, 8, 15] {
        let found = field(&WakeOptions { n_trailers, ..base });
        for (a, b) in found.iter().zip(&reference) {
            for c in 0..3 {
                assert!((a[c] - b[c]).abs() < 1e-11, "{n_trailers}: {a:?} {b:?}");
            }
        }
    }
}

/// Lift slope and Gamma/(b V alpha) in the middle of a rectangular wing of `n` elements, Gamma = pi c V (alpha - w/V).
fn rectangular_wing(aspect: f64, n: usize) -> [f64; 2] {
    let options = WakeOptions {
        n_stations: n,
        trailers: Trailers::FullSpan,
        near_wake_angle: 0.0,
        azimuth_step: TAU / 60.0,
        turns: 1.0,
        trailer_core: Some(0.0),
        core_radius: 0.0,
        core_growth: 0.0,
        station_core_floor: 0.0,
        ..WakeOptions::new(1, aspect, 0.0, 0.0, 1.0, 1.0)
    };
    let (grid, speed) = (BladeGrid::new(&options), options.tip_speed());
    let mut instant = straight(&options, |k| aspect * 0.05 * (1.12f64.powi(k as i32) - 1.0));
    let mut system = nalgebra::DMatrix::identity(n, n);
    for j in 0..n {
        shed_history(&mut instant, &options, |_| (0..n).map(|i| f64::from(i == j)).collect());
        let inflow = station_inflow(&options, &instant);
        for i in 0..n {
            system[(i, j)] += PI * inflow[i] * speed;
        }
    }
    let gamma = system.lu().solve(&nalgebra::DVector::from_element(n, PI * speed)).unwrap();
    let lift: f64 = gamma.iter().zip(grid.edges.windows(2)).map(|(g, e)| g * (e[1] - e[0])).sum();
    let off = |i: &usize| (grid.stations[*i] - 0.5 * aspect).abs();
    let centre = (0..n).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    [2.0 * lift / (speed * aspect), gamma[centre] / (aspect * speed)]
}

#[test]
fn verif_a_straight_lattice_is_prandtls_lifting_line() {
    // rectangular wings with a0 = 2 pi: slope and circulation in the middle [L01]. The elements narrow toward one end only:
    // the slope is of first order, and right in the limit
    for (aspect, slope, middle) in [(6.0, 4.53042499, 0.4319582), (10.0, 5.04679085, 0.2804661)] {
        let (coarse, fine) = (rectangular_wing(aspect, 30), rectangular_wing(aspect, 60));
        let limit = 2.0 * fine[0] - coarse[0];
        println!(
            "A = {aspect}: slope {coarse:?} {fine:?} -> {limit} of {slope}, middle {} of {middle}",
            fine[1]
        );
        assert!((fine[0] / slope - 1.0).abs() < 0.015 && (limit / slope - 1.0).abs() < 0.003);
        assert!((fine[1] / middle - 1.0).abs() < 0.005);
    }
}

/// 1/(1 + pi H) for a complex H.
fn lift_deficiency(h: [f64; 2]) -> [f64; 2] {
    let (a, b) = (1.0 + PI * h[0], PI * h[1]);
    [a / (a * a + b * b), -b / (a * a + b * b)]
}

#[test]
fn verif_shed_vortices_bring_the_lift_deficiency_of_theodorsen() {
    // Strip of a long blade with Gamma = Gamma_qs - pi c w, w = H Gamma: C = Gamma/Gamma_qs = 1/(1 + pi c H).
    // Vortices of strength (G_(j-1) - G_(j+1))/2 at the distances j D, D steps of travel, G_j = exp(-i a j), a = 2 k D/c:
    // 2 pi D H = i sin a sum exp(-i a j)/j, the sum from 1 being -ln(1 - exp(-i a)). Gathered over m steps: the sum
    // from m + 1, and (1 - (G_m + G_(m+1))/2)/m.
    let (step, near) = (2.0, 3usize);
    let expected = |shed: ShedWake, k: f64| {
        let a = 2.0 * k * step;
        let turned = |j: usize| [(a * j as f64).cos(), -(a * j as f64).sin()];
        // -ln(1 - exp(-i a)) = -ln(2 sin(a/2)) - i (pi - a)/2
        let mut sum = [-(2.0 * (0.5 * a).sin()).ln(), -0.5 * (PI - a)];
        let mut h = [0.0; 2];
        if shed == ShedWake::Beyond {
            for j in 1..=near {
                (0..2).for_each(|c| sum[c] -= turned(j)[c] / j as f64);
            }
            let (here, next) = (turned(near), turned(near + 1));
            h = [1.0 - 0.5 * (here[0] + next[0]), -0.5 * (here[1] + next[1])].map(|v| v / near as f64);
        }
        h = [h[0] - a.sin() * sum[1], h[1] + a.sin() * sum[0]].map(|v| v / (TAU * step));
        lift_deficiency(h)
    };
    let case = |shed: ShedWake, k: f64, full_angle: f64| {
        let n_k = 360;
        let options = WakeOptions {
            n_stations: 9,
            n_trailers: 2,
            trailers: Trailers::FullSpan,
            shed_wake: shed,
            azimuth_step: TAU / n_k as f64,
            turns: 1.0,
            near_wake_angle: full_angle * near as f64,
            trailer_core: Some(0.0),
            core_radius: 0.0,
            core_growth: 0.0,
            station_core_floor: 0.0,
            ..WakeOptions::new(1, 20_000.0, 0.0, 0.0, 1.0, 1.0)
        };
        let mut instant = straight(&options, |j| step * j as f64);
        let mut downwash = [0.0; 2];
        for (part, w) in downwash.iter_mut().enumerate() {
            shed_history(&mut instant, &options, |j| {
                // 2 k per chord travelled; faded out over the last half of the wake
                let (phase, fade) =
                    (-2.0 * k * step * j as f64, (2.0 * j as f64 / n_k as f64 - 1.0).max(0.0));
                let strength =
                    (0.5 * PI * fade).cos().powi(2) * if part == 0 { phase.cos() } else { phase.sin() };
                vec![strength; 9]
            });
            let inflow = station_inflow(&options, &instant);
            *w = inflow[3] * options.tip_speed();
        }
        lift_deficiency(downwash)
    };
    let angle = TAU / 360.0;
    for (k, exact) in [(0.01, [0.982421502833, -0.0456520927493]), (0.05, [0.909008997477, -0.130644389694])]
    {
        for shed in [ShedWake::All, ShedWake::Beyond] {
            let (found, sum) = (case(shed, k, angle), expected(shed, k));
            println!("{shed:?} k = {k}: C = {found:?}, sum {sum:?}, Theodorsen {exact:?}");
            for i in 0..2 {
                assert!((found[i] - sum[i]).abs() < 0.02 * k, "{shed:?} {k}: {found:?} {sum:?}");
            }
            // loss of lift and lag are there in part: the sheet nearer than about a step is left out
            assert!((1.0 - found[0]) / (1.0 - exact[0]) > 0.6 && found[0] > exact[0]);
            assert!((0.3..0.75).contains(&(found[1] / exact[1])));
        }
        let none = case(ShedWake::None, k, angle);
        assert!((none[0] - 1.0).abs() < 1e-3 && none[1].abs() < 1e-3, "{none:?}");
    }
}

/// Mean induced inflow of the whole disk, of points between the blades over a revolution.
///
/// At the blades themselves it is larger: the momentum balance knows no blades.
fn disk_inflow(wake: &RelaxationWake) -> f64 {
    let options = wake.options();
    let (rings, spokes) = (12, 24);
    // equal areas
    let points: Vec<[f64; 3]> = (0..rings * spokes)
        .map(|i| {
            let r = RADIUS * (((i / spokes) as f64 + 0.5) / rings as f64).sqrt();
            let psi = TAU * ((i % spokes) as f64 + 0.5) / spokes as f64;
            [r * psi.cos(), r * psi.sin(), 0.0]
        })
        .collect();
    let instants = options.steps_per_revolution() / options.rotor.n_blades;
    let sum: f64 =
        (0..instants).flat_map(|l| wake.wake_velocity(&points, l)).map(|v| -v[2] / options.tip_speed()).sum();
    sum / (instants * points.len()) as f64
}

#[test]
fn verif_hover_inflow_obeys_momentum_and_blades_are_alike() {
    let options = WakeOptions { turns: 2.0, far_wake_turns: 6, n_trailers: 5, ..full_span() };
    let mut wake = loaded(&options, hub(0.0, 0.0, 0.0, 0.0, 0.0), (0.5 * CT).sqrt());
    let norms = wake.sweep(30).unwrap();
    let map = wake.inflow_far();
    // momentum ring by ring, 4 lambda^2 r dr = dC_T: with this loading the mean is less than sqrt(C_T/2)
    let (grid, gamma) = (wake.grid(), rounded_circulation(&options, CT));
    let rings: f64 = gamma
        .iter()
        .zip(grid.edges.windows(2))
        .map(|(g, e)| {
            let inflow = (options.rotor.n_blades as f64 * g / (4.0 * PI * OMEGA)).sqrt() / RADIUS;
            inflow * (e[1] * e[1] - e[0] * e[0]) / (RADIUS * RADIUS)
        })
        .sum();
    let (uniform, at_blades, inflow) = ((0.5 * CT).sqrt(), harmonics(grid, &map)[0], disk_inflow(&wake));
    println!(
        "{:?}: inflow {inflow} (at blades {at_blades}), by rings {rings}, sqrt(C_T/2) {uniform}",
        norms[29]
    );
    assert!((inflow / rings - 1.0).abs() < 0.10);
    assert!((at_blades / uniform - 1.0).abs() < 0.10);
    let (n_k, n_t) = (options.n_segments() + 1, options.trailers_per_blade());
    let row = n_k * n_t;
    let mut largest: f64 = 0.0;
    for l in 0..18 {
        let (sin, cos) = (TAU * l as f64 / 18.0).sin_cos();
        for i in 0..row {
            let (p, q) = (wake.position()[i], wake.position()[l * row + i]);
            let turned = [p[0] * cos - p[1] * sin, p[0] * sin + p[1] * cos, p[2]];
            largest = (0..3).fold(largest, |m, c| m.max((turned[c] - q[c]).abs() / RADIUS));
        }
    }
    println!("largest difference of blades {largest} R");
    assert!(largest < 1e-9);
}

#[test]
fn verif_level_flight_obeys_momentum_and_leans_aft() {
    let (mu, climb) = (0.185, 0.0);
    let options = full_span();
    let hub = hub(mu, -climb, 0.0, 0.0, 0.0);
    let momentum = momentum_inflow(CT, mu, climb);
    let mut start = loaded(&options, hub, momentum);
    let sweeps = settle(&mut start, 1e-5, 120);
    let reference = start.inflow_far();
    let [mean, cosine, sine] = harmonics(start.grid(), &reference);
    let coleman = (0.5 * (mu / (momentum + climb)).atan()).tan();
    let pitt = 15.0 * PI / 32.0 * coleman;
    let over_disk = disk_inflow(&start);
    println!(
        "{sweeps} sweeps: lambda_0 {over_disk} of {momentum}, at blades {mean}, k_x {} (Coleman {coleman}, Pitt-Peters {pitt}), k_y {}",
        cosine / mean,
        sine / mean
    );
    assert!((over_disk / momentum - 1.0).abs() < 0.10);
    assert!((coleman..1.3 * pitt).contains(&(cosine / mean)));
}

#[test]
fn verif_central_marching_settles_on_the_relaxed_lattice() {
    // One predictor and one corrector in a step: the two steady states differ by what the predictor is off. In a climb; in
    // level flight the root trailers pass the next blade within a step, and that is 2 % of the mean inflow
    let settled = |steps: usize| {
        let options = WakeOptions {
            azimuth_step: TAU / steps as f64,
            turns: 1.0,
            n_trailers: 5,
            trailer_core: Some(0.06),
            core_radius: 0.06,
            ..full_span()
        };
        let hub = hub(0.185, -0.1, 0.0, 0.0, 0.0);
        let mut start = loaded(&options, hub, 0.016);
        settle(&mut start, 1e-6, 120);
        let reference = start.inflow_far();
        let central = MarchingOptions { scheme: Scheme::Pcc, ..two_fields() };
        let mut wake = TimeMarchingWake::from_relaxation(&start, 0, central).unwrap();
        let circulation = rounded_circulation(&options, CT).repeat(2);
        let n_r = options.n_stations;
        let mut map = vec![0.0; steps * n_r];
        for step in 1..=3 * steps {
            wake.step(hub, &blades(&options, step), &circulation).unwrap();
            map[(step % steps) * n_r..(step % steps + 1) * n_r].copy_from_slice(&wake.inflow_far()[..n_r]);
        }
        disk_rms(start.grid(), &difference(&map, &reference)) / harmonics(start.grid(), &reference)[0]
    };
    let (coarse, fine) = (settled(18), settled(36));
    println!("disk RMS of the difference over the mean: {coarse} at 20 deg, {fine} at 10 deg");
    assert!(fine < 0.002 && coarse < 0.002);
}

#[test]
fn verif_every_trailer_is_second_order() {
    // steady field: a marker of age zeta is where its release point went in the time zeta/omega
    fn swirl(p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = p.map(|c| c / RADIUS);
        let speed = OMEGA * RADIUS;
        [
            speed * 0.03 * (2.0 * x + y).sin(),
            speed * 0.03 * (2.0 * y - z).cos(),
            speed * (-0.02 * (1.5 * x).cos() - 0.02 * (2.0 * y).sin()),
        ]
    }
    let hub = hub(0.185, -0.015, 0.0, 0.0, 0.0);
    let carried = |p: [f64; 3], angle: f64| {
        let slope = |p: [f64; 3]| {
            let (v, w) = (swirl(p), hub.wind(p));
            std::array::from_fn(|c| (v[c] + w[c]) / OMEGA)
        };
        let n = 200;
        let h = angle / n as f64;
        let ahead = |p: [f64; 3], k: [f64; 3], f: f64| std::array::from_fn(|c| p[c] + f * h * k[c]);
        (0..n).fold(p, |p, _| {
            let k1: [f64; 3] = slope(p);
            let k2: [f64; 3] = slope(ahead(p, k1, 0.5));
            let k3: [f64; 3] = slope(ahead(p, k2, 0.5));
            let k4: [f64; 3] = slope(ahead(p, k3, 1.0));
            std::array::from_fn(|c| p[c] + h / 6.0 * (k1[c] + 2.0 * k2[c] + 2.0 * k3[c] + k4[c]))
        })
    };
    let error = |scheme: Option<Scheme>, steps: usize| {
        let options =
            WakeOptions { azimuth_step: TAU / steps as f64, turns: 2.0, n_trailers: 3, ..full_span() };
        let whole = RelaxationOptions { relaxation: 1.0, ..RelaxationOptions::default() };
        let own = MarchingOptions { scheme: scheme.unwrap_or(Scheme::Bdf2), ..two_fields() };
        let none = vec![0.0; steps * options.n_stations];
        let field: fn([f64; 3]) -> [f64; 3] = swirl;
        let mut start = RelaxationWake::with_field(options, whole, hub, 0.01, Prescribed(field)).unwrap();
        start.set_state(hub, &vec![(0.0, 0.0); steps], &none).unwrap();
        start.sweep(60).unwrap();
        let mut wake = TimeMarchingWake::from_relaxation(&start, 0, own).unwrap();
        if scheme.is_some() {
            for step in 1..=4 * steps {
                wake.step(hub, &blades(&options, step), &none[..2 * options.n_stations]).unwrap();
            }
        }
        let (grid, n_k) = (BladeGrid::new(&options), options.n_segments());
        let mut sums = [0.0; 3];
        for (i, found) in wake.position().iter().enumerate() {
            let (t, k) = (i / (n_k + 1), i % (n_k + 1));
            let zeta = k as f64 * options.delta_psi();
            let psi = PI * (t / 3) as f64 - zeta;
            let r = grid.edges[grid.trailer_edges[t % 3]];
            let exact = carried([r * psi.cos(), r * psi.sin(), 0.0], zeta);
            sums[t % 3] += (0..3).map(|c| (found[c] - exact[c]).powi(2)).sum::<f64>() / (2 * n_k) as f64;
        }
        sums.map(|s| s.sqrt() / RADIUS)
    };
    for (scheme, least) in [(None, 1.9), (Some(Scheme::Pcc), 1.9), (Some(Scheme::Bdf2), 1.5)] {
        let (coarse, fine) = (error(scheme, 36), error(scheme, 72));
        for t in 0..3 {
            let order = (coarse[t] / fine[t]).log2();
            println!("{scheme:?} trailer {t}: {:.2e} {:.2e} R, order {order:.2}", coarse[t], fine[t]);
            assert!(order > least);
        }
    }
}

/// Sheets of parallel segments on whose prolongations the markers lie, with cores wider than the spacing of the trailers.
#[test]
fn verif_the_field_of_a_full_span_wake_by_the_tree_is_within_its_tolerance() {
    let hub = hub(0.1, 0.0, 0.0, 0.0, 0.0);
    let lattice = WakeOptions {
        rotor: options().rotor,
        n_stations: 20,
        n_trailers: 0,
        azimuth_step: TAU / 36.0,
        turns: 4.0,
        trailer_core: Some(0.02),
        core_radius: 0.02,
        ..full_span()
    };
    let field = |summation: Summation, tree_tolerance: f64| {
        let options = WakeOptions { summation, tree_tolerance, ..lattice };
        let wake = TimeMarchingWake::from_relaxation(&loaded(&options, hub, 0.02), 0, two_fields()).unwrap();
        wake.wake_velocity(wake.position())
    };
    let size = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let direct = field(Summation::Direct, 1e-3);
    let largest = direct.iter().map(|v| size(*v)).fold(0.0, f64::max);
    for tolerance in [1e-3, 1e-4] {
        let tree = field(Summation::Tree, tolerance);
        let error = |(a, b): (&[f64; 3], &[f64; 3])| size(std::array::from_fn(|c| a[c] - b[c]));
        let error = tree.iter().zip(&direct).map(error).fold(0.0, f64::max) / largest;
        println!("tolerance {tolerance:.0e}: error {error:.1e}");
        assert!(error < tolerance, "{error} {tolerance}");
    }
}

#[test]
fn verif_marching_by_the_tree_is_marching_by_the_direct_sum_within_its_tolerance() {
    let hub = hub(0.1, 0.0, 0.0, 0.0, 0.0);
    let tolerance = 1e-3;
    let march = |summation: Summation, threads: usize| {
        set_threads(threads).unwrap();
        let options = WakeOptions {
            summation,
            tree_tolerance: tolerance,
            n_stations: 20,
            n_trailers: 16,
            azimuth_step: TAU / 36.0,
            ..full_span()
        };
        let mut wake =
            TimeMarchingWake::from_relaxation(&loaded(&options, hub, 0.03), 0, two_fields()).unwrap();
        for step in 1..=2 {
            wake.step(hub, &blades(&options, step), &[12.0; 40]).unwrap();
        }
        let induced = wake.wake_velocity(wake.position());
        (options, wake.position().to_vec(), induced, wake.segment_evaluations())
    };
    let (options, direct, induced, all) = march(Summation::Direct, 2);
    let (_, tree, _, near) = march(Summation::Tree, 2);
    let (_, one_thread, ..) = march(Summation::Tree, 1);
    let (_, auto, _, chosen) = march(Summation::Auto, 2);
    assert!(tree == one_thread, "the tree's wake depends on the number of threads");
    let largest = induced.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).fold(0.0, f64::max);
    // an error e of the velocity moves a marker by e dt/1.75 in a step, 1/7 of that of the one before it along the filament
    // besides, and 2/1.75 of what the last step did: 0.67 e dt, then 1.6 e dt
    let allowed = 1.6 * tolerance * largest * options.delta_psi() / options.rotor.omega;
    let apart = |a: &[[f64; 3]]| {
        let gap = |(p, q): (&[f64; 3], &[f64; 3])| (0..3).map(|c| (p[c] - q[c]).powi(2)).sum::<f64>().sqrt();
        a.iter().zip(&direct).map(gap).fold(0.0, f64::max)
    };
    println!(
        "apart {:.1e}, allowed {allowed:.1e}; evaluations {all}, tree {near}, auto {chosen}",
        apart(&tree)
    );
    assert!(apart(&tree) > 0.0 && apart(&tree) < allowed, "{} {allowed}", apart(&tree));
    assert!(near < all / 2);
    // nine thousand segments at over three thousand markers: enough for the tree to be chosen
    assert!(chosen == near && auto == tree);
}
