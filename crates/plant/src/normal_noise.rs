//! Normally distributed noise, the same bits on every machine.
//!
//! The ziggurat method of Marsaglia and Tsang (2000) in Doornik's variant (2005): layers of equal area cover the right
//! half of the bell; a point that is drawn in one of them is mostly under the bell, too. Logarithms and exponentials
//! are those of `libm`, where the system's would differ from version to version in the last bit.

use rand::{Rng, RngCore};

/// Number of layers.
const LAYERS: usize = 256;
/// Where the tail begins, which is part of the lowest layer.
const TAIL: f64 = 3.654_152_885_361_009;
/// Area of each layer, that of the lowest with the tail.
const AREA: f64 = 4.928_673_233_974_655e-3;
/// The 52 bits that choose a place within a layer are a whole number of these.
const GRAIN: f64 = 1.0 / (1_u64 << 52) as f64;

/// Draws from the standard normal distribution.
#[derive(Clone, Debug)]
pub(crate) struct NormalNoise {
    /// Right edge of each layer, the lowest first, and 0 at the top. That of the lowest is where it would end if its
    /// tail were put into the rectangle.
    edges: [f64; LAYERS + 1],
    /// The bell at these edges.
    heights: [f64; LAYERS + 1],
}

impl NormalNoise {
    /// The layers.
    pub(crate) fn new() -> Self {
        let mut edges = [0.0; LAYERS + 1];
        (edges[0], edges[1]) = (AREA / bell(TAIL), TAIL);
        for layer in 2..LAYERS {
            let below = edges[layer - 1];
            edges[layer] = (-2.0 * libm::log(AREA / below + bell(below))).sqrt();
        }
        Self { edges, heights: edges.map(bell) }
    }

    /// A number of mean 0 and variance 1.
    pub(crate) fn draw(&self, random: &mut impl Rng) -> f64 {
        loop {
            let bits = random.next_u64();
            let layer = (bits % LAYERS as u64) as usize;
            // 52 other bits, as a number from -1 to 1.
            let share = (bits >> 12) as f64 * (2.0 * GRAIN) - 1.0;
            let x = share * self.edges[layer];
            if x.abs() < self.edges[layer + 1] {
                return x;
            }
            if layer == 0 {
                return tail(random).copysign(share);
            }
            let [below, above] = [self.heights[layer], self.heights[layer + 1]];
            if above + (below - above) * random.random::<f64>() < bell(x) {
                return x;
            }
        }
    }
}

/// The bell-shaped curve.
fn bell(x: f64) -> f64 {
    libm::exp(-x * x / 2.0)
}

/// A number beyond the lowest layer, as Marsaglia (1964) draws it.
fn tail(random: &mut impl RngCore) -> f64 {
    loop {
        let [beyond, height] = [libm::log(positive(random)) / TAIL, libm::log(positive(random))];
        if -2.0 * height >= beyond * beyond {
            return TAIL - beyond;
        }
    }
}

/// A number between 0 and 1, neither of them.
fn positive(random: &mut impl RngCore) -> f64 {
    ((random.next_u64() >> 12) as f64 + 0.5) * GRAIN
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn layers_close_at_the_top_of_the_bell() {
        let NormalNoise { edges, heights } = NormalNoise::new();
        assert!(edges.windows(2).all(|pair| pair[0] > pair[1]));
        // The highest layer has the same area.
        let top = edges[LAYERS - 1] * (1.0 - heights[LAYERS - 1]);
        assert!((top / AREA - 1.0).abs() < 1e-9, "{top}");
    }

    #[test]
    fn drawn_numbers_have_the_moments_and_the_tail_of_the_distribution() {
        let (noise, mut random) = (NormalNoise::new(), ChaCha8Rng::seed_from_u64(1));
        const COUNT: usize = 1_000_000;
        let drawn: Vec<f64> = (0..COUNT).map(|_| noise.draw(&mut random)).collect();
        let moment = |power: i32| drawn.iter().map(|x| x.powi(power)).sum::<f64>() / COUNT as f64;
        for (power, expected, within) in [(1, 0.0, 0.005), (2, 1.0, 0.007), (3, 0.0, 0.02), (4, 3.0, 0.05)] {
            assert!((moment(power) - expected).abs() < within, "moment {power} is {}", moment(power));
        }
        // 2·(1 − Φ(x)) of all lie beyond x.
        for (x, expected, within) in [(1.0, 0.317_310_5, 0.002), (3.0, 0.002_699_8, 0.000_2), (TAIL, 0.000_258_0, 5e-5)]
        {
            let beyond = drawn.iter().filter(|drawn| drawn.abs() > x).count() as f64 / COUNT as f64;
            assert!((beyond - expected).abs() < within, "{beyond} beyond {x}");
        }
    }
}
