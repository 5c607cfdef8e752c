//! Memory of the sections of several blades, or of one at several azimuths.

use super::sections_in_time::BladePast;
use crate::airfoil::unsteady::Memory;
use serde::{Deserialize, Serialize};

/// Memory of sections, row by row: of the blades of a rotor, or of one of them at the azimuths of a turn. Empty where sections do
/// not remember.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct MemoryRows {
    memory: Vec<Memory>,
    n_stations: usize,
}

impl MemoryRows {
    /// Of rows of `n_stations`.
    pub fn new(memory: Vec<Memory>, n_stations: usize) -> Self {
        Self { memory, n_stations }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.memory.is_empty()
    }

    /// Of every section, row by row.
    pub fn iter(&self) -> impl Iterator<Item = &Memory> {
        self.memory.iter()
    }

    /// Rows and stations.
    pub fn shape(&self) -> [usize; 2] {
        [self.memory.len().checked_div(self.n_stations).unwrap_or(0), self.n_stations]
    }

    fn row(&self, k: usize) -> Option<&[Memory]> {
        self.memory.get(k * self.n_stations..(k + 1) * self.n_stations).filter(|row| !row.is_empty())
    }

    /// The step that began `elapsed` [s] ago, of row `k`.
    #[inline(always)]
    pub fn step(&self, k: usize, elapsed: f64) -> Option<BladePast<'_>> {
        self.row(k).map(|memory| BladePast::Step { memory, elapsed })
    }

    /// The motion that repeats, at row `k`.
    #[inline(always)]
    pub fn periodic(&self, k: usize) -> Option<BladePast<'_>> {
        self.row(k).map(BladePast::Periodic)
    }

    /// Those rows alone.
    pub fn rows(&self, rows: impl Iterator<Item = usize>) -> Self {
        let memory = rows.filter_map(|k| self.row(k)).flatten().copied().collect();
        Self { memory, n_stations: self.n_stations }
    }

    /// Rows of all, one after another.
    pub fn joined<'a>(all: impl Iterator<Item = &'a Self>) -> Self {
        let mut joined = Self::default();
        for each in all {
            joined.n_stations = each.n_stations;
            joined.memory.extend_from_slice(&each.memory);
        }
        joined
    }

    /// Of rows of equal length.
    pub fn of(rows: impl Iterator<Item = Vec<Memory>>) -> Self {
        let mut all = Self::default();
        for row in rows {
            all.n_stations = row.len();
            all.memory.extend(row);
        }
        all
    }
}
