//! Segments in a tree of cells, each with the expansion of what it holds.

use super::harmonics::{Moments, N_COEFFICIENTS};
use super::order::{bounds, middle, split, square_of_distance};
use crate::vortex::sources::Part;
use crate::vortex::strands::{Strand, Strands};
use std::ops::Range;

/// Segments of a cell that is not divided further.
const LEAF: usize = 16;

/// Segments that lie together.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Centre of the expansion [m].
    pub centre: [f64; 3],
    /// Distance of the farthest end of a segment [m].
    pub radius: f64,
    /// Sum of |circulation| length / (4 pi) [m3/s].
    pub strength: f64,
    /// Largest core radius [m].
    pub core_radius: f64,
    /// Index after the last cell inside this one.
    pub next: usize,
    /// Its segments, where it is not divided.
    pub leaf: Option<Leaf>,
}

/// Places of strands and of their pieces.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    /// In the strands of the tree.
    pub strands: Range<usize>,
    /// In the pieces of the tree.
    pub pieces: Range<usize>,
}

/// Cells, each followed by those inside it.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    /// Cells in depth-first order.
    pub cells: Vec<Cell>,
    /// Velocity expansion of every cell.
    pub coefficients: Vec<[f64; N_COEFFICIENTS]>,
    /// Segments, those of a leaf together.
    pub sources: Strands,
}

/// What the tree is made of: the segments in their first order.
struct Given<'a> {
    sources: Part<'a>,
    start: Vec<[f64; 3]>,
    middle: Vec<[f64; 3]>,
    /// |circulation| length / (4 pi).
    strength: Vec<f64>,
}

impl Cells {
    /// Divides `sources` in halves along the longest side until few segments are together.
    pub fn new(sources: Part<'_>) -> Self {
        let mut start = Vec::with_capacity(sources.pieces.len());
        let mut pieces = sources.pieces.iter();
        for strand in sources.strands {
            let mut from = strand.start;
            for piece in pieces.by_ref().take(strand.n_pieces) {
                start.push(from);
                from = piece.end;
            }
        }
        let middle = start
            .iter()
            .zip(sources.pieces)
            .map(|(from, piece)| std::array::from_fn(|c| 0.5 * (from[c] + piece.end[c])))
            .collect();
        let mut order: Vec<usize> = (0..start.len()).collect();
        let strength = sources.pieces.iter().map(|p| p.strength.abs() * p.length_sq.sqrt()).collect();
        let given = Given { sources, start, middle, strength };
        let mut tree = Self { sources: Strands::with_capacity(order.len()), ..Self::default() };
        if !order.is_empty() {
            tree.add_cell(&given, &mut order);
        }
        tree
    }

    /// Appends the cell of the segments `order` and all inside it; its index and moments.
    fn add_cell(&mut self, given: &Given, order: &mut [usize]) -> (usize, Moments) {
        let piece = |i: usize| &given.sources.pieces[i];
        let centre = middle(bounds(order.iter().flat_map(|i| [given.start[*i], piece(*i).end])));
        let mut cell = Cell { centre, radius: 0.0, strength: 0.0, core_radius: 0.0, next: 0, leaf: None };
        let (mut radius_sq, mut core_sq) = (0.0f64, 0.0f64);
        for &i in order.iter() {
            let ends = [given.start[i], piece(i).end].map(|end| square_of_distance(centre, end));
            radius_sq = radius_sq.max(ends[0]).max(ends[1]);
            core_sq = core_sq.max(piece(i).core_sq);
            cell.strength += given.strength[i];
        }
        (cell.radius, cell.core_radius) = (radius_sq.sqrt(), core_sq.sqrt());
        let index = self.cells.len();
        self.cells.push(cell);
        self.coefficients.push([0.0; N_COEFFICIENTS]);

        let mut moments = Moments::zero();
        if order.len() <= LEAF {
            // joined segments stay joined
            order.sort_unstable();
            for &i in order.iter() {
                let end: [f64; 3] = std::array::from_fn(|c| piece(i).end[c] - centre[c]);
                moments.add_segment(end, piece(i).along, piece(i).strength);
            }
            self.cells[index].leaf = Some(self.add_leaf(given, order));
        } else {
            let half = order.len() / 2;
            split(order, &given.middle, half);
            let (front, back) = order.split_at_mut(half);
            for part in [front, back] {
                let (inside, of_part) = self.add_cell(given, part);
                let offset = std::array::from_fn(|c| self.cells[inside].centre[c] - centre[c]);
                moments.add_part(&of_part, offset);
            }
        }
        self.cells[index].next = self.cells.len();
        self.coefficients[index] = moments.velocity();
        (index, moments)
    }

    /// Appends the segments `order` of a leaf.
    fn add_leaf(&mut self, given: &Given, order: &[usize]) -> Leaf {
        let sources = &mut self.sources;
        let (first_strand, first_piece) = (sources.strands.len(), sources.pieces.len());
        for &i in order {
            let start = given.start[i];
            match sources.pieces[first_piece..].last() {
                Some(last) if last.end == start => sources.strands[first_strand..]
                    .last_mut()
                    .into_iter()
                    .for_each(|strand| strand.n_pieces += 1),
                _ => sources.strands.push(Strand { start, n_pieces: 1 }),
            }
            sources.pieces.push(given.sources.pieces[i]);
        }
        Leaf { strands: first_strand..sources.strands.len(), pieces: first_piece..sources.pieces.len() }
    }
}
