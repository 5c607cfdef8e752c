//! Verification of the beam elements against published and closed-form frequencies.

mod beam_support;

use beam_support::{Motion, assert_close, csv, mostly, toml, uniform};
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::section::{BladeProperties, Root};
use wakeflight::numerics::tables::Table;

fn modes(blade: &BladeProperties, omega: f64, n_elements: usize, n_modes: usize) -> BladeModes {
    BladeModes::new(blade, omega, 0.0, n_elements, n_modes).unwrap()
}

/// Flap frequencies of the unit uniform beam without hub radius at speed eta.
fn rotating_beam(root: Root, eta: f64, n_elements: usize, n: usize) -> Vec<f64> {
    // in-plane stiffness far up: but for the lag hinge the first modes are flap
    let blade = uniform(root, 0.0, 1.0, 1.0, 1e4);
    let all = modes(&blade, eta, n_elements, n + 1);
    let mut flap = mostly(&all, Motion::Flap);
    flap.truncate(n);
    flap
}

#[test]
fn rotating_uniform_beam_with_four_elements_has_the_published_flap_frequencies() {
    for row in csv("B01_rotating_beam.csv") {
        let root = if row["root"] == "clamped" { Root::Clamped } else { Root::Hinged };
        let eta: f64 = row["eta"].parse().unwrap();
        let found = rotating_beam(root, eta, 4, 3);
        for (i, tolerance) in [1e-3, 5e-3, 2e-2].into_iter().enumerate() {
            let expected: f64 = row[&format!("mu{}", i + 1)].parse().unwrap();
            let what = format!("{} eta {eta} mode {}", row["root"], i + 1);
            if expected == 0.0 {
                assert!(found[i] < 1e-6, "{what}: {}", found[i]);
            } else {
                assert_close(found[i], expected, tolerance, &what);
            }
        }
    }
}

#[test]
fn rotating_uniform_beam_converges_with_the_number_of_elements() {
    // error of cubic elements falls with the fourth power of their length
    let row = csv("B01_rotating_beam.csv").into_iter().find(|r| r["eta"] == "6").unwrap();
    for mode in 1..=4 {
        let expected: f64 = row[&format!("mu{mode}")].parse().unwrap();
        let error = |n: usize| rotating_beam(Root::Clamped, 6.0, n, 4)[mode - 1] / expected - 1.0;
        let (coarse, middle, fine) = (error(6), error(12), error(24));
        // halving the elements must divide by nearly 16; six printed decimals bound what the finest can show
        let printed = 1e-6 / expected;
        assert!(middle > 0.0 && middle < coarse / 12.0 + printed, "mode {mode}: {coarse:e} {middle:e}");
        assert!(fine.abs() < middle / 12.0 + printed, "mode {mode}: {middle:e} {fine:e}");
    }
}

#[test]
fn in_plane_frequency_squared_is_the_out_of_plane_one_less_rotor_speed_squared() {
    let (flap, lag) =
        (uniform(Root::Clamped, 0.0, 1.0, 1.0, 1e4), uniform(Root::Clamped, 0.0, 1.0, 1e4, 1.0));
    let flap = mostly(&modes(&flap, 6.0, 6, 4), Motion::Flap);
    let lag = mostly(&modes(&lag, 6.0, 6, 4), Motion::Lag);
    for i in 0..3 {
        assert_close(lag[i] * lag[i], flap[i] * flap[i] - 36.0, 1e-9, &format!("mode {}", i + 1));
    }
}

#[test]
fn frequency_squared_rises_with_speed_at_the_southwell_slope_and_then_less() {
    let k1 = toml("B03_closed_form_blade.toml", "southwell", "K1_clamped")[0];
    let k2 = toml("B03_closed_form_blade.toml", "southwell", "K2_clamped")[0];
    let at_rest = rotating_beam(Root::Clamped, 0.0, 12, 2);
    for (i, k) in [k1, k2].into_iter().enumerate() {
        // slope at vanishing speed, then the bound at high speed
        let rise = |eta: f64| rotating_beam(Root::Clamped, eta, 12, 2)[i].powi(2) - at_rest[i].powi(2);
        assert_close(rise(0.1) / 0.01, k, 1e-3, &format!("slope {}", i + 1));
        // the shape at rest is not the best one at speed
        assert!(rise(12.0) < k * 144.0);
    }
    // Southwell's bound from below: beam at rest plus string, whose lowest frequency is the rotor speed
    for eta in [1.0, 12.0] {
        let squared = rotating_beam(Root::Clamped, eta, 12, 1)[0].powi(2);
        assert!(squared > at_rest[0].powi(2) + eta * eta);
    }
}

#[test]
fn flap_and_lag_couple_through_pitch_and_twist() {
    for row in csv("B02_flap_lag_coupled.csv") {
        let number = |key: &str| -> f64 { row[key].parse().unwrap() };
        let twist = number("twist_deg").to_radians();
        let mut blade = uniform(Root::Clamped, 0.0, 1.0, number("EIy"), number("EIz"));
        blade.twist = Table { x: vec![0.0, 1.0], y: vec![-0.75 * twist, 0.25 * twist] };
        let pitch = number("theta75_deg").to_radians();
        let what = format!("{} pitch {} twist {}", row["case"], row["theta75_deg"], row["twist_deg"]);
        let four = BladeModes::new(&blade, 1.0, pitch, 4, 3).unwrap();
        for (i, tolerance) in [3e-3, 3e-3, 1e-2].into_iter().enumerate() {
            let expected = number(&format!("w{}", i + 1));
            assert_close(four.frequency[i], expected, tolerance, &format!("{what} mode {}", i + 1));
        }
        let fine = BladeModes::new(&blade, 1.0, pitch, 12, 5).unwrap();
        for i in 0..5 {
            let expected = number(&format!("w{}", i + 1));
            assert_close(fine.frequency[i], expected, 2e-4, &format!("{what} fine mode {}", i + 1));
        }
        for i in 0..2 {
            let expected = number(&format!("flap_fraction_{}", i + 1));
            assert!((fine.shares[i].flap - expected).abs() < 1.5e-3, "{what}: {:?}", fine.shares[i]);
        }
    }
}

#[test]
fn rigid_articulated_blade_has_the_hinge_frequencies() {
    let file = "B03_closed_form_blade.toml";
    let list = |key: &str| toml(file, "articulated_uniform_rigid", key);
    for ((e, flap), lag) in list("e").into_iter().zip(list("nu_flap")).zip(list("nu_lag")) {
        // at stiffness 1e3 the elastic part of the first modes is below 1e-7
        let blade = uniform(Root::Hinged, e, 1.0, 1e3, 1e3);
        let found = modes(&blade, 1.0, 1, 2);
        assert_close(mostly(&found, Motion::Lag)[0], lag, 1e-6, &format!("lag e {e}"));
        assert_close(mostly(&found, Motion::Flap)[0], flap, 1e-6, &format!("flap e {e}"));
    }
    let zero = |key: &str| toml(file, "hinged_rigid_mode", key)[0];
    for ei in [1e-3, 1.0] {
        let found = modes(&uniform(Root::Hinged, 0.0, 1.0, ei, ei), 1.0, 4, 2);
        assert!((found.frequency[0] - zero("lag_zero_offset")).abs() < 1e-6, "{}", found.frequency[0]);
        assert_close(found.frequency[1], zero("flap_zero_offset"), 1e-9, "flap without offset");
    }
}

#[test]
fn elastic_articulated_blade_has_the_computed_flap_and_lag_frequencies() {
    let list = |key: &str| toml("B03_closed_form_blade.toml", "articulated_elastic", key);
    for (i, ei) in list("EI").into_iter().enumerate() {
        let found = modes(&uniform(Root::Hinged, 0.0466, 1.0, ei, ei), 1.0, 8, 6);
        let (flap, lag) = (mostly(&found, Motion::Flap), mostly(&found, Motion::Lag));
        for mode in 0..3 {
            assert_close(
                flap[mode],
                list(&format!("flap_{}", mode + 1))[i],
                1e-3,
                &format!("flap {mode} EI {ei}"),
            );
        }
        for mode in 0..2 {
            assert_close(
                lag[mode],
                list(&format!("lag_{}", mode + 1))[i],
                1e-3,
                &format!("lag {mode} EI {ei}"),
            );
        }
    }
}

#[test]
fn uniform_torsion_rises_by_the_propeller_moment() {
    let value = |key: &str| toml("B03_closed_form_blade.toml", "torsion_uniform_clamped", key)[0];
    let mut blade = uniform(Root::Clamped, 0.0, 1.0, 1e4, 1e4);
    blade.structure.gj = vec![value("GJ_over_mO2R4")];
    blade.structure.i_theta = vec![value("km_over_R").powi(2)];
    blade.control_stiffness = 1e6;
    for (omega, key) in [(0.0, "omega_nonrotating_per_rev"), (1.0, "omega_rotating_per_rev")] {
        let found = mostly(&modes(&blade, omega, 4, 3), Motion::Torsion)[0];
        assert_close(found, value(key), 1e-4, key);
        assert_close(mostly(&modes(&blade, omega, 12, 3), Motion::Torsion)[0], value(key), 1e-6, key);
    }
    // tension on a section of finite area: + omega^2 k_A^2 int T phi'^2 over m k_m^2 int phi^2, for phi = sin(pi x/2)
    blade.ka_over_ktheta = 1.0;
    let pi = std::f64::consts::PI;
    let bifilar = pi * pi / 4.0 * (1.0 / 3.0 + 1.0 / (pi * pi));
    let found = mostly(&modes(&blade, 1.0, 12, 3), Motion::Torsion)[0];
    let expected = (value("omega_rotating_per_rev").powi(2) + bifilar).sqrt();
    assert_close(found, expected, 1e-3, "with tension on the section");
}

#[test]
fn mass_axis_off_the_elastic_axis_couples_bending_and_torsion() {
    // wing of Goland: offset and inertia about the elastic axis
    for sign in [1.0, -1.0] {
        let (length, mass, offset) = (6.096, 35.75, 0.183);
        let mut blade = uniform(Root::Clamped, 0.0, length, 9.77e6, 1e11);
        blade.structure.mass = vec![mass];
        blade.structure.gj = vec![0.987e6];
        blade.structure.x_cg = vec![sign * offset];
        blade.structure.i_theta = vec![8.65 - mass * offset * offset];
        blade.control_stiffness = 1e12;
        let found = modes(&blade, 0.0, 8, 5);
        for (i, row) in csv("B04_goland_bending_torsion.csv").into_iter().enumerate() {
            let expected = row["omega_rad_s"].parse().unwrap();
            assert_close(found.frequency[i], expected, 2e-3, &format!("mode {}", i + 1));
        }
    }
}
