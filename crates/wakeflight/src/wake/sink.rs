//! Who looks at segments of a wake, and where they go: a list of segments, or sources packed for the sum.

use super::ground::Plane;
use crate::vortex::induced_velocity::Segments;
use crate::vortex::sources::Sources;

/// Who looks at the free vortices of one blade.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewer {
    /// First marker whose trailing vortices are seen: the last of the near wake for the blade itself, else 0.
    pub first: usize,
    /// Least core radius [m].
    pub floor: f64,
}

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

/// Segments of a wake above ground: what would be below is held in the plane.
pub(crate) struct Above<'a, S> {
    /// Where they go.
    pub sink: &'a mut S,
    /// The ground.
    pub plane: Plane,
}

impl<S: Sink> Sink for Above<'_, S> {
    fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64) {
        self.sink.push(self.plane.held(start), self.plane.held(end), circulation, core_radius);
    }
}
