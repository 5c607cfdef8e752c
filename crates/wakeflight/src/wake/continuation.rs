//! A zero of n equations followed along one parameter: predictor and corrector by arc length.
//!
//! H(x, t) = 0 is followed from a zero at t = 0 to t = 1, through folds, where t goes back for a while. What is followed
//! may have kinks: the sign of det [H_x H_t; tangent] keeps the direction across them.

use nalgebra::{DMatrix, DVector};

/// First step of arc length; the scale of x makes 1 of what is large in it.
const FIRST_STEP: f64 = 0.02;
/// Longest step; where a path does not arrive with the first, it is followed once more with the next.
const LONGEST_STEPS: [f64; 3] = [0.5, 0.1, 0.02];
/// Shortest step, below which the path is given up.
const SHORTEST_STEP: f64 = 1e-9;
/// Longest step across a sharp kink: a longer one may land on another branch.
const TURNING_STEP: f64 = 1e-3;
/// Cosine of the turn from which a kink counts as sharp.
const SHARP: f64 = 0.9;
/// Most corrections of a step.
const MAX_CORRECTIONS: usize = 8;
/// Residual over the scale at which a point counts as on the path.
const ON_PATH: f64 = 1e-7;
/// Most points of the path tried, refused ones included.
const MAX_POINTS: usize = 4000;

/// What is followed.
pub(super) trait Path {
    /// H (n), H_x (n, n) row-major and H_t (n) at (x, t); false where they do not exist.
    fn evaluate(&mut self, x: &[f64], t: f64, at: &mut Place) -> bool;
}

/// Values and derivatives at a point.
pub(super) struct Place {
    /// H (n).
    pub value: Vec<f64>,
    /// H_x (n, n), row-major.
    pub slope: Vec<f64>,
    /// H_t (n).
    pub by_parameter: Vec<f64>,
}

/// Point (x / scale, t) of the path.
type Point = DVector<f64>;

/// x at t = 1, reached from the zero `start` at t = 0, to about 1e-7 of `scale`; None where the path could not be followed
/// to there. `start` need not be a zero exactly: the first point is corrected.
pub(super) fn follow(path: &mut impl Path, start: &[f64], scale: f64) -> Option<Vec<f64>> {
    LONGEST_STEPS.iter().find_map(|&longest| follow_with(path, start, scale, longest))
}

fn follow_with(path: &mut impl Path, start: &[f64], scale: f64, longest: f64) -> Option<Vec<f64>> {
    let n = start.len();
    let mut follower = Follower {
        path,
        n,
        scale,
        at: Place { value: vec![0.0; n], slope: vec![0.0; n * n], by_parameter: vec![0.0; n] },
    };
    let mut here = Point::from_iterator(n + 1, start.iter().map(|x| x / scale).chain([0.0]));
    // the first direction is that of growing t
    let mut rising = DVector::zeros(n + 1);
    rising[n] = 1.0;
    let (first, orientation) = follower.tangent(&here, &rising, None)?;
    let mut tangent = first;
    let mut step = FIRST_STEP;
    for _ in 0..MAX_POINTS {
        if step < SHORTEST_STEP {
            return None;
        }
        let Some((there, corrections)) = follower.advance(&here, &tangent, step, orientation) else {
            step *= 0.25;
            continue;
        };
        if there[n] >= 1.0 {
            let share = (1.0 - here[n]) / (there[n] - here[n]);
            let mut last = &here + (&there - &here) * share;
            last[n] = 1.0;
            if let Some((x, _)) = follower.correct(last, &rising) {
                return Some(x.rows(0, n).iter().map(|v| v * scale).collect());
            }
            step *= 0.25;
            continue;
        }
        // back at the start: another zero of t = 0, from which this path does not lead on
        if there[n] < 0.0 {
            return None;
        }
        tangent = follower.tangent(&there, &tangent, Some(orientation))?.0;
        here = there;
        if corrections <= 3 {
            step = (2.0 * step).min(longest);
        }
    }
    None
}

struct Follower<'a, P> {
    path: &'a mut P,
    n: usize,
    scale: f64,
    at: Place,
}

impl<P: Path> Follower<'_, P> {
    /// H over the scale and [H_x H_t; row], x in units of the scale.
    fn bordered(&mut self, point: &Point, row: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let n = self.n;
        let x: Vec<f64> = point.rows(0, n).iter().map(|v| v * self.scale).collect();
        if !self.path.evaluate(&x, point[n], &mut self.at) {
            return None;
        }
        let value = DVector::from_iterator(n, self.at.value.iter().map(|v| v / self.scale));
        let matrix = DMatrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => self.at.slope[i * n + j],
            (true, false) => self.at.by_parameter[i] / self.scale,
            _ => row[j],
        });
        Some((value, matrix))
    }

    /// Unit tangent with the sign of det [H_x H_t; tangent] given, at first that along `row`; and that sign.
    fn tangent(
        &mut self,
        point: &Point,
        row: &DVector<f64>,
        orientation: Option<f64>,
    ) -> Option<(DVector<f64>, f64)> {
        let n = self.n;
        let (_, matrix) = self.bordered(point, row)?;
        let factors = matrix.lu();
        let mut right = DVector::zeros(n + 1);
        right[n] = 1.0;
        let along = factors.solve(&right)?;
        let length = along.norm();
        if !length.is_finite() || length == 0.0 {
            return None;
        }
        // with the tangent itself as last row the determinant is that with `row` times |along|^2 over row.along = 1
        let sign = factors.determinant().signum();
        let turned = if orientation.is_some_and(|wanted| wanted != sign) { -1.0 } else { 1.0 };
        Some((along * (turned / length), sign))
    }

    /// The next point of the path, about `step` on, and the corrections it took.
    ///
    /// Where it is not found straight on, a kink may have turned the path back: then the tangent of what lies beyond the
    /// kink leads on from there.
    fn advance(
        &mut self,
        here: &Point,
        tangent: &Point,
        step: f64,
        orientation: f64,
    ) -> Option<(Point, usize)> {
        // a far correction may have jumped to another branch
        let near = |(there, n): (Point, usize)| ((&there - here).norm() <= 2.5 * step).then_some((there, n));
        let ahead = here + tangent * step;
        if let Some(found) = self.correct(ahead.clone(), tangent).and_then(near) {
            return Some(found);
        }
        let (turned, _) = self.tangent(&ahead, tangent, Some(orientation))?;
        if step > TURNING_STEP || turned.dot(tangent) > SHARP {
            return None;
        }
        let (there, corrections) = self.correct(ahead + &turned * step, &turned).and_then(near)?;
        // the correction may have gone back to the near side of the kink
        let (onward, _) = self.tangent(&there, &turned, Some(orientation))?;
        (onward.dot(&turned) > SHARP).then_some((there, corrections))
    }

    /// The point of the path in the plane across `row` through `point`, and the corrections it took.
    fn correct(&mut self, mut point: Point, row: &DVector<f64>) -> Option<(Point, usize)> {
        let n = self.n;
        let mut before = f64::INFINITY;
        for correction in 0..=MAX_CORRECTIONS {
            let (value, matrix) = self.bordered(&point, row)?;
            let size = value.amax();
            if size <= ON_PATH {
                return Some((point, correction));
            }
            // kinks let the residual grow once; twice is another branch
            if size > 10.0 * before {
                return None;
            }
            before = size;
            let mut right = DVector::zeros(n + 1);
            right.rows_mut(0, n).copy_from(&value);
            point -= matrix.lu().solve(&right)?;
            if !point.iter().all(|v| v.is_finite()) {
                return None;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x^3 - 3 x = 4 (2 t - 1) (and a kink for the second unknown): x folds back at 1 and at -1.
    struct Folded;

    impl Path for Folded {
        fn evaluate(&mut self, x: &[f64], t: f64, at: &mut Place) -> bool {
            at.value[0] = x[0].powi(3) - 3.0 * x[0] - 4.0 * (2.0 * t - 1.0);
            at.value[1] = x[1] + 0.5 * (x[0] - 0.3).abs() - t;
            at.slope.copy_from_slice(&[3.0 * x[0] * x[0] - 3.0, 0.0, 0.5 * (x[0] - 0.3).signum(), 1.0]);
            at.by_parameter.copy_from_slice(&[-8.0, -1.0]);
            true
        }
    }

    #[test]
    fn a_path_is_followed_through_folds_and_kinks() {
        // zeros: x^3 - 3 x = -4 at t = 0, = 4 at t = 1
        let root: f64 = 2.195_823_345_445_647_3;
        let start = [-root, -0.5 * (root + 0.3)];
        let x = follow(&mut Folded, &start, 1.0).unwrap();
        assert!((x[0] - root).abs() < 1e-6, "{x:?}");
        assert!((x[1] - (1.0 - 0.5 * (root - 0.3))).abs() < 1e-6, "{x:?}");
    }

    #[test]
    fn a_path_that_never_arrives_is_given_up() {
        struct Back;
        impl Path for Back {
            fn evaluate(&mut self, x: &[f64], t: f64, at: &mut Place) -> bool {
                // t = 1/4 - (x - 1/2)^2: from x = 0 back to t = 0 at x = 1
                at.value[0] = t - 0.25 + (x[0] - 0.5).powi(2);
                at.slope[0] = 2.0 * (x[0] - 0.5);
                at.by_parameter[0] = 1.0;
                true
            }
        }
        assert!(follow(&mut Back, &[0.0], 1.0).is_none());
    }
}
