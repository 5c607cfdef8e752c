//! Velocity, acceleration, angular velocity and angular acceleration of a section are the time derivatives of its place
//! and triad; test motions are the derivatives by the modal coordinates.

mod mechanics_support;

use mechanics_support::*;
use wakeflight::blade::MAX_MODES;
use wakeflight::blade::kinematics::{ModalMotion, PitchMotion, SectionMotion};
use wakeflight::numerics::scalar::{Dual, Real};

fn triad<S: Real>(m: &SectionMotion<S>) -> Matrix3<S> {
    transposed(&[m.t.array(), m.c.array(), m.n.array()])
}

/// Axial vector of rate times transposed matrix.
fn axial(rate: &Matrix3<f64>, matrix: &Matrix3<f64>) -> [f64; 3] {
    let m = product(rate, &transposed(matrix));
    [m[2][1], m[0][2], m[1][0]]
}

#[test]
fn section_rates_are_time_derivatives_of_the_triad() {
    let blade = general_blade();
    let mut random = Random::new(3);
    let a = random_modal(&blade, 0.3, &mut random);
    let b = random_modal(&blade, 0.3, &mut random);
    let (w, p) = (31.0, 27.0);
    let modal = |t: f64| {
        let (s, c) = (w * t).sin_cos();
        let of = |f: &dyn Fn(usize) -> f64| std::array::from_fn(f);
        ModalMotion {
            q: of(&|i| a[i] * s + b[i] * c),
            q_dot: of(&|i| w * (a[i] * c - b[i] * s)),
            q_ddot: of(&|i| -w * w * (a[i] * s + b[i] * c)),
        }
    };
    let control = |t: f64, twist: f64| {
        let (s, c) = (p * t + 0.4).sin_cos();
        PitchMotion { theta: 0.3 + twist + 0.2 * s, theta_dot: 0.2 * p * c, theta_ddot: -0.2 * p * p * s }
    };
    let (t, h) = (0.037, 2e-4);
    let mut worst = [0f64; 5];
    for point in &blade.structure {
        let motion = |t: f64| point.shapes.motion(5, &modal(t), &control(t, point.twist));
        let m = motion(t);
        let rate = time_derivative(t, h, |t| {
            let x = triad(&motion(t));
            std::array::from_fn::<f64, 9, _>(|k| x[k / 3][k % 3])
        });
        let omega = axial(&std::array::from_fn(|i| std::array::from_fn(|j| rate[3 * i + j])), &triad(&m));
        let checks = [
            (m.velocity.array(), time_derivative(t, h, |t| motion(t).position.array())),
            (m.acceleration.array(), time_derivative(t, h, |t| motion(t).velocity.array())),
            (m.omega.array(), omega),
            (m.omega_dot.array(), time_derivative(t, h, |t| motion(t).omega.array())),
        ];
        for (worst, (found, expected)) in worst.iter_mut().zip(checks) {
            *worst = worst.max(relative_error(&found, &expected));
        }
        // test motions
        let at = modal(t);
        for i in 0..5 {
            let mut q: [Dual<1>; MAX_MODES] = at.q.map(Dual::cst);
            q[i].eps[0] = 1.0;
            let theta = control(t, point.twist).theta;
            let varied = point.shapes.motion(5, &modal_at(q), &still(theta));
            let derivative = triad(&varied).map(|row| row.map(|v| v.eps[0]));
            let (shift, turned) = m.test_motion(&point.shapes, i);
            let expected = axial(&derivative, &triad(&m));
            worst[4] = worst[4].max(relative_error(&turned.array(), &expected));
            worst[4] =
                worst[4].max(relative_error(&shift.array(), &varied.position.array().map(|v| v.eps[0])));
        }
    }
    println!("velocity, acceleration, omega, omega_dot, test motions: {worst:?}");
    assert!(worst[..4].iter().all(|e| *e < 1e-7), "{worst:?}");
    assert!(worst[4] < 1e-11, "{worst:?}");
}
