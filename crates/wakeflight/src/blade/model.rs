//! A discretised blade: quadrature points of the structure, stations of the air, everything constant precomputed.

use super::MAX_MODES;
use super::aerodynamics::StationGeometry;
use super::error::BladeError;
use super::hinge::{HingeSprings, HingeStops};
use super::kinematics::StationShapes;
use super::modes::BladeModes;
use super::quadrature::gauss_points;
use super::rigid_body::RigidBlade;
use super::section::{BladeProperties, Root};
use super::stations::{AeroStation, StructuralPoint};
use super::strain::Stiffness;
use serde::Deserialize;

/// How finely a blade is resolved.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Discretisation {
    /// Finite elements.
    pub n_elements: usize,
    /// Modes kept.
    pub n_modes: usize,
    /// Quadrature points per element.
    pub n_gauss: usize,
    /// Stations of the air loads.
    pub n_stations: usize,
    /// Pitch at which the modes are found [rad].
    pub reference_pitch: f64,
}

/// One blade, discretised.
#[derive(Clone, Debug)]
pub struct Blade {
    /// Its modes.
    pub modes: BladeModes,
    /// Modes kept.
    pub n_modes: usize,
    /// Index of the first flap mode.
    pub flap_mode: usize,
    /// Structure.
    pub structure: Vec<StructuralPoint>,
    /// The structure as one body, where the blade does not bend.
    pub rigid: Option<RigidBlade>,
    /// Air.
    pub stations: Vec<AeroStation>,
    /// Shapes at the hinge or clamp, and at the tip.
    pub root: StationShapes,
    /// Shapes at the tip.
    pub tip: StationShapes,
    /// phi(root) per modal coordinate (wind-up of the control system).
    pub root_twist: [f64; MAX_MODES],
    /// Root torsion spring [N m/rad].
    pub control_stiffness: f64,
    /// Springs at the hinges.
    pub hinge_springs: HingeSprings,
    /// Stops of the flap and of the lag hinge.
    pub stops: [Option<HingeStops>; 2],
    /// Structural damping per modal rate, 2 zeta omega; zero on hinge modes [1/s].
    pub damping: [f64; MAX_MODES],
    /// Fixed flap rotation [rad].
    pub precone: f64,
    /// Hinge or clamp station [m].
    pub root_station: f64,
    /// Radius [m].
    pub radius: f64,
    /// Mass of the blade [kg].
    pub mass: f64,
}

impl Blade {
    /// Discretise `properties` for rotor speed `omega` [rad/s].
    pub fn new(
        properties: &BladeProperties,
        omega: f64,
        tip_loss_factor: f64,
        d: &Discretisation,
    ) -> Result<Self, BladeError> {
        if d.n_modes > MAX_MODES {
            return Err(BladeError::Value {
                field: "n_modes",
                value: d.n_modes as f64,
                allowed: "1 to 12 modes",
            });
        }
        let modes = BladeModes::new(properties, omega, d.reference_pitch, d.n_elements, d.n_modes)?;
        let shaper = Shaper::new(properties, &modes, d.n_modes);
        let structure = structural_points(properties, &modes, &shaper, d);
        let stations = aero_stations(properties, &shaper, tip_loss_factor, d.n_stations);
        let mut damping = [0.0; MAX_MODES];
        let mut root_twist = [0.0; MAX_MODES];
        let at_root = modes.at(properties.root_station);
        for i in 0..d.n_modes {
            // the two rigid modes of a hinged blade lie below 1.5/rev and strain nothing; a clamped blade bends in all
            if properties.root == Root::Clamped || modes.frequency[i] > 1.5 * omega {
                damping[i] = 2.0 * properties.structural_damping_ratio * modes.frequency[i];
            }
            root_twist[i] = at_root.phi[i];
        }
        let flap_mode = (0..d.n_modes).find(|&i| modes.shares[i].flap > 0.5).unwrap_or(0);
        let rigid = properties.rigid.then(|| RigidBlade::of(&structure, &stations, properties.root_station));
        Ok(Self {
            n_modes: d.n_modes,
            flap_mode,
            rigid,
            mass: structure.iter().map(|p| p.mass).sum(),
            structure,
            stations,
            root: shaper.at(properties.root_station),
            tip: shaper.at(properties.radius),
            root_twist,
            control_stiffness: properties.control_stiffness,
            hinge_springs: HingeSprings { flap: properties.flap_spring, lag: properties.lag_spring },
            stops: [properties.flap_stops, properties.lag_stops],
            damping,
            precone: properties.precone,
            root_station: properties.root_station,
            radius: properties.radius,
            modes,
        })
    }
}

/// Builds `StationShapes`: modal shapes, pitch-flap coupling, foreshortening.
struct Shaper<'a> {
    modes: &'a BladeModes,
    n_modes: usize,
    tan_delta3: f64,
    /// Outer ends of intervals and the accumulated foreshortening forms there.
    nodes: Vec<(f64, StationShapes)>,
    properties: &'a BladeProperties,
}

impl<'a> Shaper<'a> {
    fn new(properties: &'a BladeProperties, modes: &'a BladeModes, n_modes: usize) -> Self {
        let mut shaper =
            Self { modes, n_modes, tan_delta3: properties.delta3.tan(), nodes: Vec::new(), properties };
        let mut here = shaper.bare(properties.root_station);
        let mut nodes = vec![(properties.root_station, here.clone())];
        for (a, b, _) in modes.pieces() {
            shaper.accumulate(&mut here, a, b);
            nodes.push((b, here.clone()));
        }
        shaper.nodes = nodes;
        shaper
    }

    /// Shapes at `x` without foreshortening.
    fn bare(&self, x: f64) -> StationShapes {
        let s = self.modes.at(x);
        let root = self.modes.at(self.properties.root_station);
        let mut shapes = StationShapes {
            x,
            length: x - self.properties.root_station,
            v: [[0.0; MAX_MODES]; 3],
            w: [[0.0; MAX_MODES]; 3],
            theta: [0.0; MAX_MODES],
            dphi: [0.0; MAX_MODES],
            shortening: [[0.0; MAX_MODES]; MAX_MODES],
            shortening_twist: [0.0; MAX_MODES],
        };
        for i in 0..self.n_modes {
            shapes.v[0][i] = s.v[i];
            shapes.v[1][i] = s.dv[i];
            shapes.v[2][i] = s.ddv[i];
            shapes.w[0][i] = s.w[i];
            shapes.w[1][i] = s.dw[i];
            shapes.w[2][i] = s.ddw[i];
            shapes.theta[i] = s.phi[i] - self.tan_delta3 * root.dw[i];
            shapes.dphi[i] = s.dphi[i];
        }
        shapes
    }

    /// Adds the foreshortening of a..b, which lies within one property segment and one element.
    fn accumulate(&self, shapes: &mut StationShapes, a: f64, b: f64) {
        let area_radius2 = self.area_radius_squared(0.5 * (a + b));
        for (x, weight) in gauss_points(4, a, b) {
            let s = self.modes.at(x);
            let twist_slope = slope(&self.properties.twist, x);
            for i in 0..self.n_modes {
                for j in 0..self.n_modes {
                    shapes.shortening[i][j] += weight
                        * (s.dv[i] * s.dv[j] + s.dw[i] * s.dw[j] + area_radius2 * s.dphi[i] * s.dphi[j]);
                }
                shapes.shortening_twist[i] += weight * area_radius2 * twist_slope * s.dphi[i];
            }
        }
    }

    fn area_radius_squared(&self, x: f64) -> f64 {
        let s = &self.properties.structure;
        let i = segment_of(&s.r_in, &s.r_out, x);
        // a gap at the hinge is massless and couples nothing, as in the eigenproblem
        if x < s.r_in[i] {
            return 0.0;
        }
        if s.mass[i] > 0.0 { self.properties.ka_over_ktheta.powi(2) * s.i_theta[i] / s.mass[i] } else { 0.0 }
    }

    fn at(&self, x: f64) -> StationShapes {
        let k = self.nodes.partition_point(|(end, _)| *end <= x).saturating_sub(1);
        let (start, ref before) = self.nodes[k];
        let mut shapes = self.bare(x);
        shapes.shortening = before.shortening;
        shapes.shortening_twist = before.shortening_twist;
        if x > start {
            self.accumulate(&mut shapes, start, x);
        }
        shapes
    }
}

/// Property segment that holds `x`; in a gap the next one outboard.
fn segment_of(r_in: &[f64], r_out: &[f64], x: f64) -> usize {
    let _ = r_in;
    r_out.partition_point(|&end| end <= x).min(r_out.len() - 1)
}

/// Slope of a table at `x` (of the interval that holds it; zero outside).
fn slope(table: &crate::numerics::tables::Table, x: f64) -> f64 {
    let n = table.x.len();
    if n < 2 || x < table.x[0] || x > table.x[n - 1] {
        return 0.0;
    }
    let i = table.x.partition_point(|&a| a <= x).clamp(1, n - 1) - 1;
    (table.y[i + 1] - table.y[i]) / (table.x[i + 1] - table.x[i])
}

/// Quadrature points of the structure: per element the Gauss-Legendre points, with weights that integrate the
/// piecewise constant properties times polynomials of degree n_gauss - 1 exactly, so that no step is smeared.
fn structural_points(
    p: &BladeProperties,
    modes: &BladeModes,
    shaper: &Shaper,
    d: &Discretisation,
) -> Vec<StructuralPoint> {
    let length = (p.radius - p.root_station) / d.n_elements as f64;
    let pieces = modes.pieces();
    let s = &p.structure;
    let (k1, k2) = (p.km1_over_ktheta.powi(2), 1.0 - p.km1_over_ktheta.powi(2));
    let mut points = Vec::new();
    for element in 0..d.n_elements {
        let a = p.root_station + length * element as f64;
        let b = a + length;
        let abscissae: Vec<f64> = gauss_points(d.n_gauss, a, b).into_iter().map(|(x, _)| x).collect();
        // eight property integrals per point: mass, first moment, three inertias, three stiffnesses
        let mut sums = vec![[0.0; 8]; d.n_gauss];
        for &(start, end, segment) in
            pieces.iter().filter(|(x0, x1, _)| 0.5 * (x0 + x1) > a && 0.5 * (x0 + x1) < b)
        {
            let massless = start < s.r_in[segment] - 1e-12;
            let m = if massless { 0.0 } else { s.mass[segment] };
            let i_theta = if massless { 0.0 } else { s.i_theta[segment] };
            let x_cg = s.x_cg[segment];
            let second = m * x_cg * x_cg;
            let values = [
                m,
                m * x_cg,
                i_theta + second,
                k1 * i_theta,
                k2 * i_theta + second,
                s.ei_flap[segment],
                s.ei_lag[segment],
                s.gj[segment],
            ];
            for (x, weight) in gauss_points(d.n_gauss.div_ceil(2) + 1, start, end) {
                for (i, sum) in sums.iter_mut().enumerate() {
                    let basis = lagrange(&abscissae, i, x);
                    for (total, value) in sum.iter_mut().zip(values) {
                        *total += weight * basis * value;
                    }
                }
            }
        }
        for (x, v) in abscissae.iter().zip(sums) {
            points.push(StructuralPoint {
                shapes: shaper.at(*x),
                twist: p.twist.at(*x),
                mass: v[0],
                first_moment: v[1],
                inertia: [v[2], v[3], v[4]],
                stiffness: Stiffness { flap: v[5], lag: v[6], torsion: v[7] },
            });
        }
    }
    points
}

fn lagrange(abscissae: &[f64], i: usize, x: f64) -> f64 {
    abscissae
        .iter()
        .enumerate()
        .filter(|(j, _)| *j != i)
        .map(|(_, &a)| (x - a) / (abscissae[i] - a))
        .product()
}

/// Edges of the aerodynamic elements, r0 + (R - r0) sin(pi j / 2N) [m].
pub fn station_edges(root_cutout: f64, radius: f64, n: usize) -> Vec<f64> {
    (0..=n)
        .map(|j| {
            root_cutout + (radius - root_cutout) * (std::f64::consts::FRAC_PI_2 * j as f64 / n as f64).sin()
        })
        .collect()
}

fn aero_stations(p: &BladeProperties, shaper: &Shaper, tip_loss_factor: f64, n: usize) -> Vec<AeroStation> {
    station_edges(p.root_cutout, p.radius, n)
        .windows(2)
        .map(|edge| {
            let x = 0.5 * (edge[0] + edge[1]);
            let chord = p.chord.at(x);
            let lift_end = edge[1].min(tip_loss_factor * p.radius);
            AeroStation {
                shapes: shaper.at(x),
                twist: p.twist.at(x),
                geometry: StationGeometry {
                    chord,
                    width: edge[1] - edge[0],
                    lift_width: (lift_end - edge[0]).max(0.0),
                    quarter: (p.pitch_axis_chord_fraction - 0.25) * chord,
                    three_quarter: (p.pitch_axis_chord_fraction - 0.75) * chord,
                },
            }
        })
        .collect()
}
