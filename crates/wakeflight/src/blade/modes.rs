//! Natural modes of the rotating blade.
