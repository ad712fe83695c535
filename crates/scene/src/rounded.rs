//! Numbers as the page gets them: to a hundredth of a millimetre or of a milliradian, so that they are short.

/// Numbers with five decimals. What is not finite becomes JSON's `null`.
pub fn rounded<const N: usize>(values: [f64; N]) -> [f64; N] {
    values.map(|value| (value * 1e5).round() / 1e5 + 0.0)
}
