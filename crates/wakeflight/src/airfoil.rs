//! Section coefficients by angle of attack and Mach number, and how they follow a motion in time.

pub mod span;
pub mod unsteady;

use crate::numerics::scalar::{OfTwo, Real};
use crate::numerics::tables::Grid;
use serde::Deserialize;
use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// Tables of one airfoil; rows angle of attack [rad] over -pi..pi, columns Mach number.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirfoilTables {
    /// Lift coefficient.
    pub cl: Grid,
    /// Drag coefficient.
    pub cd: Grid,
    /// Moment coefficient about the quarter chord, nose up positive.
    pub cm: Grid,
    /// Added to every drag coefficient.
    pub cd_increment: f64,
}

/// What is wrong with a table of an airfoil.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AirfoilError {
    /// Axes or rows of unequal or too small length.
    #[error("airfoil table {table}: {rows} angles, {columns} Mach numbers do not fit the values")]
    Shape {
        /// Which table.
        table: &'static str,
        /// Length of the first axis.
        rows: usize,
        /// Length of the second axis.
        columns: usize,
    },
    /// Sections along the span without a station or a table each.
    #[error(
        "airfoil: {stations} stations and {tables} section tables; one table is needed at each of one or more stations"
    )]
    Sections {
        /// Number of stations.
        stations: usize,
        /// Number of tables.
        tables: usize,
    },
    /// An axis is not strictly ascending.
    #[error("airfoil table {table}: {axis} is not strictly ascending at entry {index}")]
    NotAscending {
        /// Which table.
        table: &'static str,
        /// Angle of attack, Mach number or station.
        axis: &'static str,
        /// Entry that is not above the one before it.
        index: usize,
    },
    /// A number that is not finite.
    #[error("airfoil table {table}: a number is not finite")]
    NotFinite {
        /// Which table.
        table: &'static str,
    },
    /// Range of an axis too small.
    #[error("airfoil table {table}: {axis} runs from {first} to {last}, {needed} needed")]
    Range {
        /// Which table.
        table: &'static str,
        /// Angle of attack or Mach number.
        axis: &'static str,
        /// First entry.
        first: f64,
        /// Last entry.
        last: f64,
        /// What is needed, in words.
        needed: &'static str,
    },
}

/// An axis with a uniform index: the bin of a value is one multiplication away, its cell at most a few steps from there.
#[derive(Clone, Debug)]
struct Axis {
    nodes: Vec<f64>,
    inverse_width: Vec<f64>,
    first_cell: Vec<u32>,
    bins_per_unit: f64,
}

/// Most bins of an index; finer spacing than this only costs a step or two more.
const MOST_BINS: usize = 8192;

impl Axis {
    fn new(nodes: Vec<f64>) -> Self {
        let n_cells = nodes.len() - 1;
        let (first, last) = (nodes[0], nodes[n_cells]);
        let narrowest = nodes.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        let n_bins = (((last - first) / narrowest).ceil() as usize).clamp(1, MOST_BINS);
        let bins_per_unit = n_bins as f64 / (last - first);
        let first_cell = (0..n_bins)
            .map(|bin| {
                let start = first + bin as f64 / bins_per_unit;
                (nodes.partition_point(|&a| a <= start).clamp(1, n_cells) - 1) as u32
            })
            .collect();
        let inverse_width = nodes.windows(2).map(|w| 1.0 / (w[1] - w[0])).collect();
        Self { nodes, inverse_width, first_cell, bins_per_unit }
    }

    /// Cell, position in it (0 to 1), and the position's derivative; held beyond the ends.
    #[inline(always)]
    fn cell(&self, value: f64) -> (usize, f64, f64) {
        let last_cell = self.inverse_width.len() - 1;
        // a negative or NaN bin becomes 0, a large one the last
        let bin = ((value - self.nodes[0]) * self.bins_per_unit) as usize;
        let mut i = self.first_cell[bin.min(self.first_cell.len() - 1)] as usize;
        while i < last_cell && value >= self.nodes[i + 1] {
            i += 1;
        }
        // rounding may put the start of a bin a hair above the value
        while i > 0 && value < self.nodes[i] {
            i -= 1;
        }
        let slope = self.inverse_width[i];
        let position = (value - self.nodes[i]) * slope;
        if position < 0.0 {
            (i, 0.0, 0.0)
        } else if position > 1.0 {
            (i, 1.0, 0.0)
        } else {
            (i, position, slope)
        }
    }
}

/// Mach number at which the angle without lift is taken.
const LOW_MACH: f64 = 0.3;

/// One airfoil, its three tables joined on the union of their axes.
///
/// Joining changes nothing: each table is bilinear on every cell of the union.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "AirfoilTables")]
pub struct Airfoil {
    alpha: Axis,
    mach: Axis,
    // (cl, cd, cm) at alpha-major nodes
    nodes: Vec<[f64; 3]>,
    /// Angle of attack without lift at a low Mach number [rad].
    zero_lift: f64,
}

impl TryFrom<AirfoilTables> for Airfoil {
    type Error = AirfoilError;
    fn try_from(tables: AirfoilTables) -> Result<Self, AirfoilError> {
        Self::new(&tables)
    }
}

impl AirfoilTables {
    /// Whether the tables are finite, ascending, and cover -pi..pi; Mach numbers, one or more, are held beyond their ends.
    pub fn validate(&self) -> Result<(), AirfoilError> {
        for (table, grid) in [("cl", &self.cl), ("cd", &self.cd), ("cm", &self.cm)] {
            validate_grid(table, grid)?;
        }
        if !self.cd_increment.is_finite() {
            return Err(AirfoilError::NotFinite { table: "cd_increment" });
        }
        Ok(())
    }
}

fn validate_grid(table: &'static str, grid: &Grid) -> Result<(), AirfoilError> {
    let (rows, columns) = (grid.x.len(), grid.y.len());
    let fits = grid.values.len() == rows && grid.values.iter().all(|row| row.len() == columns);
    if !fits || rows < 2 || columns < 1 {
        return Err(AirfoilError::Shape { table, rows, columns });
    }
    let mut numbers = grid.x.iter().chain(&grid.y).chain(grid.values.iter().flatten());
    if !numbers.all(|v| v.is_finite()) {
        return Err(AirfoilError::NotFinite { table });
    }
    for (axis, nodes) in [("angle of attack", &grid.x), ("Mach number", &grid.y)] {
        if let Some(i) = nodes.windows(2).position(|w| w[1] <= w[0]) {
            return Err(AirfoilError::NotAscending { table, axis, index: i + 1 });
        }
    }
    // degrees converted to radians meet pi to rounding
    let rounding = 1e-9;
    let range = |axis, nodes: &[f64], needed| {
        Err(AirfoilError::Range { table, axis, first: nodes[0], last: nodes[nodes.len() - 1], needed })
    };
    if grid.x[0] > -PI + rounding || grid.x[rows - 1] < PI - rounding {
        return range("angle of attack", &grid.x, "-pi to pi");
    }
    if grid.y[0] < 0.0 {
        return range("Mach number", &grid.y, "0 or more");
    }
    Ok(())
}

fn union(axes: [&[f64]; 3]) -> Vec<f64> {
    let mut nodes: Vec<f64> = axes.into_iter().flatten().copied().collect();
    nodes.sort_by(f64::total_cmp);
    nodes.dedup();
    nodes
}

impl Airfoil {
    /// Joins and checks the tables.
    pub fn new(tables: &AirfoilTables) -> Result<Self, AirfoilError> {
        tables.validate()?;
        let AirfoilTables { cl, cd, cm, cd_increment } = tables;
        let alpha = union([&cl.x, &cd.x, &cm.x]);
        let mut mach = union([&cl.y, &cd.y, &cm.y]);
        if mach.len() == 1 {
            // one column holds at every Mach number
            mach.push(mach[0] + 1.0);
        }
        let mut nodes = Vec::with_capacity(alpha.len() * mach.len());
        for &a in &alpha {
            for &m in &mach {
                nodes.push([cl.at(a, m), cd.at(a, m) + cd_increment, cm.at(a, m)]);
            }
        }
        Ok(Self::of_nodes(alpha, mach, nodes))
    }

    /// From its axes and the coefficients at their nodes, angle by angle.
    fn of_nodes(alpha: Vec<f64>, mach: Vec<f64>, nodes: Vec<[f64; 3]>) -> Self {
        let mut airfoil = Self { alpha: Axis::new(alpha), mach: Axis::new(mach), nodes, zero_lift: 0.0 };
        airfoil.zero_lift = airfoil.zero_lift_at(LOW_MACH);
        airfoil
    }

    /// Angle of attack without lift at `mach` [rad], within 15 deg.
    fn zero_lift_at(&self, mach: f64) -> f64 {
        let cl = |alpha: f64| self.coefficients::<f64>(alpha, mach).0;
        let (mut low, mut high) = (-15f64.to_radians(), 15f64.to_radians());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if cl(middle) < 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// Angle of attack without lift at a low Mach number [rad], within 15 deg.
    pub fn zero_lift(&self) -> f64 {
        self.zero_lift
    }

    /// Lift, drag (increment included) and quarter-chord moment coefficients, bilinear.
    ///
    /// `alpha` [rad]: any angle, taken to -pi..pi. `mach`: held beyond the table.
    #[inline(always)]
    pub fn coefficients<S: Real>(&self, alpha: S, mach: S) -> (S, S, S) {
        let [cl, cd, cm] = S::of_two(self, alpha, mach);
        (cl, cd, cm)
    }
}

impl OfTwo<3> for Airfoil {
    #[inline(always)]
    fn at(&self, mut alpha: f64, mach: f64) -> [[f64; 3]; 3] {
        if alpha.abs() > PI {
            alpha -= TAU * (alpha / TAU).round();
        }
        let (i, f, df) = self.alpha.cell(alpha);
        let (j, g, dg) = self.mach.cell(mach);
        let n_mach = self.mach.nodes.len();
        let low = &self.nodes[i * n_mach + j..][..2];
        let high = &self.nodes[(i + 1) * n_mach + j..][..2];
        [
            interpolated((low, high), 0, (f, df), (g, dg)),
            interpolated((low, high), 1, (f, df), (g, dg)),
            interpolated((low, high), 2, (f, df), (g, dg)),
        ]
    }
}

/// Coefficient `k` in a cell at position (f, g), whose derivatives by angle and Mach number are (df, dg): its value and two
/// slopes.
#[inline(always)]
fn interpolated(
    (low, high): (&[[f64; 3]], &[[f64; 3]]),
    k: usize,
    (f, df): (f64, f64),
    (g, dg): (f64, f64),
) -> [f64; 3] {
    let (v00, v01, v10, v11) = (low[0][k], low[1][k], high[0][k], high[1][k]);
    let at_low = v00 + g * (v01 - v00);
    let at_high = v10 + g * (v11 - v10);
    let by_mach = (v01 - v00) + f * ((v11 - v10) - (v01 - v00));
    [at_low + f * (at_high - at_low), df * (at_high - at_low), dg * by_mach]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    /// Table of `f` (angle [rad], Mach number) at angles `x` [deg] and Mach numbers `y`.
    pub(super) fn grid(x: &[f64], y: &[f64], f: fn(f64, f64) -> f64) -> Grid {
        Grid {
            x: x.iter().map(|d| d.to_radians()).collect(),
            y: y.to_vec(),
            values: x.iter().map(|&a| y.iter().map(|&m| f(a.to_radians(), m)).collect()).collect(),
        }
    }

    /// Tables with different, uneven axes.
    pub(super) fn tables() -> AirfoilTables {
        // different, uneven axes: what a table of measured data looks like
        AirfoilTables {
            cl: grid(&[-180., -172.5, -49., -3., 0.5, 12., 90., 180.], &[0., 0.3, 0.75, 1.], |a, m| {
                a.sin() * (1. + m)
            }),
            cd: grid(&[-180., -20., 0., 21., 180.], &[0., 0.9], |a, m| 1. - a.cos() + m * m),
            cm: grid(&[-180., 0., 180.], &[0., 0.25, 0.95], |a, m| -0.1 * a.sin().powi(2) + m),
            cd_increment: 0.002,
        }
    }

    #[test]
    fn joined_tables_equal_each_table_by_itself() {
        let t = tables();
        let airfoil = Airfoil::new(&t).unwrap();
        for i in 0..=720 {
            for m in [0.0, 0.1, 0.3, 0.5, 0.77, 0.9, 0.97, 1.0, 1.3] {
                let a = f64::to_radians(0.5 * i as f64 - 180.0);
                let (cl, cd, cm) = airfoil.coefficients(a, m);
                assert!((cl - t.cl.at(a, m)).abs() < 1e-14);
                assert!((cd - t.cd.at(a, m) - 0.002).abs() < 1e-14);
                assert!((cm - t.cm.at(a, m)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn mach_numbers_are_held_beyond_the_columns_a_table_has() {
        let mut t = tables();
        for table in [&mut t.cl, &mut t.cd, &mut t.cm] {
            *table = grid(&[-180., 0., 10., 180.], &[0.2], |a, m| (2.0 * a).sin() + m);
        }
        let airfoil = Airfoil::new(&t).unwrap();
        for mach in [0.0, 0.2, 0.7, 1.3] {
            assert!((airfoil.coefficients(0.1, mach).0 - t.cl.at(0.1, 0.2)).abs() < 1e-14);
        }
        t.cl = grid(&[-180., 0., 10., 180.], &[0.3, 0.8], |a, m| (2.0 * a).sin() + m);
        let airfoil = Airfoil::new(&t).unwrap();
        assert_eq!(airfoil.coefficients(0.1, 0.95).0, airfoil.coefficients(0.1, 0.8).0);
        assert_eq!(airfoil.coefficients(0.1, 0.0).0, airfoil.coefficients(0.1, 0.3).0);
    }

    #[test]
    fn whole_turns_change_nothing() {
        let airfoil = Airfoil::new(&tables()).unwrap();
        for turns in [-3.0, -1.0, 1.0, 2.0] {
            let (a, _, _) = airfoil.coefficients(2.9, 0.4);
            let (b, _, _) = airfoil.coefficients(2.9 + turns * TAU, 0.4);
            assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn derivatives_equal_central_differences() {
        let airfoil = Airfoil::new(&tables()).unwrap();
        let h = 1e-6;
        for (a, m) in [(0.1, 0.45), (-2.0, 0.8), (3.5, 0.2), (0.3, 1.2)] {
            let d = airfoil.coefficients(Dual::<2>::variable(a, 0), Dual::<2>::variable(m, 1));
            let (p, q) = (airfoil.coefficients(a + h, m), airfoil.coefficients(a - h, m));
            let (r, s) = (airfoil.coefficients(a, m + h), airfoil.coefficients(a, m - h));
            for (dual, plus, minus, up, down) in
                [(d.0, p.0, q.0, r.0, s.0), (d.1, p.1, q.1, r.1, s.1), (d.2, p.2, q.2, r.2, s.2)]
            {
                assert!((dual.eps[0] - (plus - minus) / (2.0 * h)).abs() < 1e-8);
                assert!((dual.eps[1] - (up - down) / (2.0 * h)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn faulty_tables_are_refused_by_name() {
        let mut t = tables();
        t.cl.x[7] = 3.0;
        assert!(matches!(
            Airfoil::new(&t),
            Err(AirfoilError::Range { table: "cl", axis: "angle of attack", .. })
        ));
        let mut t = tables();
        t.cd.y[0] = -0.1;
        assert!(matches!(
            Airfoil::new(&t),
            Err(AirfoilError::Range { table: "cd", axis: "Mach number", .. })
        ));
        let mut t = tables();
        t.cm.x[1] = -4.0;
        assert!(matches!(Airfoil::new(&t), Err(AirfoilError::NotAscending { table: "cm", index: 1, .. })));
        let mut t = tables();
        t.cm.values[1][1] = f64::NAN;
        assert!(matches!(Airfoil::new(&t), Err(AirfoilError::NotFinite { table: "cm" })));
        let mut t = tables();
        t.cd.values[2].pop();
        assert!(matches!(Airfoil::new(&t), Err(AirfoilError::Shape { table: "cd", .. })));
        let mut t = tables();
        t.cl.values.clear();
        t.cl.x.clear();
        assert!(matches!(Airfoil::new(&t), Err(AirfoilError::Shape { table: "cl", .. })));
    }

    #[test]
    fn no_angle_and_no_mach_number_panics() {
        let airfoil = Airfoil::new(&tables()).unwrap();
        for a in [f64::NAN, f64::INFINITY, 1e300, -1e300, PI, -PI] {
            for m in [f64::NAN, f64::INFINITY, -1.0, 0.0, 5.0] {
                let _ = airfoil.coefficients(a, m);
            }
        }
        assert!(airfoil.coefficients(PI, 5.0).0.is_finite());
    }
}
