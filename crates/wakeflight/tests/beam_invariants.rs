//! Properties of the modes that hold for any blade, and effects that the closed forms leave out.

mod beam_support;

use beam_support::{Motion, assert_close, mostly, uh60a, uniform};
use nalgebra::{Cholesky, DMatrix, SymmetricEigen};
use wakeflight::blade::error::BladeError;
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::quadrature::gauss_points;
use wakeflight::blade::section::{BladeProperties, Root};
use wakeflight::numerics::tables::Table;

/// Frequencies of a twisted uniform cantilever in flap and lag from polynomials x^2 ... x^8 (Rayleigh-Ritz).
fn ritz(ei_flap: f64, ei_lag: f64, omega: f64, pitch: impl Fn(f64) -> f64) -> Vec<f64> {
    const N: usize = 7;
    let (mut mass, mut stiffness) = (DMatrix::zeros(2 * N, 2 * N), DMatrix::zeros(2 * N, 2 * N));
    for (x, dx) in gauss_points(30, 0.0, 1.0) {
        let (sin, cos) = pitch(x).sin_cos();
        let tension = 0.5 * omega * omega * (1.0 - x * x);
        let shape = |k: usize| {
            let p = k as i32 + 2;
            let q = f64::from(p);
            [x.powi(p), q * x.powi(p - 1), q * (q - 1.0) * x.powi(p - 2)]
        };
        let flap = ei_flap * cos * cos + ei_lag * sin * sin;
        let lag = ei_flap * sin * sin + ei_lag * cos * cos;
        let cross = (ei_lag - ei_flap) * sin * cos;
        for i in 0..N {
            for j in 0..N {
                let (a, b) = (shape(i), shape(j));
                mass[(i, j)] += dx * a[0] * b[0];
                mass[(N + i, N + j)] += dx * a[0] * b[0];
                let bending = dx * a[2] * b[2];
                let string = dx * tension * a[1] * b[1];
                stiffness[(i, j)] += bending * flap + string;
                stiffness[(N + i, N + j)] += bending * lag + string - dx * omega * omega * a[0] * b[0];
                stiffness[(i, N + j)] += bending * cross;
                stiffness[(N + i, j)] += bending * cross;
            }
        }
    }
    let lower = Cholesky::new(mass).unwrap().l();
    let half = lower.solve_lower_triangular(&stiffness).unwrap();
    let standard = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let eigen = SymmetricEigen::new((&standard + standard.transpose()) * 0.5);
    let mut found: Vec<f64> = eigen.eigenvalues.iter().map(|e| e.sqrt()).collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn twisted_cantilever_has_the_frequencies_of_polynomials() {
    let (ei_flap, ei_lag) = (0.014486, 0.166908);
    for (root, tip) in [(0.3, 0.3), (0.3, -0.2), (0.6, 0.0)] {
        let mut blade = uniform(Root::Clamped, 0.0, 1.0, ei_flap, ei_lag);
        blade.twist = Table { x: vec![0.0, 1.0], y: vec![root, tip] };
        let expected = ritz(ei_flap, ei_lag, 1.0, |x| root + (tip - root) * x);
        let found = BladeModes::new(&blade, 1.0, 0.0, 16, 3).unwrap();
        for (i, &exact) in expected.iter().take(3).enumerate() {
            assert_close(found.frequency[i], exact, 2e-5, &format!("twist {root} to {tip}, mode {i}"));
        }
    }
}

#[test]
fn rigid_flap_and_lag_about_a_preconed_span_follow_from_the_energy_of_a_rod() {
    // T0 = 1/2 int |rate x r|^2 with r = (e + s cos b, 0, s sin b) and (e + s cos z, s sin z, 0), hinge at e on the span:
    // flap I cos(2 precone) + e S cos^2, lag e S cos^2 - I sin^2
    let (e, length) = (0.1, 0.9f64);
    let (first, second) = (length.powi(2) / 2.0, length.powi(3) / 3.0);
    for precone in [0.0, 0.05, 0.2f64] {
        let mut blade = uniform(Root::Hinged, e, 1.0, 1e3, 1e3);
        blade.precone = precone;
        let modes = BladeModes::new(&blade, 1.0, 0.0, 1, 2).unwrap();
        let (flap, lag) = (mostly(&modes, Motion::Flap)[0], mostly(&modes, Motion::Lag)[0]);
        let hinge = e * first * precone.cos().powi(2) / second;
        assert_close(flap * flap, (2.0 * precone).cos() + hinge, 1e-6, &format!("flap, precone {precone}"));
        assert_close(lag * lag, hinge - precone.sin().powi(2), 1e-6, &format!("lag, precone {precone}"));
    }
    // without offset nothing holds lag against precone: the straight blade is no stable equilibrium
    let mut blade = uniform(Root::Hinged, 0.0, 1.0, 1e3, 1e3);
    blade.precone = 0.2;
    let refusal = BladeModes::new(&blade, 1.0, 0.0, 1, 2).unwrap_err();
    assert!(matches!(refusal, BladeError::Diverges { mode: 0, .. }));
}

#[test]
fn delta3_feeds_the_propeller_moment_to_rigid_flap() {
    // pitch -tan(delta3) b of a flap angle b: T + U gain the section's rotary inertia and propeller stiffness
    let (i_theta, delta3) = (0.02, 0.5f64);
    let mut blade = uniform(Root::Hinged, 0.1, 1.0, 1e3, 1e3);
    blade.structure.i_theta = vec![i_theta];
    blade.structure.gj = vec![1e3];
    blade.control_stiffness = 1e4;
    blade.delta3 = delta3;
    let modes = BladeModes::new(&blade, 1.0, 0.0, 2, 2).unwrap();
    let flap = mostly(&modes, Motion::Flap)[0];
    let (length, slope) = (0.9f64, delta3.tan());
    let inertia = length.powi(3) / 3.0;
    let stiffness = inertia + 0.1 * length.powi(2) / 2.0;
    let turned = i_theta * length * slope * slope;
    assert_close(flap * flap, (stiffness + turned) / (inertia + turned), 1e-5, "flap with delta3");
}

#[test]
fn shapes_are_mass_normalised_and_orthogonal_over_the_pieces() {
    let blade = uh60a();
    let reference_pitch = 17.93f64.to_radians();
    let n = 7;
    let modes = BladeModes::new(&blade, 27.0, reference_pitch, 4, n).unwrap();
    let mut modal = vec![vec![0.0; n]; n];
    for (start, end, segment) in modes.pieces() {
        for (x, dx) in gauss_points(5, start, end) {
            let s = blade.section(segment, x);
            let q = modes.at(x);
            let (sin, cos) = (reference_pitch + blade.twist.at(x)).sin_cos();
            // centre of gravity, chord and normal moved by unit modal coordinates; axial shift of second order
            let motions: Vec<[[f64; 3]; 3]> = (0..n)
                .map(|i| {
                    let (dv, dw, phi) = (q.dv[i], q.dw[i], q.phi[i]);
                    let c = [-dv * cos - dw * sin, -sin * phi, cos * phi];
                    let normal = [-dw * cos + dv * sin, -cos * phi, -sin * phi];
                    let p = [s.x_cg * c[0], q.v[i] + s.x_cg * c[1], q.w[i] + s.x_cg * c[2]];
                    [p, c, normal]
                })
                .collect();
            for i in 0..n {
                for j in 0..n {
                    for (k, weight) in [s.mass, s.i_chord, s.i_flap].into_iter().enumerate() {
                        let dot: f64 = (0..3).map(|l| motions[i][k][l] * motions[j][k][l]).sum();
                        modal[i][j] += dx * weight * dot;
                    }
                }
            }
        }
    }
    for (i, row) in modal.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            // linear axial shift by tension-twist coupling is left out above: k_A^2 th' phi, some 1e-5
            assert!((value - expected).abs() < 5e-5, "{i} {j}: {value}");
        }
    }
    for share in &modes.shares {
        assert!((share.flap + share.lag + share.torsion - 1.0).abs() < 1e-12);
    }
}

#[test]
fn slopes_and_curvatures_are_derivatives_of_the_shapes_and_the_hinge_holds() {
    let blade = uh60a();
    let modes = BladeModes::new(&blade, 27.0, 0.3, 4, 5).unwrap();
    let h = 1e-4;
    for x in [0.6, 2.0, 5.123, 8.1] {
        let (inboard, at, outboard) = (modes.at(x - h), modes.at(x), modes.at(x + h));
        let slope = |a: &[f64], b: &[f64], i: usize| (b[i] - a[i]) / (2.0 * h);
        for i in 0..5 {
            assert!((slope(&inboard.v, &outboard.v, i) - at.dv[i]).abs() < 1e-7);
            assert!((slope(&inboard.w, &outboard.w, i) - at.dw[i]).abs() < 1e-7);
            assert!((slope(&inboard.dv, &outboard.dv, i) - at.ddv[i]).abs() < 1e-7);
            assert!((slope(&inboard.dw, &outboard.dw, i) - at.ddw[i]).abs() < 1e-7);
            assert!((slope(&inboard.phi, &outboard.phi, i) - at.dphi[i]).abs() < 1e-7);
        }
    }
    let (root, tip) = (modes.at(blade.root_station), modes.at(blade.radius));
    for i in 0..5 {
        assert_eq!((root.v[i], root.w[i]), (0.0, 0.0));
        let found = modes.tip[i];
        assert!(
            (tip.v[i] - found.v).abs() + (tip.w[i] - found.w).abs() + (tip.phi[i] - found.phi).abs() < 1e-14
        );
    }
    let mut clamped = uh60a();
    clamped.root = Root::Clamped;
    let held = BladeModes::new(&clamped, 27.0, 0.3, 4, 5).unwrap().at(blade.root_station);
    assert!(held.dv.iter().chain(&held.dw).all(|slope| *slope == 0.0));
    assert!(held.phi.iter().any(|phi| phi.abs() > 1e-3));
}

#[test]
fn wrong_data_are_refused_by_name() {
    let refusal = |change: &dyn Fn(&mut BladeProperties)| {
        let mut blade = uh60a();
        change(&mut blade);
        BladeModes::new(&blade, 27.0, 0.3, 4, 5).unwrap_err().to_string()
    };
    let cases: [(&str, &dyn Fn(&mut BladeProperties)); 10] = [
        ("structure.r_out[3]", &|b| b.structure.r_out[3] = 0.1),
        ("structure.r_in[7]", &|b| b.structure.r_in[7] = 0.4),
        ("structure.mass[5]", &|b| b.structure.mass[5] = -1.0),
        ("structure.ei_lag[2]", &|b| b.structure.ei_lag[2] = f64::NAN),
        ("structure.gj[0]", &|b| b.structure.gj[0] = 0.0),
        ("structure.x_cg", &|b| b.structure.x_cg.truncate(4)),
        ("open", &|b| b.radius = 9.0),
        ("open", &|b| b.structure.r_in[9] += 0.1),
        ("twist.x[1]", &|b| b.twist.x[1] = 0.0),
        ("radius", &|b| b.radius = f64::NAN),
    ];
    for (name, change) in cases {
        let message = refusal(change);
        assert!(message.contains(name), "{name}: {message}");
    }
    let too_many = BladeModes::new(&uh60a(), 27.0, 0.3, 1, 50).unwrap_err();
    assert!(matches!(too_many, BladeError::TooManyModes { asked: 50, n_elements: 1, .. }));
    assert!(BladeModes::new(&uh60a(), f64::NAN, 0.3, 4, 5).is_err());
    assert!(BladeModes::new(&uh60a(), 27.0, 0.3, 0, 5).is_err());
}
