//! A secant along the last two steps of a Newton iteration with held derivatives.
//!
//! Where the derivatives held are not those of the place, the iteration contracts by what they miss, again and again in much the same
//! direction. The last two steps f_k, f_(k-1) tell how much: the one whose combination f_k - gamma (f_k - f_(k-1)) is shortest, in the
//! weights of the iteration, is the best guess of what is left [anderson1965], with gamma = (df, f_k)/(df, df) and the same gamma
//! taken off the way that was gone. One pair of steps is enough: two and three save another 0.5 %.

use super::radau::STAGES;

/// Steps asked for and done, of the stages of one time step.
#[derive(Clone, Debug, Default)]
pub struct Secant {
    asked: [Vec<f64>; STAGES],
    done: [Vec<f64>; STAGES],
    begun: bool,
}

impl Secant {
    /// For `n` states.
    pub fn new(n: usize) -> Self {
        let zeros = || std::array::from_fn(|_| vec![0.0; n]);
        Self { asked: zeros(), done: zeros(), begun: false }
    }

    /// Forgets the steps of another iteration.
    pub fn begin(&mut self) {
        self.begun = false;
    }

    /// Adds to the stages `z` what Newton's step `asked` and the one before lead to, `weight` (n) of every state.
    pub fn advance(&mut self, z: &mut [Vec<f64>; STAGES], asked: &[Vec<f64>; STAGES], weight: &[f64]) {
        let share = if self.begun { self.share(asked, weight) } else { 0.0 };
        self.begun = true;
        for (((z, asked), before), done) in z.iter_mut().zip(asked).zip(&mut self.asked).zip(&mut self.done) {
            for (((z, asked), before), done) in z.iter_mut().zip(asked).zip(before).zip(done) {
                *done = asked - share * (*done + (asked - *before));
                *before = *asked;
                *z += *done;
            }
        }
    }

    /// gamma; none where two steps are the same.
    fn share(&self, asked: &[Vec<f64>; STAGES], weight: &[f64]) -> f64 {
        let (mut over, mut under) = (0.0, 0.0);
        for (asked, before) in asked.iter().zip(&self.asked) {
            for ((asked, before), weight) in asked.iter().zip(before).zip(weight) {
                let change = (asked - before) * weight;
                over += change * asked * weight;
                under += change * change;
            }
        }
        let share: f64 = over / under;
        if share.is_finite() { share } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_held_derivative_misses_in_one_direction_is_gone_after_two_steps() {
        // z -> the step (1 - rho) (target - z): contraction rho, the same in every state
        let target = [[1.0, -2.0], [0.5, 3.0], [4.0, 0.1]];
        let rho = 0.4;
        let mut z: [Vec<f64>; STAGES] = std::array::from_fn(|_| vec![0.0; 2]);
        let mut secant = Secant::new(2);
        for _ in 0..2 {
            let asked = std::array::from_fn(|s| {
                z[s].iter().zip(target[s]).map(|(z, target)| (1.0 - rho) * (target - z)).collect()
            });
            secant.advance(&mut z, &asked, &[1.0, 10.0]);
        }
        for (z, target) in z.iter().flatten().zip(target.iter().flatten()) {
            assert!((z - target).abs() < 1e-14, "{z} {target}");
        }
        // a new iteration takes nothing over, and a step that is nothing is no number less
        secant.begin();
        let none: [Vec<f64>; STAGES] = std::array::from_fn(|_| vec![0.0; 2]);
        let there = z.clone();
        for _ in 0..2 {
            secant.advance(&mut z, &none, &[1.0, 1.0]);
        }
        assert_eq!(z, there);
    }
}
