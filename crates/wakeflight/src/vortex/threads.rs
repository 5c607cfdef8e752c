//! Number of threads of the sums, and the team they form.

pub(crate) use super::team::Errand;

use super::team::Team;
use std::num::NonZero;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Environment variable read where `set_threads` was not called.
pub const THREADS_VARIABLE: &str = "WAKEFLIGHT_THREADS";

/// Most threads one may ask for.
pub const MOST_THREADS: usize = 1024;

/// A number of threads that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} = {value}: allowed are whole numbers from 1 to {MOST_THREADS}")]
pub struct ThreadsError {
    /// Where the number comes from.
    pub name: &'static str,
    /// What was given.
    pub value: String,
}

/// A team and the process that owns its threads; after a fork the child builds its own.
struct Owned {
    process: u32,
    team: Arc<Team>,
}

static CHOSEN: Mutex<Option<usize>> = Mutex::new(None);
static TEAM: Mutex<Option<Owned>> = Mutex::new(None);
/// Asked for once: Linux answers by reading files, 29 us a time, and every sum of a flight asks.
static PROCESSORS: OnceLock<usize> = OnceLock::new();

fn allowed(name: &'static str, value: &str) -> Result<usize, ThreadsError> {
    match value.trim().parse::<usize>() {
        Ok(n) if (1..=MOST_THREADS).contains(&n) => Ok(n),
        _ => Err(ThreadsError { name, value: value.to_owned() }),
    }
}

/// Sets the number of threads of all later sums; results do not depend on it.
///
/// # Errors
/// For zero or more than [`MOST_THREADS`].
pub fn set_threads(n: usize) -> Result<(), ThreadsError> {
    let n = allowed("threads", &n.to_string())?;
    *CHOSEN.lock().unwrap_or_else(PoisonError::into_inner) = Some(n);
    Ok(())
}

/// Number of threads: as set, else of `WAKEFLIGHT_THREADS`, else one per processor.
///
/// # Errors
/// Where the environment variable holds no number that is allowed.
pub fn threads() -> Result<usize, ThreadsError> {
    if let Some(n) = *CHOSEN.lock().unwrap_or_else(PoisonError::into_inner) {
        return Ok(n);
    }
    match std::env::var_os(THREADS_VARIABLE) {
        Some(value) => allowed(THREADS_VARIABLE, &value.to_string_lossy()),
        None => Ok(*PROCESSORS
            .get_or_init(|| std::thread::available_parallelism().map_or(1, NonZero::get).min(MOST_THREADS))),
    }
}

/// Does `each` of the `pieces` of work; the calling thread begins at once, others join as they come.
///
/// Work is handed out piece by piece: a thread that comes late holds nobody up for longer than its own piece, one that
/// does not come not at all. Whichever thread does a piece, the piece is the same: results do not depend on the number of
/// threads.
pub(crate) fn share<T: Send>(pieces: impl Iterator<Item = T> + Send, each: impl Fn(T) + Sync) {
    let Some(team) = team() else { return pieces.for_each(each) };
    let left = Mutex::new(pieces);
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).next();
    team.run(&|| {
        while let Some(piece) = next() {
            each(piece);
        }
    });
}

/// Whether there are threads that stand by.
pub(crate) fn stand_by() -> bool {
    team().is_some()
}

/// Leaves `errand` to the threads that stand by, in place of the last one; whoever needs it does what they leave.
pub(crate) fn offer(errand: &Arc<dyn Errand>) {
    if let Some(team) = team() {
        team.offer(errand);
    }
}

/// Team for more than one thread, formed at first use; none where one thread is asked for.
fn team() -> Option<Arc<Team>> {
    let n = threads().unwrap_or(1);
    if n == 1 {
        return None;
    }
    let process = std::process::id();
    let mut held = TEAM.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(owned) = held.as_ref()
        && owned.process == process
        && owned.team.n_helpers() + 1 == n
    {
        return Some(Arc::clone(&owned.team));
    }
    let team = Arc::new(Team::new(n - 1));
    let previous = held.replace(Owned { process, team: Arc::clone(&team) });
    if let Some(owned) = previous.filter(|owned| owned.process != process) {
        // the threads of a parent process do not exist here: nothing to end
        std::mem::forget(owned);
    }
    Some(team)
}
