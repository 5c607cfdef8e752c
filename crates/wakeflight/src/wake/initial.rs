//! First guess of the geometry of the tip vortices.

use super::motion::HubMotion;
use super::options::WakeOptions;

/// Advance ratio below which the guess contracts as in hover.
const HOVER_ADVANCE_RATIO: f64 = 0.03;

/// Position of the marker of age `zeta` [rad] released at `release` [m, `_h`]: helix carried by the wind at the hub and
/// the mean induced velocity, r = release + (wind - mean_inflow omega R e_z) zeta/omega.
pub fn rigid_helix(
    options: &WakeOptions,
    hub: &HubMotion,
    mean_inflow: f64,
    release: [f64; 3],
    zeta: f64,
) -> [f64; 3] {
    let wind = hub.wind([0.0; 3]);
    [
        release[0] + wind[0] / options.rotor.omega * zeta,
        release[1] + wind[1] / options.rotor.omega * zeta,
        release[2] + (wind[2] / options.rotor.omega - mean_inflow * options.rotor.radius) * zeta,
    ]
}

/// Same in hover: contraction and two-part descent of a tip vortex below an untwisted rotor [landgrebe1972].
///
/// r/R = 0.78 + 0.22 exp(-(0.145 + 27 C_T) zeta); z/R = k1 zeta up to the next blade, k2 per radian beyond;
/// k1 = -0.25 C_T/sigma, k2 = -1.41 sqrt(C_T/2), C_T = 2 mean_inflow^2. The wind at the hub is added.
pub fn hover_helix(
    options: &WakeOptions,
    hub: &HubMotion,
    mean_inflow: f64,
    release: [f64; 3],
    zeta: f64,
) -> [f64; 3] {
    let ct = 2.0 * mean_inflow * mean_inflow;
    let solidity =
        options.rotor.n_blades as f64 * options.rotor.chord / (std::f64::consts::PI * options.rotor.radius);
    let first = std::f64::consts::TAU / options.rotor.n_blades as f64;
    let (k1, k2) = (-0.25 * ct / solidity, -1.41 * (0.5 * ct).sqrt());
    let descent = k1 * zeta.min(first) + k2 * (zeta - first).max(0.0);
    let radius = 0.78 + 0.22 * (-(0.145 + 27.0 * ct) * zeta).exp();
    let wind = hub.wind([0.0; 3]).map(|v| v / options.rotor.omega * zeta);
    [
        release[0] * radius + wind[0],
        release[1] * radius + wind[1],
        release[2] + descent * options.rotor.radius + wind[2],
    ]
}

/// Guess for the flight condition: the hover form below an advance ratio of 0.03, else the rigid helix.
pub fn tip_vortex(
    options: &WakeOptions,
    hub: &HubMotion,
    mean_inflow: f64,
    release: [f64; 3],
    zeta: f64,
) -> [f64; 3] {
    let in_plane = hub.velocity[0].hypot(hub.velocity[1]);
    if in_plane < HOVER_ADVANCE_RATIO * options.tip_speed() && mean_inflow > 0.0 {
        hover_helix(options, hub, mean_inflow, release, zeta)
    } else {
        rigid_helix(options, hub, mean_inflow, release, zeta)
    }
}
