//! The elastic force is the gradient of the strain energy, whose curvatures are those of the deformed triad; no strain
//! without deformation.

mod mechanics_support;

use mechanics_support::*;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::kinematics::StationShapes;
use wakeflight::blade::strain::{Stiffness, add_strain_gradient};
use wakeflight::numerics::scalar::{Dual, Real};

#[test]
fn strain_gradient_is_the_derivative_of_strain_energy() {
    let mut worst = 0f64;
    let mut random = Random::new(1);
    for blade in [blade(), general_blade()] {
        // beyond, random modes add up to slopes whose sine exceeds one: no such blade
        for angle in [0.02, 0.2, 0.4] {
            for pitch in [-0.5, 0.0, 0.313, 1.4, 3.0] {
                let q = random_modal(&blade, angle, &mut random);
                let (_, gradient) = strain_energy(&blade, &q, pitch);
                let mut variables = q.map(Dual::<5>::cst);
                for i in 0..5 {
                    variables[i] = Dual::variable(q[i], i);
                }
                let (energy, _) = strain_energy(&blade, &variables, pitch);
                worst = worst.max(relative_error(&gradient[..5], &energy.eps));
            }
        }
    }
    println!("largest error of the gradient: {worst:.1e}");
    assert!(worst < 1e-12, "{worst:e}");
}

/// Curvatures from the derivative of the rotation matrix along the span.
#[test]
fn strain_energy_equals_that_of_the_turning_rate_of_the_triad_along_the_span() {
    type D = Dual<1>;
    let mut worst = 0f64;
    let mut random = Random::new(2);
    let blade = general_blade();
    for pitch in [0.0, 0.313, -1.1] {
        let q = random_modal(&blade, 0.5, &mut random);
        let sum = |shape: &[f64; MAX_MODES]| shape.iter().zip(q).map(|(s, q)| s * q).sum::<f64>();
        let mut energy = 0.5 * blade.control_stiffness * sum(&blade.root_twist).powi(2);
        for p in &blade.structure {
            let along = |value: f64, slope: f64| D { re: value, eps: [slope] };
            let flap = along(sum(&p.shapes.w[1]), sum(&p.shapes.w[2])).asin();
            let lead = (along(sum(&p.shapes.v[1]), sum(&p.shapes.v[2])) / flap.sin_cos().1).asin();
            // built-in twist is no strain: it turns the section but has no slope here
            let twist = along(pitch + p.twist + sum(&p.shapes.theta), sum(&p.shapes.dphi));
            let triad = product(&product(&turn(2, lead), &turn(1, -flap)), &turn(0, twist));
            let rate = triad.map(|row| row.map(|v| v.eps[0]));
            let skew = product(&transposed(&triad.map(|row| row.map(|v| v.re))), &rate);
            let (torsion, flapwise, chordwise) = (skew[2][1], skew[2][0], skew[1][0]);
            energy += 0.5
                * (p.stiffness.torsion * torsion.powi(2)
                    + p.stiffness.flap * flapwise.powi(2)
                    + p.stiffness.lag * chordwise.powi(2));
        }
        let found = strain_energy(&blade, &q, pitch).0;
        worst = worst.max(relative_error(&[found], &[energy]));
    }
    println!("largest error of the energy: {worst:.1e}");
    assert!(worst < 1e-12, "{worst:e}");
}

/// Lag, flap and pitch of a rigid blade about the hinge, large and together.
#[test]
fn rigid_motion_about_the_hinge_has_no_strain() {
    let mut shapes = StationShapes {
        x: 5.0,
        length: 4.6,
        v: [[0.0; MAX_MODES]; 3],
        w: [[0.0; MAX_MODES]; 3],
        theta: [0.0; MAX_MODES],
        dphi: [0.0; MAX_MODES],
        shortening: [[0.0; MAX_MODES]; MAX_MODES],
        shortening_twist: [0.0; MAX_MODES],
    };
    (shapes.v[0][0], shapes.v[1][0]) = (4.5, 1.0);
    (shapes.w[0][1], shapes.w[1][1]) = (4.5, 1.0);
    shapes.theta[2] = 1.0;
    let stiffness = Stiffness { flap: 1e4, lag: 3e5, torsion: 1e4 };
    let energy = |q: &[f64; MAX_MODES], gradient: &mut [f64; MAX_MODES], shapes: &StationShapes| {
        add_strain_gradient(shapes, &stiffness, 3, q, 0.4, gradient)
    };
    let mut q = [0.0; MAX_MODES];
    q[..3].copy_from_slice(&[0.3, -0.4, 0.8]);
    let mut gradient = [0.0; MAX_MODES];
    assert_eq!(energy(&q, &mut gradient, &shapes), 0.0);
    assert!(gradient.iter().all(|g| *g == 0.0));
    // and the check can fail: a little curvature has energy
    shapes.w[2][1] = 0.01;
    assert!(energy(&q, &mut gradient, &shapes) > 1e-3);
}
