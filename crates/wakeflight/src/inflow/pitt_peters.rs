//! Pitt-Peters three-state dynamic inflow.
