//! Chain rule: what the blades' loads carry of the blades' own and the shared states into the shared rows.

use super::{Block, Slopes};
use crate::numerics::compiled::{Loops, compiled};
use crate::system::instant::Instant;
use crate::system::model::System;

impl System {
    /// What acts by states.
    pub(super) fn join(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        let n = slopes.shared.len();
        let mut b = 0;
        for blade in &mut slopes.blades {
            let r = blade.rotor;
            let (rotor, felt) = (&self.rotors[r], &slopes.rotors[r]);
            let flap = rotor.blade.flap_mode;
            let (s, c) = self.azimuth(r, at.t, at.y, b).sin_cos();
            let share = rotor.flap_per_coordinate() * 2.0 * c / rotor.n_blades as f64;
            product(&felt.by_loads, &blade.loads, &mut blade.on_shared, false);
            product(&felt.by_loads, &blade.loads_by_shared, &mut slopes.shared_y, true);
            let moved = if blade.n_modes() > 0 { n } else { 0 };
            for i in 0..moved {
                let direct = blade.on_shared.at(i, flap) + felt.by_flapping[i] * share;
                blade.on_shared.set(i, flap, direct);
            }
            if let (Some(place), true) = (self.layout.rotors[r].spin(), blade.n_modes() > 0) {
                // the flapping over the blades by the azimuth they share
                let turned = -at.y[blade.modal.start + flap] * rotor.flap_per_coordinate() * 2.0 * s
                    / rotor.n_blades as f64;
                let column = slopes.place[place.azimuth];
                for i in 0..n {
                    let direct = slopes.shared_y.at(i, column) + felt.by_flapping[i] * turned;
                    slopes.shared_y.set(i, column, direct);
                }
            }
            b = (b + 1) % rotor.n_blades;
        }
    }
}

impl Slopes {
    /// The same for what acts by accelerations.
    pub(super) fn join_masses(&mut self) {
        self.shared_dot.values.copy_from_slice(&self.alone_dot.values);
        for blade in &mut self.blades {
            let by_loads = &self.rotors[blade.rotor].by_loads;
            product(by_loads, &blade.loads_dot, &mut blade.on_shared_dot, false);
            product(by_loads, &blade.loads_by_shared_dot, &mut self.shared_dot, true);
        }
    }
}

/// out = a b, or out += a b.
fn product(a: &Block, b: &Block, out: &mut Block, add: bool) {
    compiled(Product { a, b, out, add });
}

struct Product<'a> {
    a: &'a Block,
    b: &'a Block,
    out: &'a mut Block,
    add: bool,
}

impl Loops for Product<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { a, b, out, add } = self;
        let columns = b.columns;
        if columns == 0 {
            return;
        }
        for (row, result) in out.values.chunks_exact_mut(columns).enumerate() {
            if !add {
                result.fill(0.0);
            }
            for (k, factors) in b.values.chunks_exact(columns).enumerate() {
                let weight = a.at(row, k);
                for (r, f) in result.iter_mut().zip(factors) {
                    *r += weight * f;
                }
            }
        }
    }
}
