//! International standard atmosphere 1976, troposphere.

use thiserror::Error;

/// Altitude outside the modelled layer.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "altitude {altitude} m is outside the troposphere of the standard atmosphere ({LOWEST} m to {HIGHEST} m)"
)]
pub struct AtmosphereError {
    /// Altitude asked for [m].
    pub altitude: f64,
}

/// Lowest altitude of the standard [m].
pub const LOWEST: f64 = -5000.0;
/// Tropopause [m].
pub const HIGHEST: f64 = 11000.0;

const SEA_LEVEL_TEMPERATURE: f64 = 288.15;
const SEA_LEVEL_PRESSURE: f64 = 101_325.0;
const LAPSE_RATE: f64 = 0.0065;
const GRAVITY: f64 = 9.80665;
// universal gas constant 8314.32 over molar mass 28.9644, as the 1976 standard defines them
const GAS_CONSTANT: f64 = 8314.32 / 28.9644;
const HEAT_RATIO: f64 = 1.4;
const SUTHERLAND_BETA: f64 = 1.458e-6;
const SUTHERLAND_TEMPERATURE: f64 = 110.4;

/// Air at one altitude, uniform over the aircraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atmosphere {
    /// Temperature [K].
    pub temperature: f64,
    /// Pressure [Pa].
    pub pressure: f64,
    /// Density [kg/m3].
    pub density: f64,
    /// Speed of sound [m/s].
    pub speed_of_sound: f64,
    /// Kinematic viscosity [m2/s].
    pub viscosity: f64,
}

impl Atmosphere {
    /// Standard day at an altitude [m], taken as geopotential.
    ///
    /// T = 288.15 - 0.0065 h, p = p0 (T/T0)^(g/(R L)), rho = p/(R T), a = sqrt(1.4 R T),
    /// dynamic viscosity by Sutherland 1.458e-6 T^1.5/(T + 110.4), here divided by the density.
    /// Not modelled: layers above the tropopause, humidity.
    pub fn standard(altitude: f64) -> Result<Self, AtmosphereError> {
        // written so that a NaN altitude is refused
        if !(LOWEST..=HIGHEST).contains(&altitude) {
            return Err(AtmosphereError { altitude });
        }
        let temperature = SEA_LEVEL_TEMPERATURE - LAPSE_RATE * altitude;
        let exponent = GRAVITY / (GAS_CONSTANT * LAPSE_RATE);
        let pressure = SEA_LEVEL_PRESSURE * (temperature / SEA_LEVEL_TEMPERATURE).powf(exponent);
        let density = pressure / (GAS_CONSTANT * temperature);
        let dynamic = SUTHERLAND_BETA * temperature.powf(1.5) / (temperature + SUTHERLAND_TEMPERATURE);
        Ok(Self {
            temperature,
            pressure,
            density,
            speed_of_sound: (HEAT_RATIO * GAS_CONSTANT * temperature).sqrt(),
            viscosity: dynamic / density,
        })
    }

    /// Equivalent over true airspeed, sqrt(rho/rho0).
    pub fn equivalent_over_true(&self) -> f64 {
        let sea_level = SEA_LEVEL_PRESSURE / (GAS_CONSTANT * SEA_LEVEL_TEMPERATURE);
        (self.density / sea_level).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relative(value: f64, reference: f64) -> f64 {
        (value / reference - 1.0).abs()
    }

    #[test]
    fn sea_level_has_the_constants_of_the_standard() {
        let a = Atmosphere::standard(0.0).unwrap();
        assert!(relative(a.density, 1.2250) < 1e-5);
        assert!(relative(a.speed_of_sound, 340.294) < 1e-6);
        // table of the 1976 standard: kinematic viscosity 1.4607e-5 at sea level
        assert!(relative(a.viscosity, 1.4607e-5) < 5e-5);
        assert!(relative(a.equivalent_over_true(), 1.0) < 1e-15);
    }

    #[test]
    fn the_tropopause_has_216_65_kelvin_and_22632_pascal() {
        let a = Atmosphere::standard(11000.0).unwrap();
        assert!((a.temperature - 216.65).abs() < 1e-10);
        assert!(relative(a.pressure, 22632.06) < 1e-6);
        assert!(relative(a.density, 0.363918) < 2e-6);
    }

    #[test]
    fn air_of_the_baseline_condition() {
        let a = Atmosphere::standard(1600.2).unwrap();
        // 5250 ft: temperature ratio 0.963904, density 0.0020326 slug/ft3
        let ratio = 1.0 - 6.8756e-6 * 5250.0;
        assert!(relative(a.temperature, 288.15 * ratio) < 1e-6);
        assert!((a.density / 515.378_818 - 0.002_032_6).abs() < 0.5e-7);
        assert!(relative(a.speed_of_sound, 340.294 * ratio.sqrt()) < 1e-6);
        // the aircraft data's own figures, 1.0476105 and 334.10042, carry a rounding of this size
        assert!(relative(a.density, 1.0476105) < 4e-5);
        assert!(relative(a.speed_of_sound, 334.10042) < 2e-5);
    }

    #[test]
    fn altitudes_outside_the_troposphere_are_refused() {
        for h in [11000.1, -5001.0, f64::NAN, f64::INFINITY] {
            assert!(Atmosphere::standard(h).is_err());
        }
    }
}
