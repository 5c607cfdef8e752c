//! Inflow at the stations of a blade as a flight has it: given where a step begins, and going on over it.

/// Inflow of a blade as a flight has it over a step: one value per station, and how much more it is where the step ends.
#[derive(Clone, Copy, Debug)]
pub struct HeldRow<'a> {
    begin: &'a [f64],
    change: &'a [f64],
    share: f64,
}

impl<'a> HeldRow<'a> {
    /// `change` more at the end of the step, of which `share` has passed.
    pub fn carried(begin: &'a [f64], change: &'a [f64], share: f64) -> Self {
        debug_assert_eq!(begin.len(), change.len());
        Self { begin, change, share }
    }

    /// Of station `j`.
    #[inline(always)]
    pub fn at(&self, j: usize) -> f64 {
        self.begin[j] + self.change.get(j).map_or(0.0, |more| more * self.share)
    }

    /// Stations.
    pub fn len(&self) -> usize {
        self.begin.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.begin.is_empty()
    }

    /// The first `n` stations, and the others.
    pub fn split_at(self, n: usize) -> (Self, Self) {
        let (begin, change) = (self.begin.split_at(n), self.change.split_at(n.min(self.change.len())));
        (Self { begin: begin.0, change: change.0, ..self }, Self { begin: begin.1, change: change.1, ..self })
    }
}

impl<'a> From<&'a [f64]> for HeldRow<'a> {
    /// Held as it is.
    fn from(begin: &'a [f64]) -> Self {
        Self { begin, change: &[], share: 0.0 }
    }
}
