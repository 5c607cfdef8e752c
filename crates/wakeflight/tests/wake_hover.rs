//! Free wake in hover by relaxation: momentum balance, contraction, symmetry, response to pitch and roll rate.

mod wake_cases;
use wake_cases::*;
use wakeflight::wake::RelaxationWake;

const CT: f64 = 0.006;

fn hover(p: f64, q: f64, tolerance: f64) -> RelaxationWake {
    let options = hover_options();
    let mut wake = relaxation(&options, hub(0.0, 0.0, p, q, 0.0), CT, (0.5 * CT).sqrt());
    let sweeps = settle(&mut wake, tolerance, 250);
    println!("{sweeps} sweeps");
    wake
}

#[test]
fn verif_hover_inflow_obeys_momentum() {
    let mut wake = hover(0.0, 0.0, 1e-4);
    let map = wake.inflow_far();
    let mean = harmonics(wake.grid(), &map)[0];
    let momentum = (0.5 * CT).sqrt();
    println!("mean inflow {mean}, momentum theory {momentum}");
    assert!((mean / momentum - 1.0).abs() < 0.03);

    // contraction at one turn, and descent of the second half turn on
    let marker = wake.position()[36];
    let radius = marker[0].hypot(marker[1]) / RADIUS;
    let slope = (wake.position()[72][2] - wake.position()[36][2]) / RADIUS / std::f64::consts::TAU;
    let k2 = -1.41 * (0.5 * CT).sqrt();
    println!("r/R at 360 deg {radius}, slope {slope}, of k2 {}", slope / k2);
    let landgrebe = 0.78 + 0.22 * (-(0.145 + 27.0 * CT) * std::f64::consts::TAU).exp();
    assert!((radius - landgrebe).abs() < 0.03);
    assert!((0.55..1.1).contains(&(slope / k2)));
}

#[test]
fn verif_hovering_blades_are_alike() {
    // equal blades in hover: every row is the first one turned
    let options = hover_options();
    let mut wake = relaxation(&options, hub(0.0, 0.0, 0.0, 0.0, 0.0), CT, (0.5 * CT).sqrt());
    wake.sweep(20).unwrap();
    let n_k = options.n_segments() + 1;
    let mut largest: f64 = 0.0;
    for l in 0..36 {
        let (sin, cos) = (std::f64::consts::TAU * l as f64 / 36.0).sin_cos();
        for k in 0..n_k {
            let (p, q) = (wake.position()[k], wake.position()[l * n_k + k]);
            let turned = [p[0] * cos - p[1] * sin, p[0] * sin + p[1] * cos, p[2]];
            largest = (0..3).fold(largest, |m, c| m.max((turned[c] - q[c]).abs() / RADIUS));
        }
    }
    println!("largest difference {largest} R");
    assert!(largest < 1e-10);
}

#[test]
fn verif_pitch_rate_moves_the_downwash_aft_and_roll_rate_to_the_right() {
    let rate = 0.01;
    let level = {
        let mut wake = hover(0.0, 0.0, 2e-5);
        let map = wake.inflow_far();
        harmonics(wake.grid(), &map)
    };
    let slopes = |p: f64, q: f64| {
        let mut wake = hover(p, q, 2e-5);
        let map = wake.inflow_far();
        let h = harmonics(wake.grid(), &map);
        [(h[1] - level[1]) / rate, (h[2] - level[2]) / rate]
    };
    let pitch = slopes(0.0, rate);
    let roll = slopes(rate, 0.0);
    println!("d(lambda_1c, lambda_1s)/dq = {pitch:?}, /dp = {roll:?}");
    assert!((0.35..0.65).contains(&pitch[0]), "{pitch:?}");
    assert!((roll[1] - pitch[0]).abs() < 0.01 && (roll[0] + pitch[1]).abs() < 0.01, "{pitch:?} {roll:?}");
}
