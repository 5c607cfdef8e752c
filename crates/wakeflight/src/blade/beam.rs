//! Finite elements of a rotating flap-lag-torsion beam: nodes, degrees of freedom, pieces of constant properties.

use super::error::BladeError;
use super::hermite;
use super::section::{BladeProperties, Root};
use nalgebra::DMatrix;

/// Stations closer than this fraction of the radius are one.
const SAME_STATION: f64 = 1e-9;

/// Stretch of the blade inside one element with one set of properties and one slope of the twist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Inner end [m].
    pub start: f64,
    /// Outer end [m].
    pub end: f64,
    /// Segment of the structural table.
    pub segment: usize,
    /// Built-in twist per length [rad/m].
    pub twist_rate: f64,
}

/// Elements of equal length from `root_station` to `radius`.
///
/// Degrees of freedom: lead and slope at every node, then flap and slope at every node, then twist at every node and
/// every middle of an element; inboard to outboard.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Inner end [m].
    pub root: f64,
    /// Outer end [m].
    pub tip: f64,
    /// Number of elements.
    pub n_elements: usize,
    /// Pieces for quadrature, inboard to outboard without holes.
    pub pieces: Vec<Piece>,
}

/// Interpolation at one station: functions that do not vanish there and the degrees of freedom they multiply.
#[derive(Clone, Copy, Debug)]
pub struct Interpolation {
    /// First of four consecutive degrees of freedom of lead.
    pub first_v: usize,
    /// First of four of flap.
    pub first_w: usize,
    /// First of three of twist.
    pub first_phi: usize,
    /// Value, slope, curvature of the bending functions.
    pub bending: [[f64; 4]; 3],
    /// Value, slope of the torsion functions.
    pub torsion: [[f64; 3]; 2],
}

impl Mesh {
    /// Mesh of a blade whose data have been checked.
    pub fn new(properties: &BladeProperties, n_elements: usize) -> Result<Self, BladeError> {
        if n_elements == 0 {
            return Err(BladeError::Value { field: "n_elements", value: 0.0, allowed: "1 or more" });
        }
        let (root, tip) = (properties.root_station, properties.radius);
        let mut mesh = Self { root, tip, n_elements, pieces: Vec::new() };
        let r_in = &properties.structure.r_in;
        let twist = &properties.twist;
        let nodes = (0..=n_elements).map(|i| mesh.node(i));
        let mut breaks: Vec<f64> = nodes
            .chain(r_in.iter().copied())
            .chain(twist.x.iter().copied())
            .filter(|x| (root..=tip).contains(x))
            .collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|b, a| *b - *a < SAME_STATION * tip);
        mesh.pieces = breaks
            .windows(2)
            .map(|ends| {
                let (start, end) = (ends[0], ends[1]);
                let middle = 0.5 * (start + end);
                let segment = r_in.partition_point(|&r| r <= middle).saturating_sub(1);
                let twist_rate = (twist.at(end) - twist.at(start)) / (end - start);
                Piece { start, end, segment, twist_rate }
            })
            .collect();
        Ok(mesh)
    }

    /// Station of node `i` [m].
    pub fn node(&self, i: usize) -> f64 {
        if i == self.n_elements {
            return self.tip;
        }
        self.root + (self.tip - self.root) * i as f64 / self.n_elements as f64
    }

    /// Number of degrees of freedom, held ones included.
    pub fn n_dof(&self) -> usize {
        4 * (self.n_elements + 1) + 2 * self.n_elements + 1
    }

    /// First degree of freedom of flap.
    pub fn first_flap(&self) -> usize {
        2 * (self.n_elements + 1)
    }

    /// First degree of freedom of twist.
    pub fn first_twist(&self) -> usize {
        4 * (self.n_elements + 1)
    }

    /// Degrees of freedom that the root does not hold.
    pub fn free(&self, root: Root) -> Vec<usize> {
        let held = match root {
            Root::Hinged => vec![0, self.first_flap()],
            Root::Flapping => vec![0, 1, self.first_flap()],
            Root::Clamped => vec![0, 1, self.first_flap(), self.first_flap() + 1],
        };
        (0..self.n_dof()).filter(|dof| !held.contains(dof)).collect()
    }

    /// Rigid turns about the hinges of `root`, lag before flap, one column each (n_dof, 0 to 2).
    pub fn hinge_turns(&self, root: Root) -> DMatrix<f64> {
        let firsts = match root {
            Root::Hinged => vec![0, self.first_flap()],
            Root::Flapping => vec![self.first_flap()],
            Root::Clamped => vec![],
        };
        let mut turns = DMatrix::zeros(self.n_dof(), firsts.len());
        for (column, first) in firsts.into_iter().enumerate() {
            for i in 0..=self.n_elements {
                turns[(first + 2 * i, column)] = self.node(i) - self.root;
                turns[(first + 2 * i + 1, column)] = 1.0;
            }
        }
        turns
    }

    /// Interpolation at station `x` [m]; beyond the ends, that of the end.
    pub fn at(&self, x: f64) -> Interpolation {
        let h = (self.tip - self.root) / self.n_elements as f64;
        let along = ((x - self.root) / h).clamp(0.0, self.n_elements as f64);
        let element = (along as usize).min(self.n_elements - 1);
        let s = along - element as f64;
        Interpolation {
            first_v: 2 * element,
            first_w: self.first_flap() + 2 * element,
            first_phi: self.first_twist() + 2 * element,
            bending: hermite::cubic(s, h),
            torsion: hermite::quadratic(s, h),
        }
    }
}
