//! The sum in single precision against the law in double precision, and its edge cases, on every instruction set.
use super::add_groups_velocity_on;
use super::packed::{FARTHEST, LEAST_CORE, MOST_STRENGTH};
use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::core::{Core, CoreDistance, segment_velocity};
use crate::vortex::sources::{Group, Packing, Sources};
use crate::vortex::threads::set_threads;
use std::f64::consts::PI;

const DISTANCES: [CoreDistance; 2] = [CoreDistance::Line, CoreDistance::Segment];
/// Unit of length of the tests [m].
const UNIT: f64 = 8.0;
/// Start, end, circulation and core radius.
type Segment = ([f64; 3], [f64; 3], f64, f64);

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

/// In single precision on a given instruction set.
fn single(
    set: InstructionSet,
    points: &[[f64; 3]],
    segments: &[Segment],
    distance: CoreDistance,
) -> Vec<[f64; 3]> {
    let mut sources = Sources::default();
    sources.clear(Packing::Single(UNIT));
    segments.iter().for_each(|&(start, end, circulation, core)| sources.push(start, end, circulation, core));
    let (mut velocity, whole) = (vec![[0.0; 3]; points.len()], [sources.whole()]);
    let mut groups = [Group { points, sources: &whole, velocity: &mut velocity }];
    assert!(groups[0].is_single());
    add_groups_velocity_on(set, &mut groups, distance);
    velocity
}

/// By the reference law.
fn double(points: &[[f64; 3]], segments: &[Segment], distance: CoreDistance) -> Vec<[f64; 3]> {
    let of = |point: &[f64; 3]| {
        segments.iter().fold([0.0; 3], |sum, &(start, end, circulation, core)| {
            let v = segment_velocity(*point, start, end, circulation, core, Core::Vatistas2, distance);
            [sum[0] + v[0], sum[1] + v[1], sum[2] + v[2]]
        })
    };
    points.iter().map(of).collect()
}

/// Largest difference over the largest velocity.
fn error(found: &[[f64; 3]], exact: &[[f64; 3]]) -> f64 {
    let largest = |v: &mut dyn Iterator<Item = [f64; 3]>| v.map(length).fold(0.0, f64::max);
    let off = largest(&mut found.iter().zip(exact).map(|(a, b)| difference(*a, *b)));
    off / largest(&mut exact.iter().copied())
}

/// Four helices of four turns in steps of 10 deg with a pitch of `pitch` and a drift of `drift` radii a radian, cores growing
/// from `core` radii; and their markers.
fn helices(pitch: f64, drift: f64, core: f64) -> (Vec<[f64; 3]>, Vec<Segment>) {
    let (mut points, mut segments) = (Vec::new(), Vec::new());
    for blade in 0..4 {
        let node = |k: usize| {
            let age = PI / 18.0 * k as f64;
            let psi = 0.5 * PI * f64::from(blade) - age + 0.1;
            [psi.cos() + drift * age, psi.sin(), -pitch * age].map(|x| UNIT * x)
        };
        points.extend((0..=144).map(node));
        let core = |k: usize| UNIT * (core * core + 3e-4 * PI / 18.0 * k as f64).sqrt();
        segments.extend((0..144).map(|k| (node(k), node(k + 1), 20.0 + 0.01 * k as f64, core(k))));
    }
    (points, segments)
}

#[test]
fn a_wake_errs_by_a_millionth_of_its_largest_velocity_at_its_markers_and_off_them() {
    let mut numbers = Numbers(11);
    for (pitch, drift, core, allowed) in
        [(0.02, 0.185, 0.02, 1.5e-6), (0.0, 0.0, 0.02, 1.5e-6), (0.02, 0.3, 0.002, 1e-5)]
    {
        let (mut points, segments) = helices(pitch, drift, core);
        points.extend((0..200).map(|_| numbers.point(2.0 * UNIT)));
        for distance in DISTANCES {
            let exact = double(&points, &segments, distance);
            for set in InstructionSet::ALL {
                let found = error(&single(set, &points, &segments, distance), &exact);
                assert!(found < allowed, "{set:?} {distance:?} {pitch} {drift} {core}: {found:e}");
                assert!(found > 1e-9, "not in single precision: {found:e}");
            }
        }
    }
}

/// What a segment induces differs by its rounding at places known to 6e-8: that over the larger of core and distance, of the swirl
/// that a line would have there.
#[test]
fn a_segment_errs_by_rounding_over_the_distance_or_the_core() {
    let mut numbers = Numbers(12);
    let mut worst = [0.0f64; 2];
    for _ in 0..4000 {
        let core = UNIT * 10f64.powf(-2.0 + 2.0 * numbers.next());
        let (start, end) = (numbers.point(UNIT), numbers.point(UNIT));
        // near the line, on both sides of the ends
        let fraction = 1.5 * numbers.next() + 0.5;
        let size = 10f64.powf(1.5 * numbers.next()) * core;
        let off = numbers.point(size);
        let point = [0, 1, 2].map(|i| start[i] + fraction * (end[i] - start[i]) + off[i]);
        let segment = [(start, end, 10.0, core)];
        for (distance, worst) in DISTANCES.into_iter().zip(&mut worst) {
            let exact = double(&[point], &segment, distance);
            for set in InstructionSet::ALL {
                let found = single(set, &[point], &segment, distance);
                let swirl = 10.0 / (2.0 * PI * core);
                let scaled = length(difference(found[0], exact[0])) / swirl * core / UNIT;
                *worst = worst.max(scaled);
            }
        }
    }
    assert!(worst.into_iter().all(|w| w < 1e-6 && w > 1e-9), "{worst:?}");
}

#[test]
fn opposite_segments_cancel_and_a_reversed_one_induces_the_same() {
    let mut numbers = Numbers(13);
    for _ in 0..200 {
        let (a, b) = (numbers.point(UNIT), numbers.point(UNIT));
        let points: Vec<_> = (0..5).map(|_| numbers.point(2.0 * UNIT)).collect();
        for distance in DISTANCES {
            for set in InstructionSet::ALL {
                let there = single(set, &points, &[(a, b, 7.0, 0.2)], distance);
                let back = single(set, &points, &[(b, a, -7.0, 0.2)], distance);
                assert!(error(&back, &there) < 4e-6, "{set:?} {distance:?}");
                let both = single(set, &points, &[(a, b, 7.0, 0.2), (a, b, -7.0, 0.2)], distance);
                // a fused product keeps what the one before rounded off
                let size = there.iter().copied().map(length).fold(0.0, f64::max);
                assert!(both.iter().all(|v| length(*v) < 1.5e-7 * size), "{set:?} {distance:?}: {both:?}");
            }
        }
    }
}

#[test]
fn a_mirrored_wake_induces_the_mirrored_velocity_to_rounding() {
    let (points, segments) = helices(0.02, 0.185, 0.02);
    let mirror = |p: [f64; 3]| [p[0], -p[1], p[2]];
    let mirrored: Vec<_> = points.iter().map(|p| mirror(*p)).collect();
    let reflected: Vec<Segment> =
        segments.iter().map(|&(a, b, g, c)| (mirror(a), mirror(b), -g, c)).collect();
    for distance in DISTANCES {
        for set in InstructionSet::ALL {
            let there = single(set, &points, &segments, distance);
            let back = single(set, &mirrored, &reflected, distance);
            let off = error(&back.into_iter().map(mirror).collect::<Vec<_>>(), &there);
            assert!(off < 1e-6, "{set:?} {distance:?}: {off:e}");
        }
    }
}

/// Over a closed surface far outside the flow of a ring is that of a dipole: momentum is kept.
#[test]
fn a_ring_is_a_dipole_far_away_and_lets_nothing_through_a_closed_surface() {
    let node = |k: i32| {
        let (s, c) = (2.0 * PI * f64::from(k) / 72.0).sin_cos();
        [UNIT * c, UNIT * s, 0.0]
    };
    let ring: Vec<Segment> = (0..72).map(|k| (node(k), node(k + 1), 10.0, 0.02 * UNIT)).collect();
    for set in InstructionSet::ALL {
        let r = 20.0 * UNIT;
        let v = single(set, &[[0.0, 0.0, r], [r, 0.0, 0.0]], &ring, CoreDistance::Line);
        let dipole = 10.0 * PI * UNIT * UNIT / (4.0 * PI * r.powi(3));
        // rounding of each segment's cosines, 1e-7 of the speed at the ring
        let rounding = 3e-7 * 10.0 / UNIT;
        assert!((v[0][2] - 2.0 * dipole).abs() < 0.01 * dipole + rounding, "{set:?}: {v:?} {dipole:e}");
        assert!((v[1][2] + dipole).abs() < 0.01 * dipole + rounding, "{set:?}: {v:?} {dipole:e}");
        // flow through a sphere about the ring, by Gauss points in height and 64 angles
        let heights: [f64; 4] =
            [-0.861_136_311_594, -0.339_981_043_585, 0.339_981_043_585, 0.861_136_311_594];
        let around: Vec<[f64; 3]> = heights
            .iter()
            .flat_map(|z| {
                let across = (1.0 - z * z).sqrt();
                (0..64).map(move |k| {
                    let (s, c) = (PI * f64::from(k) / 32.0 + 0.01).sin_cos();
                    [2.0 * UNIT * across * c, 2.0 * UNIT * across * s, 2.0 * UNIT * z]
                })
            })
            .collect();
        let v = single(set, &around, &ring, CoreDistance::Line);
        let through: Vec<f64> =
            v.iter().zip(&around).map(|(v, n)| v[0] * n[0] + v[1] * n[1] + v[2] * n[2]).collect();
        let (net, gross) = through.iter().fold((0.0, 0.0), |(n, g), f| (n + f, g + f.abs()));
        // weights of a height and its opposite are the same
        assert!(net.abs() < 3e-6 * gross, "{set:?}: {net:e} of {gross:e}");
    }
}

#[test]
fn velocity_is_finite_and_bounded_on_the_line_at_the_ends_and_without_core_or_length() {
    let (start, end) = ([0.1, 0.2, 0.3], [0.4, -0.5, 0.7]);
    for core_radius in [0.0f64, 1e-30, 0.05] {
        let least = UNIT * f64::from(LEAST_CORE);
        // peak of the swirl of a line with that core, and the rounding of the place in it
        let bound = 1.5 / (2.0 * PI * core_radius.max(least));
        for fraction in [-3.0, -1e-9, -1e-13, 0.0, 1e-13, 0.25, 1.0 / 3.0, 0.9, 1.0, 1.0 + 1e-13, 2.0] {
            let point = [0, 1, 2].map(|i| start[i] + fraction * (end[i] - start[i]));
            for distance in DISTANCES {
                for set in InstructionSet::ALL {
                    let v = single(set, &[point], &[(start, end, 1.0, core_radius)], distance)[0];
                    assert!(length(v) <= bound, "{set:?} {distance:?} {fraction} {core_radius}: {v:?}");
                    if fraction == 0.0 || (fraction - 1.0f64).abs() < 1e-12 {
                        assert_eq!(v, [0.0; 3], "{set:?} {distance:?} {fraction}");
                    }
                }
            }
        }
    }
    for distance in DISTANCES {
        for set in InstructionSet::ALL {
            for tiny in [0.0, 1e-300, 1e-12] {
                let segment = [([1.0; 3], [1.0 + tiny, 1.0, 1.0], 1.0, 0.1)];
                let v = single(set, &[[0.0; 3], [1.0; 3]], &segment, distance);
                assert_eq!(v, [[0.0; 3]; 2], "{set:?} {distance:?} {tiny}");
            }
        }
    }
}

/// Whatever finite numbers come, finite numbers leave: places beyond all measure, circulations that overflow, subnormal ones.
#[test]
fn extreme_numbers_stay_finite_and_a_far_segment_induces_next_to_nothing() {
    let sizes = [0.0, 5e-324, 1e-310, 1e-150, 1e-40, 1e-20, 1e-9, 1.0, 1e5, 1e20, 1e40, 1e150, 1.7e308];
    let place = |i: usize, size: f64| [size, -0.5 * size, 0.25 * size * (i % 3 + 1) as f64];
    for distance in DISTANCES {
        for set in InstructionSet::ALL {
            for at in sizes {
                for (i, from) in sizes.into_iter().enumerate() {
                    for to in sizes {
                        for (circulation, core) in
                            [(1.0, 0.1), (1.7e308, 0.0), (-1e-310, 1e300), (5.0, 5e-324)]
                        {
                            let segment = [(place(i, from), place(i + 1, to), circulation, core)];
                            let v = single(set, &[place(0, at), place(1, -at)], &segment, distance);
                            let finite = v.iter().flatten().all(|x| x.is_finite());
                            assert!(
                                finite,
                                "{set:?} {distance:?} {at} {from} {to} {circulation} {core}: {v:?}"
                            );
                        }
                    }
                }
            }
            let far = UNIT * 2.0 * f64::from(FARTHEST);
            let segment = [([far, 0.0, 0.0], [far, UNIT, 0.0], 10.0, 0.1)];
            let v = single(set, &[[0.0; 3], [0.0, 0.0, far]], &segment, distance);
            assert!(v.iter().all(|v| length(*v) < 1e-7), "{set:?} {distance:?}: {v:?}");
            let most = 16.0 * PI * UNIT * f64::from(MOST_STRENGTH);
            let strong = |circulation| {
                single(set, &[[0.0; 3]], &[([UNIT, 0.0, 0.0], [UNIT, UNIT, 0.0], circulation, 0.1)], distance)
            };
            assert_eq!(strong(1e30), strong(most * 1.001));
        }
    }
}

#[test]
fn threads_and_neighbours_do_not_change_a_bit() {
    let (points, segments) = helices(0.02, 0.185, 0.02);
    for set in InstructionSet::ALL {
        let total = |points: &[[f64; 3]]| single(set, points, &segments, CoreDistance::Line);
        let all = total(&points);
        for n in [1, 2, 3] {
            set_threads(n).expect("an allowed number");
            assert_eq!(total(&points), all);
        }
        for (i, v) in all.iter().enumerate().step_by(37) {
            assert_eq!(total(&points[i..=i])[0], *v);
        }
        assert_eq!(total(&points[3..]), all[3..]);
    }
}

/// A sum that one would lose in plain single precision: many small terms on a large one, again and again.
#[test]
fn what_is_rounded_off_is_carried_on() {
    let (points, segments) = helices(0.02, 0.185, 0.02);
    let many: Vec<Segment> = std::iter::repeat_n(&segments, 20).flatten().copied().collect();
    for set in InstructionSet::ALL {
        let (once, often) = (
            single(set, &points[..64], &segments, CoreDistance::Line),
            single(set, &points[..64], &many, CoreDistance::Line),
        );
        let scaled: Vec<_> = once.iter().map(|v| v.map(|x| 20.0 * x)).collect();
        assert!(error(&often, &scaled) < 5e-8, "{set:?}: {:e}", error(&often, &scaled));
    }
}
