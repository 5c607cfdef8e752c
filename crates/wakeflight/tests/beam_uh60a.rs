//! The UH-60A blade: hinge formulas, independent uncoupled frequencies, and the coupled modes.

mod beam_support;

use beam_support::{Motion, assert_close, csv, mostly, uh60a};
use wakeflight::blade::modes::BladeModes;
use wakeflight::blade::quadrature::gauss_points;
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
    // the reference has no tension on the area of the section
    let mut blade = uncoupled();
    blade.ka_over_ktheta = 0.0;
    let modes = BladeModes::new(&blade, OMEGA, 0.0, 44, 8).unwrap();
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
        assert_close(found, expected, 5e-3, name);
        // elements whose integrals break at every step are never too soft: the exact value lies below `found`, and the
        // reference, which smears the steps, above it
        assert!(found < expected * 1.0005, "{name}");
    }
}

/// Moment left over at the free tip of the stepped bar on its root spring, vibrating at `frequency` [rad/s].
fn torsion_at_tip(blade: &BladeProperties, frequency: f64) -> f64 {
    let s = &blade.structure;
    let (mut twist, mut moment, mut x) = (1.0, blade.control_stiffness, blade.root_station);
    for i in 0..s.r_in.len() {
        // a gap inboard has the next segment's stiffness and no inertia
        if x < s.r_in[i] {
            twist += moment * (s.r_in[i] - x) / s.gj[i];
            x = s.r_in[i];
        }
        let end = s.r_out[i].min(blade.radius);
        let difference = 1.0 - 2.0 * blade.km1_over_ktheta.powi(2);
        let inertia = s.i_theta[i] * (frequency.powi(2) - difference * OMEGA.powi(2));
        let (length, gj) = (end - x, s.gj[i]);
        if inertia <= 0.0 {
            assert_eq!(inertia, 0.0);
            twist += moment * length / gj;
        } else {
            let k = (inertia / gj).sqrt();
            let (sin, cos) = (k * length).sin_cos();
            (twist, moment) = (twist * cos + moment * sin / (k * gj), moment * cos - twist * sin * k * gj);
        }
        x = end;
    }
    moment
}

#[test]
fn uncoupled_torsion_equals_the_exact_solution_of_the_stepped_bar() {
    let mut blade = uncoupled();
    blade.ka_over_ktheta = 0.0;
    // GJ phi'' + (frequency^2 i - omega^2 (i_chord - i_flap)) phi = 0 in every segment
    let (mut low, mut high) = (4.0 * OMEGA, 5.5 * OMEGA);
    assert!(torsion_at_tip(&blade, low) > 0.0 && torsion_at_tip(&blade, high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if torsion_at_tip(&blade, middle) > 0.0 { low = middle } else { high = middle }
    }
    println!("stepped bar: {:.5}/rev", low / OMEGA);
    // steps of GJ inside an element are kinks its functions lack: first order until the mesh follows the table
    for (n_elements, tolerance) in [(4, 5e-3), (44, 1e-3), (132, 3e-4)] {
        let modes = BladeModes::new(&blade, OMEGA, 0.0, n_elements, 6).unwrap();
        let found = mostly(&modes, Motion::Torsion)[0];
        println!("{n_elements} elements: {:+.2e}", found / low - 1.0);
        assert_close(found, low, tolerance, &format!("{n_elements} elements"));
        assert!(found > low * (1.0 - 1e-9), "elements are too stiff, never too soft");
    }
}

#[test]
fn elements_that_end_at_the_steps_reach_the_stepped_bar() {
    let mut blade = uncoupled();
    blade.ka_over_ktheta = 0.0;
    let (n, root, tip) = (8, blade.root_station, blade.radius);
    let end = |i: usize| root + (tip - root) * i as f64 / n as f64;
    let s = &mut blade.structure;
    s.r_in = (0..n).map(end).collect();
    s.r_out = (1..=n).map(end).collect();
    for (list, step) in [
        (&mut s.mass, 1.0),
        (&mut s.ei_flap, 1e4),
        (&mut s.ei_lag, 1e5),
        (&mut s.gj, 3e4),
        (&mut s.i_theta, 0.02),
        (&mut s.x_cg, 0.0),
    ] {
        *list = (1..=n).map(|i| step * (1 + i * 3 % 5) as f64).collect();
    }
    let sign = |nu: f64| torsion_at_tip(&blade, nu * OMEGA) > 0.0;
    let (mut low, mut high) = (1.0001, 1.0001);
    while sign(high) {
        high += 0.01;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if sign(middle) { low = middle } else { high = middle }
    }
    for (n_elements, tolerance) in [(8, 1e-4), (16, 1e-5), (32, 1e-6)] {
        let modes = BladeModes::new(&blade, OMEGA, 0.0, n_elements, 8).unwrap();
        assert_close(per_rev(&modes, Motion::Torsion)[0], low, tolerance, &format!("{n_elements} elements"));
    }
}

#[test]
fn coupled_frequencies_converge_and_five_modes_hold_torsion() {
    let plot = |name: &str| reference(name, "BD_fanplot");
    let mut fan = ["lag 1", "flap 1", "flap 2", "lag 2", "flap 3", "torsion 1", "flap 4"].map(plot);
    fan.sort_by(f64::total_cmp);
    for n_elements in [4, 12] {
        let modes = coupled(n_elements, 10);
        println!("{n_elements} elements");
        for i in 0..10 {
            let (nu, share, tip) = (modes.frequency[i] / OMEGA, modes.shares[i], modes.tip[i]);
            let beside = fan.get(i).map_or(String::new(), |f| format!("fan plot {f:.3}"));
            println!(
                "{:2} {nu:8.4}  flap {:.3} lag {:.3} torsion {:.3}  tip v {:+.5} w {:+.5} phi {:+.5}  {beside}",
                i + 1,
                share.flap,
                share.lag,
                share.torsion,
                tip.v,
                tip.w,
                tip.phi
            );
        }
    }
    let (coarse, middle, fine) = (coupled(4, 5), coupled(12, 5), coupled(36, 5));
    for i in 0..5 {
        let above = |modes: &BladeModes| modes.frequency[i] / fine.frequency[i] - 1.0;
        println!(
            "mode {}: 4 elements {:+.2e}, 12 elements {:+.2e} of 36 elements",
            i + 1,
            above(&coarse),
            above(&middle)
        );
        assert!(above(&coarse) < 5e-3 && above(&middle) < 3e-3, "mode {i}");
        // every finer mesh holds the functions of the coarser
        assert!(above(&middle) > -1e-9 && above(&coarse) >= above(&middle) - 1e-9, "mode {i}");
    }
    assert!(!coarse.no_torsion && coupled(4, 4).no_torsion);
    assert!(coarse.frequency.is_sorted());
}

#[test]
fn pieces_cover_the_blade_and_its_mass_is_that_of_the_table() {
    // the integrals printed with the table run to its end
    let mut blade = uh60a();
    blade.radius = 8.1787;
    let pieces = BladeModes::new(&blade, OMEGA, 0.3, 4, 5).unwrap().pieces();
    assert_eq!((pieces[0].0, pieces[pieces.len() - 1].1), (blade.root_station, blade.radius));
    assert!(pieces.windows(2).all(|pair| pair[0].1 == pair[1].0));
    let hinge = blade.root_station;
    let moment = |power: i32| -> f64 {
        let part = |&(a, b, segment): &(f64, f64, usize)| {
            let points = gauss_points(3, a, b);
            points
                .into_iter()
                .map(|(x, dx)| dx * blade.section(segment, x).mass * (x - hinge).powi(power))
                .sum::<f64>()
        };
        pieces.iter().map(part).sum()
    };
    assert_close(moment(0), 118.89, 5e-5, "mass");
    assert_close(moment(1), 386.4, 1e-4, "first moment");
    assert_close(moment(2), 2052.2, 3e-5, "second moment");
    assert_eq!(blade.section(0, 0.382).mass, 0.0);
    assert_eq!(blade.section(0, 0.382).gj, blade.structure.gj[0]);
}
