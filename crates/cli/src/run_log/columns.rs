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

/// Position and velocity, x, y and z each, all empty when there is no such point.
pub mod centre_of_mass {
    use balance::CentreOfMass;
    use nalgebra::Vector3;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(com: &Option<CentreOfMass>, serializer: S) -> Result<S::Ok, S::Error> {
        let numbers = com.map(|CentreOfMass { position: p, velocity: v }| [p.x, p.y, p.z, v.x, v.y, v.z]);
        numbers.map_or([None; 6], |numbers| numbers.map(Some)).serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<CentreOfMass>, D::Error> {
        Ok(match <[Option<f64>; 6]>::deserialize(deserializer)? {
            [Some(x), Some(y), Some(z), Some(vx), Some(vy), Some(vz)] => {
                Some(CentreOfMass { position: Vector3::new(x, y, z), velocity: Vector3::new(vx, vy, vz) })
            }
            _ => None,
        })
    }
}

/// Degrees in the file: ankle about x and y, waist about x and y; all empty when nothing is known.
pub mod added_angles {
    use controller::AddedAngles;
    use nalgebra::Vector2;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(added: &Option<AddedAngles>, serializer: S) -> Result<S::Ok, S::Error> {
        let angles = added.map(|AddedAngles { ankle, waist }| [ankle.x, ankle.y, waist.x, waist.y]);
        angles.map_or([None; 4], |angles| angles.map(|angle| Some(angle.to_degrees()))).serialize(serializer)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Option<AddedAngles>, D::Error> {
        let angles = <[Option<f64>; 4]>::deserialize(deserializer)?.map(|angle| angle.map(f64::to_radians));
        Ok(match angles {
            [Some(ankle_x), Some(ankle_y), Some(waist_x), Some(waist_y)] => {
                Some(AddedAngles { ankle: Vector2::new(ankle_x, ankle_y), waist: Vector2::new(waist_x, waist_y) })
            }
            _ => None,
        })
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
