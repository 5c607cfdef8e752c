//! Free vortex wake: tip filaments, near wake, relaxation and time marching.
