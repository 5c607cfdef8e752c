//! The one layout of unknowns and equations, with their names.

use super::error::ProblemError;
use super::host::{Head, Host};
use super::path::{Path, PathUnknown};
use super::problem::Problem;
use crate::numerics::scalar::Real;
use crate::rotor::periodic::Harmonics;

/// Name and unit.
pub type Named = (String, &'static str);

/// Roll, pitch, heading against the track.
const ATTITUDE: [(&str, &str); 3] = [("roll", "rad"), ("pitch", "rad"), ("yaw", "rad")];
const INFLOW: [&str; 3] = ["inflow_0", "inflow_1s", "inflow_1c"];

/// Where each unknown lives in x; rows are in the same order but for the equations of the head, which are as listed.
#[derive(Clone, Debug)]
pub struct Layout {
    controls: &'static [(&'static str, &'static str)],
    flies: bool,
    given: Path<f64>,
    free: Vec<PathUnknown>,
    equations: Vec<Named>,
    dynamic_inflow: bool,
    tail_rotor: bool,
    n_modes: usize,
    n_harmonics: usize,
}

impl Layout {
    /// Of `problem` on `host`.
    pub fn of<H: Host>(host: &H, problem: &Problem) -> Result<Self, ProblemError> {
        let path = problem.path;
        if !host.flies() {
            if let Some(equation) = problem.equations.iter().find(|each| each.is_of_flight()) {
                return Err(ProblemError::NoAirframe(equation.name().0));
            }
            if let Some(free) = problem.free.first() {
                return Err(ProblemError::NoAirframe(free.name().0));
            }
        } else if ![path.speed, path.flight_path, path.turn_rate].iter().all(|v| v.is_finite()) {
            return Err(ProblemError::NotFinite);
        }
        if problem.n_azimuths == 0 {
            return Err(ProblemError::NoAzimuths);
        }
        let layout = Self {
            controls: host.controls(),
            flies: host.flies(),
            given: path,
            free: problem.free.clone(),
            equations: problem.equations.iter().map(|each| owned(each.name())).collect(),
            dynamic_inflow: problem.is_dynamic(),
            tail_rotor: host.has_tail_rotor(),
            n_modes: host.rotor().blade.n_modes,
            n_harmonics: problem.n_harmonics,
        };
        let (unknowns, equations) = (layout.inflow(), layout.equations.len());
        if unknowns != equations {
            return Err(ProblemError::NotSquare { unknowns, equations });
        }
        Ok(layout)
    }

    /// First of roll, pitch, heading against the track.
    pub fn attitude(&self) -> usize {
        self.controls.len()
    }

    /// First of the free parts of the path.
    pub fn path(&self) -> usize {
        self.attitude() + if self.flies { ATTITUDE.len() } else { 0 }
    }

    /// First of the inflow states; the listed equations end here.
    pub fn inflow(&self) -> usize {
        self.path() + self.free.len()
    }

    /// Tail-rotor inflow.
    pub fn tail_inflow(&self) -> usize {
        self.inflow() + if self.dynamic_inflow { INFLOW.len() } else { 0 }
    }

    /// Whether the states of dynamic inflow are unknowns.
    pub fn has_inflow(&self) -> bool {
        self.dynamic_inflow
    }

    /// Whether the inflow of a tail rotor is an unknown.
    pub fn has_tail_inflow(&self) -> bool {
        self.tail_rotor
    }

    /// Blade motion.
    pub fn harmonics(&self) -> Harmonics {
        Harmonics {
            start: self.tail_inflow() + usize::from(self.tail_rotor),
            n_modes: self.n_modes,
            n_harmonics: self.n_harmonics,
        }
    }

    /// Number of unknowns, never zero.
    #[allow(clippy::len_without_is_empty, reason = "there are always the controls")]
    pub fn len(&self) -> usize {
        self.harmonics().mode(self.n_modes)
    }

    /// Name and unit of every unknown; those of a blade mode are of its modal coordinate.
    pub fn unknowns(&self) -> Vec<Named> {
        let mut names: Vec<Named> = self.controls.iter().copied().map(owned).collect();
        if self.flies {
            names.extend(ATTITUDE.map(owned));
        }
        names.extend(self.free.iter().map(|each| owned(each.name())));
        names.extend(self.inflow_states());
        names.extend(self.harmonics().names().into_iter().map(|name| (name, "m kg^0.5")));
        names
    }

    /// Name of every equation, and unit of its residual.
    pub fn equations(&self) -> Vec<Named> {
        let mut names = self.equations.clone();
        names.extend(self.inflow_states());
        names.extend(self.harmonics().names().into_iter().map(|name| (name, "rad")));
        names
    }

    fn inflow_states(&self) -> impl Iterator<Item = Named> {
        let states = if self.dynamic_inflow { &INFLOW[..] } else { &[] };
        let tail = if self.tail_rotor { &["tail_rotor_inflow"][..] } else { &[] };
        states.iter().chain(tail).map(|&name| owned((name, "1")))
    }

    /// The head of the unknowns `x`.
    pub fn head<S: Real>(&self, x: &[S]) -> Head<S> {
        let zero = S::zero();
        let n = self.controls.len();
        let mut controls = [zero; 4];
        controls[..n].copy_from_slice(&x[..n]);
        let [roll, pitch, yaw] = if self.flies { [x[n], x[n + 1], x[n + 2]] } else { [zero; 3] };
        let mut path = self.given.constant();
        for (part, &value) in self.free.iter().zip(&x[self.path()..]) {
            *part.of(&mut path) = value;
        }
        let i = self.inflow();
        let inflow = if self.dynamic_inflow { [x[i], x[i + 1], x[i + 2]] } else { [zero; 3] };
        let tail_inflow = if self.tail_rotor { x[self.tail_inflow()] } else { zero };
        Head { controls, roll, pitch, yaw, path, inflow, tail_inflow }
    }
}

fn owned((name, unit): (&str, &'static str)) -> Named {
    (name.to_string(), unit)
}
