//! Springs at the hinges of a blade, against closed forms.

mod beam_support;

use beam_support::{Motion, mostly, uniform};
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::section::{BladeProperties, Root};

const OMEGA: f64 = 27.0;
const RADIUS: f64 = 8.0;

/// Blade of 1 kg/m that turns rigidly about a hinge at `e` R.
fn rigid(root: Root, e: f64) -> BladeProperties {
    let mut blade = uniform(root, e * RADIUS, RADIUS, 1.0, 1.0);
    blade.rigid = true;
    blade
}

fn inertia(e: f64) -> f64 {
    ((1.0 - e) * RADIUS).powi(3) / 3.0
}

/// nu_flap^2 = 1 + 3 e/(2 (1 - e)) + K/(I Omega^2), nu_lag^2 = 3 e/(2 (1 - e)) + K/(I Omega^2).
#[test]
fn a_rigid_blade_has_the_frequencies_of_its_offset_and_its_springs() {
    for e in [0.0, 0.05, 0.15] {
        for (flap, lag) in [(0.0, 4e3), (3e4, 1e4), (1e4, 5e4)] {
            let mut blade = rigid(Root::Hinged, e);
            (blade.flap_spring, blade.lag_spring) = (flap, lag);
            let offset = 1.5 * e / (1.0 - e);
            let over = inertia(e) * OMEGA * OMEGA;
            let mut expected = [1.0 + offset + flap / over, offset + lag / over].map(f64::sqrt);
            expected.sort_by(f64::total_cmp);
            let found = BladeModes::new(&blade, OMEGA, 0.3, 4, 2).unwrap().frequency;
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    (found / OMEGA / expected - 1.0).abs() < 1e-9,
                    "{e} {flap} {lag}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_blade_without_lag_hinge_has_the_flap_frequency_alone() {
    let mut blade = rigid(Root::Flapping, 0.05);
    blade.flap_spring = 2e4;
    let expected = (1.0 + 1.5 * 0.05 / 0.95 + 2e4 / (inertia(0.05) * OMEGA * OMEGA)).sqrt();
    let modes = BladeModes::new(&blade, OMEGA, 0.0, 4, 1).unwrap();
    assert!((modes.frequency[0] / OMEGA / expected - 1.0).abs() < 1e-9);
    assert!(BladeModes::new(&blade, OMEGA, 0.0, 4, 2).is_err());
}

/// At rest, with k = K L/EI: k (1 + cos b cosh b) = b (sin b cosh b - cos b sinh b), frequency (b/L)^2 sqrt(EI/m).
#[test]
fn an_elastic_beam_on_a_spring_has_the_frequencies_of_the_characteristic_equation() {
    let (length, ei) = (6.0, 500.0);
    for k in [0.1, 1.0, 20.0] {
        let mut blade = uniform(Root::Hinged, 0.0, length, ei, 1e7);
        (blade.flap_spring, blade.lag_spring) = (k * ei / length, 1e6);
        let f = |b: f64| k * (1.0 + b.cos() * b.cosh()) - b * (b.sin() * b.cosh() - b.cos() * b.sinh());
        let mut roots = Vec::new();
        let mut b = 1e-3;
        while roots.len() < 3 {
            let (mut low, mut high) = (b, b + 0.01);
            if f(low) * f(high) < 0.0 {
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
                }
                roots.push(low);
            }
            b += 0.01;
        }
        let found = mostly(&BladeModes::new(&blade, 0.0, 0.0, 24, 5).unwrap(), Motion::Flap);
        for (found, root) in found.iter().zip(roots) {
            let expected = (root / length).powi(2) * ei.sqrt();
            assert!((found / expected - 1.0).abs() < 1e-5, "k {k}: {found} {expected}");
        }
    }
}

#[test]
fn a_spring_where_there_is_no_hinge_or_of_negative_stiffness_is_refused() {
    for (root, flap, lag, field) in [
        (Root::Clamped, 1.0, 0.0, "flap_spring"),
        (Root::Clamped, 0.0, 1.0, "lag_spring"),
        (Root::Flapping, 0.0, 1.0, "lag_spring"),
        (Root::Hinged, -1.0, 0.0, "flap_spring"),
        (Root::Hinged, 0.0, f64::NAN, "lag_spring"),
    ] {
        let mut blade = uniform(root, 0.5, RADIUS, 1e5, 1e6);
        (blade.flap_spring, blade.lag_spring) = (flap, lag);
        let error = BladeModes::new(&blade, OMEGA, 0.0, 4, 2).unwrap_err().to_string();
        assert!(error.contains(field), "{error}");
    }
}
