//! Where segments of a wake go: a list of segments, or sources packed for the sum.

use crate::vortex::induced_velocity::Segments;
use crate::vortex::sources::Sources;

/// Where segments go.
pub(crate) trait Sink {
    /// Appends one segment.
    fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64);
}

impl Sink for Segments {
    fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64) {
        self.start.push(start);
        self.end.push(end);
        self.circulation.push(circulation);
        self.core_radius.push(core_radius);
    }
}

impl Sink for Sources {
    fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64) {
        Sources::push(self, start, end, circulation, core_radius);
    }
}
