//! One value per joint, indexed by joint and not by number.

use std::ops::{Add, AddAssign, Index, IndexMut, Mul, Neg, Sub, SubAssign};

use crate::Joint;

/// One `T` for each of the twenty joints, in the order of [`Joint::ALL`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PerJoint<T>(pub [T; Joint::COUNT]);

/// An angle (rad), rate (rad/s), acceleration (rad/s²) or torque (N·m) for each joint.
pub type JointVector = PerJoint<f64>;

impl<T> PerJoint<T> {
    /// The values that a function assigns to the joints.
    pub fn from_fn(mut value: impl FnMut(Joint) -> T) -> Self {
        Self(std::array::from_fn(|index| value(Joint::ALL[index])))
    }

    /// The joints and their values, parents first.
    pub fn iter(&self) -> impl Iterator<Item = (Joint, &T)> {
        Joint::ALL.into_iter().zip(&self.0)
    }
}

impl JointVector {
    /// All zero: the robot standing straight, or at rest.
    pub const ZERO: JointVector = PerJoint([0.0; Joint::COUNT]);

    /// One for a joint, zero for all others.
    pub fn unit(joint: Joint) -> Self {
        let mut unit = Self::ZERO;
        unit[joint] = 1.0;
        unit
    }

    /// Whether no value is NaN or infinite.
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|value| value.is_finite())
    }

    /// The largest absolute value.
    pub fn max_abs(&self) -> f64 {
        self.0.iter().fold(0.0, |max, value| value.abs().max(max))
    }

    /// Joint by joint, the function `f` of both values.
    #[inline]
    pub fn zip_with(&self, other: &Self, mut f: impl FnMut(f64, f64) -> f64) -> Self {
        // A plain loop becomes vector code, an array's from_fn does not.
        let mut result = Self::ZERO;
        for ((result, a), b) in result.0.iter_mut().zip(&self.0).zip(&other.0) {
            *result = f(*a, *b);
        }
        result
    }
}

impl<T: Default> Default for PerJoint<T> {
    fn default() -> Self {
        Self::from_fn(|_| T::default())
    }
}

impl<T> Index<Joint> for PerJoint<T> {
    type Output = T;

    #[inline]
    fn index(&self, joint: Joint) -> &T {
        &self.0[joint.index()]
    }
}

impl<T> IndexMut<Joint> for PerJoint<T> {
    #[inline]
    fn index_mut(&mut self, joint: Joint) -> &mut T {
        &mut self.0[joint.index()]
    }
}

impl Add for JointVector {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip_with(&other, |a, b| a + b)
    }
}

impl AddAssign for JointVector {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for JointVector {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip_with(&other, |a, b| a - b)
    }
}

impl SubAssign for JointVector {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Mul<f64> for JointVector {
    type Output = Self;

    #[inline]
    fn mul(mut self, factor: f64) -> Self {
        for value in &mut self.0 {
            *value *= factor;
        }
        self
    }
}

impl Neg for JointVector {
    type Output = Self;

    fn neg(self) -> Self {
        self * -1.0
    }
}
