//! Natural modes of the rotating blade.

use super::assembly::Matrices;
use super::beam::Mesh;
use super::error::BladeError;
use super::section::{BladeProperties, Root};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// Deflections at the tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TipDeflection {
    /// Lead [m], toward the leading edge.
    pub v: f64,
    /// Flap [m], up.
    pub w: f64,
    /// Twist [rad], nose up.
    pub phi: f64,
}

/// Shares of a mode's kinetic energy; cross terms are halved between their two motions, so the sum is 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyShares {
    /// Flap.
    pub flap: f64,
    /// Lag.
    pub lag: f64,
    /// Torsion.
    pub torsion: f64,
}

/// Mode shapes at one station, one entry per mode; derivatives along the span.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapesAt {
    /// Lead [m].
    pub v: Vec<f64>,
    /// Its slope.
    pub dv: Vec<f64>,
    /// Its curvature [1/m].
    pub ddv: Vec<f64>,
    /// Flap [m].
    pub w: Vec<f64>,
    /// Its slope.
    pub dw: Vec<f64>,
    /// Its curvature [1/m].
    pub ddw: Vec<f64>,
    /// Elastic twist [rad], without what delta3 takes away.
    pub phi: Vec<f64>,
    /// Its slope [rad/m].
    pub dphi: Vec<f64>,
}

/// Natural modes of the undeformed rotating blade at one root pitch, ascending in frequency.
///
/// Flap, lag and torsion coupled by pitch, twist and centre of gravity; with centrifugal stiffening and tension-twist
/// coupling and hinge springs; without gyroscopic terms, lag damper and its spring, air. Shapes are mass-normalised (modal mass 1 kg); the
/// motion with the largest share of kinetic energy is positive at the tip (lead forward, flap up, nose up).
#[derive(Clone, Debug)]
pub struct BladeModes {
    /// Rotor speed [rad/s].
    pub omega: f64,
    /// Pitch of the root [rad].
    pub reference_pitch: f64,
    /// Natural frequencies [rad/s], ascending.
    pub frequency: Vec<f64>,
    /// Number of modes kept.
    pub n_modes: usize,
    /// Deflections of the mass-normalised shapes at the tip.
    pub tip: Vec<TipDeflection>,
    /// Shares of kinetic energy.
    pub shares: Vec<EnergyShares>,
    /// Warning: no mode kept is mostly torsion.
    pub no_torsion: bool,
    mesh: Mesh,
    /// Degrees of freedom of every mode, held ones included (n_dof, n_modes).
    shapes: DMatrix<f64>,
}

/// Eigenvalues below this fraction of the largest one belong to motion without mass.
const MASSLESS: f64 = 1e-12;
/// Negative squares of frequencies below this fraction of the shift are rounding.
const ROUNDING: f64 = 1e-6;

impl BladeModes {
    /// First `n_modes` modes of a blade of `n_elements` equal elements at rotor speed `omega` [rad/s] and root pitch
    /// `reference_pitch` [rad].
    pub fn new(
        properties: &BladeProperties,
        omega: f64,
        reference_pitch: f64,
        n_elements: usize,
        n_modes: usize,
    ) -> Result<Self, BladeError> {
        properties.check()?;
        for (field, value) in [("omega", omega), ("reference_pitch", reference_pitch)] {
            if !value.is_finite() {
                return Err(BladeError::Value { field, value, allowed: "finite" });
            }
        }
        let mesh = Mesh::new(properties, n_elements)?;
        let matrices = Matrices::new(properties, &mesh, omega, reference_pitch);
        let (frequency, shapes) = if properties.rigid {
            rigid_modes(&mesh, &matrices, properties.root, omega, n_elements, n_modes)?
        } else {
            elastic_modes(&mesh, &matrices, properties.root, omega, n_elements, n_modes)?
        };
        Ok(Self::labelled(mesh, &matrices, omega, reference_pitch, frequency, shapes))
    }

    /// Modes with their signs, tip deflections and shares of energy.
    fn labelled(
        mesh: Mesh,
        matrices: &Matrices,
        omega: f64,
        reference_pitch: f64,
        frequency: Vec<f64>,
        mut shapes: DMatrix<f64>,
    ) -> Self {
        let n_modes = frequency.len();
        let (mut tip, mut shares) = (Vec::new(), Vec::new());
        for i in 0..n_modes {
            let mut shape = shapes.column(i).into_owned();
            let share = energy_shares(&mesh, &matrices.mass, &shape);
            let mut deflection = tip_deflection(&mesh, &shape);
            if share.dominant(deflection) < 0.0 {
                shape.neg_mut();
                deflection = tip_deflection(&mesh, &shape);
            }
            shapes.set_column(i, &shape);
            tip.push(deflection);
            shares.push(share);
        }
        let no_torsion = shares.iter().all(|share| share.torsion <= 0.5);
        Self { omega, reference_pitch, frequency, n_modes, tip, shares, no_torsion, mesh, shapes }
    }

    /// Mode shapes at station `x` [m]; beyond root and tip, those of the end.
    pub fn at(&self, x: f64) -> ShapesAt {
        let at = self.mesh.at(x);
        let sums = |first: usize, factors: &[f64]| -> Vec<f64> {
            let rows = self.shapes.rows(first, factors.len());
            rows.column_iter().map(|q| q.iter().zip(factors).map(|(q, n)| q * n).sum()).collect()
        };
        let [value, slope, curvature] = &at.bending;
        ShapesAt {
            v: sums(at.first_v, value),
            dv: sums(at.first_v, slope),
            ddv: sums(at.first_v, curvature),
            w: sums(at.first_w, value),
            dw: sums(at.first_w, slope),
            ddw: sums(at.first_w, curvature),
            phi: sums(at.first_phi, &at.torsion[0]),
            dphi: sums(at.first_phi, &at.torsion[1]),
        }
    }

    /// Intervals (start [m], end [m], segment of the structural table) in which shapes are polynomials, structure is
    /// constant and twist is linear; they cover root_station..radius.
    ///
    /// Read the section by `BladeProperties::section(segment, x)`: an interval inboard of the table's first station has
    /// the stiffness of segment 0 and no mass.
    pub fn pieces(&self) -> Vec<(f64, f64, usize)> {
        self.mesh.pieces.iter().map(|piece| (piece.start, piece.end, piece.segment)).collect()
    }
}

/// Modes of the finite elements: frequencies [rad/s], degrees of freedom (n_dof, n_modes).
fn elastic_modes(
    mesh: &Mesh,
    matrices: &Matrices,
    root: Root,
    omega: f64,
    n_elements: usize,
    n_modes: usize,
) -> Result<(Vec<f64>, DMatrix<f64>), BladeError> {
    let free = mesh.free(root);
    let mass = matrices.mass.select_rows(&free).select_columns(&free);
    let stiffness = matrices.stiffness.select_rows(&free).select_columns(&free);
    let (frequency, free_shapes) = eigenmodes(&mass, &stiffness, omega, n_elements, n_modes)?;
    let mut shapes = DMatrix::zeros(mesh.n_dof(), n_modes);
    for i in 0..n_modes {
        for (k, &dof) in free.iter().enumerate() {
            shapes[(dof, i)] = free_shapes[(k, i)];
        }
    }
    Ok((frequency, shapes))
}

/// The same with the blade turning rigidly about its hinges: the elements' matrices reduced to those turns.
fn rigid_modes(
    mesh: &Mesh,
    matrices: &Matrices,
    root: Root,
    omega: f64,
    n_elements: usize,
    n_modes: usize,
) -> Result<(Vec<f64>, DMatrix<f64>), BladeError> {
    let turns = mesh.hinge_turns(root);
    let available = turns.ncols();
    if n_modes > available {
        return Err(BladeError::TooManyModes { asked: n_modes, n_elements, available });
    }
    if n_modes == 0 {
        return Ok((Vec::new(), DMatrix::zeros(mesh.n_dof(), 0)));
    }
    let reduced = |matrix: &DMatrix<f64>| turns.transpose() * matrix * &turns;
    let (mass, stiffness) = (reduced(&matrices.mass), reduced(&matrices.stiffness));
    let (frequency, hinge_shapes) = eigenmodes(&mass, &stiffness, omega, n_elements, n_modes)?;
    Ok((frequency, turns * hinge_shapes))
}

impl EnergyShares {
    /// Tip deflection of the motion with the largest share.
    fn dominant(&self, tip: TipDeflection) -> f64 {
        if self.torsion > self.flap.max(self.lag) {
            tip.phi
        } else if self.flap >= self.lag {
            tip.w
        } else {
            tip.v
        }
    }
}

/// Frequencies [rad/s] and mass-normalised shapes of stiffness x = frequency^2 mass x.
///
/// Solved as mass x = (stiffness + shift mass) x / (frequency^2 + shift): neither a hinge without stiffness nor a root
/// without rotary inertia makes that matrix singular; motion without mass has eigenvalue zero and is left out.
fn eigenmodes(
    mass: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
    omega: f64,
    n_elements: usize,
    n_modes: usize,
) -> Result<(Vec<f64>, DMatrix<f64>), BladeError> {
    let not_solved = |reason| BladeError::NotSolved { reason };
    let (shift, cholesky) =
        shifted(mass, stiffness, omega).ok_or(not_solved("stiffness not positive where there is no mass"))?;
    let lower = cholesky.l();
    let half = lower.solve_lower_triangular(mass).ok_or(not_solved("first substitution"))?;
    let symmetric =
        lower.solve_lower_triangular(&half.transpose()).ok_or(not_solved("second substitution"))?;
    let symmetric = (&symmetric + symmetric.transpose()) * 0.5;
    if symmetric.iter().any(|value| !value.is_finite()) {
        return Err(not_solved("not finite"));
    }
    let eigen = SymmetricEigen::try_new(symmetric, f64::EPSILON, 0).ok_or(not_solved("no convergence"))?;

    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let largest = order.first().map_or(0.0, |&i| eigen.eigenvalues[i]);
    order.retain(|&i| eigen.eigenvalues[i] > MASSLESS * largest);
    if n_modes == 0 || order.len() < n_modes {
        return Err(BladeError::TooManyModes { asked: n_modes, n_elements, available: order.len() });
    }
    let mut frequency = Vec::with_capacity(n_modes);
    let mut shapes = DMatrix::zeros(mass.nrows(), n_modes);
    for (mode, &i) in order[..n_modes].iter().enumerate() {
        let frequency_squared = 1.0 / eigen.eigenvalues[i] - shift;
        if frequency_squared < -ROUNDING * shift {
            return Err(BladeError::Diverges { mode, frequency_squared });
        }
        frequency.push(frequency_squared.max(0.0).sqrt());
        let shape = lower
            .tr_solve_lower_triangular(&eigen.eigenvectors.column(i))
            .ok_or(not_solved("back substitution"))?;
        let modal_mass = shape.dot(&(mass * &shape));
        shapes.set_column(mode, &(shape / modal_mass.sqrt()));
    }
    Ok((frequency, shapes))
}

/// Smallest tried shift [rad^2/s^2] that makes stiffness + shift mass positive definite, and its factor.
fn shifted(
    mass: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
    omega: f64,
) -> Option<(f64, Cholesky<f64, nalgebra::Dyn>)> {
    // rotor speed, or for a blade at rest the lowest ratio on the diagonals
    let ratios = (0..mass.nrows()).filter(|&i| mass[(i, i)] > 0.0);
    let lowest = ratios.map(|i| stiffness[(i, i)] / mass[(i, i)]).fold(f64::INFINITY, f64::min);
    let mut shift = omega * omega + 1e-2 * lowest.abs();
    for _ in 0..12 {
        if let Some(cholesky) = Cholesky::new(stiffness + mass * shift) {
            return Some((shift, cholesky));
        }
        shift *= 10.0;
    }
    None
}

fn tip_deflection(mesh: &Mesh, shape: &DVector<f64>) -> TipDeflection {
    TipDeflection {
        v: shape[mesh.first_flap() - 2],
        w: shape[mesh.first_twist() - 2],
        phi: shape[mesh.n_dof() - 1],
    }
}

fn energy_shares(mesh: &Mesh, mass: &DMatrix<f64>, shape: &DVector<f64>) -> EnergyShares {
    let momentum = mass * shape;
    let (flap, twist) = (mesh.first_flap(), mesh.first_twist());
    let part = |from: usize, to: usize| (from..to).map(|i| shape[i] * momentum[i]).sum::<f64>();
    let total = shape.dot(&momentum);
    EnergyShares {
        flap: part(flap, twist) / total,
        lag: part(0, flap) / total,
        torsion: part(twist, mesh.n_dof()) / total,
    }
}
