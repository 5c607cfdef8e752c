//! Threads that stand by between two sums.
//!
//! A sum of a flight takes a third of a millisecond, to wake a sleeping thread a tenth: helpers look for work for a while
//! before they sleep, and the caller waits for none that has not begun.
#![allow(
    unsafe_code,
    reason = "work borrows from its caller, who does not return before every helper has left it"
)]

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError, TryLockError, Weak};
use std::thread::{Builder, yield_now};
use std::time::{Duration, Instant};

/// How long a helper looks for work before it sleeps; between two sums of a flight lies less.
const ALERT: Duration = Duration::from_micros(400);
/// Looks at the state between two offers of the processor to others.
const LOOKS: usize = 64;

/// `state`: whether helpers may join, above it the number of those at work, above that the number of the work.
const OPEN: u64 = 1;
const ONE_HELPER: u64 = 2;
const HELPERS: u64 = 0xffff << 1;
const ONE_WORK: u64 = 1 << 17;
/// Work of this number does not come: helpers end.
const END: u64 = u64::MAX;

/// Work in pieces that nobody waits for: helpers do some of it while there is nothing else to do.
pub(crate) trait Errand: Send + Sync {
    /// Does a piece; false where none is left.
    fn piece(&self) -> bool;
}

/// What every helper does until nothing is left.
type Work<'a> = &'a (dyn Fn() + Sync + 'a);

struct Shared {
    state: AtomicU64,
    /// Where the caller keeps its `Work`; valid while the state is open or a helper is at work.
    work: AtomicPtr<()>,
    /// What helpers do beside, and whether there is any.
    errand: Mutex<Option<Weak<dyn Errand>>>,
    has_errand: AtomicBool,
    asleep: AtomicUsize,
    bed: Mutex<()>,
    wake: Condvar,
    /// What a helper panicked with.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

/// Helpers of the calling threads, one caller at a time.
pub(super) struct Team {
    shared: Arc<Shared>,
    caller: Mutex<()>,
    n_helpers: usize,
}

impl Team {
    /// With as many of `n_helpers` as the system gives.
    pub fn new(n_helpers: usize) -> Self {
        let shared = Arc::new(Shared {
            state: AtomicU64::new(0),
            work: AtomicPtr::new(std::ptr::null_mut()),
            errand: Mutex::new(None),
            has_errand: AtomicBool::new(false),
            asleep: AtomicUsize::new(0),
            bed: Mutex::new(()),
            wake: Condvar::new(),
            panic: Mutex::new(None),
        });
        for i in 0..n_helpers {
            let of_helper = Arc::clone(&shared);
            let name = format!("wakeflight-{}", i + 1);
            if Builder::new().name(name).spawn(move || of_helper.help()).is_err() {
                break;
            }
        }
        Self { shared, caller: Mutex::new(()), n_helpers }
    }

    /// Number of helpers asked for.
    pub fn n_helpers(&self) -> usize {
        self.n_helpers
    }

    /// Leaves `errand` to helpers that have no other work, in place of the last one.
    pub fn offer(&self, errand: &Arc<dyn Errand>) {
        *self.shared.errand.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::downgrade(errand));
        self.shared.has_errand.store(true, Ordering::SeqCst);
        if self.shared.asleep.load(Ordering::SeqCst) > 0 {
            self.shared.rouse();
        }
    }

    /// Does `work`, here and by every helper that comes before it is done here; alone where the team has work already.
    pub fn run(&self, work: Work<'_>) {
        let _caller = match self.caller.try_lock() {
            Ok(guard) => guard,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return work(),
        };
        self.shared.work.store((&raw const work).cast_mut().cast(), Ordering::Relaxed);
        // leaves, also by a panic, when no helper holds the work any more
        let open = Opened::new(&self.shared);
        work();
        drop(open);
        let panic = self.shared.panic.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(panic) = panic {
            resume_unwind(panic);
        }
    }
}

impl Drop for Team {
    fn drop(&mut self) {
        self.shared.state.store(END, Ordering::SeqCst);
        self.shared.rouse();
    }
}

/// Work that helpers may join.
struct Opened<'a>(&'a Shared);

impl<'a> Opened<'a> {
    fn new(shared: &'a Shared) -> Self {
        let before = shared.state.load(Ordering::Relaxed);
        shared.state.store((before + ONE_WORK) | OPEN, Ordering::SeqCst);
        if shared.asleep.load(Ordering::SeqCst) > 0 {
            shared.rouse();
        }
        Self(shared)
    }
}

impl Drop for Opened<'_> {
    fn drop(&mut self) {
        self.0.state.fetch_and(!OPEN, Ordering::AcqRel);
        let mut looks = 0;
        while self.0.state.load(Ordering::Acquire) & HELPERS != 0 {
            looks += 1;
            pause(looks);
        }
    }
}

/// Waits a moment; now and then lets others have the processor.
fn pause(looks: usize) {
    if looks.is_multiple_of(LOOKS) {
        yield_now();
    } else {
        std::hint::spin_loop();
    }
}

impl Shared {
    /// Wakes the helpers that sleep.
    fn rouse(&self) {
        drop(self.bed.lock().unwrap_or_else(PoisonError::into_inner));
        self.wake.notify_all();
    }

    /// The life of a helper.
    fn help(&self) {
        let mut last = 0;
        while let Some(state) = self.awaited(last) {
            let joined = state + ONE_HELPER;
            if self.state.compare_exchange_weak(state, joined, Ordering::AcqRel, Ordering::Relaxed).is_err() {
                continue;
            }
            last = state / ONE_WORK;
            let place = self.work.load(Ordering::Relaxed).cast_const().cast::<Work<'_>>();
            // SAFETY: the caller waits in `Opened::drop` until this helper is counted out below
            let work = unsafe { *place };
            if let Err(panic) = catch_unwind(AssertUnwindSafe(work)) {
                *self.panic.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic);
            }
            self.state.fetch_sub(ONE_HELPER, Ordering::AcqRel);
        }
    }

    /// Does a piece of the errand; false where there is none.
    fn run_errand(&self) -> bool {
        if !self.has_errand.load(Ordering::SeqCst) {
            return false;
        }
        let held = self.errand.lock().unwrap_or_else(PoisonError::into_inner).clone();
        // who needs the errand does what is left of it, and meets what made a piece fail
        let goes_on = held
            .as_ref()
            .and_then(Weak::upgrade)
            .is_some_and(|errand| catch_unwind(AssertUnwindSafe(|| errand.piece())).unwrap_or(false));
        if !goes_on {
            let mut errand = self.errand.lock().unwrap_or_else(PoisonError::into_inner);
            // another may have been offered meanwhile
            let same = errand.as_ref().zip(held.as_ref()).is_none_or(|(now, then)| Weak::ptr_eq(now, then));
            if same {
                *errand = None;
                self.has_errand.store(false, Ordering::SeqCst);
            }
        }
        goes_on
    }

    /// The state once it is open for other work than the `last`; none at the end.
    fn awaited(&self, last: u64) -> Option<u64> {
        let new = || {
            let state = self.state.load(Ordering::SeqCst);
            (state & OPEN != 0 && state / ONE_WORK != last).then_some(state)
        };
        let (mut begun, mut looks) = (Instant::now(), 0);
        loop {
            let mut found = new();
            if found.is_none() && self.run_errand() {
                (begun, looks) = (Instant::now(), 0);
            } else if found.is_none() {
                looks += 1;
                pause(looks);
                if looks.is_multiple_of(LOOKS) && begun.elapsed() > ALERT {
                    let mut bed = self.bed.lock().unwrap_or_else(PoisonError::into_inner);
                    self.asleep.fetch_add(1, Ordering::SeqCst);
                    while {
                        found = new();
                        found.is_none() && !self.has_errand.load(Ordering::SeqCst)
                    } {
                        bed = self.wake.wait(bed).unwrap_or_else(PoisonError::into_inner);
                    }
                    self.asleep.fetch_sub(1, Ordering::SeqCst);
                }
            }
            match found {
                Some(END) => return None,
                Some(state) => return Some(state),
                None => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Errand, Team};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn every_piece_is_done_once_whether_helpers_sleep_or_not() {
        let team = Team::new(3);
        // an interpreter takes its time
        let rounds = if cfg!(miri) { 20 } else { 2000 };
        for round in 0..rounds {
            if round % (rounds / 4) == 0 {
                std::thread::sleep(Duration::from_millis(3));
            }
            let (left, done) = (AtomicUsize::new(0), [const { AtomicUsize::new(0) }; 40]);
            team.run(&|| {
                while let Some(piece) = done.get(left.fetch_add(1, Ordering::Relaxed)) {
                    piece.fetch_add(1, Ordering::Relaxed);
                }
            });
            assert!(done.iter().all(|n| n.load(Ordering::Relaxed) == 1), "round {round}");
        }
    }

    #[test]
    fn work_within_work_and_of_other_callers_is_done_by_its_caller() {
        let (team, count) = (Team::new(2), AtomicUsize::new(0));
        let inner = || {
            count.fetch_add(1, Ordering::Relaxed);
        };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| team.run(&|| team.run(&inner)));
            }
        });
        // every caller, and every helper that joined one
        assert!((4..=12).contains(&count.load(Ordering::Relaxed)), "{count:?}");
    }

    struct Count {
        left: AtomicUsize,
        done: AtomicUsize,
    }

    impl Errand for Count {
        fn piece(&self) -> bool {
            let mine = self.left.fetch_add(1, Ordering::Relaxed) < 50;
            self.done.fetch_add(usize::from(mine), Ordering::Relaxed);
            mine
        }
    }

    #[test]
    fn errands_are_run_beside_other_work_and_left_when_nobody_needs_them() {
        let team = Team::new(2);
        for sleeps in [false, true] {
            let count = Arc::new(Count { left: AtomicUsize::new(0), done: AtomicUsize::new(0) });
            let errand: Arc<dyn Errand> = Arc::clone(&count) as _;
            if sleeps {
                std::thread::sleep(Duration::from_millis(3));
            }
            team.offer(&errand);
            team.run(&|| ());
            while count.piece() {}
            while count.done.load(Ordering::Relaxed) < 50 {
                std::thread::yield_now();
            }
            assert_eq!(count.done.load(Ordering::Relaxed), 50);
        }
        team.offer(&(Arc::new(Count { left: AtomicUsize::new(0), done: AtomicUsize::new(0) }) as _));
        team.run(&|| ());
    }

    #[test]
    fn a_panic_of_a_helper_reaches_the_caller() {
        let (team, turns) = (Team::new(1), AtomicUsize::new(0));
        let caller = std::thread::current().id();
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            team.run(&|| {
                if std::thread::current().id() == caller {
                    while turns.load(Ordering::Relaxed) == 0 {
                        std::thread::yield_now();
                    }
                } else {
                    turns.fetch_add(1, Ordering::Relaxed);
                    panic!("lost");
                }
            });
        }));
        assert!(result.is_err());
        // and the team works on
        team.run(&|| {
            turns.fetch_add(1, Ordering::Relaxed);
        });
        assert!(turns.load(Ordering::Relaxed) >= 2);
    }
}
