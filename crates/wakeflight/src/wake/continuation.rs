//! A zero of n equations followed along one parameter: predictor and corrector by arc length.
//!
//! H(x, t) = 0 is followed from a zero at t = 0 to t = 1, through folds, where t goes back for a while. What is followed
//! may have kinks: the sign of det [H_x H_t; tangent] keeps the direction across them.

use crate::numerics::linear::LinearSystem;

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

/// Where a path that was followed ends.
enum End {
    /// At t = 1, with its x over the scale.
    Arrived(Vec<f64>),
    /// Back at t = 0, at another zero: from there this path does not lead on.
    Back,
    /// Nowhere: no next point was found.
    Lost,
}

/// x at t = 1, reached from the zero `start` at t = 0, to about 1e-7 of `scale`; None where the path could not be followed
/// to there. `start` need not be a zero exactly: the first point is corrected.
pub(super) fn follow(path: &mut impl Path, start: &[f64], scale: f64) -> Option<Vec<f64>> {
    let mut back = 0;
    for longest in LONGEST_STEPS {
        match Follower::new(path, start.len(), scale).follow(start, longest) {
            End::Arrived(x) => return Some(x.iter().map(|v| v * scale).collect()),
            // once, a step may have been long enough for another branch; twice, with other steps, this is where it leads
            End::Back if back == 1 => return None,
            End::Back => back += 1,
            End::Lost => {}
        }
    }
    None
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `from` and `step` of `along` more.
fn ahead(from: &[f64], along: &[f64], step: f64) -> Vec<f64> {
    from.iter().zip(along).map(|(a, b)| a + step * b).collect()
}

/// A path, points (x / scale, t) on it and what is needed to go on.
struct Follower<'a, P> {
    path: &'a mut P,
    n: usize,
    scale: f64,
    /// Point that `at` belongs to; empty before the first.
    known: Vec<f64>,
    at: Place,
    x: Vec<f64>,
    system: LinearSystem,
}

impl<'a, P: Path> Follower<'a, P> {
    fn new(path: &'a mut P, n: usize, scale: f64) -> Self {
        let at = Place { value: vec![0.0; n], slope: vec![0.0; n * n], by_parameter: vec![0.0; n] };
        Self { path, n, scale, known: Vec::new(), at, x: vec![0.0; n], system: LinearSystem::new(n + 1) }
    }

    fn follow(&mut self, start: &[f64], longest: f64) -> End {
        let n = self.n;
        let mut here: Vec<f64> = start.iter().map(|x| x / self.scale).chain([0.0]).collect();
        // the first direction is that of growing t
        let mut rising = vec![0.0; n + 1];
        rising[n] = 1.0;
        let Some((mut tangent, orientation)) = self.tangent(&here, &rising, None) else { return End::Lost };
        let mut step = FIRST_STEP;
        for _ in 0..MAX_POINTS {
            if step < SHORTEST_STEP {
                return End::Lost;
            }
            let Some((there, corrections)) = self.advance(&here, &tangent, step, orientation) else {
                step *= 0.25;
                continue;
            };
            if there[n] >= 1.0 {
                let share = (1.0 - here[n]) / (there[n] - here[n]);
                let mut last: Vec<f64> = here.iter().zip(&there).map(|(a, b)| a + (b - a) * share).collect();
                last[n] = 1.0;
                if let Some((mut x, _)) = self.correct(last, &rising) {
                    x.truncate(n);
                    return End::Arrived(x);
                }
                step *= 0.25;
                continue;
            }
            if there[n] < 0.0 {
                return End::Back;
            }
            let Some((onward, _)) = self.tangent(&there, &tangent, Some(orientation)) else {
                return End::Lost;
            };
            (here, tangent) = (there, onward);
            if corrections <= 3 {
                step = (2.0 * step).min(longest);
            }
        }
        End::Lost
    }

    /// Finds H and its derivatives at `point`, unless they are those of the last; false where they do not exist.
    fn evaluate(&mut self, point: &[f64]) -> bool {
        if self.known == point {
            return true;
        }
        self.known.clear();
        self.x.iter_mut().zip(point).for_each(|(x, v)| *x = v * self.scale);
        if !self.path.evaluate(&self.x, point[self.n], &mut self.at) {
            return false;
        }
        self.known.extend_from_slice(point);
        true
    }

    /// Solves [H_x H_t; row] y = (right, last), x in units of the scale; with the sign of the determinant.
    fn solve(
        &mut self,
        row: &[f64],
        right: impl Fn(&Place, usize) -> f64,
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let (n, at, scale) = (self.n, &self.at, self.scale);
        self.system.set(|i, to| {
            if i < n {
                to[..n].copy_from_slice(&at.slope[i * n..(i + 1) * n]);
                (to[n], to[n + 1]) = (at.by_parameter[i] / scale, right(at, i));
            } else {
                to[..=n].copy_from_slice(row);
                to[n + 1] = last;
            }
        });
        let mut y = vec![0.0; n + 1];
        let sign = self.system.solve_signed(&mut y)?;
        Some((y, sign))
    }

    /// Unit tangent with the sign of det [H_x H_t; tangent] given, at first that along `row`; and that sign.
    fn tangent(&mut self, point: &[f64], row: &[f64], orientation: Option<f64>) -> Option<(Vec<f64>, f64)> {
        if !self.evaluate(point) {
            return None;
        }
        let (mut along, sign) = self.solve(row, |_, _| 0.0, 1.0)?;
        let length = norm(&along);
        if !length.is_finite() || length == 0.0 {
            return None;
        }
        // with the tangent itself as last row the determinant is that with `row` times |along|^2 over row.along = 1
        let turned = if orientation.is_some_and(|wanted| wanted != sign) { -1.0 } else { 1.0 };
        along.iter_mut().for_each(|v| *v *= turned / length);
        Some((along, sign))
    }

    /// The next point of the path, about `step` on, and the corrections it took.
    ///
    /// Where it is not found straight on, a kink may have turned the path back: then the tangent of what lies beyond the
    /// kink leads on from there.
    fn advance(
        &mut self,
        here: &[f64],
        tangent: &[f64],
        step: f64,
        orientation: f64,
    ) -> Option<(Vec<f64>, usize)> {
        // a far correction may have jumped to another branch
        let near = |(there, n): (Vec<f64>, usize)| {
            (norm(&ahead(&there, here, -1.0)) <= 2.5 * step).then_some((there, n))
        };
        let straight_on = ahead(here, tangent, step);
        if let Some(found) = self.correct(straight_on.clone(), tangent).and_then(near) {
            return Some(found);
        }
        let (turned, _) = self.tangent(&straight_on, tangent, Some(orientation))?;
        if step > TURNING_STEP || dot(&turned, tangent) > SHARP {
            return None;
        }
        let (there, corrections) =
            self.correct(ahead(&straight_on, &turned, step), &turned).and_then(near)?;
        // the correction may have gone back to the near side of the kink
        let (onward, _) = self.tangent(&there, &turned, Some(orientation))?;
        (dot(&onward, &turned) > SHARP).then_some((there, corrections))
    }

    /// The point of the path in the plane across `row` through `point`, and the corrections it took.
    fn correct(&mut self, mut point: Vec<f64>, row: &[f64]) -> Option<(Vec<f64>, usize)> {
        let scale = self.scale;
        let mut before = f64::INFINITY;
        for correction in 0..=MAX_CORRECTIONS {
            if !self.evaluate(&point) {
                return None;
            }
            let size = self.at.value.iter().fold(0.0f64, |most, v| most.max(v.abs())) / scale;
            if size <= ON_PATH {
                return Some((point, correction));
            }
            // kinks let the residual grow once; twice is another branch
            if size > 10.0 * before {
                return None;
            }
            before = size;
            let (change, _) = self.solve(row, |at, i| at.value[i] / scale, 0.0)?;
            point.iter_mut().zip(&change).for_each(|(p, c)| *p -= c);
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
