//! How fields that are more than a number become columns of a CSV file, for serde's `with`.

/// A pose as x, y, z [m] and a unit quaternion w, x, y, z.
pub mod pose {
    use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(pose: &Isometry3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        let (p, q) = (pose.translation, pose.rotation);
        [p.x, p.y, p.z, q.w, q.i, q.j, q.k].serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Isometry3<f64>, D::Error> {
        let [x, y, z, qw, qx, qy, qz] = <[f64; 7]>::deserialize(deserializer)?;
        let rotation = Quaternion::new(qw, qx, qy, qz);
        // A file rounds nothing, but a person may have: anything near unit length is taken as it was meant.
        if (rotation.norm() - 1.0).abs() > 1e-3 {
            return Err(D::Error::custom(format!("the quaternion has length {}: it must be 1", rotation.norm())));
        }
        // Normalising what is a unit already would change its last bits.
        let unit = if (rotation.norm_squared() - 1.0).abs() < 1e-12 {
            UnitQuaternion::new_unchecked(rotation)
        } else {
            UnitQuaternion::from_quaternion(rotation)
        };
        Ok(Isometry3::from_parts(Translation3::new(x, y, z), unit))
    }
}

/// One column per joint.
pub mod joints {
    use model::{Joint, JointVector, PerJoint};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(values: &JointVector, serializer: S) -> Result<S::Ok, S::Error> {
        values.0.serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<JointVector, D::Error> {
        <[f64; Joint::COUNT]>::deserialize(deserializer).map(PerJoint)
    }
}

/// x, y, z.
pub mod vector {
    use nalgebra::Vector3;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(vector: &Vector3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        <[f64; 3]>::from(*vector).serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Vector3<f64>, D::Error> {
        <[f64; 3]>::deserialize(deserializer).map(Vector3::from)
    }
}

/// x and y, both empty when there is no such point.
pub mod maybe_point {
    use nalgebra::Vector2;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(point: &Option<Vector2<f64>>, serializer: S) -> Result<S::Ok, S::Error> {
        [point.map(|p| p.x), point.map(|p| p.y)].serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<Vector2<f64>>, D::Error> {
        let [x, y] = <[Option<f64>; 2]>::deserialize(deserializer)?;
        Ok(x.zip(y).map(|(x, y)| Vector2::new(x, y)))
    }
}

/// Radians inside, degrees in the file.
pub mod degrees {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(angle: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        angle.to_degrees().serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<f64, D::Error> {
        f64::deserialize(deserializer).map(f64::to_radians)
    }
}

/// 0 or 1, as a spreadsheet can plot it.
pub mod flag {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(flag: &bool, serializer: S) -> Result<S::Ok, S::Error> {
        u8::from(*flag).serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<bool, D::Error> {
        match u8::deserialize(deserializer)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(D::Error::custom(format!("{other} is neither 0 nor 1"))),
        }
    }
}
