//! Nanoseconds per evaluation of the segment sum: 576 markers of four helices at their own segments, one thread.
use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;
use std::time::Instant;
use wakeflight::vortex::core::{Core, CoreDistance};
use wakeflight::vortex::induced_velocity::{Filaments, InstructionSet, add_filaments_velocity_on};
use wakeflight::vortex::threads::set_threads;

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
    let evaluations = (points.len() * filaments.circulation.len()) as f64;
    let sets = [InstructionSet::Scalar, InstructionSet::Vector, InstructionSet::Avx512];
    println!("widest here: {:?}", InstructionSet::widest());
    for distance in [CoreDistance::Line, CoreDistance::Segment] {
        for core in [
            Core::Vatistas2,
            Core::Singular,
            Core::Scully,
            Core::Rankine,
            Core::LambOseen,
            Core::RosenheadMoore,
        ] {
            for set in sets
                .into_iter()
                .filter(|set| *set != InstructionSet::Avx512 || InstructionSet::widest() == *set)
            {
                let mut velocity = vec![[0.0; 3]; points.len()];
                let mut best = f64::INFINITY;
                for _ in 0..60 {
                    let start = Instant::now();
                    add_filaments_velocity_on(
                        set,
                        black_box(&points),
                        &filaments,
                        core,
                        distance,
                        &mut velocity,
                    );
                    best = best.min(start.elapsed().as_secs_f64());
                }
                black_box(&velocity);
                println!("{distance:?} {core:?} {set:?}: {:.2} ns", best * 1e9 / evaluations);
            }
        }
    }
}
