//! Separation point of a section, found from its own table for each Mach number.
//!
//! Kirchhoff's flow past a plate separated at the share f of its chord has C_l = C_l,alpha (alpha - alpha_0) (1 + sqrt f)^2/4; the
//! table's lift gives f. Away from zero lift f only falls; it is held at 0 beyond 45 deg.

use super::super::{Airfoil, Axis, interpolated};
use crate::numerics::scalar::{OfTwo, Real};

/// Angles between zero lift and here [deg] give the slope of attached flow.
const SLOPE_RANGE: [f64; 2] = [1.5, 6.0];
/// Step of the angles at which the table is read [deg].
const STEP: f64 = 0.5;
/// Angle [deg] beyond which the flow is separated.
const SEPARATED: f64 = 45.0;
/// Largest angle [deg] that is kept; the model is not engaged beyond.
const LAST: f64 = 60.0;
/// Share of the attached lift that separation takes, at full and at no attachment in Kirchhoff's flow and at most.
const LOST: [f64; 2] = [0.5, 1.0];
/// Intervals of the separation point in the table of arms.
const ARMS: usize = 20;

/// What a table says of separation.
#[derive(Clone, Debug)]
pub struct Separation {
    alpha: Axis,
    mach: Axis,
    /// Separation point, lift lost from attached to separated flow, nothing; at angle-major nodes.
    nodes: Vec<[f64; 3]>,
    point: Axis,
    /// Arm of the lift about the quarter chord above zero lift, below it, nothing; at nodes of separation point and Mach number.
    arms: Vec<[f64; 3]>,
    /// Slope [1/rad] and zero-lift angle [rad] at each Mach number.
    attached: Vec<[f64; 2]>,
}

/// Separation at an angle of attack of steady flow.
#[derive(Clone, Copy, Debug)]
pub struct Separated<S> {
    /// Separation point as a share of the chord, 1 attached.
    pub point: S,
    /// Lift coefficient of attached less that of separated flow.
    pub lift_lost: S,
}

impl Separation {
    /// From the table of a section.
    pub fn of(airfoil: &Airfoil) -> Self {
        let mach = airfoil.mach.nodes.clone();
        let count = (2.0 * LAST / STEP) as usize + 1;
        let angles: Vec<f64> = (0..count).map(|i| (i as f64 * STEP - LAST).to_radians()).collect();
        let columns: Vec<Column> = mach.iter().map(|&m| Column::of(airfoil, m, &angles)).collect();
        let nodes =
            (0..count).flat_map(|i| columns.iter().map(move |c| [c.point[i], c.lift_lost[i], 0.0])).collect();
        let shares: Vec<f64> = (0..=ARMS).map(|j| j as f64 / ARMS as f64).collect();
        let arms = shares
            .iter()
            .flat_map(|&f| columns.iter().map(move |c| (c, f)))
            .map(|(c, f)| [c.arm(airfoil, &angles, f, true), c.arm(airfoil, &angles, f, false), 0.0])
            .collect();
        let attached = columns.iter().map(|c| [c.slope, c.zero_lift]).collect();
        Self {
            alpha: Axis::new(angles),
            mach: Axis::new(mach),
            nodes,
            point: Axis::new(shares),
            arms,
            attached,
        }
    }

    /// Separation of steady flow at `alpha` [rad].
    pub fn at<S: Real>(&self, alpha: S, mach: S) -> Separated<S> {
        let law = Lookup { rows: &self.alpha, mach: &self.mach, nodes: &self.nodes };
        let [point, lift_lost, _] = S::of_two(&law, alpha, mach);
        Separated { point, lift_lost }
    }

    /// Arm of the lift about the quarter chord, moment over lift, over the chord, that belongs to a separation point on the side
    /// of `alpha`.
    pub(super) fn arm<S: Real>(&self, alpha: S, point: S, mach: S) -> S {
        let law = Lookup { rows: &self.point, mach: &self.mach, nodes: &self.arms };
        let [above, below, _] = S::of_two(&law, point, mach);
        if alpha.re() >= self.zero_lift(mach).re() { above } else { below }
    }

    /// Lift slope of attached flow [1/rad].
    pub(super) fn slope<S: Real>(&self, mach: S) -> S {
        self.by_mach(mach, 0)
    }

    /// Angle of attack without lift [rad].
    pub(super) fn zero_lift<S: Real>(&self, mach: S) -> S {
        self.by_mach(mach, 1)
    }

    fn by_mach<S: Real>(&self, mach: S, which: usize) -> S {
        let (j, g, dg) = self.mach.cell(mach.re());
        let (low, high) = (self.attached[j][which], self.attached[j + 1][which]);
        mach.chain(low + g * (high - low), dg * (high - low))
    }
}

/// Three bilinear functions of a row variable and the Mach number.
struct Lookup<'a> {
    rows: &'a Axis,
    mach: &'a Axis,
    nodes: &'a [[f64; 3]],
}

impl OfTwo<3> for Lookup<'_> {
    fn at(&self, row: f64, mach: f64) -> [[f64; 3]; 3] {
        let (i, f, df) = self.rows.cell(row);
        let (j, g, dg) = self.mach.cell(mach);
        let n = self.mach.nodes.len();
        let low = &self.nodes[i * n + j..][..2];
        let high = &self.nodes[(i + 1) * n + j..][..2];
        std::array::from_fn(|k| interpolated((low, high), k, (f, df), (g, dg)))
    }
}

/// One Mach number.
struct Column {
    mach: f64,
    slope: f64,
    zero_lift: f64,
    point: Vec<f64>,
    lift_lost: Vec<f64>,
}

impl Column {
    fn of(airfoil: &Airfoil, mach: f64, angles: &[f64]) -> Self {
        let cl = |alpha: f64| airfoil.coefficients::<f64>(alpha, mach).0;
        let zero_lift = airfoil.zero_lift_at(mach);
        let [first, last] = SLOPE_RANGE;
        let steps = ((last - first) / STEP) as usize;
        let secant = |degrees: f64| cl(zero_lift + degrees.to_radians()) / degrees.to_radians();
        // the steepest secant either side: attached lift lies on it or below
        let slope = (0..=steps)
            .map(|i| first + i as f64 * STEP)
            .flat_map(|d| [secant(d), secant(-d)])
            .fold(f64::MIN_POSITIVE, f64::max);
        let attached = |alpha: f64| slope * (alpha - zero_lift);
        let raw = |alpha: f64| {
            let ratio = cl(alpha) / attached(alpha);
            if (alpha - zero_lift).abs() < STEP.to_radians() {
                1.0
            } else if alpha.abs() > SEPARATED.to_radians() || ratio.is_nan() || ratio <= 0.25 {
                0.0
            } else {
                (2.0 * ratio.sqrt() - 1.0).powi(2).min(1.0)
            }
        };
        let mut point: Vec<f64> = angles.iter().map(|&a| raw(a)).collect();
        let middle = angles.partition_point(|&a| a < zero_lift).min(angles.len() - 1);
        for i in middle + 1..point.len() {
            point[i] = point[i].min(point[i - 1]);
        }
        for i in (0..middle).rev() {
            point[i] = point[i].min(point[i + 1]);
        }
        let lift_lost = angles
            .iter()
            .zip(&point)
            .map(|(&a, &f)| {
                let full = attached(a);
                let share = if f < 1.0 { (1.0 - cl(a) / full) / (1.0 - f) } else { LOST[0] };
                full * share.clamp(LOST[0], LOST[1])
            })
            .collect();
        Self { mach, slope, zero_lift, point, lift_lost }
    }

    /// Arm where the separation point first falls to `share`, above or below zero lift.
    fn arm(&self, airfoil: &Airfoil, angles: &[f64], share: f64, above: bool) -> f64 {
        let middle = angles.partition_point(|&a| a < self.zero_lift).min(angles.len() - 1);
        let order: Vec<usize> =
            if above { (middle..angles.len()).collect() } else { (0..middle).rev().collect() };
        // attached flow: the last angle of it; otherwise the first angle separated that far
        let first = order.windows(2).find_map(|w| {
            let (inner, outer) = (self.point[w[0]], self.point[w[1]]);
            let reached = if share < 1.0 { outer <= share } else { outer < 1.0 };
            reached.then(|| {
                let t = if inner > outer { ((inner - share) / (inner - outer)).clamp(0.0, 1.0) } else { 0.0 };
                angles[w[0]] + t * (angles[w[1]] - angles[w[0]])
            })
        });
        let Some(alpha) = first else { return 0.0 };
        let (cl, _, cm) = airfoil.coefficients::<f64>(alpha, self.mach);
        let (_, _, cm_0) = airfoil.coefficients::<f64>(self.zero_lift, self.mach);
        if cl.abs() > 0.1 { (cm - cm_0) / cl } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::AirfoilTables;
    use super::super::super::tests::grid;
    use super::*;
    use std::f64::consts::PI;

    /// A plate in Kirchhoff's flow whose separation point falls from 10 to 20 deg.
    fn plate() -> Airfoil {
        let degrees: Vec<f64> = (-720..=720).map(|i| 0.25 * i as f64).collect();
        let lift = |a: f64, _: f64| {
            let f = (2.0 - a.abs().to_degrees() / 10.0).clamp(0.0, 1.0);
            2.0 * PI * a * (1.0 + f.sqrt()).powi(2) / 4.0
        };
        let tables = AirfoilTables {
            cl: grid(&degrees, &[0.0, 1.0], lift),
            cd: grid(&[-180., 180.], &[0.0], |_, _| 0.01),
            cm: grid(&[-180., 0., 180.], &[0.0], |a, _| -0.1 * a),
            cd_increment: 0.0,
        };
        Airfoil::new(&tables).unwrap()
    }

    #[test]
    fn the_separation_point_of_kirchhoffs_plate_is_found_again() {
        let separation = Separation::of(&plate());
        for degrees in [-30.0, -17.0, -12.0, -4.0, 0.0, 3.0, 10.0, 11.0, 15.5, 19.0, 25.0, 50.0, 90.0] {
            let exact = (2.0 - f64::abs(degrees) / 10.0).clamp(0.0, 1.0);
            let found = separation.at(f64::to_radians(degrees), 0.3);
            assert!((found.point - exact).abs() < 1e-9, "{degrees} deg: {} {exact}", found.point);
        }
        // attached flow loses half its lift, fully separated three quarters
        let lost = |d: f64| separation.at(d.to_radians(), 0.3).lift_lost / (2.0 * PI * d.to_radians());
        assert!((lost(5.0) - 0.5).abs() < 1e-9 && (lost(20.0) - 0.75).abs() < 1e-9);
        assert!((separation.slope(0.3) - 2.0 * PI).abs() < 1e-9);
    }

    #[test]
    fn away_from_zero_lift_the_flow_only_separates() {
        let separation = Separation::of(&plate());
        for side in [-1.0, 1.0] {
            let mut before = 1.0;
            for i in 0..360 {
                let point = separation.at(side * f64::to_radians(0.5 * i as f64), 0.5).point;
                assert!((0.0..=before).contains(&point));
                before = point;
            }
        }
    }
}
