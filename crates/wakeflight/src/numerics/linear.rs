//! Small dense linear systems, solved where they stand.

/// Solves A x = b by elimination with partial pivoting: `matrix` (n, n) row-major is used up, `right` (n) becomes x.
///
/// Returns whether every pivot differs from zero; otherwise both hold whatever was reached.
pub fn solve_in_place(matrix: &mut [f64], right: &mut [f64]) -> bool {
    let n = right.len();
    debug_assert_eq!(matrix.len(), n * n);
    for k in 0..n {
        let size = |row: usize| matrix[row * n + k].abs();
        let pivot = (k + 1..n).fold(k, |best, row| if size(row) > size(best) { row } else { best });
        if matrix[pivot * n + k] == 0.0 {
            return false;
        }
        if pivot != k {
            let (upper, lower) = matrix.split_at_mut(pivot * n);
            upper[k * n + k..(k + 1) * n].swap_with_slice(&mut lower[k..n]);
            right.swap(k, pivot);
        }
        let (upper, lower) = matrix.split_at_mut((k + 1) * n);
        let first = &upper[k * n + k..];
        let (inverse, known) = (1.0 / first[0], right[k]);
        for (row, b) in lower.chunks_exact_mut(n).zip(&mut right[k + 1..]) {
            let factor = row[k] * inverse;
            for (a, p) in row[k + 1..].iter_mut().zip(&first[1..]) {
                *a -= factor * p;
            }
            *b -= factor * known;
        }
    }
    for k in (0..n).rev() {
        let row = &matrix[k * n + k..(k + 1) * n];
        let known: f64 = row[1..].iter().zip(&right[k + 1..]).map(|(a, x)| a * x).sum();
        right[k] = (right[k] - known) / row[0];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_that_need_pivots_are_solved() {
        // A of a fixed pseudo-random sequence, zeros on the diagonal: without pivoting the first step divides by zero
        for n in [1, 2, 5, 20, 33] {
            let mut seed = 1u64;
            let mut next = || {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (seed >> 40) as f64 / 8_388_608.0 - 1.0
            };
            let mut matrix: Vec<f64> = (0..n * n).map(|_| next()).collect();
            if n > 1 {
                (0..n).for_each(|i| matrix[i * n + i] = 0.0);
            }
            let exact: Vec<f64> = (0..n).map(|_| next()).collect();
            let mut right: Vec<f64> =
                matrix.chunks(n).map(|row| row.iter().zip(&exact).map(|(a, x)| a * x).sum()).collect();
            assert!(solve_in_place(&mut matrix, &mut right));
            for (x, e) in right.iter().zip(&exact) {
                assert!((x - e).abs() < 1e-11, "{n}: {x} {e}");
            }
        }
    }

    #[test]
    fn a_singular_system_is_refused() {
        assert!(!solve_in_place(&mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 1.0]));
    }
}
