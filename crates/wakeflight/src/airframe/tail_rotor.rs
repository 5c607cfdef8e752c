//! Tail rotor: closed-form thrust with its own inflow.

use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use serde::Deserialize;
use std::f64::consts::PI;

/// Tail rotor properties, SI and radians.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TailRotor {
    /// Hub from the body origin [m], body axes.
    pub position: [f64; 3],
    /// Radius [m].
    pub radius: f64,
    /// Rotor speed [rad/s].
    pub omega: f64,
    /// Solidity.
    pub solidity: f64,
    /// Cant: thrust along (0, cos, -sin) in body axes [rad].
    pub cant: f64,
    /// Twist, root to tip [rad].
    pub twist: f64,
    /// Lift curve slope [1/rad].
    pub lift_curve_slope: f64,
    /// Tip loss factor B.
    pub tip_loss_factor: f64,
    /// Pitch bias [rad].
    pub pitch_bias: f64,
    /// Pitch lost per newton of thrust by coning and delta3 [rad/N]; zero where the data have no coning.
    pub pitch_per_thrust: f64,
    /// Drag polar: d0 + d1 alpha + d2 alpha^2.
    pub cd_polar: [f64; 3],
    /// Thrust factor at rest, thrust factor at and beyond the speed, and that speed [m/s]; quadratic between.
    pub fin_blockage: [f64; 3],
}

/// Loads of the tail rotor on the airframe at its hub; its shaft torque is neglected.
#[derive(Clone, Copy, Debug)]
pub struct TailRotorLoads<S: Copy> {
    /// Force [N].
    pub force: Vec3<S, Body>,
    /// Thrust left after fin blockage [N].
    pub thrust: S,
    /// Shaft power [W].
    pub power: S,
    /// Rate of the inflow state [1/s].
    pub lambda_i_dot: S,
}

impl TailRotor {
    /// Loads for the local velocity of the hub through the air [m/s], pitch of the rigging `theta_tr` [rad] and the
    /// induced inflow ratio `lambda_i`; `forward_speed` [m/s] sets the blockage by the fin.
    ///
    /// CT = (a sigma/2)[theta (B^3/3 + B mu^2/2) + theta_tw (B^4/4 + B^2 mu^2/4) - lambda (B^2/2 + mu^2/4)],
    /// theta = theta_tr + bias - pitch_per_thrust T (T before blockage; linear, solved), lambda = lambda_i + V n/(Omega R)
    /// with the thrust axis n, lambda_i_dot = Omega (3 pi/8)[CT - 2 lambda_i sqrt(mu^2 + lambda^2)],
    /// CP = lambda CT + sigma cd (1 + 4.6 mu^2)/8 with the polar at 6 CT/(a sigma) [howlett1981].
    pub fn evaluate<S: Real>(
        &self,
        velocity: Vec3<S, Body>,
        theta_tr: S,
        lambda_i: S,
        density: f64,
        forward_speed: S,
    ) -> TailRotorLoads<S> {
        let tip_speed = self.omega * self.radius;
        let (sin_cant, cos_cant) = self.cant.sin_cos();
        let axial = (velocity.y * cos_cant - velocity.z * sin_cant) / tip_speed;
        let across = (velocity.y * sin_cant + velocity.z * cos_cant) / tip_speed;
        let along = velocity.x / tip_speed;
        let mu_squared = along * along + across * across;
        let lambda = lambda_i + axial;

        let b = self.tip_loss_factor;
        let by_pitch = mu_squared * (b / 2.0) + b.powi(3) / 3.0;
        let by_twist = mu_squared * (b * b / 4.0) + b.powi(4) / 4.0;
        let by_inflow = mu_squared / 4.0 + b * b / 2.0;
        let half_slope = 0.5 * self.lift_curve_slope * self.solidity;
        let thrust_unit = density * PI * self.radius.powi(2) * tip_speed * tip_speed;
        let uncoupled = ((theta_tr + self.pitch_bias) * by_pitch + by_twist * self.twist
            - lambda * by_inflow)
            * half_slope;
        let ct = uncoupled / (by_pitch * (half_slope * self.pitch_per_thrust * thrust_unit) + 1.0);

        // the small number keeps the root differentiable at rest
        let through = (mu_squared + lambda * lambda + 1e-16).sqrt();
        let lambda_i_dot = (ct - lambda_i * through * 2.0) * (self.omega * 3.0 * PI / 8.0);
        let thrust = ct * thrust_unit * self.blockage(forward_speed);

        let alpha = ct * (6.0 / (self.lift_curve_slope * self.solidity));
        let [d0, d1, d2] = self.cd_polar;
        let cd = (alpha * d2 + d1) * alpha + d0;
        let cp = lambda * ct + cd * (mu_squared * 4.6 + 1.0) * (self.solidity / 8.0);
        TailRotorLoads {
            force: Vec3::new(S::zero(), thrust * cos_cant, thrust * -sin_cant),
            thrust,
            power: cp * (thrust_unit * tip_speed),
            lambda_i_dot,
        }
    }

    /// Share of the thrust that the fin leaves, by forward speed [m/s].
    fn blockage<S: Real>(&self, forward_speed: S) -> S {
        let [at_rest, beyond, speed] = self.fin_blockage;
        if forward_speed.re().abs() >= speed {
            return S::cst(beyond);
        }
        (forward_speed / speed).squared() * (beyond - at_rest) + at_rest
    }
}
