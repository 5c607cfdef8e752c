//! What must hold for segments and their sums, whatever the core.
use super::core::{Core, CoreDistance, segment_velocity};
use super::curvature::curvature_velocity;
use super::induced_velocity::{
    Filaments, Segments, add_filaments_velocity, add_filaments_velocity_on, add_induced_velocity,
    add_segments_velocity,
};
use super::threads::{set_threads, threads};
use crate::numerics::instruction_set::InstructionSet;
use std::f64::consts::PI;

const CORES: [Core; 6] =
    [Core::Singular, Core::Scully, Core::Vatistas2, Core::Rankine, Core::LambOseen, Core::RosenheadMoore];
const DISTANCES: [CoreDistance; 2] = [CoreDistance::Line, CoreDistance::Segment];

/// Uniform numbers in [-1, 1), the same in every run.
struct Numbers(u64);
impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn point(&mut self, size: f64) -> [f64; 3] {
        [size * self.next(), size * self.next(), size * self.next()]
    }
}

fn length(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn close(a: [f64; 3], b: [f64; 3], relative: f64) {
    let (error, allowed) = (length(difference(a, b)), relative * length(b));
    assert!(error <= allowed, "{a:?} is not {b:?}: {error:e} > {allowed:e}");
}

/// A random segment (start, end), a point near it, circulation and core radius.
fn sample(numbers: &mut Numbers) -> ([f64; 3], [f64; 3], [f64; 3], f64, f64) {
    let (start, end) = (numbers.point(1.0), numbers.point(1.0));
    (numbers.point(2.0), start, end, 10.0 * numbers.next(), 0.2 + 0.19 * numbers.next())
}

#[test]
fn a_long_segment_induces_the_velocity_of_a_line_vortex() {
    for h in [0.01, 0.1, 1.0] {
        let v = segment_velocity(
            [h, 0.0, 0.0],
            [0.0, 0.0, -100.0],
            [0.0, 0.0, 100.0],
            3.0,
            0.0,
            Core::Singular,
            CoreDistance::Line,
        );
        close(v, [0.0, 3.0 / (2.0 * PI * h), 0.0], 5e-5);
        // in the plane of its end a half-line gives half
        let v = segment_velocity(
            [h, 0.0, 0.0],
            [0.0; 3],
            [0.0, 0.0, 1e6],
            3.0,
            0.0,
            Core::Singular,
            CoreDistance::Line,
        );
        close(v, [0.0, 3.0 / (4.0 * PI * h), 0.0], 1e-6);
    }
}

#[test]
fn swirl_peaks_at_the_core_radius() {
    let swirl = |core, h| {
        let (start, end) = ([0.0, 0.0, -1e4], [0.0, 0.0, 1e4]);
        segment_velocity([h, 0.0, 0.0], start, end, 1.0, 0.05, core, CoreDistance::Line)[1]
    };
    for (core, peak) in [
        (Core::Scully, 0.5),
        (Core::Vatistas2, 0.5f64.sqrt()),
        (Core::Rankine, 1.0),
        (Core::LambOseen, 0.715_331_862_959),
        (Core::RosenheadMoore, 0.5),
    ] {
        let at_core = swirl(core, 0.05);
        assert!((at_core * 2.0 * PI * 0.05 - peak).abs() < 1e-9, "{core:?}");
        assert!(swirl(core, 0.05 * 0.999) < at_core && swirl(core, 0.05 * 1.001) < at_core, "{core:?}");
    }
}

#[test]
fn a_reversed_segment_induces_the_opposite() {
    let mut numbers = Numbers(1);
    for _ in 0..200 {
        let (point, start, end, circulation, core_radius) = sample(&mut numbers);
        for core in CORES {
            for distance in DISTANCES {
                let forward = segment_velocity(point, start, end, circulation, core_radius, core, distance);
                let backward = segment_velocity(point, end, start, -circulation, core_radius, core, distance);
                close(backward, forward, 1e-12);
            }
        }
    }
}

#[test]
fn two_halves_induce_what_the_whole_does() {
    let mut numbers = Numbers(2);
    for _ in 0..200 {
        let (point, start, end, circulation, core_radius) = sample(&mut numbers);
        let middle = sum(start, end).map(|x| 0.5 * x);
        // a core at the distance to the line sees one line; the softened kernel is integrated exactly
        for core in CORES {
            let part =
                |a, b| segment_velocity(point, a, b, circulation, core_radius, core, CoreDistance::Line);
            close(sum(part(start, middle), part(middle, end)), part(start, end), 1e-11);
        }
    }
}

#[test]
fn moving_turning_and_scaling_everything_moves_the_velocity_along() {
    let mut numbers = Numbers(3);
    let (c, s) = (0.3f64.cos(), 0.3f64.sin());
    // turn about z, then cyclic exchange of axes
    let turned = |v: [f64; 3]| [v[2], c * v[0] - s * v[1], s * v[0] + c * v[1]];
    for _ in 0..100 {
        let (point, start, end, circulation, core_radius) = sample(&mut numbers);
        let shift = numbers.point(5.0);
        for core in CORES {
            for distance in DISTANCES {
                let v = segment_velocity(point, start, end, circulation, core_radius, core, distance);
                for scale in [1e-3, 1.0, 1e4] {
                    let moved = |p| sum(turned(p), shift).map(|x| scale * x);
                    let w = segment_velocity(
                        moved(point),
                        moved(start),
                        moved(end),
                        circulation,
                        scale * core_radius,
                        core,
                        distance,
                    );
                    close(w.map(|x| scale * x), turned(v), 1e-9);
                }
            }
        }
    }
}

#[test]
fn velocity_is_finite_on_the_segment_its_ends_and_its_prolongation() {
    let (start, end) = ([0.1, 0.2, 0.3], [0.4, -0.5, 0.7]);
    for fraction in [-3.0, -1e-13, 0.0, 1e-13, 0.25, 1.0 / 3.0, 0.9, 1.0, 1.0 + 1e-13, 2.0] {
        let point = [0, 1, 2].map(|i| start[i] + fraction * (end[i] - start[i]));
        let mut filament = Filaments::default();
        filament.push(&[start, end], &[1.0], &[0.0]);
        for core in CORES {
            for distance in DISTANCES {
                for core_radius in [0.0, 0.05] {
                    let v = segment_velocity(point, start, end, 1.0, core_radius, core, distance);
                    assert!(v.iter().all(|x| x.is_finite()), "{core:?} {distance:?} {fraction}: {v:?}");
                    filament.core_radius[0] = core_radius;
                    for set in InstructionSet::ALL {
                        let mut w = [[0.0; 3]];
                        add_filaments_velocity_on(set, &[point], &filament, core, distance, &mut w);
                        assert!(
                            w[0].iter().all(|x| x.is_finite()),
                            "{set:?} {core:?} {distance:?} {fraction}: {w:?}"
                        );
                        if fraction == 0.0 || (fraction - 1.0f64).abs() < 1e-12 {
                            assert_eq!((v, w[0]), ([0.0; 3], [0.0; 3]));
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_segment_without_length_induces_nothing() {
    let mut filament = Filaments::default();
    filament.push(&[[1.0; 3], [1.0; 3], [1.0; 3]], &[1.0; 2], &[0.0, 0.1]);
    for core in CORES {
        for distance in DISTANCES {
            let mut v = [[0.0; 3]; 2];
            add_filaments_velocity(&[[0.0; 3], [1.0; 3]], &filament, core, distance, &mut v);
            assert_eq!(v, [[0.0; 3]; 2], "{core:?} {distance:?}");
            assert_eq!(segment_velocity([0.0; 3], [1.0; 3], [1.0; 3], 1.0, 0.1, core, distance), [0.0; 3]);
        }
    }
}

#[test]
fn vector_sums_equal_the_reference_law() {
    let mut numbers = Numbers(4);
    for _ in 0..300 {
        let (_, start, end, circulation, core_radius) = sample(&mut numbers);
        let near: Vec<_> = (0..7).map(|_| numbers.point(2.0)).collect();
        let far: Vec<_> = (0..4).map(|_| numbers.point(300.0)).collect();
        let points = [near, far].concat();
        let segment = Segments {
            start: vec![start],
            end: vec![end],
            circulation: vec![circulation],
            core_radius: vec![core_radius],
        };
        let mut filament = Filaments::default();
        filament.push(&[start, end], &[circulation], &[core_radius]);
        for core in CORES {
            for distance in DISTANCES {
                for set in InstructionSet::ALL {
                    let mut v = vec![[0.0; 3]; points.len()];
                    add_filaments_velocity_on(set, &points, &filament, core, distance, &mut v);
                    for (v, point) in v.iter().zip(&points) {
                        close(
                            *v,
                            segment_velocity(*point, start, end, circulation, core_radius, core, distance),
                            1e-13,
                        );
                    }
                }
                let (mut v, mut w) = (vec![[1.0; 3]; points.len()], vec![[1.0; 3]; points.len()]);
                add_segments_velocity(&points, &segment, core, distance, &mut v);
                add_filaments_velocity(&points, &filament, core, distance, &mut w);
                assert_eq!(v, w);
            }
        }
    }
}

/// Four turns of a helix, its markers, and points off it.
fn helix() -> (Vec<[f64; 3]>, Filaments) {
    let node = |k: usize| {
        let psi = 0.174_533 * k as f64;
        [psi.cos(), psi.sin(), -0.01 * k as f64]
    };
    let nodes: Vec<_> = (0..=144).map(node).collect();
    let mut filaments = Filaments::default();
    let circulation: Vec<f64> = (0..144).map(|k| 1.0 + 0.01 * f64::from(k)).collect();
    filaments.push(&nodes, &circulation, &[0.05; 144]);
    filaments.push(&nodes[..10], &[0.3; 9], &[0.02; 9]);
    let mut numbers = Numbers(5);
    let others = (0..300).map(|_| numbers.point(1.5));
    (nodes.iter().copied().chain(others).collect(), filaments)
}

#[test]
fn threads_and_neighbours_do_not_change_a_bit() {
    let (points, filaments) = helix();
    let total = |points: &[[f64; 3]]| {
        let mut v = vec![[0.0; 3]; points.len()];
        add_filaments_velocity(points, &filaments, Core::Vatistas2, CoreDistance::Line, &mut v);
        v
    };
    let mut results = Vec::new();
    for n in [1, 2, 3, 5] {
        set_threads(n).expect("an allowed number");
        assert_eq!(threads(), Ok(n));
        results.push(total(&points));
    }
    assert!(results.iter().all(|v| *v == results[0]));
    // each point alone, and in a list that starts elsewhere
    for (i, v) in results[0].iter().enumerate().step_by(7) {
        assert_eq!(total(&points[i..=i])[0], *v);
    }
    assert_eq!(total(&points[3..]), results[0][3..]);
    assert!(set_threads(0).is_err() && set_threads(100_000).is_err());
}

#[test]
fn separate_segments_and_filaments_give_the_same_sum() {
    let (points, filaments) = helix();
    let nodes = &filaments.nodes;
    let first = Filaments { nodes: nodes[..145].to_vec(), n_nodes: vec![145], ..filaments.clone() };
    let segments = Segments {
        start: nodes[..144].to_vec(),
        end: nodes[1..145].to_vec(),
        circulation: filaments.circulation[..144].to_vec(),
        core_radius: filaments.core_radius[..144].to_vec(),
    };
    let (mut v, mut w) = (vec![[0.0; 3]; points.len()], vec![[0.0; 3]; points.len()]);
    add_induced_velocity(&points, &segments, Core::Vatistas2, &mut v);
    add_filaments_velocity(&points, &first, Core::Vatistas2, CoreDistance::Line, &mut w);
    assert_eq!(v, w);
}

fn ring(n: usize, core_radius: f64) -> Filaments {
    let mut nodes: Vec<_> =
        (0..n).map(|k| (2.0 * PI * k as f64 / n as f64).sin_cos()).map(|(s, c)| [c, s, 0.0]).collect();
    nodes.push(nodes[0]);
    let mut filaments = Filaments::default();
    filaments.push(&nodes, &vec![1.0; n], &vec![core_radius; n]);
    filaments
}

#[test]
fn a_polygon_induces_at_its_centre_what_the_ring_does_to_second_order() {
    let error = |n| {
        let mut v = [[0.0; 3]];
        add_filaments_velocity(&[[0.0; 3]], &ring(n, 0.0), Core::Singular, CoreDistance::Line, &mut v);
        v[0][2] / 0.5 - 1.0
    };
    let (at_36, at_72) = (error(36), error(72));
    assert!((at_36 - 0.002_55).abs() < 1e-5 && (at_72 - 0.000_64).abs() < 1e-5, "{at_36} {at_72}");
    assert!((at_36 / at_72 - 4.0).abs() < 0.01);
}

#[test]
fn a_node_of_a_polygon_moves_as_the_thin_ring_with_the_curvature_correction() {
    let bare = |n, core_radius, core| {
        let mut v = [[0.0; 3]];
        add_filaments_velocity(
            &[[1.0, 0.0, 0.0]],
            &ring(n, core_radius),
            core,
            CoreDistance::Segment,
            &mut v,
        );
        4.0 * PI * v[0][2]
    };
    for (n, expected) in
        [(18, 2.519_433_034_823), (36, 3.210_448_625_953), (72, 3.902_733_153_988), (144, 4.595_582_262_039)]
    {
        assert!((bare(n, 0.0, Core::Singular) - expected).abs() < 1e-9);
    }
    for core_radius in [0.005f64, 0.01, 0.02, 0.05] {
        let nodes = ring(36, core_radius).nodes;
        let local = curvature_velocity(nodes[35], nodes[0], nodes[1], 1.0, core_radius);
        let exact = (8.0 / core_radius).ln() - 0.5;
        let speed = bare(36, core_radius, Core::Vatistas2) + 4.0 * PI * local[2];
        assert!((speed / exact - 1.0).abs() < 0.005, "{core_radius}: {speed} {exact}");
        assert!(local[0].abs() < 1e-15 && local[1].abs() < 1e-15);
    }
}

#[test]
fn a_straight_or_folded_filament_has_no_curvature_velocity() {
    let (a, b, c) = ([0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]);
    assert_eq!(curvature_velocity(a, b, c, 1.0, 0.1), [0.0; 3]);
    assert_eq!(curvature_velocity(a, a, c, 1.0, 0.1), [0.0; 3]);
    assert_eq!(curvature_velocity(a, b, a, 1.0, 0.1), [0.0; 3]);
    assert_eq!(curvature_velocity(a, b, [1.0, 1.0, 0.0], 1.0, 0.0), [0.0; 3]);
}
