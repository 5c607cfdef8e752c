//! The airframe as the wake of the first rotor meets it: points of its parts, the body of its fuselage, and the way back.

use super::model::System;
use crate::numerics::frames::{Body, Hub, Vec3};
use crate::wake::Spheroid;
use crate::wake::airframe::{AirframeInWake, AtParts, BODY_LENGTH, BODY_WIDTH, POINTS};

/// Square of the span of a stabilator over its area, which its data give.
const STABILATOR_ASPECT_RATIO: f64 = 4.0;
/// The same of the height of a fin.
const FIN_ASPECT_RATIO: f64 = 2.0;
/// Radius of the points of a tail rotor about its hub over its radius: the middle of its disk's area.
const TAIL_ROTOR_RING: f64 = 0.7;

/// Middles of five equal pieces of a line of unit length.
const ALONG: [f64; POINTS] = [-0.4, -0.2, 0.0, 0.2, 0.4];

/// Middles of pieces of a line about `centre` that goes along `line`.
fn along(centre: [f64; 3], line: [f64; 3]) -> [[f64; 3]; POINTS] {
    ALONG.map(|s| std::array::from_fn(|i| centre[i] + s * line[i]))
}

impl System {
    /// The airframe in hub axes as the sense of the first rotor has them; none on a stand.
    pub fn airframe_in_wake(&self) -> Option<AirframeInWake> {
        let airframe = self.carrier.airframe()?;
        let (rotor, radius) = (self.main(), self.main().blade.radius);
        let to_hub = |v: [f64; 3]| -> [f64; 3] {
            rotor.sense.polar(rotor.rot_hb::<f64>() * airframe.hand.polar(Vec3::<f64, Body>::cst(v))).array()
        };
        let from_hub = |p: [f64; 3]| {
            let hub = airframe.hand.polar(Vec3::<f64, Body>::cst(rotor.position)).array();
            to_hub(std::array::from_fn(|i| p[i] - hub[i]))
        };
        let length = BODY_LENGTH * radius;
        let fuselage = airframe.fuselage.as_ref().map(|part| along(part.position, [length, 0.0, 0.0]));
        let stabilator = airframe
            .stabilator
            .as_ref()
            .map(|part| along(part.position, [0.0, (STABILATOR_ASPECT_RATIO * part.area).sqrt(), 0.0]));
        let fin = airframe
            .fin
            .as_ref()
            .map(|part| along(part.position, [0.0, 0.0, (FIN_ASPECT_RATIO * part.area).sqrt()]));
        let tail_rotor = self.closed.first().map(|part| {
            let (centre, ring) = (part.position, TAIL_ROTOR_RING * part.radius);
            let (sine, cosine) = part.cant.sin_cos();
            let beside = |x: f64, up: f64| {
                [centre[0] + ring * x, centre[1] + ring * up * sine, centre[2] + ring * up * cosine]
            };
            [centre, beside(1.0, 0.0), beside(0.0, 1.0), beside(-1.0, 0.0), beside(0.0, -1.0)]
        });
        let body = airframe.fuselage.as_ref().map(|part| Spheroid {
            centre: from_hub(part.position),
            axis: to_hub([1.0, 0.0, 0.0]),
            half_length: 0.5 * length,
            half_width: 0.5 * BODY_WIDTH * radius,
        });
        let parts = [fuselage, stabilator, fin, tail_rotor];
        Some(AirframeInWake { points: parts.map(|part| part.map(|points| points.map(from_hub))), body })
    }

    /// Air at the parts of the airframe [m/s] from hub axes as the sense of the first rotor has them into body axes.
    pub fn washed(&self, at_parts: &AtParts) -> AtParts {
        let rotor = self.main();
        let to_body = rotor.rot_hb::<f64>().transposed();
        at_parts.map(|v| (to_body * rotor.sense.polar(Vec3::<f64, Hub>::cst(v))).array())
    }
}
