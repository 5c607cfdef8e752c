//! Velocity of the markers that a step begins with: known, or found by idle threads while the blades move on.
//!
//! The flight dynamics of a step need the inflow at the stations alone. What the wake needs of the same field is therefore handed
//! to the threads that stand by, piece by piece, and whatever is left of it is done where it is asked for: the same sums, the same
//! bits, whoever does them.

use super::filament::Filaments;
use super::instant::RotorInstant;
use super::motion::HubMotion;
use super::sources::WakeSources;
use super::velocity_field::{VortexSegments, add_self_induced};
use crate::vortex::sources::Group;
use crate::vortex::threads::{Errand, offer};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// Markers of one piece of work.
const PIECE: usize = 32;

/// Velocity of the markers of a piece.
type Piece = [[f64; 3]; PIECE];

/// Velocity of the markers relative to the hub axes, with the wind of the hub's motion [m/s, `_h`].
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(from = "Option<Vec<[f64; 3]>>", into = "Option<Vec<[f64; 3]>>")]
pub(super) enum MarkerVelocity {
    /// To be found.
    #[default]
    Unknown,
    /// Found.
    Known(Vec<[f64; 3]>),
    /// Being found.
    Coming(Arc<Coming>),
}

impl From<Option<Vec<[f64; 3]>>> for MarkerVelocity {
    fn from(known: Option<Vec<[f64; 3]>>) -> Self {
        known.map_or(Self::Unknown, Self::Known)
    }
}

impl From<MarkerVelocity> for Option<Vec<[f64; 3]>> {
    fn from(velocity: MarkerVelocity) -> Self {
        velocity.found()
    }
}

impl MarkerVelocity {
    /// The velocity; none where it has to be found.
    pub fn found(&self) -> Option<Vec<[f64; 3]>> {
        match self {
            Self::Unknown => None,
            Self::Known(velocity) => Some(velocity.clone()),
            Self::Coming(coming) => Some(coming.found()),
        }
    }
}

/// A sum at all markers of an instant, under way.
#[derive(Debug)]
pub(super) struct Coming {
    vortices: VortexSegments,
    sources: Arc<WakeSources>,
    free: Filaments,
    hub: HubMotion,
    next: AtomicUsize,
    pieces: Vec<Mutex<Option<Piece>>>,
}

impl Coming {
    /// Offers the sum to the threads that stand by; `sources` are those of `instant`.
    pub fn begin(
        vortices: VortexSegments,
        sources: Arc<WakeSources>,
        instant: &RotorInstant,
        hub: &HubMotion,
    ) -> Arc<Self> {
        let (free, hub, next) = (instant.free.clone(), *hub, AtomicUsize::new(0));
        let pieces = free.position.chunks(PIECE).map(|_| Mutex::default()).collect();
        let coming = Arc::new(Self { vortices, sources, free, hub, next, pieces });
        let offered: Arc<dyn Errand> = Arc::clone(&coming) as _;
        offer(&offered);
        coming
    }

    /// Segment evaluations of the whole.
    pub fn evaluations(&self) -> u64 {
        (self.free.position.len() * self.sources.whole().len()) as u64
    }

    fn summed(&self, piece: usize) -> Piece {
        let from = piece * PIECE;
        let points = &self.free.position[from..(from + PIECE).min(self.free.position.len())];
        let mut found = [[0.0; 3]; PIECE];
        let velocity = &mut found[..points.len()];
        for (v, p) in velocity.iter_mut().zip(points) {
            *v = self.hub.wind(*p);
        }
        let sources = [self.sources.whole()];
        self.vortices.add_alone(&mut Group { points, sources: &sources, velocity });
        for (k, v) in velocity.iter_mut().enumerate() {
            add_self_induced(&self.vortices, &self.free, from + k, v);
        }
        found
    }

    /// The velocity; what is left of the work is done here, beside whoever is at it. Waits for nobody.
    pub fn found(&self) -> Vec<[f64; 3]> {
        while self.piece() {}
        let mut velocity = Vec::with_capacity(self.pieces.len() * PIECE);
        for (k, piece) in self.pieces.iter().enumerate() {
            // a piece that another thread still has in hand is as soon done again
            let done = piece.try_lock().ok().and_then(|done| *done);
            velocity.extend(done.unwrap_or_else(|| self.summed(k)));
        }
        velocity.truncate(self.free.position.len());
        velocity
    }
}

impl Errand for Coming {
    fn piece(&self) -> bool {
        let k = self.next.fetch_add(1, Ordering::Relaxed);
        let Some(piece) = self.pieces.get(k) else { return false };
        if let Ok(mut done) = piece.try_lock() {
            *done = Some(self.summed(k));
        }
        true
    }
}
