//! Mass and stiffness matrix of the rotating blade about its straight, twisted, undeformed shape.
//!
//! Second variation of strain energy minus kinetic energy in the rotating frame, centrifugal potential included;
//! hinge springs included; without gyroscopic terms, lag damper and its spring, air.

use super::beam::Mesh;
use super::inertia::{DV, DW, N_LOCAL, PHI, SectionInertia, U, V, W, section_inertia};
use super::quadrature::{gauss_legendre, gauss_points};
use super::section::BladeProperties;
use nalgebra::DMatrix;

/// Gauss points on every piece: exact for the polynomials of a blade without twist, and converged with it.
pub const N_GAUSS: usize = 5;

/// Linear form in the degrees of freedom: pairs of degree of freedom and factor.
type Form = Vec<(usize, f64)>;

/// Mass and stiffness matrix, held degrees of freedom included.
#[derive(Clone, Debug)]
pub struct Matrices {
    /// Consistent mass.
    pub mass: DMatrix<f64>,
    /// Elastic and centrifugal stiffness.
    pub stiffness: DMatrix<f64>,
}

impl Matrices {
    /// Integrals over the blade at rotor speed `omega` [rad/s] and root pitch `reference_pitch` [rad].
    ///
    /// Strain energy 1/2 int EI_flap k_f^2 + EI_lag k_l^2 + GJ phi'^2 dx, with the springs of the root
    /// 1/2 (K phi(root)^2 + K_flap w'(root)^2 + K_lag v'(root)^2), and
    /// k_f = w'' cos th - v'' sin th, k_l = v'' cos th + w'' sin th, th = reference pitch + twist.
    /// Axial shift u = -1/2 int v'^2 + w'^2 + k_A^2 (phi'^2 + 2 th_tw' phi') dx: its quadratic part carries the tension
    /// T(x) = int_x^R (dT0/du) dx, its linear part (tension-twist coupling) enters the section's inertia.
    pub fn new(properties: &BladeProperties, mesh: &Mesh, omega: f64, reference_pitch: f64) -> Self {
        let n = mesh.n_dof();
        let mut matrices = Self { mass: DMatrix::zeros(n, n), stiffness: DMatrix::zeros(n, n) };
        let pitch = |x: f64| reference_pitch + properties.twist.at(x);
        let rate = properties.rate(omega);
        // pitch taken away by flap at the hinge
        let delta3 = (mesh.first_flap() + 1, -properties.delta3.tan());
        let tension = Tension::new(properties, mesh, omega, reference_pitch);
        let rule = gauss_legendre(N_GAUSS);

        let mut shift_inboard = vec![0.0; 2 * mesh.n_elements + 1];
        for (i_piece, piece) in mesh.pieces.iter().enumerate() {
            let half = 0.5 * (piece.end - piece.start);
            let mut pull_factor = 0.0;
            for &(point, weight) in &rule {
                let (x, dx) = (piece.start + half * (1.0 + point), half * weight);
                let section = properties.section(piece.segment, x);
                let inertia = section_inertia(&section, rate, x, pitch(x));
                let at = mesh.at(x);
                let lead = |order: usize| form(at.first_v, &at.bending[order]);
                let flap = |order: usize| form(at.first_w, &at.bending[order]);
                let twist_slope = form(at.first_phi, &at.torsion[1]);

                let (sin, cos) = pitch(x).sin_cos();
                let flapwise = sum(&flap(2), cos, &lead(2), -sin);
                let chordwise = sum(&lead(2), cos, &flap(2), sin);
                let t = tension.at(i_piece, x);
                matrices.add_stiffness(dx * section.ei_flap, &flapwise);
                matrices.add_stiffness(dx * section.ei_lag, &chordwise);
                matrices.add_stiffness(dx * (section.gj + t * section.ka_squared), &twist_slope);
                matrices.add_stiffness(dx * t, &lead(1));
                matrices.add_stiffness(dx * t, &flap(1));

                pull_factor = -section.ka_squared * piece.twist_rate;
                let mut local: [Form; N_LOCAL] = Default::default();
                local[U] = shift(&shift_inboard, mesh, pull_factor, piece.start, x);
                local[V] = lead(0);
                local[W] = flap(0);
                local[DV] = lead(1);
                local[DW] = flap(1);
                local[PHI] = form(at.first_phi, &at.torsion[0]);
                if delta3.1 != 0.0 {
                    local[PHI].push(delta3);
                }
                matrices.add_section(dx, &inertia, &local);
            }
            for (dof, factor) in shift(&shift_inboard, mesh, pull_factor, piece.start, piece.end) {
                shift_inboard[dof - mesh.first_twist()] = factor;
            }
        }
        let root_twist = mesh.first_twist();
        matrices.stiffness[(root_twist, root_twist)] += properties.control_stiffness;
        let (lag_hinge, flap_hinge) = (1, mesh.first_flap() + 1);
        matrices.stiffness[(lag_hinge, lag_hinge)] += properties.lag_spring;
        matrices.stiffness[(flap_hinge, flap_hinge)] += properties.flap_spring;
        matrices
    }

    fn add_stiffness(&mut self, factor: f64, form: &Form) {
        for &(i, a) in form {
            for &(j, b) in form {
                self.stiffness[(i, j)] += factor * a * b;
            }
        }
    }

    fn add_section(&mut self, dx: f64, inertia: &SectionInertia, local: &[Form; N_LOCAL]) {
        for (k, row) in local.iter().enumerate() {
            for (l, column) in local.iter().enumerate() {
                let (mass, centrifugal) = (dx * inertia.mass[k][l], dx * inertia.centrifugal[k][l]);
                if mass == 0.0 && centrifugal == 0.0 {
                    continue;
                }
                for &(i, a) in row {
                    for &(j, b) in column {
                        self.mass[(i, j)] += mass * a * b;
                        self.stiffness[(i, j)] += centrifugal * a * b;
                    }
                }
            }
        }
    }
}

/// Centrifugal tension of the undeformed blade, by Gauss quadrature of the pull outboard.
struct Tension<'a> {
    properties: &'a BladeProperties,
    mesh: &'a Mesh,
    rate: [f64; 3],
    reference_pitch: f64,
    /// At the outer end of every piece [N].
    outer: Vec<f64>,
}

impl<'a> Tension<'a> {
    fn new(properties: &'a BladeProperties, mesh: &'a Mesh, omega: f64, reference_pitch: f64) -> Self {
        let outer = vec![0.0; mesh.pieces.len()];
        let rate = properties.rate(omega);
        let mut tension = Self { properties, mesh, rate, reference_pitch, outer };
        for i in (1..mesh.pieces.len()).rev() {
            tension.outer[i - 1] = tension.at(i, mesh.pieces[i].start);
        }
        tension
    }

    /// At station `x` of piece `i_piece` [N].
    fn at(&self, i_piece: usize, x: f64) -> f64 {
        let piece = &self.mesh.pieces[i_piece];
        let outboard = gauss_points(N_GAUSS, x, piece.end).into_iter().map(|(x, dx)| {
            let section = self.properties.section(piece.segment, x);
            let pitch = self.reference_pitch + self.properties.twist.at(x);
            dx * section_inertia(&section, self.rate, x, pitch).pull
        });
        self.outer[i_piece] + outboard.sum::<f64>()
    }
}

fn form(first: usize, factors: &[f64]) -> Form {
    factors.iter().enumerate().map(|(i, &factor)| (first + i, factor)).collect()
}

fn sum(a: &Form, factor_a: f64, b: &Form, factor_b: f64) -> Form {
    let scaled = |form: &Form, factor: f64| form.iter().map(|&(i, c)| (i, factor * c)).collect();
    let parts: [Form; 2] = [scaled(a, factor_a), scaled(b, factor_b)];
    parts.concat()
}

/// Linear part of the axial shift at `x`: that of the pieces inboard plus `factor` (phi(x) - phi(start)).
fn shift(inboard: &[f64], mesh: &Mesh, factor: f64, start: f64, x: f64) -> Form {
    let mut out = inboard.to_vec();
    for (station, sign) in [(x, 1.0), (start, -1.0)] {
        let at = mesh.at(station);
        for (i, &value) in at.torsion[0].iter().enumerate() {
            out[at.first_phi - mesh.first_twist() + i] += sign * factor * value;
        }
    }
    out.into_iter()
        .enumerate()
        .filter(|&(_, factor)| factor != 0.0)
        .map(|(i, factor)| (mesh.first_twist() + i, factor))
        .collect()
}
