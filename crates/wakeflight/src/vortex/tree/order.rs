//! Points ordered so that neighbours in the list are neighbours in space.

/// Box around points: lowest and highest corner; the points must not be none.
pub(super) fn bounds(points: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], [f64; 3]) {
    points.fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), p| {
        (std::array::from_fn(|c| low[c].min(p[c])), std::array::from_fn(|c| high[c].max(p[c])))
    })
}

/// Middle of a box.
pub(super) fn middle((low, high): ([f64; 3], [f64; 3])) -> [f64; 3] {
    std::array::from_fn(|c| 0.5 * (low[c] + high[c]))
}

/// Distance of two points.
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    square_of_distance(a, b).sqrt()
}

/// Its square.
pub(super) fn square_of_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d: [f64; 3] = std::array::from_fn(|c| a[c] - b[c]);
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// Moves the `at` lowest entries along the longest side of the box around `points` to the front.
pub(super) fn split(order: &mut [usize], points: &[[f64; 3]], at: usize) {
    let (low, high) = bounds(order.iter().map(|i| points[*i]));
    let side = |c: usize| high[c] - low[c];
    let axis = (1..3).fold(0, |widest, c| if side(c) > side(widest) { c } else { widest });
    // equal coordinates in the order of the list: the same split on every machine
    order.select_nth_unstable_by(at, |a, b| points[*a][axis].total_cmp(&points[*b][axis]).then(a.cmp(b)));
}

/// Orders entries into compact blocks of `size`, the last one shorter.
pub(super) fn into_blocks(order: &mut [usize], points: &[[f64; 3]], size: usize) {
    if order.len() <= size {
        order.sort_unstable();
        return;
    }
    let at = order.len().div_ceil(size).div_ceil(2) * size;
    split(order, points, at);
    let (front, back) = order.split_at_mut(at);
    into_blocks(front, points, size);
    into_blocks(back, points, size);
}
