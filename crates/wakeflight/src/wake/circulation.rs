//! Circulation of a blade solved together with its near wake.

use super::continuation::{Path, Place, follow};
use super::error::{WakeError, finite, length};
use crate::numerics::linear::{Columns, LinearSystem};

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
/// Largest inflow of the own near wake in a solution. It acts until a section no longer lifts, and so brings less than the wind
/// across it; a root beyond lies where the broad side's small lift feeds a narrow element's own trailers.
const LARGEST_INFLOW: f64 = 1.0;
/// Circulation over the steepest slope that counts as large along a path: an inflow.
const PATH_SCALE: f64 = 0.05;

/// Most steps in which circulation follows its sections with a lag.
const MAX_LAGGED: usize = 2000;
/// Residual over that from which slopes are taken as they are, at which it has arrived.
const ARRIVED: f64 = 0.01;

/// Share of the tolerance to which a solution is found that Newton did not find from the start.
const TO_ROUNDING: f64 = 1e-5;

/// Solution of the circulation and the near wake.
#[derive(Clone, Debug, PartialEq)]
pub struct CirculationSolution {
    /// Circulation (n_stations) [m2/s].
    pub gamma: Vec<f64>,
    /// Induced inflow that belongs to it, near wake included (n_stations).
    pub inflow: Vec<f64>,
    /// Largest |gamma_section - gamma| [m2/s].
    pub residual: f64,
    /// Station it is found at, from 0 at the root.
    pub worst_station: usize,
    /// Newton iterations.
    pub iterations: usize,
    /// How it was found; None: it was not, and this is no solution but where the search ended.
    pub found_by: Option<Route>,
}

impl CirculationSolution {
    /// Whether the equations are solved to the tolerance.
    pub fn converged(&self) -> bool {
        self.found_by.is_some()
    }
}

/// Ways to a solution, in the order they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// Newton from the start given.
    Newton,
    /// Circulation that follows its sections with a lag, until it has reached them.
    Lagged,
    /// The path on which the defect of the start given goes to zero: the solution continuous with the start.
    FromStart,
    /// Newton from the circulation of sections with the far inflow's slopes.
    Linear,
    /// The path on which the near wake's influence grows from none to its own.
    NearWake,
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
    /// The same, to be multiplied by.
    columns: Columns,
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
/// number). What that finds is taken if it is near; otherwise the slopes stay clipped.
///
/// Where Newton does not arrive, each station goes toward its section step by step from the start, as air that needs time would,
/// and where that comes to rest Newton ends it: of several solutions the one that the blade would come to. Where it finds no rest,
/// the solution is followed along a path by arc length ([`follow`]): with the defect D_0 of
/// the start, D = (1 - t) D_0 for t from 0 to 1 leads from the start to the solution continuous with it. Should it come
/// back to t = 0, the influence of the near wake is let grow from none, where each station has one solution of its own, to
/// all: Gamma = Gamma_section(lambda_far + t N Gamma). Lift coefficients are bounded and vanish where the inflow is all of
/// the wind, so circulation stays bounded on the way and the path has nowhere to go but to t = 1. Between the two Newton is
/// tried from the circulation that sections of the far inflow's slope would have: a wide blade's start without near wake
/// stalls its tip, and Newton does not come back from there. Values of `section` that are not finite are treated as an
/// infinite residual and never accepted.
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
    let mut problem = Problem {
        far: lambda_far,
        near: n_matrix,
        columns: Columns::new(n_matrix, n),
        floor: slope_floor,
        section: &mut section,
    };
    let mut start = Iterate::new(n);
    start.gamma.copy_from_slice(gamma_start);
    let (found, iterations, found_by) = problem.solve(start, tolerance);
    let worst_station =
        (0..n).fold(0, |w, i| if found.defect[i].abs() > found.defect[w].abs() { i } else { w });
    Ok(CirculationSolution {
        gamma: found.gamma,
        inflow: found.inflow,
        residual: found.residual,
        worst_station,
        iterations,
        found_by,
    })
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64])> Problem<'_, F> {
    /// Everything but the circulation of `at`, from its circulation.
    fn evaluate(&mut self, at: &mut Iterate) {
        let n = self.far.len();
        self.columns.add_product(self.far, &at.gamma, &mut at.inflow);
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

    /// A solution, or the best iterate of Newton from `start` without a route.
    fn solve(&mut self, start: Iterate, tolerance: f64) -> (Iterate, usize, Option<Route>) {
        let gamma_start = start.gamma.clone();
        let (newton, mut iterations) = self.settle(start, tolerance);
        if self.solved(&newton, tolerance) {
            return (newton, iterations, Some(Route::Newton));
        }
        for route in [Route::Lagged, Route::FromStart, Route::Linear, Route::NearWake] {
            let arrived = match route {
                Route::Lagged => self.lagged(&gamma_start),
                Route::Newton | Route::FromStart => self.along_defect(&gamma_start),
                Route::Linear => self.linear(),
                Route::NearWake => self.along_near_wake(),
            };
            let Some(gamma) = arrived else { continue };
            let mut there = Iterate::new(gamma.len());
            there.gamma = gamma;
            let (found, n) = match route {
                Route::Linear | Route::Lagged => self.settle(there, tolerance),
                _ => {
                    self.evaluate(&mut there);
                    self.descend(there, Slopes::Exact, tolerance)
                }
            };
            iterations += n;
            if self.solved(&found, tolerance) {
                // on to rounding: the last digits do not tell the way it came
                let (found, n) = self.descend(found, Slopes::Exact, TO_ROUNDING * tolerance);
                return (found, iterations + n, Some(route));
            }
        }
        (newton, iterations, None)
    }

    /// Whether `at` solves the equations with an inflow that a near wake can bring.
    fn solved(&self, at: &Iterate, tolerance: f64) -> bool {
        let near =
            at.inflow.iter().zip(self.far).fold(0.0f64, |most, (all, far)| most.max((all - far).abs()));
        at.residual <= tolerance && near <= LARGEST_INFLOW
    }

    /// Circulation of sections that keep the slopes they have at the far inflow.
    fn linear(&mut self) -> Option<Vec<f64>> {
        let n = self.far.len();
        let mut flat = Iterate::new(n);
        self.evaluate(&mut flat);
        let mut gamma = vec![0.0; n];
        self.newton_step(&flat, Slopes::Clipped, &mut LinearSystem::new(n), &mut gamma).then_some(gamma)
    }

    /// From `start`, each station goes toward its section by the share that what all others may do to it leaves: a blade in air that
    /// needs time to follow. None where it does not come to rest.
    fn lagged(&mut self, start: &[f64]) -> Option<Vec<f64>> {
        let n = start.len();
        let share: Vec<f64> = (0..n)
            .map(|i| {
                let felt: f64 = self.near[i * n..(i + 1) * n].iter().map(|v| v.abs()).sum();
                1.0 / (1.0 + felt * self.floor[i].abs())
            })
            .collect();
        let steepest = self.floor.iter().fold(0.0f64, |most, s| most.max(s.abs()));
        let mut here = Iterate::new(n);
        here.gamma.copy_from_slice(start);
        for _ in 0..MAX_LAGGED {
            self.evaluate(&mut here);
            if here.residual <= ARRIVED * CLOSE * steepest {
                return Some(here.gamma);
            }
            if here.residual.is_infinite() {
                return None;
            }
            for ((gamma, defect), share) in here.gamma.iter_mut().zip(&here.defect).zip(&share) {
                *gamma += share * defect;
            }
        }
        None
    }

    fn path_scale(&self) -> f64 {
        PATH_SCALE * self.floor.iter().fold(0.0f64, |most, s| most.max(s.abs()))
    }

    /// From `start`, where the defect is D_0, along D = (1 - t) D_0.
    fn along_defect(&mut self, start: &[f64]) -> Option<Vec<f64>> {
        let mut first = Iterate::new(start.len());
        first.gamma.copy_from_slice(start);
        self.evaluate(&mut first);
        let scale = self.path_scale();
        follow(&mut DefectPath { problem: self, first }, start, scale)
    }

    /// From the circulation without near wake along Gamma = Gamma_section(lambda_far + t N Gamma).
    fn along_near_wake(&mut self) -> Option<Vec<f64>> {
        let mut none = Iterate::new(self.far.len());
        self.evaluate(&mut none);
        let (start, scale) = (none.defect, self.path_scale());
        let here = Iterate::new(start.len());
        follow(&mut NearWakePath { problem: self, here }, &start, scale)
    }

    /// (I - S N)^-1 (Gamma_section - Gamma) into `step`; false where it does not exist.
    fn newton_step(
        &self,
        here: &Iterate,
        slopes: Slopes,
        system: &mut LinearSystem,
        step: &mut [f64],
    ) -> bool {
        let slope = here.slope.iter().zip(self.floor).map(|(slope, floor)| match slopes {
            Slopes::Exact => *slope,
            Slopes::Clipped => slope.max(*floor).min(0.0),
        });
        system.set_feedback(slope, self.near, &here.defect);
        system.solve(step) && step.iter().all(|v| v.is_finite())
    }

    /// From `start` close to a solution with clipped slopes, to it with exact ones where it is as near as it seems.
    fn settle(&mut self, mut start: Iterate, tolerance: f64) -> (Iterate, usize) {
        let steepest = self.floor.iter().fold(0.0f64, |most, s| most.max(s.abs()));
        let near = tolerance.max(CLOSE * steepest);
        self.evaluate(&mut start);
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

    /// Damped Newton from `here`, which is evaluated: the best iterate and the number of iterations.
    fn descend(&mut self, mut here: Iterate, slopes: Slopes, tolerance: f64) -> (Iterate, usize) {
        let n = self.far.len();
        let mut best = here.clone();
        let (mut candidate, mut shorter) = (Iterate::new(n), Iterate::new(n));
        let (mut system, mut step) = (LinearSystem::new(n), vec![0.0; n]);
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
            if !self.newton_step(&here, slopes, &mut system, &mut step) {
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

/// D(Gamma) - (1 - t) D_0 = 0.
struct DefectPath<'p, 'a, F> {
    problem: &'p mut Problem<'a, F>,
    first: Iterate,
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64])> Path for DefectPath<'_, '_, F> {
    fn evaluate(&mut self, x: &[f64], t: f64, at: &mut Place) -> bool {
        let n = x.len();
        let mut here = Iterate::new(n);
        here.gamma.copy_from_slice(x);
        self.problem.evaluate(&mut here);
        for i in 0..n {
            at.value[i] = here.defect[i] - (1.0 - t) * self.first.defect[i];
            for j in 0..n {
                at.slope[i * n + j] = here.slope[i] * self.problem.near[i * n + j] - f64::from(i == j);
            }
        }
        at.by_parameter.copy_from_slice(&self.first.defect);
        here.residual.is_finite()
    }
}

/// Gamma_section(lambda_far + t N Gamma) - Gamma = 0.
struct NearWakePath<'p, 'a, F> {
    problem: &'p mut Problem<'a, F>,
    here: Iterate,
}

impl<F: FnMut(&[f64], &mut [f64], &mut [f64])> Path for NearWakePath<'_, '_, F> {
    fn evaluate(&mut self, x: &[f64], t: f64, at: &mut Place) -> bool {
        let n = x.len();
        // the near wake's inflow is linear: t N Gamma is that of t Gamma
        self.here.gamma.iter_mut().zip(x).for_each(|(gamma, x)| *gamma = t * x);
        self.problem.evaluate(&mut self.here);
        for i in 0..n {
            let (slope, row) = (self.here.slope[i], &self.problem.near[i * n..(i + 1) * n]);
            at.value[i] = self.here.defect[i] + t * x[i] - x[i];
            at.by_parameter[i] = slope * row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>();
            for j in 0..n {
                at.slope[i * n + j] = t * slope * row[j] - f64::from(i == j);
            }
        }
        self.here.residual.is_finite()
    }
}

#[cfg(test)]
mod tests;
