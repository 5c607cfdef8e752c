//! Local velocity of a curved filament.

/// Self-induced velocity of the arc through three neighbouring nodes that its two chords lack [m/s].
pub fn curvature_velocity(prev: [f64; 3], here: [f64; 3], next: [f64; 3], circulation: f64, core_radius: f64) -> [f64; 3] {
    const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;
    let a = [here[0] - prev[0], here[1] - prev[1], here[2] - prev[2]];
    let b = [next[0] - here[0], next[1] - here[1], next[2] - here[2]];
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let norm = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let sum = [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let (la, lb, lc, ls) = (norm(a), norm(b), norm(cross), norm(sum));
    let denominator = la * lb * ls;
    if !(denominator > 0.0 && lc > 1e-12 * la * lb && core_radius > 0.0) {
        return [0.0; 3];
    }
    let curvature = 2.0 * lc / denominator;
    let bracket = ((2.0 * (la * lb).sqrt() / core_radius).ln() - EULER_GAMMA).max(0.0);
    let speed = circulation * curvature / (4.0 * std::f64::consts::PI) * bracket / lc;
    [cross[0] * speed, cross[1] * speed, cross[2] * speed]
}
