//! Options of the annular momentum inflow, each declared once.

use crate::wake::options::describe::{ANNULAR, always, choices, declare};

choices! {
    /// Loss of momentum towards the tip.
    pub enum TipLoss {
        /// Prandtl's.
        Prandtl = "prandtl",
        /// None.
        None = "none",
    }
}

declare! {
    /// Options of the momentum of every ring of the disk for itself [leishman2006].
    pub struct AnnularOptions in "annular" of ANNULAR {
        /// Prandtl's loss of momentum towards the tip, or none.
        tip_loss: TipLoss = always(TipLoss::Prandtl), source(&["leishman2006"]);
    }
}
