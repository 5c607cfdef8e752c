//! The tree against the direct sum, and its parts against what they stand for.
use super::far_field::over_harmonics;
use super::harmonics::{DEGREE, Moments, VELOCITY_DEGREE, remainder};
use super::{DEFAULT_TOLERANCE, Method, Numbers, add_filaments_velocity_by, add_segments_velocity_by};
use crate::vortex::core::{Core, CoreDistance, segment_velocity};
use crate::vortex::induced_velocity::{Filaments, Segments, add_filaments_velocity};
use crate::vortex::lanes::Lanes;
use crate::vortex::roots::Exact;
use crate::vortex::threads::set_threads;
use pulp::Scalar;
use std::f64::consts::PI;

const CORES: [Core; 6] =
    [Core::Singular, Core::Scully, Core::Vatistas2, Core::Rankine, Core::LambOseen, Core::RosenheadMoore];
const TREE: Method = Method::Tree { tolerance: DEFAULT_TOLERANCE, numbers: Numbers::Tolerance };

/// Uniform numbers in [-1, 1), the same in every run.
struct Random(u64);
impl Random {
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

/// Four turns of a tip vortex and of trailers of the opposite sign behind each of two blades, skewed as in forward flight.
fn wake(n_filaments: usize, core_radius: f64) -> Filaments {
    let mut filaments = Filaments::default();
    for blade in 0..2 {
        for i in 0..n_filaments {
            let r = 0.2 + 0.8 * (i + 1) as f64 / n_filaments as f64;
            let nodes: Vec<_> = (0..=144)
                .map(|k| {
                    let age = f64::from(k) * PI / 18.0;
                    let psi = f64::from(blade) * PI - age;
                    [r * psi.cos() + 0.1 * age, r * psi.sin(), -0.02 * age]
                })
                .collect();
            let tip = i + 1 == n_filaments;
            let circulation = if tip { 1.0 } else { -1.0 / n_filaments as f64 };
            filaments.push(&nodes, &[circulation; 144], &[core_radius; 144]);
        }
    }
    filaments
}

/// Nodes of the wake, points inside cores, at several core radii from a filament, and anywhere.
fn points(filaments: &Filaments, core_radius: f64) -> Vec<[f64; 3]> {
    let mut numbers = Random(7);
    let mut points = filaments.nodes.clone();
    for node in filaments.nodes.iter().step_by(9) {
        for size in [0.3, 1.0, 4.0] {
            let off = numbers.point(size * core_radius);
            points.push([node[0] + off[0], node[1] + off[1], node[2] + off[2]]);
        }
    }
    points.extend((0..200).map(|_| numbers.point(2.0)));
    points
}

/// Largest error over the largest velocity.
fn error(method: Method, filaments: &Filaments, core: Core, distance: CoreDistance) -> (f64, f64) {
    let points = points(filaments, filaments.core_radius[0]);
    let (mut tree, mut direct) = (vec![[0.0; 3]; points.len()], vec![[0.0; 3]; points.len()]);
    let account = add_filaments_velocity_by(method, &points, filaments, core, distance, &mut tree);
    add_filaments_velocity(&points, filaments, core, distance, &mut direct);
    assert!(account.cell_evaluations > 0 && account.truncation_bound > 0.0);
    let largest = direct.iter().fold(0.0f64, |m, v| m.max(length(*v)));
    let error = tree.iter().zip(&direct).fold(0.0f64, |m, (a, b)| m.max(length(difference(*a, *b))));
    (error / largest, account.truncation_bound / largest)
}

#[test]
fn the_tree_equals_the_direct_sum_to_a_thousandth_inside_cores_and_on_filaments() {
    for (n_filaments, core_radius) in [(8, 0.03), (3, 0.1), (12, 0.005)] {
        let filaments = wake(n_filaments, core_radius);
        for core in CORES {
            for distance in [CoreDistance::Line, CoreDistance::Segment] {
                let (found, bound) = error(TREE, &filaments, core, distance);
                assert!(found < 5e-4, "{n_filaments} {core:?} {distance:?}: {found:e} bound {bound:e}");
            }
        }
    }
}

#[test]
fn without_cores_the_error_keeps_below_its_bound_and_falls_with_the_tolerance() {
    let filaments = wake(8, 0.02);
    let mut last = f64::INFINITY;
    for tolerance in [1e-2, 1e-3, 1e-4, 1e-5] {
        let (found, bound) = error(
            Method::Tree { tolerance, numbers: Numbers::Double },
            &filaments,
            Core::Singular,
            CoreDistance::Line,
        );
        assert!(found <= bound && found < 0.5 * tolerance && found < last, "{found:e} {bound:e}");
        last = found;
    }
}

/// Velocities at nodes of a wake, whose lengths and circulations are multiplied; over what is expected of both.
fn at_nodes(
    lengths: f64,
    circulations: f64,
    core_radius: f64,
    distance: CoreDistance,
    by: Method,
) -> Vec<[f64; 3]> {
    let mut filaments = wake(8, core_radius);
    filaments.nodes.iter_mut().for_each(|node| *node = node.map(|c| lengths * c));
    filaments.core_radius.iter_mut().for_each(|core_radius| *core_radius *= lengths);
    filaments.circulation.iter_mut().for_each(|circulation| *circulation *= circulations);
    let mut v = vec![[0.0; 3]; filaments.nodes.len()];
    add_filaments_velocity_by(by, &filaments.nodes, &filaments, Core::Vatistas2, distance, &mut v);
    v.iter().map(|v| v.map(|c| c * lengths / circulations)).collect()
}

#[test]
fn in_single_precision_the_tree_differs_by_rounding_whatever_the_units() {
    let tolerance = DEFAULT_TOLERANCE;
    let double = Method::Tree { tolerance, numbers: Numbers::Double };
    for distance in [CoreDistance::Line, CoreDistance::Segment] {
        let exact = at_nodes(1.0, 1.0, 0.03, distance, double);
        let largest = exact.iter().fold(0.0f64, |m, v| m.max(length(*v)));
        for (lengths, circulations) in [(1.0, 1.0), (3.0, 1.0), (1e-7, 1e12), (1e8, 1e-20), (3e-3, 1e-30)] {
            let single = at_nodes(lengths, circulations, 0.03, distance, TREE);
            let error = single.iter().zip(&exact).fold(0.0f64, |m, (a, b)| m.max(length(difference(*a, *b))));
            assert!(error > 0.0, "{lengths}: not in single precision");
            // at nodes, from which a rounded place is off by no more than the size of a leaf over 1e7; elsewhere 1e-7
            assert!(error < 2e-5 * largest, "{lengths} {circulations} {distance:?}: {:e}", error / largest);
        }
    }
}

#[test]
fn where_rounding_would_count_the_tree_sums_in_double_precision() {
    let same = |core_radius: f64, tolerance: f64| {
        let by = |numbers| {
            at_nodes(1.0, 1.0, core_radius, CoreDistance::Line, Method::Tree { tolerance, numbers })
        };
        by(Numbers::Tolerance) == by(Numbers::Double)
    };
    assert!(!same(0.03, 1e-3));
    assert!(same(1e-4, 1e-3), "cores of a ten thousandth");
    assert!(same(0.03, 1e-5), "a tolerance near rounding");
}

/// On the axis of a straight vortex the velocity is zero, and tiny beside it: what is rounded of a place would be more.
#[test]
fn where_all_velocities_are_tiny_beside_what_cores_could_do_the_error_is_small_beside_them() {
    let mut filaments = Filaments::default();
    let nodes: Vec<_> = (0..=200).map(|k| [0.01 * f64::from(k), 0.0, 0.3]).collect();
    filaments.push(&nodes, &[1.0; 200], &[0.02; 200]);
    for off in [1e-8, 1e-6, 1e-4, 1e-2] {
        let points: Vec<_> = nodes.iter().map(|[x, y, z]| [*x, y + off * (7.0 * x).sin(), *z]).collect();
        for distance in [CoreDistance::Line, CoreDistance::Segment] {
            let (mut tree, mut direct) = (vec![[0.0; 3]; points.len()], vec![[0.0; 3]; points.len()]);
            add_filaments_velocity_by(TREE, &points, &filaments, Core::Vatistas2, distance, &mut tree);
            add_filaments_velocity(&points, &filaments, Core::Vatistas2, distance, &mut direct);
            let largest = direct.iter().fold(0.0f64, |m, v| m.max(length(*v)));
            let error = tree.iter().zip(&direct).fold(0.0f64, |m, (a, b)| m.max(length(difference(*a, *b))));
            assert!(error < 5e-4 * largest, "{off} {distance:?}: {:e}", error / largest);
        }
    }
}

/// A cell of random segments within radius 1, and its moments about a centre.
fn cell(seed: u64) -> (Segments, f64) {
    let mut numbers = Random(seed);
    let mut segments = Segments::default();
    let mut strength = 0.0;
    for _ in 0..20 {
        let (start, end) = (numbers.point(0.57), numbers.point(0.57));
        let circulation = numbers.next();
        strength += circulation.abs() / (4.0 * PI) * length(difference(end, start));
        segments.start.push(start);
        segments.end.push(end);
        segments.circulation.push(circulation);
        segments.core_radius.push(0.0);
    }
    (segments, strength)
}

fn moments(segments: &Segments, centre: [f64; 3]) -> Moments {
    let mut moments = Moments::zero();
    for ((start, end), circulation) in segments.start.iter().zip(&segments.end).zip(&segments.circulation) {
        moments.add_segment(difference(*end, centre), difference(*end, *start), circulation / (4.0 * PI));
    }
    moments
}

fn expansion(moments: &Moments, centre: [f64; 3], point: [f64; 3]) -> [f64; 3] {
    let on = Lanes::<Scalar, Exact>::new(Scalar::new(), Exact);
    let mut v = [0.0; 3];
    over_harmonics::<_, VELOCITY_DEGREE>(on, &difference(point, centre), 1e-300, &moments.velocity(), &mut v);
    v
}

/// What the expansion of `segments`, about the origin, leaves out at `point`, over its bound for sources within radius 1.
fn left_over_bound(segments: &Segments, strength: f64, point: [f64; 3]) -> f64 {
    let (mut exact, distance) = ([0.0; 3], length(point));
    for i in 0..segments.start.len() {
        let (start, end, circulation) = (segments.start[i], segments.end[i], segments.circulation[i]);
        let v = segment_velocity(point, start, end, circulation, 0.0, Core::Singular, CoreDistance::Line);
        exact = [exact[0] + v[0], exact[1] + v[1], exact[2] + v[2]];
    }
    let left = length(difference(expansion(&moments(segments, [0.0; 3]), [0.0; 3], point), exact));
    left / (strength / (distance * distance) * remainder(DEGREE, 1.0 / distance))
}

#[test]
fn an_expansion_leaves_out_less_than_its_bound() {
    let mut numbers = Random(11);
    for seed in 0..20 {
        let (segments, strength) = cell(seed);
        for distance in [1.2, 2.0, 4.0, 10.0] {
            let direction = numbers.point(1.0);
            let point = direction.map(|x| distance * x / length(direction));
            let ratio = left_over_bound(&segments, strength, point);
            assert!(ratio <= 1.0, "{distance}: {ratio}");
        }
    }
    // the bound is reached by a short segment at the rim, across the line to the point
    let short = Segments {
        start: vec![[0.999, -1e-3, 0.0]],
        end: vec![[0.999, 1e-3, 0.0]],
        circulation: vec![1.0],
        core_radius: vec![0.0],
    };
    for distance in [1.5, 3.0] {
        let ratio = left_over_bound(&short, 2e-3 / (4.0 * PI), [distance, 0.0, 0.0]);
        assert!(ratio > 0.95 && ratio <= 1.0, "{distance}: {ratio}");
    }
}

#[test]
fn moments_carried_to_another_centre_are_those_taken_there() {
    let (segments, _) = cell(3);
    let centre = [0.3, -0.2, 0.5];
    let mut carried = Moments::zero();
    carried.add_part(&moments(&segments, centre), centre);
    let taken = moments(&segments, [0.0; 3]);
    for point in [[2.0, 1.0, -1.0], [0.0, 0.0, 3.0], [-1.0, -2.0, 0.1]] {
        let (a, b) = (expansion(&carried, [0.0; 3], point), expansion(&taken, [0.0; 3], point));
        assert!(length(difference(a, b)) < 1e-13 * length(b), "{a:?} {b:?}");
    }
}

#[test]
fn threads_do_not_change_a_bit_of_the_tree() {
    let filaments = wake(6, 0.02);
    let points = points(&filaments, 0.02);
    let mut results = Vec::new();
    for n in [1, 2, 5] {
        set_threads(n).expect("an allowed number");
        let mut v = vec![[0.0; 3]; points.len()];
        let account =
            add_filaments_velocity_by(TREE, &points, &filaments, Core::Vatistas2, CoreDistance::Line, &mut v);
        results.push((v, account));
    }
    assert!(results.iter().all(|r| *r == results[0]));
}

#[test]
fn the_work_of_the_tree_grows_little_faster_than_the_number_of_segments() {
    let work = |n_filaments| {
        let filaments = wake(n_filaments, 0.01);
        let mut v = vec![[0.0; 3]; filaments.nodes.len()];
        let (core, distance) = (Core::Vatistas2, CoreDistance::Segment);
        let account = add_filaments_velocity_by(TREE, &filaments.nodes, &filaments, core, distance, &mut v);
        (account.segment_evaluations + 4 * account.cell_evaluations) as f64
    };
    // four times the segments: 16 times by the direct sum
    assert!(work(64) / work(16) < 7.0);
}

#[test]
fn few_segments_are_summed_directly_and_nothing_induces_nothing() {
    let auto = Method::Auto { tolerance: DEFAULT_TOLERANCE, numbers: Numbers::Tolerance };
    let none_in_single = Method::Auto { tolerance: DEFAULT_TOLERANCE, numbers: Numbers::Single };
    assert!(auto.tree(5000, 5000).is_some() && none_in_single.tree(5000, 5000).is_none());
    assert!(none_in_single.tree(40_000, 40_000).is_some());
    let filaments = wake(1, 0.02);
    let (mut v, mut w) = (vec![[0.0; 3]; filaments.nodes.len()], vec![[0.0; 3]; filaments.nodes.len()]);
    let (core, distance) = (Core::Vatistas2, CoreDistance::Line);
    let account = add_filaments_velocity_by(auto, &filaments.nodes, &filaments, core, distance, &mut v);
    add_filaments_velocity(&filaments.nodes, &filaments, core, distance, &mut w);
    assert_eq!((v, account.cell_evaluations), (w, 0));

    let mut none = [[0.0; 3]; 2];
    add_segments_velocity_by(TREE, &[[0.0; 3], [1.0; 3]], &Segments::default(), core, distance, &mut none);
    add_filaments_velocity_by(TREE, &[], &filaments, core, distance, &mut []);
    let mut still = filaments.clone();
    still.circulation.fill(0.0);
    add_filaments_velocity_by(TREE, &[[0.0; 3], [1.0; 3]], &still, core, distance, &mut none);
    assert_eq!(none, [[0.0; 3]; 2]);
}

/// Powers of lengths over the radius of a cell that is tiny, or a point, leave the range of single precision.
#[test]
fn tiny_cells_and_cells_without_extent_far_from_the_points_induce_finite_velocities() {
    let mut numbers = Random(5);
    for size in [1e-7, 1e-12, 0.0] {
        let mut filaments = Filaments::default();
        for _ in 0..40 {
            let middle = numbers.point(1.0);
            let size = if numbers.next() > 0.0 { size } else { 0.3 };
            let nodes: Vec<_> = (0..30)
                .map(|_| numbers.point(size))
                .map(|off| [middle[0] + off[0], middle[1] + off[1], middle[2] + off[2]])
                .collect();
            filaments.push(&nodes, &[1.0; 29], &[2.0; 29]);
        }
        let mut points = filaments.nodes.clone();
        points.extend((0..300).map(|_| numbers.point(3.0)));
        for distance in [CoreDistance::Line, CoreDistance::Segment] {
            let (mut tree, mut direct) = (vec![[0.0; 3]; points.len()], vec![[0.0; 3]; points.len()]);
            add_filaments_velocity_by(TREE, &points, &filaments, Core::Vatistas2, distance, &mut tree);
            add_filaments_velocity(&points, &filaments, Core::Vatistas2, distance, &mut direct);
            let largest = direct.iter().fold(0.0f64, |m, v| m.max(length(*v)));
            for (a, b) in tree.iter().zip(&direct) {
                assert!(length(difference(*a, *b)) < 5e-4 * largest, "{size} {distance:?}: {a:?} {b:?}");
            }
        }
    }
}
