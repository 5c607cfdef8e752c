//! The rotor: equal blades on a hub, each with its lag damper, turned by the swashplate.

use super::data::RotorData;
use super::drive::Drive;
use super::lag_damper::LagDamper;
use super::sense::Sense;
use super::speed::{RotorSpeed, Turning};
use super::swashplate::{BladePitch, PitchHarmonic, Rigging};
use crate::airfoil::span::StationAirfoils;
use crate::blade::MAX_MODES;
use crate::blade::aerodynamics::{Air, SectionAir};
use crate::blade::error::BladeError;
use crate::blade::held_row::HeldRow;
use crate::blade::hinge::HingeStops;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion, combine};
use crate::blade::model::{Blade, Discretisation};
use crate::blade::sections_in_time::{BladePast, SectionLaw, SectionsInTime};
use crate::blade::surroundings::{BladeEnvironment, BladeInflow};
use crate::blade::thin_section::ThinSection;
use crate::numerics::frames::{Body, Hub, Rotation, Vec3, rot_hb};
use crate::numerics::scalar::{Dual, Real};

/// Derivatives of a damper's virtual work, row by row.
pub type DamperSlopes = [[f64; 2 * MAX_MODES]; MAX_MODES];

/// Rotor of equal blades.
#[derive(Clone, Debug)]
pub struct Rotor {
    /// Blade.
    pub blade: Blade,
    /// Number of blades.
    pub n_blades: usize,
    /// Section table of every station.
    pub airfoils: StationAirfoils,
    /// Law of sections that meet the air at three quarters of the chord; none on a lifting line.
    pub thin: Option<ThinSection>,
    /// Law of sections that remember; none where they answer the flow of the instant.
    pub sections: Option<SectionLaw>,
    /// Whether drag acts along the whole wind of a section, its part along the span included.
    pub yawed_drag: bool,
    /// Damper of every blade.
    pub lag_damper: Option<LagDamper>,
    /// Sticks to pitch.
    pub rigging: Rigging,
    /// Higher harmonics of the pitch.
    pub higher: Vec<PitchHarmonic>,
    /// Nominal speed [rad/s], positive in the sense of `sense`: what is counted without dimension is counted at it.
    pub omega: f64,
    /// Speed in time.
    pub speed: RotorSpeed,
    /// Sense of rotation: what is said of hub axes is said of its twin's.
    pub sense: Sense,
    /// Hub centre from the body origin [m].
    pub position: [f64; 3],
    /// Shaft tilt forward and to the right [rad].
    pub shaft_tilt: [f64; 2],
}

impl Rotor {
    /// Discretised from its data; lift ends at `tip_loss_factor` R.
    pub fn new(
        data: &RotorData,
        rigging: Rigging,
        tip_loss_factor: f64,
        discretisation: &Discretisation,
    ) -> Result<Self, BladeError> {
        let blade = Blade::new(&data.blade, data.omega, tip_loss_factor, discretisation)?;
        Ok(Self {
            airfoils: data.airfoil.at(blade.stations.iter().map(|station| station.shapes.x)),
            blade,
            n_blades: data.n_blades,
            thin: None,
            sections: None,
            yawed_drag: false,
            lag_damper: data.lag_damper.clone(),
            rigging,
            higher: Vec::new(),
            sense: data.rotation,
            omega: data.omega,
            speed: RotorSpeed::Constant,
            position: data.position,
            shaft_tilt: [data.shaft_tilt_forward, data.shaft_tilt_lateral],
        })
    }

    /// Rotation from body to hub axes.
    #[inline(always)]
    pub fn rot_hb<S: Real>(&self) -> Rotation<S, Hub, Body> {
        rot_hb(self.shaft_tilt[0], self.shaft_tilt[1])
    }

    /// Nominal tip speed [m/s].
    pub fn tip_speed(&self) -> f64 {
        self.omega * self.blade.radius
    }

    /// Azimuth of the first blade [rad] at time `t` [s]; where it is a state, that of the nominal speed.
    #[inline(always)]
    pub fn turned(&self, t: f64) -> f64 {
        match &self.speed {
            RotorSpeed::Constant | RotorSpeed::Free(_) | RotorSpeed::OverGround => self.omega * t,
            RotorSpeed::Prescribed(history) => history.azimuth(t),
        }
    }

    /// Time [s] at which the first blade has turned by `psi` [rad]; where it is a state, at the nominal speed.
    pub fn time(&self, psi: f64) -> f64 {
        match &self.speed {
            RotorSpeed::Constant | RotorSpeed::Free(_) | RotorSpeed::OverGround => psi / self.omega,
            RotorSpeed::Prescribed(history) => history.time(psi),
        }
    }

    /// Length [s] of a step of azimuth of which a revolution has `n`, at the nominal speed.
    pub fn nominal_step(&self, n: usize) -> f64 {
        std::f64::consts::TAU / (n as f64 * self.omega)
    }

    /// Speed and its rate at time `t` of a step that began at `begin` [s]; where it is a state, the nominal one.
    #[inline(always)]
    pub fn turning(&self, t: f64, begin: f64) -> Turning {
        match &self.speed {
            RotorSpeed::Constant | RotorSpeed::Free(_) | RotorSpeed::OverGround => {
                Turning::steady(self.omega)
            }
            RotorSpeed::Prescribed(history) => history.turning(t, begin),
        }
    }

    /// Pitch of a blade at azimuth `psi` [rad] of a rotor that is `turning`, for controls that move at constant rates, with exact
    /// rates.
    #[inline(always)]
    pub fn blade_pitch<U: Real>(
        &self,
        stick: [U; 4],
        stick_rate: [U; 4],
        psi: U,
        turning: Turning<U>,
    ) -> BladePitch<U> {
        let mut pitch = self.rigging.blade_pitch(stick, stick_rate, psi, turning);
        for harmonic in &self.higher {
            harmonic.add_to(&mut pitch, psi, turning);
        }
        pitch
    }

    /// Hub motion, as its sense of rotation has it, from body velocity, rates, their derivatives, and gravity [body axes].
    #[inline(always)]
    pub fn hub_motion<S: Real>(
        &self,
        velocity_b: Vec3<S, Body>,
        rates_b: Vec3<S, Body>,
        velocity_dot: Vec3<S, Body>,
        rates_dot: Vec3<S, Body>,
        gravity_b: Vec3<S, Body>,
    ) -> HubMotion<S> {
        let r = self.rot_hb::<S>();
        let arm = Vec3::cst(self.position);
        let swing = rates_b.cross(arm);
        self.sense.hub_motion(HubMotion {
            velocity: r * (velocity_b + swing),
            acceleration_less_gravity: r
                * (velocity_dot + rates_b.cross(velocity_b) + rates_dot.cross(arm) + rates_b.cross(swing)
                    - gravity_b),
            omega: r * rates_b,
            omega_dot: r * rates_dot,
        })
    }

    /// What moves a speed that is a state.
    pub fn drive(&self) -> Option<&Drive> {
        match &self.speed {
            RotorSpeed::Free(drive) => Some(drive),
            RotorSpeed::Constant | RotorSpeed::Prescribed(_) | RotorSpeed::OverGround => None,
        }
    }

    /// Azimuth of blade `b` [rad] when the first is at `psi`.
    #[inline(always)]
    pub fn azimuth<S: Real>(&self, psi: S, b: usize) -> S {
        psi + std::f64::consts::TAU * b as f64 / self.n_blades as f64
    }

    #[inline(always)]
    pub(super) fn environment(&self, air: Air) -> BladeEnvironment<'_> {
        BladeEnvironment {
            airfoils: &self.airfoils,
            air,
            rotor_speed: self.omega,
            yawed_drag: self.yawed_drag,
        }
    }

    /// Loads of a blade with its damper, at azimuth `psi` for the stick position [m] and its rate [m/s].
    #[inline(always)]
    pub fn blade_loads<S: Real>(
        &self,
        air: Air,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> BladeLoads<S> {
        let mut loads = self.undamped_loads(air, hub, psi, modal, control, inflow);
        self.add_damper(modal, control, &mut loads.modal);
        loads
    }

    /// The same without the damper.
    #[inline(always)]
    pub fn undamped_loads<S: Real>(
        &self,
        air: Air,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> BladeLoads<S> {
        self.blade.loads(&self.environment(air), hub, psi, modal, control, inflow)
    }

    /// Inflow of a blade held as one row: at the stations, followed for thin sections by that at three quarters of the chord.
    pub fn held_inflow<'a, S: Real>(&self, row: impl Into<HeldRow<'a>>) -> BladeInflow<'a, S> {
        let (n, row) = (self.blade.stations.len(), row.into());
        match self.thin {
            Some(law) if row.len() == 2 * n => {
                let (quarter, three_quarter) = row.split_at(n);
                BladeInflow::TwoLines { law, quarter, three_quarter }
            }
            Some(law) => BladeInflow::TwoLines { law, quarter: row, three_quarter: row },
            None => BladeInflow::Stations(row),
        }
    }

    /// The sections of a blade of which `past` is known, where they remember.
    #[inline(always)]
    pub fn sections_in_time<'a>(&'a self, past: Option<BladePast<'a>>) -> Option<SectionsInTime<'a>> {
        let law = self.sections.as_ref()?;
        past.map(|past| SectionsInTime { law, past })
    }

    /// Air and inflow at every station of a blade.
    #[inline(always)]
    pub fn blade_air<S: Real>(
        &self,
        air: Air,
        hub: &HubMotion<S>,
        psi: S,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        inflow: &BladeInflow<S>,
    ) -> impl Iterator<Item = (SectionAir<S>, S)> {
        self.blade.air(self.environment(air), hub, psi, modal, control, inflow)
    }

    /// Virtual work of damper, hinge spring and stops: they act between hub and blade and pass no load on.
    #[inline(always)]
    pub(crate) fn add_damper<S: Real>(
        &self,
        modal: &ModalMotion<S>,
        control: &PitchMotion<S>,
        work: &mut [S; MAX_MODES],
    ) {
        let (blade, n) = (&self.blade, self.blade.n_modes);
        let stops = blade.stops.iter().any(Option::is_some);
        if self.lag_damper.is_none() && !stops {
            return;
        }
        let m = blade.root.motion(n, modal, control);
        let (flap, lead) = m.tangent_angles();
        if let Some(damper) = &self.lag_damper {
            let pitch = control.theta + combine(&blade.root.theta, &modal.q, n);
            let pitch_dot = control.theta_dot + combine(&blade.root.theta, &modal.q_dot, n);
            let (flap_dot, lead_dot) = m.angle_rates();
            let (force, stroke) = damper.force_and_gradient(lead, flap, pitch, lead_dot, flap_dot, pitch_dot);
            let spring = damper.spring_moment(lead);
            for (i, total) in work.iter_mut().enumerate().take(n) {
                let (flap_i, lead_i) = m.angle_gradient(&blade.root, i);
                let stroke_i = stroke[0] * lead_i + stroke[1] * flap_i + stroke[2] * blade.root.theta[i];
                *total += spring * lead_i - force * stroke_i;
            }
        }
        if stops {
            let [of_flap, of_lag] = &blade.stops;
            let moment = |stop: &Option<HingeStops>, angle: S| stop.map_or(S::zero(), |s| s.moment(angle));
            let (up, forward) = (moment(of_flap, flap), moment(of_lag, lead));
            for (i, total) in work.iter_mut().enumerate().take(n) {
                let (flap_i, lead_i) = m.angle_gradient(&blade.root, i);
                *total += up * flap_i + forward * lead_i;
            }
        }
    }

    /// Angles of a blade at its hinges [rad], flap up and lead forward positive.
    pub fn hinge_angles(&self, modal: &ModalMotion<f64>) -> (f64, f64) {
        let still = PitchMotion { theta: 0.0, theta_dot: 0.0, theta_ddot: 0.0 };
        self.blade.root.motion(self.blade.n_modes, modal, &still).tangent_angles()
    }

    /// Lift, drag and moment coefficients of the tables of the stations, row after row.
    pub fn section_coefficients(&self, alpha: &[f64], mach: &[f64]) -> [Vec<f64>; 3] {
        let mut found = [const { Vec::new() }; 3];
        let n = self.blade.stations.len();
        for (k, (&alpha, &mach)) in alpha.iter().zip(mach).enumerate() {
            let (cl, cd, cm) = self.airfoils.at(k % n).coefficients(alpha, mach);
            for (all, one) in found.iter_mut().zip([cl, cd, cm]) {
                all.push(one);
            }
        }
        found
    }

    /// Derivatives of the damper's virtual work by modal coordinates and rates: (row, column), columns coordinates first.
    pub fn damper_slopes(&self, modal: &ModalMotion<f64>, control: &PitchMotion<f64>) -> DamperSlopes {
        let n = self.blade.n_modes;
        let zero = [Dual::zero(); MAX_MODES];
        let mut motion = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for i in 0..n {
            motion.q[i] = Dual::variable(modal.q[i], i);
            motion.q_dot[i] = Dual::variable(modal.q_dot[i], n + i);
        }
        let held = PitchMotion {
            theta: Dual::cst(control.theta),
            theta_dot: Dual::cst(control.theta_dot),
            theta_ddot: Dual::cst(control.theta_ddot),
        };
        let mut work = [Dual::<{ 2 * MAX_MODES }>::zero(); MAX_MODES];
        self.add_damper(&motion, &held, &mut work);
        work.map(|w| w.eps)
    }

    /// Rigid flap and lead angles that put the tip where the deflected blade has it [rad].
    pub fn equivalent_angles(&self, modal: &ModalMotion<f64>) -> (f64, f64) {
        let (n, tip) = (self.blade.n_modes, &self.blade.tip);
        let still = PitchMotion { theta: 0.0, theta_dot: 0.0, theta_ddot: 0.0 };
        let at = tip.motion(n, modal, &still).position;
        let (s, c) = self.blade.precone.sin_cos();
        let (x, y, z) = (at.x * c - at.z * s, at.y, at.x * s + at.z * c);
        let e = self.hinge();
        ((z / (self.blade.radius - e)).clamp(-1.0, 1.0).asin(), y.atan2(x - e))
    }

    /// C_T, C_L (right side down +), C_M (nose up +) of air loads on the hub, hub axes [N, N m].
    pub fn aero_coefficients<S: Real>(&self, air: Air, force: Vec3<S, Hub>, moment: Vec3<S, Hub>) -> [S; 3] {
        let radius = self.blade.radius;
        let scale = 1.0 / (air.density * std::f64::consts::PI * radius * radius * self.tip_speed().powi(2));
        // hub axes, x aft and y right: right side down is a moment about -x, nose up about +y
        [force.z * scale, -(moment.x * (scale / radius)), moment.y * (scale / radius)]
    }

    /// Blade area over disk area.
    pub fn solidity(&self) -> f64 {
        let blade = &self.blade;
        let area: f64 = blade.stations.iter().map(|s| s.geometry.chord * s.geometry.width).sum();
        self.n_blades as f64 * area / (std::f64::consts::PI * blade.radius * blade.radius)
    }

    /// Station about which the wake's rigid equivalent blade turns [m].
    pub fn hinge(&self) -> f64 {
        self.blade.root_station
    }
}
