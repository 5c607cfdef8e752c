//! Places at which a wind is asked, as they lie to one another.

/// A point or a velocity: north, east, down [m], [m/s].
pub type Triple = [f64; 3];

/// Places in inertial axes [m]: three fixed to the airframe, stations on straight blades.
#[derive(Clone, Debug)]
pub struct Spread {
    /// Origin of the body, hub, tail.
    pub fixed: [Triple; 3],
    /// Unit vectors along the blades (n_blades,).
    pub spokes: Vec<Triple>,
    /// Distances of the stations from the hub [m].
    pub reach: Vec<f64>,
}

impl Spread {
    /// Number of places.
    pub fn len(&self) -> usize {
        self.fixed.len() + self.spokes.len() * self.reach.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The hub.
    pub fn hub(&self) -> &Triple {
        &self.fixed[1]
    }

    /// The fixed ones, then station by station, blade by blade.
    pub fn points(&self) -> impl Iterator<Item = Triple> {
        let hub = self.fixed[1];
        let blade = move |s: &Triple| {
            let s = *s;
            self.reach.iter().map(move |r| std::array::from_fn(|i| hub[i] + s[i] * r))
        };
        self.fixed.into_iter().chain(self.spokes.iter().flat_map(blade))
    }

    /// All of them moved back by `taken`.
    pub(super) fn less(&self, taken: &Triple) -> Self {
        let fixed = self.fixed.map(|p| std::array::from_fn(|i| p[i] - taken[i]));
        Self { fixed, ..self.clone() }
    }
}

/// Scalar product.
pub(super) fn dot(a: &Triple, b: &Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
