//! Reduces the points of a curve without changing its picture.

use super::chart::Point;

/// Elements about `interval` apart; `time` says when each was (s).
pub(super) fn thinned<R>(rows: &[R], interval: f64, time: impl Fn(&R) -> f64) -> impl Iterator<Item = &R> {
    let step = match rows {
        [first, .., last] if time(last) > time(first) => interval * rows.len() as f64 / (time(last) - time(first)),
        _ => 1.0,
    };
    rows.iter().step_by((step as usize).max(1))
}

/// The curve with the least and the greatest value of each span of time, in their order, which are at most so many
/// points. Gaps stay, however short.
pub(super) fn outlined(points: &[Point], most: usize) -> Vec<Point> {
    let span = (2 * points.len()).div_ceil(most);
    if span <= 2 {
        return points.to_vec();
    }
    let pieces = points.chunk_by(|before, after| before[1].is_finite() == after[1].is_finite());
    pieces.flat_map(|piece| if piece[0][1].is_finite() { outline(piece, span) } else { vec![piece[0]] }).collect()
}

fn outline(piece: &[Point], span: usize) -> Vec<Point> {
    let ends = |span: &[Point]| {
        let by_value = |a: &(usize, &Point), b: &(usize, &Point)| a.1[1].total_cmp(&b.1[1]);
        let (least, greatest) = (span.iter().enumerate().min_by(by_value), span.iter().enumerate().max_by(by_value));
        let mut ends: Vec<(usize, &Point)> = least.into_iter().chain(greatest).collect();
        ends.sort_by_key(|(place, _)| *place);
        ends.into_iter().map(|(_, point)| *point).collect::<Vec<Point>>()
    };
    piece.chunks(span).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinned_curve_keeps_spikes_and_gaps() {
        let mut points: Vec<Point> = (0..60_000).map(|tick| [f64::from(tick) * 1e-3, 0.0]).collect();
        points[31_234][1] = -0.5;
        points[40_000..41_000].iter_mut().for_each(|point| point[1] = f64::NAN);
        points[50_007][1] = f64::NAN;
        let thinned = outlined(&points, 3000);
        assert!(thinned.len() <= 3006, "{}", thinned.len());
        assert!(thinned.contains(&[31.234, -0.5]));
        let gaps: Vec<f64> = thinned.iter().filter(|point| point[1].is_nan()).map(|point| point[0]).collect();
        assert_eq!(gaps, [40.0, 50.007]);
        assert!(thinned.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "time goes on");
    }
}
