//! The equations of motion, linearised about the undeformed blade in vacuum at the reference pitch, have the modes'
//! frequencies: unit mass matrix, stiffness diag(omega_i^2), gyroscopic terms alone without symmetry.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::airfoil::span::StationAirfoils;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::kinematics::ModalMotion;
use wakeflight::blade::model::Blade;
use wakeflight::blade::section::BladeProperties;
use wakeflight::blade::surroundings::{BladeEnvironment, BladeInflow};
use wakeflight::numerics::jacobian::{Direction, dense_jacobian};
use wakeflight::numerics::scalar::Real;
use wakeflight::numerics::tables::Table;

const N: usize = 5;

/// Residual about rest at q, q_dot, q_ddot.
fn residual<S: Real>(blade: &Blade, x: &[S], f: &mut [S]) {
    let part = |first: usize| {
        std::array::from_fn::<S, MAX_MODES, _>(|i| if i < N { x[first + i] } else { S::zero() })
    };
    let modal = ModalMotion { q: part(0), q_dot: part(N), q_ddot: part(2 * N) };
    let airfoils = StationAirfoils::uniform(smooth_airfoil(6.0, 0.0, 0.01, 0.0), blade.stations.len());
    let environment =
        BladeEnvironment { airfoils: &airfoils, air: AIR, rotor_speed: OMEGA, yawed_drag: false };
    let (hub, pitch) = (hub_at_rest(), still(REFERENCE_PITCH));
    let loads = blade.loads(&environment, &hub, S::zero(), &modal, &pitch, &BladeInflow::Vacuum);
    f[..N].copy_from_slice(&loads.modal[..N]);
}

/// The residual, and its derivatives by q, q_dot, q_ddot (columns 0..5, 5..10, 10..15).
fn linearised(blade: &Blade) -> ([f64; N], [[f64; 15]; N]) {
    let (rest, mut value, mut slopes) = ([0.0; 15], [0.0; N], [0.0; 15 * 15]);
    residual(blade, &rest, &mut value);
    let rows = |x: &[Direction], f: &mut [Direction]| residual(blade, x, f);
    dense_jacobian(&rest, rows, &mut slopes);
    (value, std::array::from_fn(|i| std::array::from_fn(|j| slopes[15 * i + j])))
}

/// Largest errors of frequency, of the mass matrix, and of the stiffness off the diagonal over omega_i omega_j.
fn errors(blade: &Blade) -> [f64; 3] {
    let (_, slopes) = linearised(blade);
    let frequency = &blade.modes.frequency;
    let mut worst = [0f64; 3];
    for i in 0..N {
        for j in 0..N {
            let stiffness = -slopes[i][j] / (frequency[i] * frequency[j]);
            let mass = -slopes[i][10 + j] - if i == j { 1.0 } else { 0.0 };
            assert!(stiffness.is_finite() && mass.is_finite());
            worst[1] = worst[1].max(mass.abs());
            if i == j {
                worst[0] = worst[0].max((stiffness.sqrt() - 1.0).abs());
            } else {
                worst[2] = worst[2].max(stiffness.abs());
            }
        }
    }
    worst
}

fn convergence(properties: &BladeProperties, name: &str) -> Vec<[f64; 3]> {
    let mut found = Vec::new();
    for n_gauss in [4, 6, 8, 12, 40] {
        let blade = Blade::new(properties, OMEGA, 0.97, &discretisation(N, n_gauss)).unwrap();
        let e = errors(&blade);
        println!(
            "{name}, {n_gauss} points: frequency {:.1e}, mass {:.1e}, coupling {:.1e}",
            e[0], e[1], e[2]
        );
        let (rest, _) = linearised(&blade);
        let angle: Vec<f64> = (0..N)
            .map(|i| rest[i] / blade.modes.frequency[i].powi(2) / per_radian(&blade, i))
            .map(f64::to_degrees)
            .collect();
        println!("    static answer [deg of the tip] {angle:.3?}");
        found.push(e);
    }
    found
}

/// Precone, pitch-flap coupling, offset centre of gravity.
fn with_everything() -> BladeProperties {
    let mut properties = uh60a();
    properties.precone = 0.05;
    properties.delta3 = 0.2;
    for (i, x) in properties.structure.x_cg.iter_mut().enumerate() {
        *x += 0.02 - 0.05 * (i % 3) as f64 / 3.0;
    }
    properties
}

/// Steps of mass and stiffness are integrated exactly; without kinks of twist and foreshortening inside the elements
/// (linear twist, no tension-twist coupling) nothing is left but the polynomial degree.
#[test]
fn frequencies_of_a_blade_without_kinks_converge_to_those_of_its_modes() {
    for (mut properties, name) in [(uh60a(), "linear twist"), (with_everything(), "linear twist, everything")]
    {
        properties.twist = Table { x: vec![0.0, properties.radius], y: vec![0.0, -0.3] };
        properties.ka_over_ktheta = 0.0;
        let found = convergence(&properties, name);
        assert!(found[0].iter().any(|e| *e > 1e-7), "too easy: {:?}", found[0]);
        assert!(found[3].iter().all(|e| *e < 1e-9), "{:?}", found[3]);
    }
}

/// A massless gap between hinge and first segment has no tension-twist coupling in either.
#[test]
fn a_gap_at_the_hinge_changes_nothing() {
    let mut properties = uh60a();
    properties.twist = Table { x: vec![0.0, properties.radius], y: vec![0.0, -0.3] };
    properties.root_station = 0.1;
    properties.structure.i_theta[0] = 3.0;
    let e = errors(&Blade::new(&properties, OMEGA, 0.97, &discretisation(N, 20)).unwrap());
    println!("gap: frequency {:.1e}, mass {:.1e}, coupling {:.1e}", e[0], e[1], e[2]);
    // the steps of k_A leave some 1e-7; a gap with the coupling of the first segment would leave 7e-6
    assert!(e[0] < 1e-6, "{e:?}");
}

/// The kinks of the UH-60A's twist and of k_A leave a few parts in a million, which fall slowly with the points.
#[test]
fn frequencies_of_the_nonlinear_blade_are_those_of_its_modes() {
    for (properties, name) in [(uh60a(), "UH-60A"), (with_everything(), "UH-60A, everything")] {
        let found = convergence(&properties, name);
        for e in &found[1..4] {
            assert!(e.iter().all(|e| *e < 3e-5), "{e:?}");
        }
        assert!(found[4][0] < 1e-6, "{:?}", found[4]);
    }
}

/// Gyroscopic forces do no work: their matrix is antisymmetric once the structural damping is taken off.
#[test]
fn gyroscopic_matrix_is_antisymmetric() {
    let blade = general_blade();
    let (_, slopes) = linearised(&blade);
    let (mut symmetric, mut largest) = (0f64, 0f64);
    for i in 0..N {
        for j in 0..N {
            let damping = |i: usize, j: usize| if i == j { blade.damping[i] } else { 0.0 };
            let (a, b) = (-slopes[i][5 + j] - damping(i, j), -slopes[j][5 + i] - damping(j, i));
            symmetric = symmetric.max((a + b).abs());
            largest = largest.max(a.abs());
        }
    }
    println!("gyroscopic {largest:.3} 1/s, symmetric part {symmetric:.1e}");
    assert!(largest > 1.0 && symmetric < 1e-10 * largest);
}
