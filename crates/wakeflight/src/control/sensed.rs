//! What is known of a flight at one moment: signals of its states, exact.

/// Standard gravity [m/s2].
const GRAVITY: f64 = 9.80665;
/// Airspeed [m/s] below which the rate of a coordinated turn, g tan(bank)/V, is taken as there: it grows without bound.
pub const SLOWEST_TURN: f64 = 10.0;

/// States of an airframe, its air and its rotor, SI, angles in rad.
#[derive(Clone, Debug, Default)]
pub struct Sensed {
    /// u, v, w over ground [m/s], body axes.
    pub velocity: [f64; 3],
    /// p, q, r [rad/s].
    pub rates: [f64; 3],
    /// Attitude, body to inertial, of unit length.
    pub quaternion: [f64; 4],
    /// North, east, down from where the flight began [m].
    pub position: [f64; 3],
    /// Velocity through the air [m/s], body axes.
    pub through: [f64; 3],
    /// Altitude of the ground of `position` above sea level [m].
    pub ground: f64,
    /// Speed of the main rotor [rad/s].
    pub rotor_speed: f64,
}

/// A signal that feedback knows by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names say what they are")]
pub enum Signal {
    P,
    Q,
    R,
    Roll,
    Pitch,
    Yaw,
    Sideslip,
    Altitude,
    ClimbRate,
    /// Yaw rate beyond that of a coordinated turn.
    Turning,
    /// Specific force to the right, which is measured apart.
    SideForce,
}

impl Signal {
    /// By its name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "p" => Self::P,
            "q" => Self::Q,
            "r" => Self::R,
            "roll" => Self::Roll,
            "pitch" => Self::Pitch,
            "yaw" => Self::Yaw,
            "sideslip" => Self::Sideslip,
            "altitude" => Self::Altitude,
            "climb_rate" => Self::ClimbRate,
            "turning" => Self::Turning,
            "ay" => Self::SideForce,
            _ => return None,
        })
    }
}

impl Sensed {
    /// Of the states `y`, of which the airframe's come first; `through`: velocity through the air where it moves.
    pub fn of(y: &[f64], ground: f64, rotor_speed: f64, through: Option<[f64; 3]>) -> Self {
        let velocity = [y[0], y[1], y[2]];
        let size = (y[6] * y[6] + y[7] * y[7] + y[8] * y[8] + y[9] * y[9]).sqrt();
        Self {
            velocity,
            rates: [y[3], y[4], y[5]],
            quaternion: [y[6] / size, y[7] / size, y[8] / size, y[9] / size],
            position: [y[10], y[11], y[12]],
            through: through.unwrap_or(velocity),
            ground,
            rotor_speed,
        }
    }

    /// z of the earth in body axes.
    pub fn down(&self) -> [f64; 3] {
        let [a, b, c, d] = self.quaternion;
        [2.0 * (b * d - a * c), 2.0 * (c * d + a * b), 1.0 - 2.0 * (b * b + c * c)]
    }

    /// Bank, right side down positive [rad].
    pub fn roll(&self) -> f64 {
        let [a, b, c, d] = self.quaternion;
        (2.0 * (a * b + c * d)).atan2(1.0 - 2.0 * (b * b + c * c))
    }

    /// Pitch attitude, nose up positive [rad].
    pub fn pitch(&self) -> f64 {
        let [a, b, c, d] = self.quaternion;
        (2.0 * (a * c - d * b)).clamp(-1.0, 1.0).asin()
    }

    /// Heading, nose right positive [rad].
    pub fn yaw(&self) -> f64 {
        let [a, b, c, d] = self.quaternion;
        (2.0 * (a * d + b * c)).atan2(1.0 - 2.0 * (c * c + d * d))
    }

    /// Speed through the air [m/s].
    pub fn airspeed(&self) -> f64 {
        let [u, v, w] = self.through;
        (u * u + v * v + w * w).sqrt()
    }

    /// Angle of the velocity through the air out of the plane of symmetry, from the right positive [rad].
    pub fn sideslip(&self) -> f64 {
        self.through[1].atan2(self.through[0])
    }

    /// Speed upward [m/s].
    pub fn climb_rate(&self) -> f64 {
        let ([x, y, z], [u, v, w]) = (self.down(), self.velocity);
        -(u * x + v * y + w * z)
    }

    /// Altitude above sea level [m].
    pub fn altitude(&self) -> f64 {
        self.ground - self.position[2]
    }

    /// Yaw rate beyond that of a coordinated turn at this bank, r - g sin(roll) cos(pitch)/V [rad/s].
    pub fn turning(&self) -> f64 {
        let speed = self.airspeed().max(SLOWEST_TURN);
        self.rates[2] - GRAVITY * self.roll().sin() * self.pitch().cos() / speed
    }

    /// A signal; `side_force`: that which is measured apart.
    pub fn signal(&self, signal: Signal, side_force: f64) -> f64 {
        match signal {
            Signal::P => self.rates[0],
            Signal::Q => self.rates[1],
            Signal::R => self.rates[2],
            Signal::Roll => self.roll(),
            Signal::Pitch => self.pitch(),
            Signal::Yaw => self.yaw(),
            Signal::Sideslip => self.sideslip(),
            Signal::Altitude => self.altitude(),
            Signal::ClimbRate => self.climb_rate(),
            Signal::Turning => self.turning(),
            Signal::SideForce => side_force,
        }
    }
}
