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
    /// Nominal rotor speed [rad/s].
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

/// Pitch by the controls, inflow and speed of a closed-form rotor.
#[derive(Clone, Copy, Debug)]
pub struct ClosedFormState<S> {
    /// Pitch of the rigging [rad].
    pub theta: S,
    /// Induced velocity over the nominal tip speed.
    pub inflow: S,
    /// Speed over the nominal one.
    pub speed_ratio: S,
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
    /// Loads for the local velocity of the hub through the air [m/s] and the rotor's state: pitch theta_tr, inflow lambda_i, speed;
    /// `forward_speed` [m/s] sets the blockage by the fin.
    ///
    /// CT = (a sigma/2)[theta (B^3/3 + B mu^2/2) + theta_tw (B^4/4 + B^2 mu^2/4) - lambda (B^2/2 + mu^2/4)],
    /// theta = theta_tr + bias - pitch_per_thrust T (T before blockage; linear, solved), lambda = lambda_i + V n/(Omega R)
    /// with the thrust axis n, lambda_i_dot = Omega (3 pi/8)[CT - 2 lambda_i sqrt(mu^2 + lambda^2)],
    /// CP = lambda CT + sigma cd (1 + 4.6 mu^2)/8 with the polar at 6 CT/(a sigma) [howlett1981].
    ///
    /// All at the speed of the moment but for the state, which counts at the nominal one: momentum knows no speed of rotation.
    pub fn evaluate<S: Real>(
        &self,
        velocity: Vec3<S, Body>,
        state: ClosedFormState<S>,
        density: f64,
        forward_speed: S,
    ) -> TailRotorLoads<S> {
        let ClosedFormState { theta: theta_tr, inflow: lambda_i, speed_ratio } = state;
        let (tip_speed, ratio_squared) = (self.omega * self.radius, speed_ratio * speed_ratio);
        let (sin_cant, cos_cant) = self.cant.sin_cos();
        let axial = (velocity.y * cos_cant - velocity.z * sin_cant) / tip_speed / speed_ratio;
        let across = (velocity.y * sin_cant + velocity.z * cos_cant) / tip_speed / speed_ratio;
        let along = velocity.x / tip_speed / speed_ratio;
        let mu_squared = along * along + across * across;
        let lambda = lambda_i / speed_ratio + axial;

        let b = self.tip_loss_factor;
        let by_pitch = mu_squared * (b / 2.0) + b.powi(3) / 3.0;
        let by_twist = mu_squared * (b * b / 4.0) + b.powi(4) / 4.0;
        let by_inflow = mu_squared / 4.0 + b * b / 2.0;
        let half_slope = 0.5 * self.lift_curve_slope * self.solidity;
        let thrust_unit = density * PI * self.radius.powi(2) * tip_speed * tip_speed;
        let uncoupled = ((theta_tr + self.pitch_bias) * by_pitch + by_twist * self.twist
            - lambda * by_inflow)
            * half_slope;
        let coning = by_pitch * (half_slope * self.pitch_per_thrust * thrust_unit);
        let ct = uncoupled / (coning * ratio_squared + 1.0);

        // the small number keeps the root differentiable at rest
        let through = (mu_squared + lambda * lambda + 1e-16).sqrt();
        let drawn = lambda_i * (through * speed_ratio) * 2.0;
        let lambda_i_dot = (ct * ratio_squared - drawn) * (self.omega * 3.0 * PI / 8.0);
        let thrust = ct * thrust_unit * ratio_squared * self.blockage(forward_speed);

        let alpha = ct * (6.0 / (self.lift_curve_slope * self.solidity));
        let [d0, d1, d2] = self.cd_polar;
        let cd = (alpha * d2 + d1) * alpha + d0;
        let cp = lambda * ct + cd * (mu_squared * 4.6 + 1.0) * (self.solidity / 8.0);
        TailRotorLoads {
            force: Vec3::new(S::zero(), thrust * cos_cant, thrust * -sin_cant),
            thrust,
            power: cp * (thrust_unit * tip_speed) * (ratio_squared * speed_ratio),
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
