//! Velocity of the markers that a step begins with: known, or found by idle threads while the blades move on.
//!
//! The flight dynamics of a step need the inflow at the stations alone. What the wake needs of the same field is therefore handed
//! to the threads that stand by, piece by piece, and whatever is left of it is done where it is asked for: the same sums, the same
//! bits, whoever does them.

use super::far_cylinder::has_cylinder;
use super::filament::Filaments;
use super::instant::RotorInstant;
use super::motion::HubMotion;
use super::options::WakeOptions;
use super::sources::WakeSources;
use super::velocity_field::{
    FieldWork, InducedVelocity, VortexSegments, Wanted, add_self_induced, field_of_packed,
};
use crate::vortex::sources::Group;
use crate::vortex::threads::{Errand, offer, stand_by};
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

/// The inflow at the stations, and the velocity of the markers with the wind of the `hub`, which may be left to threads that stand
/// by; the number of segment evaluations.
pub(super) fn field_before_step<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    (instant, hub): (&RotorInstant, &HubMotion),
    work: &mut FieldWork,
    inflow: &mut Vec<f64>,
) -> (MarkerVelocity, u64) {
    work.pack(options, instant, true);
    let (n_points, n_segments) = (instant.free.position.len(), work.sources.whole().len());
    let by_others = match field.in_pieces(n_points, n_segments) {
        Some(vortices) if stand_by() && instant.ground.is_none() && !has_cylinder(options) => Some(vortices),
        _ => None,
    };
    let Some(vortices) = by_others else {
        let mut velocity = Vec::new();
        let wanted = Wanted { markers: Some((hub, &mut velocity)), stations: Some(inflow) };
        let evaluations = field_of_packed(field, options, instant, work, wanted);
        return (MarkerVelocity::Known(velocity), evaluations);
    };
    let coming = Coming::begin(vortices, Arc::clone(&work.sources), instant, hub);
    let wanted = Wanted { stations: Some(inflow), ..Wanted::default() };
    let evaluations = coming.evaluations() + field_of_packed(field, options, instant, work, wanted);
    (MarkerVelocity::Coming(coming), evaluations)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::geometry::BladeGrid;
    use crate::wake::velocity_field::field_at;

    #[test]
    fn what_others_find_meanwhile_has_the_bits_of_the_field_found_at_once() {
        let options = WakeOptions::new(3, 8.0, 1.0, 0.4, 0.5, 27.0);
        let mut instant = RotorInstant::new(&options, &BladeGrid::new(&options));
        for (m, position) in instant.free.position.iter_mut().enumerate() {
            let turned = 0.17 * m as f64;
            *position = [8.0 * turned.cos() + 0.3 * turned, 8.0 * turned.sin(), -0.1 * turned];
        }
        instant.free.circulation.fill(20.0);
        let hub = HubMotion { velocity: [-30.0, 1.0, 2.0], ..HubMotion::default() };
        let vortices = VortexSegments::new(&options);
        let mut expected = Vec::new();
        let wanted = Wanted { markers: Some((&hub, &mut expected)), ..Wanted::default() };
        let evaluations = field_at(&vortices, &options, &instant, &mut FieldWork::default(), wanted);
        let mut sources = WakeSources::default();
        sources.pack(&options, &instant, false);
        let coming = Coming::begin(vortices, Arc::new(sources), &instant, &hub);
        assert_eq!(coming.evaluations(), evaluations);
        // a copy of the wake asks too, and a snapshot
        let velocity = MarkerVelocity::Coming(coming);
        assert_eq!(velocity.found().as_ref(), Some(&expected));
        assert_eq!(Option::from(velocity), Some(expected));
    }
}
