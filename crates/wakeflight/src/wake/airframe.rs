//! The airframe in the air of the rotor: points at which its parts feel the wake, and the body that the blades feel.

use super::choices::{FuselageUpwash, Wash};
use super::instant::RotorInstant;
use super::motion::HubMotion;
use super::options::WakeOptions;
use super::spheroid::Spheroid;
use serde::{Deserialize, Serialize};

/// Parts of an airframe that feel the wake, in this order.
pub const PARTS: [&str; 4] = ["fuselage", "stabilator", "fin", "tail_rotor"];
/// Points over which the air at a part is averaged.
pub const POINTS: usize = 5;
/// Length of the body that stands for a fuselage, over the rotor radius.
pub const BODY_LENGTH: f64 = 1.0;
/// Its thickness, over the rotor radius.
pub const BODY_WIDTH: f64 = 0.3;

/// Velocity of the air at each of the [`PARTS`] [m/s]; zero at a part that there is not.
pub type AtParts = [[f64; 3]; PARTS.len()];

/// The airframe as its rotor has it: hub axes in the sense of rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct AirframeInWake {
    /// Points of each of the [`PARTS`] [m, `_h`]; none of a part that there is not.
    pub points: [Option<[[f64; 3]; POINTS]>; PARTS.len()],
    /// The body of the fuselage.
    pub body: Option<Spheroid>,
}

impl AirframeInWake {
    /// Mean at each part of a velocity that is known at points [m -> m/s, `_h`].
    pub fn mean(&self, velocity: impl FnOnce(&[[f64; 3]]) -> Vec<[f64; 3]>) -> AtParts {
        let points: Vec<[f64; 3]> = self.points.iter().flatten().flatten().copied().collect();
        let found = velocity(&points);
        let mut rows = found.chunks_exact(POINTS);
        self.points.map(|part| match part.and_then(|_| rows.next()) {
            Some(row) => std::array::from_fn(|i| row.iter().map(|v| v[i]).sum::<f64>() / POINTS as f64),
            None => [0.0; 3],
        })
    }
}

impl WakeOptions {
    /// The airframe, where its parts feel the wake.
    pub fn washed(&self, airframe: Option<AirframeInWake>) -> Option<AirframeInWake> {
        airframe.filter(|_| self.wash == Wash::Wake)
    }

    /// The body of the fuselage, where the blades feel it.
    pub fn body(&self, airframe: Option<AirframeInWake>) -> Option<Spheroid> {
        match self.fuselage_upwash {
            FuselageUpwash::None => None,
            FuselageUpwash::Spheroid => airframe.and_then(|a| a.body),
        }
    }

    /// Adds to an inflow (n_blades, n_stations) over the tip speed what the body of the fuselage does at the stations of `instant`.
    ///
    /// Its motion is that of the hub at its centre; the wake does not carry it.
    pub fn add_upwash(
        &self,
        airframe: Option<AirframeInWake>,
        hub: &HubMotion,
        instant: &RotorInstant,
        inflow: &mut [f64],
    ) {
        let Some(body) = self.body(airframe) else { return };
        let ([p, q, r], [x, y, z]) = (hub.rates, body.centre);
        let swing = [q * z - r * y, r * x - p * z, p * y - q * x];
        let motion = std::array::from_fn(|i| hub.velocity[i] + swing[i]);
        for (lambda, point) in inflow.iter_mut().zip(&instant.station) {
            *lambda -= body.velocity(motion, *point)[2] / self.tip_speed();
        }
    }
}

/// Mean of several samples of the air at the parts.
pub fn mean_at_parts<'a>(samples: impl ExactSizeIterator<Item = &'a AtParts>) -> AtParts {
    let n = samples.len() as f64;
    let mut mean = AtParts::default();
    for sample in samples {
        for (sum, v) in mean.as_flattened_mut().iter_mut().zip(sample.as_flattened()) {
            *sum += v / n;
        }
    }
    mean
}
