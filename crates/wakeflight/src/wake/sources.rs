//! The vortices of a rotor and its wake packed for the sum, and what each blade sees of them.

use super::choices::{Precision, Trailers};
use super::filament::Filaments;
use super::instant::RotorInstant;
use super::lattice::{bound, push_filament, push_shed};
use super::options::WakeOptions;
use super::sink::{Above, Sink, Viewer};
use crate::vortex::induced_velocity::Segments;
use crate::vortex::sources::{Mark, Packing, Part, Sources};
use crate::vortex::threads::share;

/// What trails, what is shed, what an inboard sheet holds and what is bound: in this order, each blade by blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Free filaments.
    Free,
    /// Shed vortices of a full-span wake.
    Shed,
    /// Filaments of the inboard sheet.
    Sheet,
    /// Bound vortices.
    Bound,
}

/// Every kind, in the order of the sum.
pub(crate) const KINDS: [Kind; 4] = [Kind::Free, Kind::Shed, Kind::Sheet, Kind::Bound];

/// Appends the vortices of one kind and one blade; `own`: as the stations of that blade see them.
pub(crate) fn push_kind(
    segments: &mut impl Sink,
    options: &WakeOptions,
    instant: &RotorInstant,
    kind: Kind,
    blade: usize,
    own: bool,
    floor: f64,
) {
    match instant.ground {
        None => push_to(segments, options, instant, (kind, blade), own, floor),
        Some(plane) => {
            push_to(&mut Above { sink: segments, plane }, options, instant, (kind, blade), own, floor);
        }
    }
}

fn push_to(
    segments: &mut impl Sink,
    options: &WakeOptions,
    instant: &RotorInstant,
    (kind, blade): (Kind, usize),
    own: bool,
    floor: f64,
) {
    let viewer = Viewer { first: if own { options.near_wake_markers() } else { 0 }, floor };
    match kind {
        Kind::Free => {
            let n = options.trailers_per_blade();
            for i in blade * n..(blade + 1) * n {
                push_filament(segments, options, (&instant.free, &instant.far), i, viewer);
            }
        }
        Kind::Shed => push_shed(segments, options, &instant.free, blade, own, viewer),
        Kind::Sheet => {
            let n = options.sheet_filaments();
            for i in blade * n..(blade + 1) * n {
                push_filament(segments, options, (&instant.sheet, &Filaments::default()), i, viewer);
            }
        }
        // a straight bound line induces nothing at its own stations
        Kind::Bound if own => {}
        Kind::Bound => {
            let n = options.n_stations;
            let core = (options.bound_core * options.rotor.chord).max(floor);
            let edges = &instant.edge[blade * (n + 1)..(blade + 1) * (n + 1)];
            let mut push = |j: usize, gamma: f64| segments.push(edges[j], edges[j + 1], gamma, core);
            match options.trailers {
                Trailers::Tip => {
                    let gamma = &instant.circulation[blade * n..(blade + 1) * n];
                    gamma.iter().enumerate().for_each(|(j, g)| push(j, *g));
                }
                Trailers::FullSpan => bound(options, &instant.trailer_edges, &instant.free, blade)
                    .enumerate()
                    .for_each(|(j, g)| push(j, g)),
            }
        }
    }
}

/// Segments of one rotor instant, packed once for markers and stations.
#[derive(Debug, Default)]
pub(crate) struct WakeSources {
    n_blades: usize,
    /// As markers see them.
    all: Sources,
    /// Begin of every kind and blade, and the end.
    marks: Vec<Mark>,
    /// The same with no core below the stations' floor; empty where none is.
    floored: Sources,
    is_floored: bool,
    /// What every blade sees of its own wake, kind after kind; begin of each and the end.
    own: Sources,
    own_marks: Vec<Mark>,
}

/// Parts that a blade sees.
pub(crate) const SEEN: usize = 2 * KINDS.len();

impl WakeSources {
    /// Packs an instant; `for_stations`: also what the blades see.
    pub fn pack(&mut self, options: &WakeOptions, instant: &RotorInstant, for_stations: bool) {
        self.n_blades = options.rotor.n_blades;
        let Self { all, marks, own, own_marks, .. } = self;
        if !for_stations {
            return pack_all(all, marks, options, instant);
        }
        let floor = options.station_core_floor * options.rotor.chord;
        let work: [Box<dyn FnOnce() + Send + '_>; 2] = [
            Box::new(|| pack_all(all, marks, options, instant)),
            Box::new(|| pack_own(own, own_marks, options, instant, floor)),
        ];
        share(work.into_iter(), |pack| pack());
        self.is_floored = self.all.least_core() < floor;
        if self.is_floored {
            self.floored.copy_floored(&self.all, floor);
        }
    }

    /// Everything, as markers see it.
    pub fn whole(&self) -> Part<'_> {
        self.all.whole()
    }

    /// What the stations of `blade` see: the wakes of the others, its own beyond its near wake, in the order of the kinds.
    pub fn seen_from(&self, blade: usize) -> [Part<'_>; SEEN] {
        let others = if self.is_floored { &self.floored } else { &self.all };
        let place = |kind: usize| kind * self.n_blades + blade;
        std::array::from_fn(|i| {
            let kind = i / 2;
            if i % 2 == 0 {
                // from this blade's place in the kind before to its place in this kind
                let from = kind.checked_sub(1).map_or(0, |before| place(before) + 1);
                others.part(self.marks[from], self.marks[place(kind)])
            } else if kind + 1 < KINDS.len() {
                let own = blade * KINDS.len() + kind;
                self.own.part(self.own_marks[own], self.own_marks[own + 1])
            } else {
                // a blade does not see its own bound vortex: the last part is what comes behind it
                others.part(self.marks[place(kind) + 1], self.marks[KINDS.len() * self.n_blades])
            }
        })
    }
}

/// What every blade sees of its own wake.
fn pack_own(
    to: &mut Sources,
    marks: &mut Vec<Mark>,
    options: &WakeOptions,
    instant: &RotorInstant,
    floor: f64,
) {
    to.clear(options.packing(false));
    marks.clear();
    for blade in 0..options.rotor.n_blades {
        for kind in KINDS {
            marks.push(to.mark());
            push_kind(to, options, instant, kind, blade, true, floor);
        }
    }
    marks.push(to.mark());
}

fn pack_all(to: &mut Sources, marks: &mut Vec<Mark>, options: &WakeOptions, instant: &RotorInstant) {
    push_all(to, marks, options, instant, options.packing(false));
    let (n_markers, n_segments) = (instant.free.position.len(), to.whole().len());
    if options.precision == Precision::Single && options.method().tree(n_markers, n_segments).is_some() {
        push_all(to, marks, options, instant, options.packing(true));
    }
}

fn push_all(
    to: &mut Sources,
    marks: &mut Vec<Mark>,
    options: &WakeOptions,
    instant: &RotorInstant,
    packing: Packing,
) {
    to.clear(packing);
    marks.clear();
    for kind in KINDS {
        for blade in 0..options.rotor.n_blades {
            marks.push(to.mark());
            push_kind(to, options, instant, kind, blade, false, 0.0);
        }
    }
    marks.push(to.mark());
}

impl RotorInstant {
    /// Every segment in its fixed order. Seen from the stations of `own_blade`: without its bound vortex, its filaments
    /// beyond the near wake only, and no core smaller than the floor.
    pub fn segments(&self, options: &WakeOptions, own_blade: Option<usize>) -> Segments {
        let mut segments = Segments::default();
        let floor = own_blade.map_or(0.0, |_| options.station_core_floor * options.rotor.chord);
        for kind in KINDS {
            for blade in 0..options.rotor.n_blades {
                push_kind(&mut segments, options, self, kind, blade, own_blade == Some(blade), floor);
            }
        }
        segments
    }
}
