//! Circulation of a blade solved together with its near wake.

use super::error::{WakeError, finite, length};
use nalgebra::{DMatrix, DVector};

/// Most Newton iterations.
const MAX_ITERATIONS: usize = 40;
/// Most halvings of one step.
const MAX_HALVINGS: usize = 10;
/// Most consecutive steps without descent (kinks of section tables).
const MAX_FAILURES: usize = 3;

/// Solution of the circulation and the near wake.
#[derive(Clone, Debug, PartialEq)]
pub struct CirculationSolution {
    /// Circulation (n_stations) [m2/s].
    pub gamma: Vec<f64>,
    /// Induced inflow that belongs to it, near wake included (n_stations).
    pub inflow: Vec<f64>,
    /// Largest |gamma_section - gamma| [m2/s].
    pub residual: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// Whether the residual is below the tolerance; otherwise this is the best iterate.
    pub converged: bool,
}

/// One evaluation: inflow, section circulation and slopes at `gamma`.
#[derive(Clone)]
struct Iterate {
    gamma: DVector<f64>,
    inflow: DVector<f64>,
    defect: DVector<f64>,
    slope: Vec<f64>,
    residual: f64,
}

/// Solves Gamma_i = Gamma_section,i(lambda_far,i + sum_j N_ij Gamma_j) for one blade.
///
/// * `lambda_far` (n) [-]: inflow at the stations without the near wake of the own blade;
/// * `n_matrix` (n, n) row-major [s/m2]: see [`near_wake_matrix`](super::near_wake_matrix);
/// * `section(lambda, gamma, dgamma_dlambda)`: circulation of the sections [m2/s] and its slope [m2/s];
/// * `gamma_start` (n) [m2/s]: start;
/// * `slope_floor` (n) [m2/s]: least slope of the linearisation, -3 chord omega R. (Gamma = V c C_l / 2 and
///   d alpha/d lambda = -omega R/V give -C_l_alpha/2 chord omega R, about -pi chord omega R for a thin section.)
///   Slopes are clipped to [floor, 0];
/// * `tolerance` [m2/s], for example 1e-8 omega R^2.
///
/// Newton steps (I - S N) dGamma = Gamma_section - Gamma, halved while the residual grows; where they fail from the
/// start given, once more from the circulation that sections of the far inflow's slope would have: a wide blade's start
/// without near wake stalls its tip, and Newton does not come back from there. Values of `section` that are
/// not finite are treated as an infinite residual and never accepted.
pub fn solve_circulation(
    lambda_far: &[f64],
    n_matrix: &[f64],
    mut section: impl FnMut(&[f64], &mut [f64], &mut [f64]),
    gamma_start: &[f64],
    slope_floor: &[f64],
    tolerance: f64,
) -> Result<CirculationSolution, WakeError> {
    let n = lambda_far.len();
    length("n_matrix", n_matrix.len(), n * n)?;
    length("gamma_start", gamma_start.len(), n)?;
    length("slope_floor", slope_floor.len(), n)?;
    finite("lambda_far", lambda_far)?;
    finite("n_matrix", n_matrix)?;
    finite("gamma_start", gamma_start)?;
    finite("slope_floor", slope_floor)?;
    let near = DMatrix::from_row_slice(n, n, n_matrix);
    let far = DVector::from_column_slice(lambda_far);

    let mut evaluate = |gamma: DVector<f64>| {
        let inflow = &far + &near * &gamma;
        let mut from_section = vec![0.0; n];
        let mut slope = vec![0.0; n];
        section(inflow.as_slice(), &mut from_section, &mut slope);
        let defect = DVector::from_vec(from_section) - &gamma;
        let usable = defect.iter().chain(&slope).all(|v| v.is_finite());
        let residual = if usable { defect.amax() } else { f64::INFINITY };
        for (s, floor) in slope.iter_mut().zip(slope_floor) {
            *s = s.max(*floor).min(0.0);
        }
        Iterate { gamma, inflow, defect, slope, residual }
    };

    let mut best = descend(&mut evaluate, &near, DVector::from_column_slice(gamma_start), tolerance);
    if best.0.residual > tolerance {
        let flat = evaluate(DVector::zeros(n));
        if let Some(linear) = newton_step(&flat, &near) {
            let again = descend(&mut evaluate, &near, linear, tolerance);
            if again.0.residual < best.0.residual {
                best = (again.0, best.1 + again.1);
            }
        }
    }
    let (found, iterations) = best;
    Ok(CirculationSolution {
        gamma: found.gamma.as_slice().to_vec(),
        inflow: found.inflow.as_slice().to_vec(),
        converged: found.residual <= tolerance,
        residual: found.residual,
        iterations,
    })
}

/// (I - S N)^-1 (Gamma_section - Gamma), if it exists.
fn newton_step(here: &Iterate, near: &DMatrix<f64>) -> Option<DVector<f64>> {
    let n = here.gamma.len();
    let mut jacobian = DMatrix::identity(n, n);
    for i in 0..n {
        for j in 0..n {
            jacobian[(i, j)] -= here.slope[i] * near[(i, j)];
        }
    }
    let step = jacobian.lu().solve(&here.defect)?;
    step.iter().all(|v| v.is_finite()).then_some(step)
}

/// Damped Newton from `start`: the best iterate and the number of iterations.
fn descend(
    evaluate: &mut impl FnMut(DVector<f64>) -> Iterate,
    near: &DMatrix<f64>,
    start: DVector<f64>,
    tolerance: f64,
) -> (Iterate, usize) {
    let mut here = evaluate(start);
    let mut best = here.clone();
    let mut iterations = 0;
    let mut failures = 0;
    while best.residual > tolerance
        && here.residual.is_finite()
        && iterations < MAX_ITERATIONS
        && failures < MAX_FAILURES
    {
        iterations += 1;
        let Some(step) = newton_step(&here, near) else { break };
        let mut fraction = 1.0;
        let mut candidate = evaluate(&here.gamma + &step);
        for _ in 0..MAX_HALVINGS {
            if candidate.residual < here.residual {
                break;
            }
            fraction *= 0.5;
            let shorter = evaluate(&here.gamma + &step * fraction);
            if shorter.residual < candidate.residual {
                candidate = shorter;
            }
        }
        if candidate.residual < here.residual {
            failures = 0;
        } else {
            failures += 1;
        }
        here = candidate;
        if here.residual < best.residual {
            best = here.clone();
        }
    }
    (best, iterations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::near_wake::near_wake_matrix;
    use crate::wake::options::{BladeState, HubMotion, WakeOptions};

    fn rotor() -> (WakeOptions, Vec<f64>) {
        let options = WakeOptions::new(4, 8.0, 1.5, 0.4, 0.5, 27.0);
        let matrix = near_wake_matrix(&options, &HubMotion::default(), &BladeState::default()).unwrap();
        (options, matrix)
    }

    #[test]
    fn thin_sections_are_solved_in_one_step() {
        // Gamma = k (alpha0 - lambda): linear, (1 + k N) Gamma = k (alpha0 - lambda_far)
        let (options, matrix) = rotor();
        let n = options.n_stations;
        let slope = 2.9 * options.chord * options.tip_speed();
        let far = vec![0.05; n];
        let section = |lambda: &[f64], gamma: &mut [f64], derivative: &mut [f64]| {
            for i in 0..n {
                gamma[i] = slope * (0.12 - lambda[i]);
                derivative[i] = -slope;
            }
        };
        let floor = vec![-3.0 * options.chord * options.tip_speed(); n];
        let solution = solve_circulation(&far, &matrix, section, &vec![0.0; n], &floor, 1e-9).unwrap();
        assert!(solution.converged && solution.iterations <= 2, "{solution:?}");
        for i in 0..n {
            let near: f64 = (0..n).map(|j| matrix[i * n + j] * solution.gamma[j]).sum();
            assert!((solution.gamma[i] - slope * (0.12 - 0.05 - near)).abs() < 1e-8);
            assert!((solution.inflow[i] - 0.05 - near).abs() < 1e-12);
        }
        // free edges: less circulation toward tip and root than in the middle
        let crest = solution.gamma.iter().fold(0.0f64, |m, g| m.max(*g));
        assert!(solution.gamma[n - 1] < 0.5 * crest && solution.gamma[0] < crest);
    }

    #[test]
    fn stalled_sections_are_solved() {
        // lift that breaks and recovers: slopes of the wrong sign are clipped
        let (options, matrix) = rotor();
        let n = options.n_stations;
        let k = options.chord * options.tip_speed();
        let lift = |a: f64| 5.7 * 0.5 * a / (1.0 + (a / 0.25).powi(4)).sqrt();
        let section = |lambda: &[f64], gamma: &mut [f64], derivative: &mut [f64]| {
            for i in 0..n {
                let alpha = 0.35 - 0.2 * i as f64 / n as f64 - lambda[i];
                gamma[i] = k * lift(alpha);
                derivative[i] = -k * (lift(alpha + 1e-6) - lift(alpha - 1e-6)) / 2e-6;
            }
        };
        let solution =
            solve_circulation(&vec![0.04; n], &matrix, section, &vec![0.0; n], &vec![-3.0 * k; n], 1e-9)
                .unwrap();
        assert!(solution.converged, "{} after {}", solution.residual, solution.iterations);
    }

    #[test]
    fn values_that_are_not_finite_never_travel() {
        let (options, matrix) = rotor();
        let n = options.n_stations;
        let section = |_: &[f64], gamma: &mut [f64], _: &mut [f64]| gamma.fill(f64::NAN);
        let solution =
            solve_circulation(&vec![0.0; n], &matrix, section, &vec![1.0; n], &vec![-1.0; n], 1e-9).unwrap();
        assert!(!solution.converged && solution.residual.is_infinite());
        assert!(solution.gamma.iter().chain(&solution.inflow).all(|v| v.is_finite()));
        assert!(
            solve_circulation(&vec![f64::NAN; n], &matrix, section, &vec![1.0; n], &vec![-1.0; n], 1e-9)
                .is_err()
        );
    }
}
