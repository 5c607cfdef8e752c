//! Readers of the verification data, for tests only.
#![allow(dead_code)]

use std::path::PathBuf;
use wakeflight::airfoil::{Airfoil, AirfoilTables};
use wakeflight::airframe::fuselage::Fuselage;
use wakeflight::airframe::interference::Interference;
use wakeflight::airframe::tail::{StabilatorSchedule, Surface};
use wakeflight::airframe::tail_rotor::TailRotor;
use wakeflight::numerics::scalar::Dual;
use wakeflight::numerics::tables::{Grid, Table};

pub const INCH: f64 = 0.0254;
pub const FOOT: f64 = 0.3048;
pub const KNOT: f64 = 0.514444444;

/// Column names and rows of numbers of a file.
pub struct Csv {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Csv {
    pub fn read(name: &str) -> Self {
        let mut path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        path.push("../../tests/verification/data");
        path.push(name);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let mut lines = text.lines().filter(|l| !l.starts_with('#') && !l.trim().is_empty());
        let names = lines.next().unwrap().split(',').map(|s| s.trim().to_string()).collect();
        let rows = lines.map(|l| l.split(',').map(|s| s.trim().parse().unwrap()).collect()).collect();
        Self { names, rows }
    }

    pub fn column(&self, name: &str) -> Vec<f64> {
        let i = self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|r| r[i]).collect()
    }

    /// Table of two columns, times a unit each.
    pub fn table(&self, x: &str, x_unit: f64, y: &str, y_unit: f64) -> Table {
        let scaled = |name: &str, unit: f64| self.column(name).iter().map(|v| v * unit).collect();
        Table { x: scaled(x, x_unit), y: scaled(y, y_unit) }
    }

    /// Grid in long form: two argument columns [deg], one of values.
    pub fn grid(&self, x: &str, y: &str, value: &str, unit: f64) -> Grid {
        let axis = |name: &str| {
            let mut nodes = self.column(name);
            nodes.sort_by(f64::total_cmp);
            nodes.dedup_by(|a, b| a == b);
            nodes
        };
        let (nodes_x, nodes_y) = (axis(x), axis(y));
        let mut values = vec![vec![f64::NAN; nodes_y.len()]; nodes_x.len()];
        for ((a, b), v) in self.column(x).iter().zip(self.column(y)).zip(self.column(value)) {
            let i = nodes_x.iter().position(|n| n == a).unwrap();
            let j = nodes_y.iter().position(|n| *n == b).unwrap();
            values[i][j] = v * unit;
        }
        assert!(values.iter().flatten().all(|v| v.is_finite()), "holes in {value}");
        let radians = |nodes: Vec<f64>| nodes.into_iter().map(f64::to_radians).collect();
        Grid { x: radians(nodes_x), y: radians(nodes_y), values }
    }
}

pub fn airfoil_tables(name: &str, cd_increment: f64) -> AirfoilTables {
    let grid = |what: &str| {
        let csv = Csv::read(&format!("airfoil_{name}_{what}.csv"));
        Grid {
            x: csv.rows.iter().map(|r| r[0].to_radians()).collect(),
            y: csv.names[1..].iter().map(|n| n.trim_start_matches('M').parse().unwrap()).collect(),
            values: csv.rows.iter().map(|r| r[1..].to_vec()).collect(),
        }
    };
    AirfoilTables { cl: grid("cl"), cd: grid("cd"), cm: grid("cm"), cd_increment }
}

pub fn airfoil(name: &str, cd_increment: f64) -> Airfoil {
    Airfoil::new(&airfoil_tables(name, cd_increment)).unwrap()
}

/// Position of a station [in] from the gross centre of gravity at STA 358, WL 248.2.
pub fn position(station: f64, buttline: f64, waterline: f64) -> [f64; 3] {
    [(358.0 - station) * INCH, buttline * INCH, (248.2 - waterline) * INCH]
}

pub fn fuselage() -> Fuselage {
    let csv = Csv::read("fuselage_aero_grid.csv");
    let grid = |name: &str, unit: f64| csv.grid("alpha_deg", "beta_deg", name, unit);
    let (area, volume) = (FOOT.powi(2), FOOT.powi(3));
    Fuselage {
        position: position(345.5, 0.0, 234.0),
        drag: grid("Dq_ft2", area),
        lift: grid("Lq_ft2", area),
        pitching: grid("Mq_ft3", volume),
        side: grid("Yq_ft2", area),
        rolling: grid("Rq_ft3", volume),
        yawing: grid("Nq_ft3", volume),
    }
}

pub fn interference() -> Interference {
    let rotor = Csv::read("interference_rotor_wash.csv");
    let fuselage = Csv::read("interference_fuselage_wash.csv");
    let deg = 1f64.to_radians();
    let grid = |name: &str| rotor.grid("chi_deg", "a1f_deg", name, 1.0);
    Interference::Tables {
        ekx_fuselage: grid("ekx_fus"),
        ekz_fuselage: grid("ekz_fus"),
        ekx_tail: grid("ekx_tail"),
        ekz_tail: grid("ekz_tail"),
        downwash: fuselage.table("angle_deg", deg, "eps_deg_of_alpha", deg),
        sidewash: fuselage.table("angle_deg", deg, "sigma_deg_of_psi", deg),
        q_ratio_stabilator: Csv::read("interference_tail_qloss_stabilator.csv").table(
            "alpha_deg",
            deg,
            "q_ratio",
            1.0,
        ),
        q_ratio_fin: Csv::read("interference_tail_qloss_fin.csv").table("psi_deg", deg, "q_ratio", 1.0),
    }
}

pub fn stabilator() -> Surface {
    let csv = Csv::read("empennage_stabilator.csv");
    let deg = 1f64.to_radians();
    Surface {
        position: position(700.0, 0.0, 244.0),
        area: 4.1806368,
        incidence: 0.0,
        cl: csv.table("alpha_deg", deg, "cl", 1.0),
        cd: csv.table("alpha_deg", deg, "cd", 1.0),
    }
}

pub fn fin() -> Surface {
    let csv = Csv::read("empennage_fin.csv");
    let deg = 1f64.to_radians();
    Surface {
        position: position(695.0, 0.0, 273.0),
        area: 3.0007682,
        incidence: 0.0,
        cl: csv.table("beta_deg", deg, "cl", 1.0),
        cd: csv.table("beta_deg", deg, "cd", 1.0),
    }
}

pub fn schedule() -> StabilatorSchedule {
    StabilatorSchedule {
        base_deg: 42.0,
        v1_kt: [30.0, 50.0],
        coll_const: 0.67,
        coll_slope: 0.003286,
        coll_breaks_pct: [70.0, 20.0, 50.0, 50.0],
        v2: [80.0, 67.0, -0.1119],
        q_gain: 0.16,
        limits: [-0.13962634, 0.68067841],
        rate_limit: 7f64.to_radians(),
        collective_travel: 0.254,
    }
}

pub fn tail_rotor() -> TailRotor {
    TailRotor {
        position: position(732.0, 14.0, 324.7),
        radius: 1.6764,
        omega: 124.62,
        solidity: 0.1875,
        cant: 0.34906585,
        twist: -0.30019663,
        lift_curve_slope: 5.73,
        tip_loss_factor: 0.92,
        pitch_bias: 0.087266463,
        pitch_per_thrust: (0.001455f64 * 0.7002075).to_radians() / 4.4482216,
        cd_polar: [0.0087, -0.0216, 0.4],
        fin_blockage: [0.9, 1.0, 30.0 * KNOT],
    }
}

/// Variables with one derivative direction each.
pub fn variables<const N: usize>(x: [f64; N]) -> [Dual<N>; N] {
    std::array::from_fn(|i| Dual::variable(x[i], i))
}

/// Asserts that dual derivatives equal central differences, `scale` being the size of the outputs.
pub fn assert_derivatives<const N: usize, const M: usize>(
    x: [f64; N],
    dual: [Dual<N>; M],
    scale: f64,
    f: impl Fn([f64; N]) -> [f64; M],
) {
    let value = f(x);
    for i in 0..N {
        let h = 1e-6 * x[i].abs().max(0.1);
        let (mut up, mut down) = (x, x);
        up[i] += h;
        down[i] -= h;
        let (up, down) = (f(up), f(down));
        for k in 0..M {
            let difference = (up[k] - down[k]) / (2.0 * h);
            // division of duals goes by the reciprocal: equal to rounding only
            assert!((dual[k].re - value[k]).abs() < 1e-12 * scale, "value {k}");
            let error = (dual[k].eps[i] - difference).abs();
            assert!(
                error < 1e-7 * scale + 1e-6 * difference.abs(),
                "d{k}/d{i}: {} {difference}",
                dual[k].eps[i]
            );
        }
    }
}
