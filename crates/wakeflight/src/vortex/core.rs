//! Core models of a vortex filament.

/// Swirl profile of the core; `core_radius` is the radius of peak swirl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Core {
    /// No core.
    Singular,
    /// Vatistas n = 1.
    Scully,
    /// Vatistas n = 2.
    Vatistas2,
    /// Solid-body core.
    Rankine,
    /// Gaussian vorticity.
    LambOseen,
    /// Kernel softened in the distance to the element, 1/(r^2 + eps^2)^(3/2).
    RosenheadMoore,
}

/// Distance that enters the core factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoreDistance {
    /// To the infinite line through the segment.
    Line,
    /// To the segment itself.
    Segment,
}
