//! Sections along the span: tables at named stations, between them linear in the station or in steps.
//!
//! A blade has finitely many stations of the air, so that the table of each is made once: the weighted mean of its
//! neighbours' tables, exact because both are bilinear on the cells of the union of their axes. Values and derivatives are
//! then those of one table, whatever the number of sections.

use super::unsteady::Separation;
use super::{Airfoil, AirfoilError, AirfoilTables, Axis};
use serde::Deserialize;
use std::f64::consts::PI;

/// Sections of a blade as the data give them.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SpanTables {
    stations: Vec<f64>,
    stepwise: bool,
    tables: Vec<AirfoilTables>,
}

/// Sections of a blade, inboard to outboard.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "SpanTables")]
pub struct SpanSections {
    /// Where each section is, from the hub centre [m], ascending.
    stations: Vec<f64>,
    /// Whether a section holds from its station to the next one; otherwise tables are linear in the station.
    stepwise: bool,
    airfoils: Vec<Airfoil>,
}

impl TryFrom<SpanTables> for SpanSections {
    type Error = AirfoilError;
    fn try_from(data: SpanTables) -> Result<Self, AirfoilError> {
        let airfoils = data.tables.iter().map(Airfoil::new).collect::<Result<Vec<_>, _>>()?;
        Self::new(data.stations, data.stepwise, airfoils)
    }
}

impl SpanSections {
    /// `airfoils` at `stations` [m] from the hub centre; `stepwise`: each holds from its station to the next one.
    pub fn new(stations: Vec<f64>, stepwise: bool, airfoils: Vec<Airfoil>) -> Result<Self, AirfoilError> {
        if stations.is_empty() || stations.len() != airfoils.len() {
            return Err(AirfoilError::Sections { stations: stations.len(), tables: airfoils.len() });
        }
        if stations.iter().any(|r| !r.is_finite()) {
            return Err(AirfoilError::NotFinite { table: "stations" });
        }
        if let Some(i) = stations.windows(2).position(|r| r[1] <= r[0]) {
            return Err(AirfoilError::NotAscending { table: "stations", axis: "station", index: i + 1 });
        }
        Ok(Self { stations, stepwise, airfoils })
    }

    /// One section along the whole span.
    pub fn uniform(airfoil: Airfoil) -> Self {
        Self { stations: vec![0.0], stepwise: false, airfoils: vec![airfoil] }
    }

    /// Tables of the stations of the air at `x` [m] from the hub centre; beyond the named stations, those of the end.
    pub fn at(&self, x: impl IntoIterator<Item = f64>) -> StationAirfoils {
        let mut made: Vec<(usize, f64)> = Vec::new();
        let mut all = StationAirfoils { airfoils: Vec::new(), of_station: Vec::new() };
        for x in x {
            let place = self.place(x);
            let known = made.iter().position(|&other| other == place);
            let index = known.unwrap_or_else(|| {
                let (inner, share) = place;
                made.push(place);
                all.airfoils.push(if share == 0.0 {
                    self.airfoils[inner].clone()
                } else {
                    Airfoil::between(&self.airfoils[inner], &self.airfoils[inner + 1], share)
                });
                made.len() - 1
            });
            all.of_station.push(index);
        }
        all
    }

    /// Section inboard of `x`, and the share of the next one, from 0 to below 1.
    fn place(&self, x: f64) -> (usize, f64) {
        let inner = self.stations.partition_point(|&r| r <= x).saturating_sub(1);
        if self.stepwise || x <= self.stations[0] || inner + 1 == self.stations.len() {
            return (inner, 0.0);
        }
        (inner, (x - self.stations[inner]) / (self.stations[inner + 1] - self.stations[inner]))
    }
}

/// The table of every station of the air.
#[derive(Clone, Debug)]
pub struct StationAirfoils {
    airfoils: Vec<Airfoil>,
    of_station: Vec<usize>,
}

impl StationAirfoils {
    /// One table for all of `n_stations`.
    pub fn uniform(airfoil: Airfoil, n_stations: usize) -> Self {
        Self { airfoils: vec![airfoil], of_station: vec![0; n_stations] }
    }

    /// Table of station `j`.
    #[inline(always)]
    pub fn at(&self, j: usize) -> &Airfoil {
        &self.airfoils[self.of_station[j]]
    }
}

/// The separation of every station, found from its table.
#[derive(Clone, Debug)]
pub struct StationSeparations {
    separations: Vec<Separation>,
    of_station: Vec<usize>,
}

impl StationSeparations {
    /// Of the tables of `airfoils`.
    pub fn of(airfoils: &StationAirfoils) -> Self {
        let separations = airfoils.airfoils.iter().map(Separation::of).collect();
        Self { separations, of_station: airfoils.of_station.clone() }
    }

    /// Separation of station `j`.
    #[inline(always)]
    pub fn at(&self, j: usize) -> &Separation {
        &self.separations[self.of_station[j]]
    }
}

/// Nodes [rad, 1] nearer than this are one: degrees converted to radians.
const SAME_NODE: f64 = 1e-9;

/// Nodes of two axes, each once.
fn joined(a: &Axis, b: &Axis) -> Vec<f64> {
    let mut nodes: Vec<f64> = a.nodes.iter().chain(&b.nodes).copied().collect();
    nodes.sort_by(f64::total_cmp);
    nodes.dedup_by(|after, before| *after - *before < SAME_NODE);
    nodes
}

impl Airfoil {
    /// The section `share` of the way from `inner` to `outer`: mean of their coefficients at every angle and Mach number.
    fn between(inner: &Self, outer: &Self, share: f64) -> Self {
        let alpha = joined(&inner.alpha, &outer.alpha);
        let mach = joined(&inner.mach, &outer.mach);
        let mut nodes = Vec::with_capacity(alpha.len() * mach.len());
        for a in alpha.iter().map(|a| a.clamp(-PI, PI)) {
            for &m in &mach {
                let (of_inner, of_outer) = (inner.coefficients(a, m), outer.coefficients(a, m));
                let mean = |u: f64, v: f64| u + share * (v - u);
                nodes.push([
                    mean(of_inner.0, of_outer.0),
                    mean(of_inner.1, of_outer.1),
                    mean(of_inner.2, of_outer.2),
                ]);
            }
        }
        Self::of_nodes(alpha, mach, nodes)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{grid, tables};
    use super::*;
    use crate::numerics::scalar::Dual;

    fn two() -> [Airfoil; 2] {
        let mut tip = tables();
        tip.cl = grid(&[-180., -90., -7., 2., 15., 180.], &[0.2, 0.6, 0.8], |a, m| (2.0 * a).sin() + m * a);
        tip.cd_increment = 0.0;
        [Airfoil::new(&tables()).unwrap(), Airfoil::new(&tip).unwrap()]
    }

    #[test]
    fn between_two_stations_coefficients_are_linear_and_beyond_them_held() {
        let [root, tip] = two();
        let sections = SpanSections::new(vec![2.0, 6.0], false, vec![root.clone(), tip.clone()]).unwrap();
        let x = [1.0, 2.0, 3.0, 5.5, 6.0, 8.0];
        let made = sections.at(x);
        for (j, share) in [0.0, 0.0, 0.25, 0.875, 1.0, 1.0].into_iter().enumerate() {
            for i in 0..=720 {
                for m in [0.0, 0.1, 0.3, 0.5, 0.77, 0.9, 0.97, 1.3] {
                    let a = f64::to_radians(0.5 * i as f64 - 180.0);
                    let (u, v, w) =
                        (root.coefficients(a, m), tip.coefficients(a, m), made.at(j).coefficients(a, m));
                    for (u, v, w) in [(u.0, v.0, w.0), (u.1, v.1, w.1), (u.2, v.2, w.2)] {
                        assert!((w - (u + share * (v - u))).abs() < 1e-13, "station {j}, {a} rad, Mach {m}");
                    }
                }
            }
        }
        // the ends share the tables of the named sections
        assert_eq!(made.of_station, [0, 0, 1, 2, 3, 3]);
    }

    #[test]
    fn derivatives_between_two_stations_are_the_means_of_theirs() {
        let [root, tip] = two();
        let made =
            SpanSections::new(vec![0.0, 1.0], false, vec![root.clone(), tip.clone()]).unwrap().at([0.3]);
        for (a, m) in [(0.1, 0.45), (-2.0, 0.7), (3.1, 0.25), (0.3, 1.2)] {
            let at = |airfoil: &Airfoil| {
                airfoil.coefficients(Dual::<2>::variable(a, 0), Dual::<2>::variable(m, 1)).0.eps
            };
            let (u, v, w) = (at(&root), at(&tip), at(made.at(0)));
            for k in 0..2 {
                assert!((w[k] - (0.7 * u[k] + 0.3 * v[k])).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn in_steps_a_section_holds_from_its_station_to_the_next() {
        let [root, tip] = two();
        let made = SpanSections::new(vec![2.0, 6.0], true, vec![root.clone(), tip.clone()]).unwrap();
        let made = made.at([1.0, 5.9, 6.0, 7.0]);
        assert_eq!(made.of_station, [0, 0, 1, 1]);
        assert_eq!(made.at(1).coefficients(0.2, 0.5), root.coefficients(0.2, 0.5));
        assert_eq!(made.at(2).coefficients(0.2, 0.5), tip.coefficients(0.2, 0.5));
    }

    #[test]
    fn one_section_has_the_bits_of_its_table() {
        let [airfoil, _] = two();
        let made = SpanSections::uniform(airfoil.clone()).at([0.5, 3.0]);
        assert_eq!(made.airfoils.len(), 1);
        for (a, m) in [(0.1, 0.45), (-2.0, 0.8), (PI, 0.2)] {
            assert_eq!(made.at(1).coefficients(a, m), airfoil.coefficients(a, m));
        }
    }

    #[test]
    fn faulty_sections_are_refused() {
        let [root, tip] = two();
        let made = |stations: &[f64]| {
            SpanSections::new(stations.to_vec(), false, vec![root.clone(), tip.clone()])
                .map(|_| ())
                .unwrap_err()
        };
        assert_eq!(made(&[1.0]), AirfoilError::Sections { stations: 1, tables: 2 });
        assert!(matches!(made(&[2.0, 2.0]), AirfoilError::NotAscending { table: "stations", index: 1, .. }));
        assert!(matches!(made(&[f64::NAN, 2.0]), AirfoilError::NotFinite { table: "stations" }));
        assert!(SpanSections::new(vec![], false, vec![]).is_err());
    }
}
