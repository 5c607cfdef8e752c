//! International standard atmosphere 1976, troposphere.
