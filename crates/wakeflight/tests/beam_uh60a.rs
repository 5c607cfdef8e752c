//! The UH-60A blade: hinge formulas, independent uncoupled frequencies, and the coupled modes.

mod beam_support;

use beam_support::{Motion, assert_close, csv, mostly, uh60a};
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::section::BladeProperties;
use wakeflight::numerics::tables::Table;

const OMEGA: f64 = 27.0;
/// Mid collective stick without cyclic.
const REFERENCE_PITCH_DEG: f64 = 17.93;

fn uncoupled() -> BladeProperties {
    let mut blade = uh60a();
    blade.structure.x_cg.fill(0.0);
    blade.twist = Table { x: vec![0.0], y: vec![0.0] };
    blade
}

fn reference(mode: &str, column: &str) -> f64 {
    let rows = csv("blade_frequencies.csv");
    let row = rows.iter().find(|row| row["mode"].starts_with(mode)).unwrap();
    row[column].parse().unwrap()
}

/// Frequencies per rev of the modes that are mostly `motion`.
fn per_rev(modes: &BladeModes, motion: Motion) -> Vec<f64> {
    mostly(modes, motion).into_iter().map(|frequency| frequency / OMEGA).collect()
}

fn coupled(n_elements: usize, n_modes: usize) -> BladeModes {
    BladeModes::new(&uh60a(), OMEGA, REFERENCE_PITCH_DEG.to_radians(), n_elements, n_modes).unwrap()
}

#[test]
fn first_flap_and_lag_modes_obey_the_hinge_formulas() {
    for (blade, pitch) in [(uncoupled(), 0.0), (uh60a(), REFERENCE_PITCH_DEG.to_radians())] {
        for n_elements in [4, 12] {
            let modes = BladeModes::new(&blade, OMEGA, pitch, n_elements, 5).unwrap();
            let (flap, lag) = (per_rev(&modes, Motion::Flap)[0], per_rev(&modes, Motion::Lag)[0]);
            assert_close(flap, reference("flap 1", "analytic"), 5e-3, "flap 1");
            assert_close(lag, reference("lag 1", "analytic"), 3e-2, "lag 1");
        }
    }
}

#[test]
fn uncoupled_frequencies_equal_those_of_an_independent_finite_element_code() {
    let modes = BladeModes::new(&uncoupled(), OMEGA, 0.0, 44, 8).unwrap();
    let named = [
        ("lag 1", Motion::Lag, 0),
        ("flap 1", Motion::Flap, 0),
        ("flap 2", Motion::Flap, 1),
        ("torsion 1", Motion::Torsion, 0),
        ("lag 2", Motion::Lag, 1),
        ("flap 3", Motion::Flap, 2),
        ("flap 4", Motion::Flap, 3),
    ];
    for (name, motion, i) in named {
        let expected = reference(name, "FE_blade_structure_csv");
        let found = per_rev(&modes, motion)[i];
        println!("{name}: {found:.4} against {expected:.4} ({:+.3} %)", 100.0 * (found / expected - 1.0));
        assert_close(found, expected, 2e-3, name);
    }
}

#[test]
fn coupled_frequencies_report() {
    let plot = |name: &str| reference(name, "BD_fanplot");
    let fan = ["lag 1", "flap 1", "flap 2", "lag 2", "flap 3", "torsion 1", "flap 4"].map(plot);
    for n_elements in [4, 12] {
        for n_modes in [5, 7, 10] {
            let modes = coupled(n_elements, n_modes);
            println!("{n_elements} elements, {n_modes} modes, no torsion: {}", modes.no_torsion);
            for i in 0..n_modes {
                let (nu, share, tip) = (modes.frequency[i] / OMEGA, modes.shares[i], modes.tip[i]);
                let beside = fan.get(i).map_or(String::new(), |f| format!("fan plot {f:.3}"));
                println!(
                    "{:2} {nu:8.4}  flap {:.3} lag {:.3} torsion {:.3}  tip v {:+.5} w {:+.5} phi {:+.5}  {beside}",
                    i + 1, share.flap, share.lag, share.torsion, tip.v, tip.w, tip.phi
                );
            }
        }
    }
}
