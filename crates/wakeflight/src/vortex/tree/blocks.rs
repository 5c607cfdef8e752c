//! Points in blocks of neighbours, which share their lists of cells.

use super::order::{bounds, distance, into_blocks, middle};

/// Points that share their lists of cells; a multiple of every number of lanes.
pub(super) const BLOCK: usize = 32;

/// Neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<'a> {
    /// Where [m].
    pub points: &'a [[f64; 3]],
    /// Middle of the box around them [m].
    pub middle: [f64; 3],
    /// Distance of the farthest of them from it [m].
    pub reach: f64,
}

/// Points gathered into blocks.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Index of each in the order they were given in.
    order: Vec<usize>,
    points: Vec<[f64; 3]>,
    /// Middle and reach of each block.
    places: Vec<([f64; 3], f64)>,
}

impl Blocks {
    /// Gathers `points`.
    pub fn new(points: &[[f64; 3]]) -> Self {
        let mut order: Vec<usize> = (0..points.len()).collect();
        into_blocks(&mut order, points, BLOCK);
        let points: Vec<[f64; 3]> = order.iter().map(|i| points[*i]).collect();
        let places = points
            .chunks(BLOCK)
            .map(|points| {
                let middle = middle(bounds(points.iter().copied()));
                (middle, points.iter().fold(0.0f64, |reach, p| reach.max(distance(middle, *p))))
            })
            .collect();
        Self { order, points, places }
    }

    /// All of them.
    pub fn each(&self) -> impl Iterator<Item = Block<'_>> + Send {
        let points = self.points.chunks(BLOCK);
        points.zip(&self.places).map(|(points, &(middle, reach))| Block { points, middle, reach })
    }

    /// Velocities of all points in the order of blocks: zero.
    pub fn zeros(&self) -> Vec<[f64; 3]> {
        vec![[0.0; 3]; self.points.len()]
    }

    /// Adds what was found in the order of blocks to `velocity`, in the order in which points were given.
    pub fn add_to(&self, velocity: &mut [[f64; 3]], found: &[[f64; 3]]) {
        for (i, added) in self.order.iter().zip(found) {
            for c in 0..3 {
                velocity[*i][c] += added[c];
            }
        }
    }
}
