//! Finite elements of a rotating flap-lag-torsion beam.
