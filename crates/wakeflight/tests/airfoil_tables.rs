//! Section tables as the aircraft data give them.

mod data_files;

use data_files::*;
use wakeflight::airfoil::Airfoil;

#[test]
fn sc1095_has_the_characteristics_stated_for_it() {
    let a = airfoil("sc1095", 0.0);
    let at = |alpha: f64, mach: f64| a.coefficients(alpha.to_radians(), mach);
    // Mach, lift slope per degree over -2..4 deg, cd at 2 deg, cm at 0
    for (mach, slope, cd, cm) in [
        (0.2, 0.1073, 0.0080, -0.0120),
        (0.4, 0.1169, 0.0082, -0.0110),
        (0.5, 0.1220, 0.0075, -0.0120),
        (0.6, 0.1355, 0.0075, -0.0130),
        (0.7, 0.1625, 0.0105, -0.0160),
        (0.8, 0.1350, 0.040, -0.0255),
    ] {
        assert!(((at(4.0, mach).0 - at(-2.0, mach).0) / 6.0 - slope).abs() < 6e-5, "slope at {mach}");
        assert!((at(2.0, mach).1 - cd).abs() < 5e-5, "cd at {mach}: {}", at(2.0, mach).1);
        assert!((at(0.0, mach).2 - cm).abs() < 5e-5, "cm at {mach}: {}", at(0.0, mach).2);
    }
    assert!((at(12.0, 0.3).0 - 1.25).abs() < 0.005);
}

#[test]
fn every_look_up_equals_the_table_by_itself() {
    for name in ["sc1095", "naca0012", "naca23012"] {
        let t = airfoil_tables(name, 0.002);
        let a = Airfoil::new(&t).unwrap();
        for i in -1800..=1800 {
            let alpha = f64::to_radians(0.1 * i as f64);
            for mach in [0.0, 0.15, 0.3, 0.62, 0.77, 0.9, 1.0] {
                let (cl, cd, cm) = a.coefficients(alpha, mach);
                assert!((cl - t.cl.at(alpha, mach)).abs() < 1e-12);
                assert!((cd - t.cd.at(alpha, mach) - 0.002).abs() < 1e-12);
                assert!((cm - t.cm.at(alpha, mach)).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn tables_arrive_checked_from_serialised_data() {
    let grid =
        |first: f64| format!(r#"{{"x":[{first},3.14159265358979312],"y":[0.0,1.0],"values":[[0,0],[1,1]]}}"#);
    let json = |first: f64| {
        let (good, g) = (grid(-std::f64::consts::PI), grid(first));
        format!(r#"{{"cl":{good},"cd":{good},"cm":{g},"cd_increment":0.002}}"#)
    };
    assert!(serde_json::from_str::<Airfoil>(&json(-std::f64::consts::PI)).is_ok());
    let error = serde_json::from_str::<Airfoil>(&json(-3.0)).unwrap_err().to_string();
    assert!(error.contains("cm") && error.contains("-pi to pi"), "{error}");
}

/// Prints nanoseconds per look-up of three coefficients; not a gate.
#[test]
#[ignore = "a measurement"]
fn time_of_a_look_up() {
    use wakeflight::numerics::scalar::Dual;
    for name in ["sc1095", "naca0012"] {
        let a = airfoil(name, 0.002);
        let n = 10_000_000;
        let mut sum = 0.0;
        let start = std::time::Instant::now();
        for i in 0..n {
            let x = (i as f64 * 0.618_033_988).fract();
            let (cl, cd, cm) = a.coefficients(-0.2 + 0.5 * x, 0.1 + 0.7 * x);
            sum += cl + cd + cm;
        }
        println!("{name}: {:.1} ns ({sum})", start.elapsed().as_secs_f64() * 1e9 / n as f64);
        let start = std::time::Instant::now();
        for i in 0..n / 10 {
            let x = (i as f64 * 0.618_033_988).fract();
            let d = Dual::<16>::variable(-0.2 + 0.5 * x, 3);
            let (cl, cd, cm) = a.coefficients(d, d + 0.4);
            sum += cl.eps[3] + cd.eps[3] + cm.eps[3];
        }
        println!("{name}, 16 directions: {:.1} ns ({sum})", start.elapsed().as_secs_f64() * 1e10 / n as f64);
    }
}
