//! Exact Jacobian of F by dual numbers, using that a blade's states are felt by that blade and the sums alone.

use super::model::{Aircraft, Inputs};
use super::state::Owner;
use crate::blade::loads::BladeLoads;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};

/// Derivative directions carried at once.
const LANES: usize = 10;
type D = Dual<LANES>;

fn constant(b: &BladeLoads<f64>) -> BladeLoads<D> {
    BladeLoads {
        modal: b.modal.map(D::cst),
        force: Vec3::cst(b.force.array()),
        moment: Vec3::cst(b.moment.array()),
        aero_force: Vec3::cst(b.aero_force.array()),
        aero_moment: Vec3::cst(b.aero_moment.array()),
    }
}

impl Aircraft {
    /// a dF/dy + b dF/dy_dot, row-major (n, n). The solver asks for (1, c_j), the mass matrix is (0, 1).
    #[allow(clippy::too_many_arguments, reason = "the arguments of F and the two weights")]
    pub fn jacobian(
        &self,
        t: f64,
        y: &[f64],
        y_dot: &[f64],
        inputs: &Inputs,
        a: f64,
        b: f64,
        out: &mut [f64],
    ) {
        let n = self.layout.len();
        let hub = self.hub_motion(y, y_dot);
        let n_blades = self.rotor.n_blades;
        let values: Vec<BladeLoads<f64>> =
            (0..n_blades).map(|k| self.blade_loads(t, y, y_dot, inputs, &hub, k)).collect();
        let mut f = vec![D::zero(); n];
        for columns in self.column_groups() {
            let mut y_s: Vec<D> = y.iter().map(|&v| D::cst(v)).collect();
            let mut y_dot_s: Vec<D> = y_dot.iter().map(|&v| D::cst(v)).collect();
            for (lane, &column) in columns.iter().enumerate() {
                y_s[column].eps[lane] = a;
                y_dot_s[column].eps[lane] = b;
            }
            let hub_s = self.hub_motion(&y_s, &y_dot_s);
            let loads: Vec<BladeLoads<D>> = (0..n_blades)
                .map(|k| {
                    let felt = columns.iter().any(|&c| match self.layout.owner(c) {
                        Owner::Everyone => true,
                        Owner::Blade(own) => own == k,
                        Owner::Airframe => false,
                    });
                    if felt {
                        self.blade_loads(t, &y_s, &y_dot_s, inputs, &hub_s, k)
                    } else {
                        constant(&values[k])
                    }
                })
                .collect();
            self.assemble(t, &y_s, &y_dot_s, inputs, &loads, &mut f);
            for (row, value) in f.iter().enumerate() {
                for (lane, &column) in columns.iter().enumerate() {
                    out[row * n + column] = value.eps[lane];
                }
            }
        }
    }

    /// Columns in groups of at most LANES, each of one owner.
    fn column_groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<(Owner, Vec<usize>)> = Vec::new();
        for column in 0..self.layout.len() {
            let owner = self.layout.owner(column);
            match groups.iter_mut().rev().find(|(o, g)| *o == owner && g.len() < LANES) {
                Some((_, group)) => group.push(column),
                None => groups.push((owner, vec![column])),
            }
        }
        groups.into_iter().map(|(_, g)| g).collect()
    }
}
