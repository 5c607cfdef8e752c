//! Nanoseconds per evaluation of the segment sum: 576 markers of four helices at their own segments, one thread.
//!
//! One line each: core distance, core, instruction set, median and best of 51 repetitions [ns]. `textbook` is the plain
//! loop over points and segments of the reference law, measured in turn with the others; `directional` the sum with its
//! derivative along a direction, on the instruction set in use. A name that ends in `-single` is a sum in single precision,
//! which is there for one core.
use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;
use std::time::Instant;
use wakeflight::numerics::instruction_set::InstructionSet;
use wakeflight::vortex::core::{Core, CoreDistance, segment_velocity};
use wakeflight::vortex::directional::{Targets, directional};
use wakeflight::vortex::induced_velocity::{Filaments, add_filaments_velocity_on};
use wakeflight::vortex::single;
use wakeflight::vortex::sources::{Group, Packing, Sources};
use wakeflight::vortex::threads::set_threads;

const CORES: [Core; 6] =
    [Core::Vatistas2, Core::Singular, Core::Scully, Core::Rankine, Core::LambOseen, Core::RosenheadMoore];

/// Median and best time of `task` [s].
fn timed(repetitions: usize, mut task: impl FnMut()) -> (f64, f64) {
    let mut times: Vec<f64> = (0..repetitions)
        .map(|_| {
            let start = Instant::now();
            task();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[repetitions / 2], times[0])
}

/// The textbook loop.
fn textbook(
    points: &[[f64; 3]],
    filaments: &Filaments,
    core: Core,
    distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    for (point, total) in points.iter().zip(velocity) {
        let (mut node, mut segment) = (0, 0);
        for n_nodes in &filaments.n_nodes {
            for k in node..node + n_nodes - 1 {
                let (start, end) = (filaments.nodes[k], filaments.nodes[k + 1]);
                let (circulation, radius) = (filaments.circulation[segment], filaments.core_radius[segment]);
                let v = segment_velocity(*point, start, end, circulation, radius, core, distance);
                for axis in 0..3 {
                    total[axis] += v[axis];
                }
                segment += 1;
            }
            node += n_nodes;
        }
    }
}

fn main() {
    set_threads(1).expect("one thread is allowed");
    let (mut filaments, mut points) = (Filaments::default(), Vec::new());
    for i_blade in 0..4 {
        let nodes: Vec<[f64; 3]> = (0..145)
            .map(|k| {
                let psi = f64::from(i_blade) * FRAC_PI_2 - f64::from(k) * FRAC_PI_2 / 9.0;
                [psi.cos(), psi.sin(), -0.01 * f64::from(k)]
            })
            .collect();
        points.extend_from_slice(&nodes[1..]);
        filaments.push(&nodes, &[1.0; 144], &[0.05; 144]);
    }
    let rates = Filaments {
        nodes: filaments.nodes.iter().map(|p| [p[1], -p[0], 0.1]).collect(),
        ..filaments.clone()
    };
    let mut sources = Sources::default();
    sources.clear(Packing::Single(1.0));
    for (nodes, circulation) in filaments.nodes.chunks(145).zip(filaments.circulation.chunks(144)) {
        for (ends, circulation) in nodes.windows(2).zip(circulation) {
            sources.push(ends[0], ends[1], *circulation, 0.05);
        }
    }
    let whole = [sources.whole()];
    let moves = vec![[0.1, 0.2, 0.3]; points.len()];
    let evaluations = (points.len() * filaments.circulation.len()) as f64;
    let mut velocity = vec![[0.0; 3]; points.len()];
    let sets = InstructionSet::ALL.into_iter().filter(|set| set.available());
    for distance in [CoreDistance::Line, CoreDistance::Segment] {
        for core in CORES {
            let mut line = |name: &str, share: f64, task: &mut dyn FnMut(&mut [[f64; 3]])| {
                let (median, best) = timed(51, || task(black_box(&mut velocity)));
                let scale = 1e9 / (share * evaluations);
                println!("{distance:?} {core:?} {name} {:.3} {:.3}", scale * median, scale * best);
            };
            // a part of the points: as short a run as the others
            let few = &points[..points.len() / 16];
            line("textbook", 1.0 / 16.0, &mut |v| textbook(few, &filaments, core, distance, v));
            for set in sets.clone() {
                line(set.name(), 1.0, &mut |v| {
                    add_filaments_velocity_on(set, &points, &filaments, core, distance, v);
                });
            }
            for set in sets.clone().filter(|_| core == Core::Vatistas2) {
                line(&format!("{}-single", set.name()), 1.0, &mut |velocity| {
                    let mut groups = [Group { points: &points, sources: &whole, velocity }];
                    single::add_groups_velocity_on(set, &mut groups, distance);
                });
            }
            line("directional", 1.0, &mut |_| {
                let targets = Targets { points: &points, rates: &moves };
                black_box(directional(targets, &filaments, &rates, (core, distance)));
            });
        }
    }
}
