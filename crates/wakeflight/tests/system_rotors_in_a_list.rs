//! Rotors in a list: their order changes nothing but places, and a clockwise aircraft is the mirror image of its twin, to the bit.

mod mechanics_support;

use mechanics_support::beam_support::uh60a;
use mechanics_support::*;
use wakeflight::rotor::sense::Sense;
use wakeflight::system::data::AircraftData;
use wakeflight::system::instant::{HeldInflow, Inputs};
use wakeflight::system::model::System;

const STICK: [f64; 4] = [0.13, 0.14, 0.12, 0.06];

fn data() -> AircraftData {
    aircraft_data(uh60a(), data_files::airfoil("sc1095", 0.002))
}

fn held(system: &System, random: &mut Random) -> Inputs {
    let mut held = inputs(STICK, HeldInflow::Dynamic);
    held.inflow = system
        .rotors
        .iter()
        .map(|r| {
            let n = r.n_blades * r.blade.stations.len();
            HeldInflow::stations((0..n).map(|_| 0.02 + 0.02 * random.next()).collect(), 0.02)
        })
        .collect();
    held.stick_rate = [0.2, -0.1, 0.15, 0.05];
    held
}

/// F, dF/dy + 30 dF/dy_dot, and the rate of state that satisfies F = 0.
fn answers(system: &System, y: &[f64], y_dot: &[f64], inputs: &Inputs) -> [Vec<f64>; 3] {
    let n = y.len();
    let (mut f, mut jacobian) = (vec![f64::NAN; n], vec![f64::NAN; n * n]);
    let instant = at(0.4, y, y_dot, inputs);
    system.residual_of_four(&instant, &mut f);
    system.jacobian(&instant, 1.0, 30.0, &mut jacobian);
    [f, jacobian, system.consistent_rate(0.4, y, inputs).unwrap()]
}

/// Entry of y in the swapped system for every entry in the first.
fn places(first: &System, swapped: &System) -> Vec<usize> {
    let (a, b) = (&first.layout, &swapped.layout);
    let mut place: Vec<usize> = (0..a.len()).collect();
    for r in 0..2 {
        let (from, to) = (&a.rotors[r], &b.rotors[1 - r]);
        let whole = from.modal(0).start..from.inflow().end;
        for i in whole.clone() {
            place[i] = to.modal(0).start + i - whole.start;
        }
    }
    place
}

#[test]
fn rotors_in_swapped_order_give_swapped_answers_to_the_bit() {
    let mut data = tandem(&data());
    // the wash on the airframe is that of the first rotor
    data.interference = None;
    let mut swapped = data.clone();
    std::mem::swap(&mut swapped.rotor, &mut swapped.further_rotors[0].rotor);
    std::mem::swap(&mut swapped.rigging, &mut swapped.further_rotors[0].rigging);
    for free_wake in [true, false] {
        let (a, b) = (build(&data, free_wake, 9.80665), build(&swapped, free_wake, 9.80665));
        let mut random = Random::new(3);
        let (y, y_dot) = random_state(&a, &mut random);
        let mut inputs = held(&a, &mut random);
        if !free_wake {
            inputs.inflow = vec![HeldInflow::Dynamic; 2];
        }
        let mut other = inputs.clone();
        other.inflow.reverse();
        let place = places(&a, &b);
        let moved = |v: &[f64]| {
            let mut out = vec![0.0; v.len()];
            place.iter().zip(v).for_each(|(&p, &value)| out[p] = value);
            out
        };
        let [f, jacobian, rate] = answers(&a, &y, &y_dot, &inputs);
        let [g, other_jacobian, other_rate] = answers(&b, &moved(&y), &moved(&y_dot), &other);
        assert_eq!(moved(&f), g);
        // sums over rotors and the order of elimination round differently in what is solved
        let n = y.len();
        for i in 0..n {
            for j in 0..n {
                let (x, z) = (jacobian[i * n + j], other_jacobian[place[i] * n + place[j]]);
                assert!((x - z).abs() <= 1e-12 * (1.0 + x.abs()), "{i} {j}: {x} {z}");
            }
        }
        for (x, z) in moved(&rate).iter().zip(&other_rate) {
            assert!((x - z).abs() <= 1e-9 * (1.0 + x.abs()), "{x} {z}");
        }
        // what sets the rotors apart matters
        assert_ne!(f, g);
    }
}

/// Signs of the entries of y under the mirror: blades and inflow of a rotor count in its own sense.
fn signs(system: &System) -> Vec<f64> {
    let mut signs = vec![1.0; system.layout.len()];
    // v, p, r, the quaternion's x and z, east
    for i in [1, 3, 5, 7, 9, 11] {
        signs[i] = -1.0;
    }
    signs
}

#[test]
fn a_mirrored_aircraft_has_mirrored_answers_to_the_bit() {
    let plain = tandem(&data());
    let mut mirrored = plain.clone();
    mirrored.mirrored = true;
    let further = mirrored.further_rotors.iter_mut().map(|r| &mut r.rotor);
    for rotor in std::iter::once(&mut mirrored.rotor).chain(further) {
        rotor.rotation = match rotor.rotation {
            Sense::CounterClockwise => Sense::Clockwise,
            Sense::Clockwise => Sense::CounterClockwise,
        };
        rotor.position[1] = -rotor.position[1];
        rotor.shaft_tilt_lateral = -rotor.shaft_tilt_lateral;
    }
    for tail in [false, true] {
        let (mut plain, mut mirrored) = (plain.clone(), mirrored.clone());
        if tail {
            plain.tail_rotor = Some(data_files::tail_rotor());
            mirrored.tail_rotor = Some(data_files::tail_rotor());
        }
        let (a, b) = (build(&plain, false, 9.80665), build(&mirrored, false, 9.80665));
        let mut inputs = inputs(STICK, HeldInflow::Dynamic);
        inputs.inflow.push(HeldInflow::Dynamic);
        inputs.stick_rate = [0.2, -0.1, 0.15, 0.05];
        let (y, y_dot) = random_state(&a, &mut Random::new(4));
        let sign = signs(&a);
        let turned = |v: &[f64]| -> Vec<f64> { v.iter().zip(&sign).map(|(v, s)| v * s).collect() };
        let [f, jacobian, rate] = answers(&a, &y, &y_dot, &inputs);
        let [g, other_jacobian, other_rate] = answers(&b, &turned(&y), &turned(&y_dot), &inputs);
        assert_eq!(turned(&f), g);
        assert_eq!(turned(&rate), other_rate);
        let n = y.len();
        for (k, (x, z)) in jacobian.iter().zip(&other_jacobian).enumerate() {
            assert_eq!(x * sign[k / n] * sign[k % n], *z, "{} {}", k / n, k % n);
        }
        let (o, m) = (
            a.outputs(&at(0.4, &y, &y_dot, &inputs)),
            b.outputs(&at(0.4, &turned(&y), &turned(&y_dot), &inputs)),
        );
        assert_eq!([o.force[0], -o.force[1], o.force[2]], m.force);
        assert_eq!([-o.moment[0], o.moment[1], -o.moment[2]], m.moment);
        for (o, m) in o.rotors.iter().zip(&m.rotors) {
            assert_eq!([o.hub_force[0], -o.hub_force[1], o.hub_force[2]], m.hub_force);
            assert_eq!((o.power, o.beta_1c, o.beta_1s), (m.power, m.beta_1c, m.beta_1s));
        }
    }
}
