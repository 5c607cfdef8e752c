//! Influence of a row of bound vortices and of its trailers on control points, per unit circulation of each element.

use super::choices::CoreDistance;
use crate::vortex::core::Core;
use crate::vortex::induced_velocity::add_each_velocity;
use crate::vortex::sources::{Part, Sources};

/// Velocity along -`up` at the control points per unit circulation of each element, row-major (n, n) [1/m].
///
/// * `trailers` (n + 1): nodes of each trailer from its edge on the bound line downstream;
/// * `cores` (n + 1) [m]: radius of the solid core of each trailer, 0 for none;
/// * `with_bound`: whether the bound elements between the first nodes of the trailers count.
///
/// An element of circulation Gamma_j feeds the trailer at its outer edge and takes from that at its inner edge.
pub fn influence(
    trailers: &[Vec<[f64; 3]>],
    cores: &[f64],
    control: &[[f64; 3]],
    up: [f64; 3],
    with_bound: bool,
) -> Vec<f64> {
    let n = control.len();
    let mut sources = Sources::default();
    let mut marks = vec![sources.mark()];
    for (nodes, core) in trailers.iter().zip(cores) {
        for ends in nodes.windows(2) {
            sources.push(ends[0], ends[1], 1.0, *core);
        }
        marks.push(sources.mark());
    }
    if with_bound {
        for j in 0..n {
            sources.push(trailers[j][0], trailers[j + 1][0], 1.0, 0.0);
            marks.push(sources.mark());
        }
    }
    let parts: Vec<Part<'_>> = marks.windows(2).map(|ends| sources.part(ends[0], ends[1])).collect();
    let mut velocity = vec![[0.0; 3]; parts.len() * n];
    add_each_velocity(control, &parts, Core::Rankine, CoreDistance::Line.into(), &mut velocity);
    let mut matrix = vec![0.0; n * n];
    for (line, velocity) in velocity.chunks_exact(n.max(1)).enumerate() {
        for (row, v) in matrix.chunks_exact_mut(n.max(1)).zip(velocity) {
            let w = -(v[0] * up[0] + v[1] * up[1] + v[2] * up[2]);
            match line.checked_sub(trailers.len()) {
                Some(bound) => row[bound] += w,
                None => {
                    if line > 0 {
                        row[line - 1] += w;
                    }
                    if line < n {
                        row[line] -= w;
                    }
                }
            }
        }
    }
    matrix
}
