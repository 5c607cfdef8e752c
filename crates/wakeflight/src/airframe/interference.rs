//! Rotor wash and fuselage wash on the airframe's parts.

use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use crate::numerics::tables::{Grid, Table};
use crate::rotor::sense::Sense;
use crate::wake::AtParts;
use serde::Deserialize;

/// Interference by tables or by constant factors.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Interference {
    /// Tables of wake skew (rows) and longitudinal flapping (columns) [rad], and of fuselage angles [rad].
    Tables {
        /// Rotor wash on the fuselage, forward.
        ekx_fuselage: Grid,
        /// Rotor wash on the fuselage, down.
        ekz_fuselage: Grid,
        /// Rotor wash on stabilator and fin, forward.
        ekx_tail: Grid,
        /// Rotor wash on stabilator and fin, down.
        ekz_tail: Grid,
        /// Fuselage downwash angle at the stabilator [rad] against angle of attack.
        downwash: Table,
        /// Fuselage sidewash angle at fin and tail rotor [rad] against psi = -sideslip.
        sidewash: Table,
        /// Dynamic pressure ratio at the stabilator against angle of attack.
        q_ratio_stabilator: Table,
        /// Dynamic pressure ratio at fin and tail rotor against psi = -sideslip.
        q_ratio_fin: Table,
    },
    /// Downwash = factor times mean induced velocity; no fuselage wash, q ratio one.
    Factors {
        /// At the fuselage.
        fuselage: f64,
        /// At the stabilator.
        stabilator: f64,
    },
}

/// Velocities to add to those of the parts relative to the air [m/s]: the wash of the main rotor, turned round.
#[derive(Clone, Copy, Debug)]
pub struct RotorWash<S: Copy> {
    /// At the fuselage's reference point.
    pub fuselage: Vec3<S, Body>,
    /// At the stabilator.
    pub stabilator: Vec3<S, Body>,
    /// At the fin.
    pub fin: Vec3<S, Body>,
    /// At the tail rotor; tables have none.
    pub tail_rotor: Option<Vec3<S, Body>>,
}

/// What the fuselage does to the flow at the tail.
#[derive(Clone, Copy, Debug)]
pub struct FuselageWash<S> {
    /// Downwash angle [rad].
    pub downwash: S,
    /// Sidewash angle [rad].
    pub sidewash: S,
    /// Root of the dynamic pressure ratio at the stabilator.
    pub speed_ratio_stabilator: S,
    /// Root of the dynamic pressure ratio at fin and tail rotor.
    pub speed_ratio_fin: S,
}

impl Interference {
    /// Rotor wash for the mean inflow `lambda_0` (down +) and the hub's velocity ratios forward `mu_x` and down `mu_z`.
    ///
    /// u += ekx v_i, w -= ekz v_i, v_i = lambda_0 Omega R, tables of chi = atan2(mu_x, |lambda_0 - mu_z|) - beta_1c and
    /// of a_1f = -beta_1c, both held beyond the table [howlett1981]. `beta_1c` [rad]: disk forward-down +.
    pub fn rotor_wash<S: Real>(
        &self,
        lambda_0: S,
        mu_x: S,
        mu_z: S,
        beta_1c: S,
        tip_speed: f64,
    ) -> RotorWash<S> {
        let induced = lambda_0 * tip_speed;
        let down = |factor: f64| Vec3::new(S::zero(), S::zero(), induced * -factor);
        match self {
            Self::Tables { ekx_fuselage, ekz_fuselage, ekx_tail, ekz_tail, .. } => {
                // the small number keeps the angle differentiable where no air passes the disk
                let through = ((lambda_0 - mu_z).squared() + 1e-12).sqrt();
                let chi = mu_x.atan2(through) - beta_1c;
                let wash = |ekx: &Grid, ekz: &Grid| {
                    Vec3::new(induced * ekx.at(chi, -beta_1c), S::zero(), -induced * ekz.at(chi, -beta_1c))
                };
                let tail = wash(ekx_tail, ekz_tail);
                let fuselage = wash(ekx_fuselage, ekz_fuselage);
                RotorWash { fuselage, stabilator: tail, fin: tail, tail_rotor: None }
            }
            Self::Factors { fuselage, stabilator } => {
                let (fuselage, stabilator) = (down(*fuselage), down(*stabilator));
                RotorWash { fuselage, stabilator, fin: Vec3::zero(), tail_rotor: None }
            }
        }
    }

    /// Fuselage wash at the fuselage's angles [rad], rotor wash included.
    pub fn fuselage_wash<S: Real>(&self, alpha: S, beta: S) -> FuselageWash<S> {
        match self {
            Self::Tables { downwash, sidewash, q_ratio_stabilator, q_ratio_fin, .. } => FuselageWash {
                downwash: downwash.at(alpha),
                sidewash: sidewash.at(-beta),
                speed_ratio_stabilator: q_ratio_stabilator.at(alpha).sqrt(),
                speed_ratio_fin: q_ratio_fin.at(-beta).sqrt(),
            },
            Self::Factors { .. } => FuselageWash::none(),
        }
    }
}

impl<S: Real> RotorWash<S> {
    /// The air of the wake itself at the parts [m/s], body axes of the airframe's hand: held, without derivatives.
    pub fn of_wake(air: &AtParts, hand: Sense) -> Self {
        let [fuselage, stabilator, fin, tail_rotor] = air.map(|v| -hand.polar(Vec3::cst(v)));
        Self { fuselage, stabilator, fin, tail_rotor: Some(tail_rotor) }
    }
}

impl<S: Real> FuselageWash<S> {
    /// Undisturbed flow.
    pub fn none() -> Self {
        Self {
            downwash: S::zero(),
            sidewash: S::zero(),
            speed_ratio_stabilator: S::one(),
            speed_ratio_fin: S::one(),
        }
    }

    /// Body velocity relative to the air [m/s] as the stabilator sees it, before rotor wash and rates:
    /// w - u downwash, then u and w times the speed ratio.
    pub fn at_stabilator(&self, velocity: Vec3<S, Body>) -> Vec3<S, Body> {
        let k = self.speed_ratio_stabilator;
        Vec3::new(velocity.x * k, velocity.y, (velocity.z - velocity.x * self.downwash) * k)
    }

    /// As the fin sees it: v - u sidewash, then u times the speed ratio.
    pub fn at_fin(&self, velocity: Vec3<S, Body>) -> Vec3<S, Body> {
        Vec3::new(velocity.x * self.speed_ratio_fin, velocity.y - velocity.x * self.sidewash, velocity.z)
    }

    /// As the tail rotor sees it: both wash angles, then all three components times the fin's speed ratio.
    pub fn at_tail_rotor(&self, velocity: Vec3<S, Body>) -> Vec3<S, Body> {
        let Vec3 { x: u, y: v, z: w, .. } = velocity;
        Vec3::new(u, v - u * self.sidewash, w - u * self.downwash) * self.speed_ratio_fin
    }
}
