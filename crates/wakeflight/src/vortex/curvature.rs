//! Local self-induction of a curved filament, which its straight segments leave out.

use super::induced_velocity::Filaments;
use std::collections::HashMap;

/// Velocity that the curvature of a filament induces at its node `here`, between `prev` and `next` [m/s].
///
/// On the circle through the three nodes, a = here - prev, b = next - here, kappa its curvature, n the unit of a x b:
/// v = circulation kappa / (4 pi) max(0, ln(2 sqrt(|a| |b|) / core_radius) - gamma_E) n, gamma_E Euler's constant.
///
/// This is what a node of a polygon, which gets nothing from its two own segments, lacks to the self-induced speed of a thin
/// vortex ring with the n = 2 core, circulation / (4 pi R) (ln(8 R / core_radius) - 1/2). Add it to the sum over the other
/// segments with the core distance to the segment.
/// Zero where the nodes lie on a line or coincide, and for `core_radius` = 0, where it has no bound.
/// Not modelled: other core profiles, whose constants differ.
#[must_use]
pub fn curvature_velocity(
    prev: [f64; 3],
    here: [f64; 3],
    next: [f64; 3],
    circulation: f64,
    core_radius: f64,
) -> [f64; 3] {
    let a = [here[0] - prev[0], here[1] - prev[1], here[2] - prev[2]];
    let b = [next[0] - here[0], next[1] - here[1], next[2] - here[2]];
    let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let chords = length(a) * length(b) * length([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
    if chords == 0.0 || core_radius <= 0.0 {
        return [0.0; 3];
    }
    let bracket = (2.0 * (length(a) * length(b)).sqrt() / core_radius).ln() - EULER_GAMMA;
    // kappa n = 2 a x b / (|a| |b| |a + b|)
    let factor = circulation / (2.0 * std::f64::consts::PI * chords) * bracket.max(0.0);
    normal.map(|c| factor * c)
}

/// Adds what the curvature of their filament induces at those of the `points` that are inner nodes of one, to the last bit of their
/// coordinates [m/s]; circulation and square of the core radius there the means of the two segments that meet.
pub fn add_curvature_velocity(points: &[[f64; 3]], filaments: &Filaments, velocity: &mut [[f64; 3]]) {
    let place = |p: &[f64; 3]| p.map(|c| (c + 0.0).to_bits());
    let mut at: HashMap<[u64; 3], Vec<usize>> = HashMap::new();
    for (i, point) in points.iter().enumerate() {
        at.entry(place(point)).or_default().push(i);
    }
    let (mut node, mut segment) = (0, 0);
    for &n in &filaments.n_nodes {
        for k in 1..n.saturating_sub(1) {
            let Some(found) = at.get(&place(&filaments.nodes[node + k])) else { continue };
            let [before, after] = [segment + k - 1, segment + k];
            let circulation = 0.5 * (filaments.circulation[before] + filaments.circulation[after]);
            let [a, b] = [before, after].map(|s| filaments.core_radius[s].powi(2));
            let [prev, here, next] = [k - 1, k, k + 1].map(|k| filaments.nodes[node + k]);
            let local = curvature_velocity(prev, here, next, circulation, (0.5 * (a + b)).sqrt());
            for &i in found {
                velocity[i].iter_mut().zip(local).for_each(|(v, more)| *v += more);
            }
        }
        node += n;
        segment += n.saturating_sub(1);
    }
}

const EULER_GAMMA: f64 = 0.577_215_664_901_532_9;
