//! Winds in closed form: steady, gusts, turbulence of waves, and sums of them, at points in inertial axes.

use super::spread::{Spread, Triple, dot};
use crate::numerics::fourier::FourierField;

/// A gust frozen in space: its velocity grows along a line, as a cosine from none to all over half of its length.
#[derive(Clone, Debug)]
pub struct GustFront {
    /// Unit vector along which it begins.
    pub along: Triple,
    /// Where it begins, along that [m].
    pub ahead: f64,
    /// Its length [m].
    pub length: f64,
    /// Whether it falls again over the other half; otherwise it stays.
    pub falls: bool,
    /// Velocity of its peak.
    pub velocity: Triple,
}

impl GustFront {
    fn at(&self, point: &Triple) -> Triple {
        let within = (dot(&self.along, point) - self.ahead) / self.length;
        let top = if self.falls { 1.0 } else { 0.5 };
        let share = 0.5 * (1.0 - (std::f64::consts::TAU * within.clamp(0.0, top)).cos());
        self.velocity.map(|v| share * v)
    }
}

/// What a wind is made of.
#[derive(Clone, Debug)]
pub enum Kind {
    /// The same everywhere and always.
    Steady(Triple),
    /// A gust.
    Gust(GustFront),
    /// Turbulence.
    Waves(FourierField),
}

/// A wind: the sum of its parts; the steady ones carry along those that are frozen in space.
#[derive(Clone, Debug, Default)]
pub struct Wind {
    parts: Vec<Kind>,
    drift: Triple,
}

impl From<Kind> for Wind {
    fn from(kind: Kind) -> Self {
        let drift = if let Kind::Steady(velocity) = &kind { *velocity } else { [0.0; 3] };
        Self { parts: vec![kind], drift }
    }
}

impl Wind {
    /// All of these at once.
    pub fn sum<'a>(winds: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut whole = Self::default();
        for wind in winds {
            whole.parts.extend(wind.parts.iter().cloned());
            add(&mut whole.drift, &wind.drift);
        }
        whole
    }

    /// How far what is frozen has been carried at time `t` [s].
    fn carried(&self, t: f64) -> Triple {
        self.drift.map(|v| v * t)
    }

    /// Velocities at `points` and time `t` [s].
    pub fn at(&self, points: &[Triple], t: f64) -> Vec<Triple> {
        let carried = self.carried(t);
        let (moved, mut found, mut sum) =
            (less(points, &carried), vec![[0.0; 3]; points.len()], vec![[0.0; 3]; points.len()]);
        for part in &self.parts {
            match part {
                Kind::Steady(velocity) => found.fill(*velocity),
                Kind::Gust(gust) => found.iter_mut().zip(&moved).for_each(|(f, p)| *f = gust.at(p)),
                Kind::Waves(field) => field.at(&moved, &mut found),
            }
            sum.iter_mut().zip(&found).for_each(|(s, f)| add(s, f));
        }
        sum
    }

    /// Velocities at places that are spread so, in their order, at time `t` [s].
    pub fn over(&self, spread: &Spread, t: f64) -> Vec<Triple> {
        let moved = spread.less(&self.carried(t));
        let (mut found, mut sum) = (vec![[0.0; 3]; spread.len()], vec![[0.0; 3]; spread.len()]);
        for part in &self.parts {
            match part {
                Kind::Steady(velocity) => found.fill(*velocity),
                Kind::Gust(gust) => {
                    found.iter_mut().zip(moved.points()).for_each(|(f, p)| *f = gust.at(&p));
                }
                Kind::Waves(field) => waves_over(field, &moved, &mut found),
            }
            sum.iter_mut().zip(&found).for_each(|(s, f)| add(s, f));
        }
        sum
    }
}

/// Turbulence over a spread: blades opposite one another are one line.
fn waves_over(field: &FourierField, spread: &Spread, found: &mut [Triple]) {
    let (fixed, blades) = found.split_at_mut(spread.fixed.len());
    field.at(&spread.fixed, fixed);
    let (n, hub) = (spread.reach.len(), spread.hub());
    if n == 0 {
        return;
    }
    if spread.spokes.len().is_multiple_of(2) {
        let (first, opposite) = blades.split_at_mut(blades.len() / 2);
        let pairs = first.chunks_mut(n).zip(opposite.chunks_mut(n)).zip(&spread.spokes);
        pairs.for_each(|((ahead, behind), along)| {
            field.on_line((hub, along), &spread.reach, ahead, behind);
        });
    } else {
        let mut beyond = vec![[0.0; 3]; n];
        for (ahead, along) in blades.chunks_mut(n).zip(&spread.spokes) {
            field.on_line((hub, along), &spread.reach, ahead, &mut beyond);
        }
    }
}

fn less(points: &[Triple], taken: &Triple) -> Vec<Triple> {
    points.iter().map(|p| std::array::from_fn(|i| p[i] - taken[i])).collect()
}

fn add(sum: &mut Triple, more: &Triple) {
    (0..3).for_each(|i| sum[i] += more[i]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(n_blades: usize) -> Spread {
        let psi = |b: usize| 0.4 + std::f64::consts::TAU * b as f64 / n_blades as f64;
        let spoke = |b: usize| [0.8 * psi(b).cos(), psi(b).sin(), 0.6 * psi(b).cos()];
        Spread {
            fixed: [[3.0, -2.0, 1.0], [3.5, -2.0, -1.0], [-6.0, -2.5, 0.0]],
            spokes: (0..n_blades).map(spoke).collect(),
            reach: vec![0.7, 2.2, 5.0],
        }
    }

    #[test]
    fn places_have_what_their_points_have_and_the_steady_carries_the_frozen() {
        let front = GustFront {
            along: [0.6, 0.8, 0.0],
            ahead: -2.0,
            length: 9.0,
            falls: true,
            velocity: [0.5, 0.0, -3.0],
        };
        let waves = FourierField::new(
            &[[0.3, 0.1, -0.2], [2.0, 0.0, 1.0]],
            &[[1.0, 0.0, 1.5], [0.1, 0.3, -0.2]],
            &[0.4, 2.0],
        );
        let frozen = [Wind::from(Kind::Gust(front)), Kind::Waves(waves).into()];
        let steady = Wind::from(Kind::Steady([4.0, -1.0, 0.5]));
        let all = Wind::sum([&frozen[0], &steady, &frozen[1]]);
        for blades in [3, 4] {
            let places = spread(blades);
            let points: Vec<_> = places.points().collect();
            let found = all.over(&places, 2.5);
            assert_eq!(found.len(), 3 + 3 * blades);
            let moved: Vec<Triple> = points.iter().map(|p| [p[0] - 10.0, p[1] + 2.5, p[2] - 1.25]).collect();
            let still: Vec<_> = frozen.iter().map(|wind| wind.at(&moved, 0.0)).collect();
            for (k, (a, b)) in found.iter().zip(all.at(&points, 2.5)).enumerate() {
                for i in 0..3 {
                    assert!((a[i] - b[i]).abs() < 1e-13);
                    let expected = still[0][k][i] + still[1][k][i] + [4.0, -1.0, 0.5][i];
                    assert!((a[i] - expected).abs() < 1e-13);
                }
            }
        }
    }
}
