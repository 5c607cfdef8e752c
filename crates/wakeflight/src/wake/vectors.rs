//! Plain vectors in the hub frame.

/// Sum of two vectors.
pub(crate) fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Mean of two vectors.
pub(super) fn mean(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| 0.5 * (a[c] + b[c]))
}

/// Difference of two vectors.
pub(super) fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| a[c] - b[c])
}

/// Adds `b` to `a`.
pub(crate) fn add_to(a: &mut [f64; 3], b: [f64; 3]) {
    for c in 0..3 {
        a[c] += b[c];
    }
}
