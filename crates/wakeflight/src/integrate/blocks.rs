//! Linear systems of the system: blades coupled through the shared states alone, eliminated one by one.
//!
//! c dF/dy_dot + dF/dy: a blade's rows hold its own columns and the shared ones. With the rows of q_dot = s the modal rates go
//! first (ds = c dq - r_q), then each blade's coordinates, and the shared states are left with the Schur complement of all blades.

use crate::system::slopes::{Block, Slopes};
use nalgebra::ComplexField;

/// Numbers a system is solved in: real or complex.
pub trait Number: ComplexField<RealField = f64> + Copy {}
impl<T: ComplexField<RealField = f64> + Copy> Number for T {}

/// A pivot was zero or not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a matrix of the flight dynamics is singular or not finite")]
pub struct Singular;

#[derive(Clone, Debug)]
struct BladeFactor<T> {
    /// LU of the blade's own block (n_modes, n_modes).
    own: Vec<T>,
    pivots: Vec<usize>,
    /// own^-1 times the shared columns, column after column (n_shared, n_modes).
    by_shared: Vec<T>,
    /// Shared rows by the blade's unknowns (n_shared, n_modes).
    on_shared: Vec<T>,
    /// Modal rows by modal rates (n_modes, n_modes).
    by_rate: Vec<T>,
    /// Shared rows by modal rates (n_shared, n_modes).
    rate_on_shared: Vec<T>,
    right: Vec<T>,
}

/// What a factor belongs to.
#[derive(Clone, Copy, Debug)]
enum Kind<T> {
    /// dF/dy_dot alone.
    Mass,
    /// c dF/dy_dot + dF/dy.
    Newton(T),
}

/// Factors of c dF/dy_dot + dF/dy, or of dF/dy_dot; made once, filled again and again.
#[derive(Clone, Debug)]
pub struct Factor<T> {
    kind: Kind<T>,
    blades: Vec<BladeFactor<T>>,
    shared: Vec<T>,
    pivots: Vec<usize>,
    right: Vec<T>,
}

impl<T: Number> Factor<T> {
    /// Room for systems of this shape.
    pub fn new(slopes: &Slopes) -> Self {
        let n = slopes.shared.len();
        let zeros = |k: usize| vec![T::zero(); k];
        let blade = |m: usize| BladeFactor {
            own: zeros(m * m),
            pivots: vec![0; m],
            by_shared: zeros(m * n),
            on_shared: zeros(m * n),
            by_rate: zeros(m * m),
            rate_on_shared: zeros(m * n),
            right: zeros(m),
        };
        Self {
            kind: Kind::Mass,
            blades: slopes.blades.iter().map(|b| blade(b.n_modes())).collect(),
            shared: zeros(n * n),
            pivots: vec![0; n],
            right: zeros(n),
        }
    }

    /// Factors dF/dy_dot.
    pub fn mass(&mut self, slopes: &Slopes) -> Result<(), Singular> {
        self.kind = Kind::Mass;
        for (f, b) in self.blades.iter_mut().zip(&slopes.blades) {
            copy(&mut f.own, &b.own_dot);
            copy_transposed(
                &mut f.by_shared,
                |i, j| T::from_real(b.by_shared_dot.at(i, j)),
                b.own_dot.columns,
            );
            copy(&mut f.on_shared, &b.on_shared_dot);
        }
        copy(&mut self.shared, &slopes.shared_dot);
        self.eliminate()
    }

    /// Factors c dF/dy_dot + dF/dy.
    pub fn newton(&mut self, slopes: &Slopes, c: T) -> Result<(), Singular> {
        self.kind = Kind::Newton(c);
        let real = T::from_real;
        for (f, b) in self.blades.iter_mut().zip(&slopes.blades) {
            let m = b.n_modes();
            for i in 0..m {
                for j in 0..m {
                    let by_rate = real(b.own.at(i, m + j)) + c * real(b.own_dot.at(i, j));
                    f.by_rate[i * m + j] = by_rate;
                    f.own[i * m + j] = real(b.own.at(i, j)) + c * by_rate;
                }
            }
            for i in 0..slopes.shared.len() {
                for j in 0..m {
                    let by_rate = real(b.on_shared.at(i, m + j)) + c * real(b.on_shared_dot.at(i, j));
                    f.rate_on_shared[i * m + j] = by_rate;
                    f.on_shared[i * m + j] = real(b.on_shared.at(i, j)) + c * by_rate;
                }
            }
            let both = |i, j| real(b.by_shared.at(i, j)) + c * real(b.by_shared_dot.at(i, j));
            copy_transposed(&mut f.by_shared, both, m);
        }
        for (k, v) in self.shared.iter_mut().enumerate() {
            *v = real(slopes.shared_y.values[k]) + c * real(slopes.shared_dot.values[k]);
        }
        self.eliminate()
    }

    /// Factors every blade and the Schur complement of the shared states.
    fn eliminate(&mut self) -> Result<(), Singular> {
        let n = self.pivots.len();
        for f in &mut self.blades {
            let m = f.pivots.len();
            if m == 0 {
                continue;
            }
            factorise(m, &mut f.own, &mut f.pivots)?;
            for column in f.by_shared.chunks_exact_mut(m) {
                substitute(m, &f.own, &f.pivots, column);
            }
            for (i, row) in f.on_shared.chunks_exact(m).enumerate() {
                // rows of the kinematics and of states that no blade feels are empty
                if row.iter().all(|v| *v == T::zero()) {
                    continue;
                }
                for (j, column) in f.by_shared.chunks_exact(m).enumerate() {
                    self.shared[i * n + j] -= product(row, column);
                }
            }
        }
        factorise(n, &mut self.shared, &mut self.pivots)
    }

    /// Solves in place; `x` holds the right-hand side in the order of y.
    pub fn solve(&mut self, slopes: &Slopes, x: &mut [T]) {
        for (r, &i) in self.right.iter_mut().zip(&slopes.shared) {
            *r = x[i];
        }
        for (f, b) in self.blades.iter_mut().zip(&slopes.blades) {
            let m = b.n_modes();
            if m == 0 {
                continue;
            }
            f.right.copy_from_slice(&x[b.modal_rate.clone()]);
            if let Kind::Newton(_) = self.kind {
                let r_q = &x[b.modal.clone()];
                for (r, row) in f.right.iter_mut().zip(f.by_rate.chunks_exact(m)) {
                    *r += product(row, r_q);
                }
                for (r, row) in self.right.iter_mut().zip(f.rate_on_shared.chunks_exact(m)) {
                    *r += product(row, r_q);
                }
            }
            substitute(m, &f.own, &f.pivots, &mut f.right);
            for (r, row) in self.right.iter_mut().zip(f.on_shared.chunks_exact(m)) {
                *r -= product(row, &f.right);
            }
        }
        substitute(self.pivots.len(), &self.shared, &self.pivots, &mut self.right);
        for (r, &i) in self.right.iter().zip(&slopes.shared) {
            x[i] = *r;
        }
        for (f, b) in self.blades.iter_mut().zip(&slopes.blades) {
            let (q, s, m) = (b.modal.start, b.modal_rate.start, b.n_modes());
            if m == 0 {
                continue;
            }
            for (shared, column) in self.right.iter().zip(f.by_shared.chunks_exact(m)) {
                for (r, v) in f.right.iter_mut().zip(column) {
                    *r -= *v * *shared;
                }
            }
            for i in 0..m {
                match self.kind {
                    // coordinates have their own right-hand side already
                    Kind::Mass => x[s + i] = f.right[i],
                    Kind::Newton(c) => {
                        x[s + i] = c * f.right[i] - x[q + i];
                        x[q + i] = f.right[i];
                    }
                }
            }
        }
    }
}

fn copy<T: Number>(to: &mut [T], from: &Block) {
    for (t, &f) in to.iter_mut().zip(&from.values) {
        *t = T::from_real(f);
    }
}

/// to[column][row] = from(row, column) for `rows` rows.
fn copy_transposed<T: Number>(to: &mut [T], from: impl Fn(usize, usize) -> T, rows: usize) {
    for (j, column) in to.chunks_exact_mut(rows.max(1)).enumerate() {
        for (i, v) in column.iter_mut().enumerate() {
            *v = from(i, j);
        }
    }
}

#[inline(always)]
fn product<T: Number>(a: &[T], b: &[T]) -> T {
    let mut sum = T::zero();
    for (&x, &y) in a.iter().zip(b) {
        sum += x * y;
    }
    sum
}

/// LU with partial pivoting, in place (n, n) row-major.
fn factorise<T: Number>(n: usize, a: &mut [T], pivots: &mut [usize]) -> Result<(), Singular> {
    for k in 0..n {
        let mut pivot = k;
        for i in k + 1..n {
            if a[i * n + k].norm1() > a[pivot * n + k].norm1() {
                pivot = i;
            }
        }
        pivots[k] = pivot;
        let size = a[pivot * n + k].norm1();
        if size == 0.0 || !size.is_finite() {
            return Err(Singular);
        }
        if pivot != k {
            for j in 0..n {
                a.swap(k * n + j, pivot * n + j);
            }
        }
        let inverse = T::one() / a[k * n + k];
        let (above, below) = a.split_at_mut((k + 1) * n);
        let top = &above[k * n..];
        for row in below.chunks_exact_mut(n) {
            if row[k] == T::zero() {
                continue;
            }
            let factor = row[k] * inverse;
            row[k] = factor;
            for j in k + 1..n {
                row[j] -= factor * top[j];
            }
        }
    }
    Ok(())
}

/// Solves with the factors of `factorise`, in place.
fn substitute<T: Number>(n: usize, lu: &[T], pivots: &[usize], x: &mut [T]) {
    for k in 0..n {
        x.swap(k, pivots[k]);
    }
    for i in 1..n {
        let sum = product(&lu[i * n..i * n + i], &x[..i]);
        x[i] -= sum;
    }
    for i in (0..n).rev() {
        let sum = product(&lu[i * n + i + 1..(i + 1) * n], &x[i + 1..n]);
        x[i] = (x[i] - sum) / lu[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn a_system_that_needs_pivots_is_solved() {
        let a = [0.0, 2.0, 1.0, 1.0, 1e-3, -1.0, 3.0, 1.0, 0.0].map(|v| Complex::new(v, 0.5 * v * v));
        let x = [1.0, -2.0, 0.5].map(|v| Complex::new(v, -v));
        let mut b: Vec<_> = (0..3).map(|i| product(&a[3 * i..3 * i + 3], &x)).collect();
        let (mut lu, mut pivots) = (a.to_vec(), vec![0; 3]);
        factorise(3, &mut lu, &mut pivots).unwrap();
        substitute(3, &lu, &pivots, &mut b);
        for (found, wanted) in b.iter().zip(x) {
            assert!((found - wanted).norm() < 1e-13);
        }
        assert_eq!(factorise(2, &mut [1.0, 2.0, 2.0, 4.0], &mut [0, 0]), Err(Singular));
        assert_eq!(factorise(1, &mut [f64::NAN], &mut [0]), Err(Singular));
    }
}
