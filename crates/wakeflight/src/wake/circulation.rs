//! Circulation of a blade solved together with its near wake.

use super::error::{WakeError, finite, length};
use crate::numerics::linear::solve_in_place;

/// Most Newton iterations.
const MAX_ITERATIONS: usize = 40;
/// Residual over the steepest slope, an inflow, from which on slopes are taken as they are.
const CLOSE: f64 = 0.002;
/// Way from there to the solution over the steepest slope, at most: farther off lies another one, of stalled sections.
const FARTHEST: f64 = 0.01;
/// Most Newton iterations with the slopes as they are.
const MAX_EXACT_ITERATIONS: usize = 10;
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
    gamma: Vec<f64>,
    inflow: Vec<f64>,
    defect: Vec<f64>,
    slope: Vec<f64>,
    residual: f64,
}

impl Iterate {
    fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self { gamma: zero(), inflow: zero(), defect: zero(), slope: zero(), residual: f64::INFINITY }
    }

    fn copy(&mut self, from: &Self) {
        self.gamma.copy_from_slice(&from.gamma);
        self.inflow.copy_from_slice(&from.inflow);
        self.defect.copy_from_slice(&from.defect);
        self.slope.copy_from_slice(&from.slope);
        self.residual = from.residual;
    }
}

/// Slopes of the linearisation.
#[derive(Clone, Copy)]
enum Slopes {
    /// As the sections have them: quadratic convergence, near a solution.
    Exact,
    /// Clipped to [floor, 0]: slow, but the sign of a stalled section does not turn Newton away.
    Clipped,
}

/// The circulation problem of one blade.
struct Problem<'a, F> {
    far: &'a [f64],
    near: &'a [f64],
    floor: &'a [f64],
    section: F,
}

/// Solves Gamma_i = Gamma_section,i(lambda_far,i + sum_j N_ij Gamma_j) for one blade.
///
/// * `lambda_far` (n) [-]: inflow at the stations without the near wake of the own blade;
/// * `n_matrix` (n, n) row-major [s/m2]: see [`near_wake_matrix`](super::near_wake_matrix);
/// * `section(lambda, gamma, dgamma_dlambda)`: circulation of the sections [m2/s] and its slope [m2/s];
/// * `gamma_start` (n) [m2/s]: start;
/// * `slope_floor` (n) [m2/s]: least slope of the linearisation, -3 chord omega R. (Gamma = V c C_l / 2 and
///   d alpha/d lambda = -omega R/V give -C_l_alpha/2 chord omega R, about -pi chord omega R for a thin section.)
///   Slopes are clipped to [floor, 0] where Newton with the slopes as they are does not descend;
/// * `tolerance` [m2/s], for example 1e-8 omega R^2.
///
/// Newton steps (I - S N) dGamma = Gamma_section - Gamma, halved while the residual grows. Clipped slopes bring it close:
/// with a stalled section's own slope Newton leaves for solutions far beyond stall. From there the slopes are taken as
/// they are, which converges in two or three steps where clipped ones take fifteen or never arrive (reverse flow, high Mach
/// number). What that finds is taken if it is near; otherwise the slopes stay clipped. Where all fails from the start
/// given, once more from the circulation that sections of the far inflow's slope would have: a wide blade's start
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
    let mut problem = Problem { far: lambda_far, near: n_matrix, floor: slope_floor, section: &mut section };
    let mut start = Iterate::new(n);
    start.gamma.copy_from_slice(gamma_start);
    let mut best = problem.settle(start, tolerance);
    if best.0.residual > tolerance {
        let mut flat = Iterate::new(n);
        problem.evaluate(&mut flat);
        let mut linear = Iterate::new(n);
        let mut jacobian = vec![0.0; n * n];
        if problem.newton_step(&flat, Slopes::Clipped, &mut jacobian, &mut linear.gamma) {
            let again = problem.settle(linear, tolerance);
            if again.0.residual < best.0.residual {
                best = (again.0, best.1 + again.1);
            }
        }
    }
    let (found, iterations) = best;
    Ok(CirculationSolution {
        gamma: found.gamma,
        inflow: found.inflow,
        converged: found.residual <= tolerance,
        residual: found.residual,
        iterations,
    })
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64])> Problem<'_, F> {
    /// Everything but the circulation of `at`, from its circulation.
    fn evaluate(&mut self, at: &mut Iterate) {
        let n = self.far.len();
        for i in 0..n {
            let row = &self.near[i * n..(i + 1) * n];
            at.inflow[i] = self.far[i] + row.iter().zip(&at.gamma).map(|(a, g)| a * g).sum::<f64>();
        }
        (self.section)(&at.inflow, &mut at.defect, &mut at.slope);
        let mut largest: f64 = 0.0;
        let mut usable = true;
        for i in 0..n {
            at.defect[i] -= at.gamma[i];
            usable &= at.defect[i].is_finite() && at.slope[i].is_finite();
            largest = largest.max(at.defect[i].abs());
        }
        at.residual = if usable { largest } else { f64::INFINITY };
    }

    /// (I - S N)^-1 (Gamma_section - Gamma) into `step`; false where it does not exist.
    fn newton_step(&self, here: &Iterate, slopes: Slopes, jacobian: &mut [f64], step: &mut [f64]) -> bool {
        let n = self.far.len();
        for i in 0..n {
            let slope = match slopes {
                Slopes::Exact => here.slope[i],
                Slopes::Clipped => here.slope[i].max(self.floor[i]).min(0.0),
            };
            let row = &mut jacobian[i * n..(i + 1) * n];
            for (a, near) in row.iter_mut().zip(&self.near[i * n..(i + 1) * n]) {
                *a = -slope * near;
            }
            row[i] += 1.0;
        }
        step.copy_from_slice(&here.defect);
        solve_in_place(jacobian, step) && step.iter().all(|v| v.is_finite())
    }

    /// From `start` close to a solution with clipped slopes, to it with exact ones where it is as near as it seems.
    fn settle(&mut self, start: Iterate, tolerance: f64) -> (Iterate, usize) {
        let steepest = self.floor.iter().fold(0.0f64, |most, s| most.max(s.abs()));
        let near = tolerance.max(CLOSE * steepest);
        let (close, n_close) = self.descend(start, Slopes::Clipped, near);
        if close.residual <= tolerance || close.residual > near {
            return (close, n_close);
        }
        let (found, n_found) = self.descend(close.clone(), Slopes::Exact, tolerance);
        let way = found.gamma.iter().zip(&close.gamma).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
        if found.residual <= tolerance && way <= FARTHEST * steepest {
            return (found, n_close + n_found);
        }
        let (slow, n_slow) = self.descend(close, Slopes::Clipped, tolerance);
        (slow, n_close + n_found + n_slow)
    }

    /// Damped Newton from `here.gamma`: the best iterate and the number of iterations.
    fn descend(&mut self, mut here: Iterate, slopes: Slopes, tolerance: f64) -> (Iterate, usize) {
        let n = self.far.len();
        self.evaluate(&mut here);
        let mut best = here.clone();
        let (mut candidate, mut shorter) = (Iterate::new(n), Iterate::new(n));
        let (mut jacobian, mut step) = (vec![0.0; n * n], vec![0.0; n]);
        let (mut iterations, mut failures) = (0, 0);
        let (most_iterations, most_failures) = match slopes {
            Slopes::Exact => (MAX_EXACT_ITERATIONS, 1),
            Slopes::Clipped => (MAX_ITERATIONS, MAX_FAILURES),
        };
        while best.residual > tolerance
            && here.residual.is_finite()
            && iterations < most_iterations
            && failures < most_failures
        {
            iterations += 1;
            if !self.newton_step(&here, slopes, &mut jacobian, &mut step) {
                break;
            }
            let along = |to: &mut Iterate, fraction: f64| {
                for (i, gamma) in to.gamma.iter_mut().enumerate() {
                    *gamma = here.gamma[i] + step[i] * fraction;
                }
            };
            along(&mut candidate, 1.0);
            self.evaluate(&mut candidate);
            let mut fraction = 1.0;
            for _ in 0..MAX_HALVINGS {
                if candidate.residual < here.residual {
                    break;
                }
                fraction *= 0.5;
                along(&mut shorter, fraction);
                self.evaluate(&mut shorter);
                if shorter.residual < candidate.residual {
                    std::mem::swap(&mut candidate, &mut shorter);
                }
            }
            if candidate.residual < here.residual {
                failures = 0;
            } else {
                failures += 1;
            }
            std::mem::swap(&mut here, &mut candidate);
            if here.residual < best.residual {
                best.copy(&here);
            }
        }
        (best, iterations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::motion::{BladeState, HubMotion};
    use crate::wake::near_wake::near_wake_matrix;
    use crate::wake::options::WakeOptions;

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
