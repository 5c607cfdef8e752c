//! Blades and reference tables of the beam tests.
#![allow(dead_code)]

use std::collections::HashMap;
use std::path::PathBuf;
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::section::{BladeProperties, Root, Structure};
use wakeflight::numerics::tables::Table;

/// Text of a file of reference data.
pub fn data(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/verification/data").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Rows of a CSV file with `#` comments, by column name.
pub fn csv(name: &str) -> Vec<HashMap<String, String>> {
    let text = data(name);
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let header: Vec<String> = lines.next().unwrap().split(',').map(str::to_string).collect();
    lines.map(|line| header.iter().cloned().zip(line.split(',').map(str::to_string)).collect()).collect()
}

/// Column `name` as numbers.
pub fn column(rows: &[HashMap<String, String>], name: &str) -> Vec<f64> {
    rows.iter().map(|row| row[name].parse().unwrap()).collect()
}

/// Numbers of `key` in `[section]` of a TOML file: one, or a list on one line.
pub fn toml(name: &str, section: &str, key: &str) -> Vec<f64> {
    let text = data(name);
    let mut inside = false;
    for line in text.lines().map(|line| line.split('#').next().unwrap().trim()) {
        if line.starts_with('[') {
            inside = line == format!("[{section}]");
        } else if let (true, Some((found, value))) = (inside, line.split_once('='))
            && found.trim() == key
        {
            let list = value.trim().trim_matches(['[', ']']);
            return list.split(',').map(|v| v.trim().parse().unwrap()).collect();
        }
    }
    panic!("{name}: no [{section}] {key}");
}

/// Uniform blade from `root` to `radius` of mass 1 kg/m, without rotary inertia, twist or offset, stiff in torsion.
pub fn uniform(hold: Root, root: f64, radius: f64, ei_flap: f64, ei_lag: f64) -> BladeProperties {
    let table = |y: f64| Table { x: vec![0.0], y: vec![y] };
    BladeProperties {
        root: hold,
        root_station: root,
        radius,
        root_cutout: root,
        structure: Structure {
            r_in: vec![root],
            r_out: vec![radius],
            mass: vec![1.0],
            ei_flap: vec![ei_flap],
            ei_lag: vec![ei_lag],
            gj: vec![1.0],
            i_theta: vec![0.0],
            x_cg: vec![0.0],
        },
        twist: table(0.0),
        chord: table(1.0),
        pitch_axis_chord_fraction: 0.25,
        control_stiffness: 1.0,
        km1_over_ktheta: 0.0,
        ka_over_ktheta: 0.0,
        structural_damping_ratio: 0.0,
        delta3: 0.0,
        precone: 0.0,
        flap_spring: 0.0,
        lag_spring: 0.0,
        flap_stops: None,
        lag_stops: None,
        rigid: false,
    }
}

/// The UH-60A blade with straight tip and the twist of its simulation model.
pub fn uh60a() -> BladeProperties {
    let rotor = |key: &str| toml("uh60a_blade.toml", "main_rotor", key)[0];
    let blade = |key: &str| toml("uh60a_blade.toml", "main_rotor.blade", key)[0];
    let rows = csv("blade_structure.csv");
    let twist = csv("blade_twist_genhel.csv");
    let radius = rotor("radius");
    BladeProperties {
        root: Root::Hinged,
        root_station: rotor("hinge_offset"),
        radius,
        root_cutout: rotor("root_cutout"),
        structure: Structure {
            r_in: column(&rows, "r_in_m"),
            r_out: column(&rows, "r_out_m"),
            mass: column(&rows, "mass_kg_m"),
            ei_flap: column(&rows, "EI_flap_Nm2"),
            ei_lag: column(&rows, "EI_lag_Nm2"),
            gj: column(&rows, "GJ_Nm2"),
            i_theta: column(&rows, "I_theta_cg_kgm"),
            x_cg: column(&rows, "x_cg_straight_m"),
        },
        twist: Table {
            x: column(&twist, "r_R").iter().map(|x| x * radius).collect(),
            y: column(&twist, "twist_deg").iter().map(|y| y.to_radians()).collect(),
        },
        chord: Table { x: vec![0.0], y: vec![rotor("chord")] },
        pitch_axis_chord_fraction: blade("pitch_axis_chord_fraction"),
        control_stiffness: blade("control_stiffness"),
        km1_over_ktheta: blade("km1_over_ktheta"),
        ka_over_ktheta: blade("kA_over_ktheta"),
        structural_damping_ratio: blade("structural_damping_ratio"),
        delta3: rotor("delta3"),
        precone: rotor("precone"),
        flap_spring: 0.0,
        lag_spring: 0.0,
        flap_stops: None,
        lag_stops: None,
        rigid: false,
    }
}

/// Motion that holds more than half of a mode's kinetic energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    Flap,
    Lag,
    Torsion,
}

/// Frequencies [rad/s] of the modes that are mostly `motion`, ascending.
pub fn mostly(modes: &BladeModes, motion: Motion) -> Vec<f64> {
    let share = |i: usize| match motion {
        Motion::Flap => modes.shares[i].flap,
        Motion::Lag => modes.shares[i].lag,
        Motion::Torsion => modes.shares[i].torsion,
    };
    (0..modes.n_modes).filter(|&i| share(i) > 0.5).map(|i| modes.frequency[i]).collect()
}

/// `value` within the fraction `tolerance` of `expected`.
#[track_caller]
pub fn assert_close(value: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (value - expected).abs();
    assert!(
        error <= tolerance * expected.abs(),
        "{what}: {value} against {expected}, {:.3e} of it off, allowed {tolerance:.1e}",
        error / expected.abs()
    );
}
