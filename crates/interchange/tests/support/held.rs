//! Mechanism files whose held joints turn.

use nalgebra::{Translation3, Vector3};

use super::{TestBody, TestJoint, Tree, as_number};

impl Tree {
    /// Reads a mechanism file with its held joints: each is called `held` and its name in the URDF, as is its link.
    pub(crate) fn of_mechanism_with_held(file: &toml::Table) -> Self {
        let mut tree = Self::of_mechanism(file);
        let all = file.get("held").and_then(toml::Value::as_array).cloned().unwrap_or_default();
        let with_link: Vec<&toml::Value> = all.iter().filter(|held| held.get("parent").is_some()).collect();
        let place = |tree: &Self, name: &str| tree.poses(&Default::default())[name].translation.vector;
        for held in &with_link {
            let text = |key: &str| held.get(key).map(|text| text.as_str().unwrap().to_string());
            let vector = |key: &str| Vector3::from_iterator(held[key].as_array().unwrap().iter().map(as_number));
            let name = format!("held {}", text("urdf").unwrap());
            let mount = text("parent").unwrap();
            tree.joints.push(TestJoint {
                name: name.clone(),
                kind: "revolute".into(),
                parent: text("parent_held").map_or(mount.clone(), |below| format!("held {below}")),
                child: name.clone(),
                origin: Translation3::from(vector("origin_m")).into(),
                axis: vector("axis"),
            });
            tree.bodies.insert(name.clone(), TestBody::default());
            if held.get("mass_kg").is_some() {
                let (mass, com) = (as_number(&held["mass_kg"]), vector("com_m"));
                tree.bodies.get_mut(&name).unwrap().mass = mass;
                tree.bodies.get_mut(&name).unwrap().com = com;
                let lump = text("lumped_into").unwrap_or(mount);
                let at = place(&tree, &name) - place(&tree, &lump) + com;
                let rest = tree.bodies.get_mut(&lump).unwrap();
                rest.com = rest.mass * rest.com - mass * at;
                rest.mass -= mass;
                rest.com = if rest.mass < 1e-6 { Vector3::zeros() } else { rest.com / rest.mass };
            }
        }
        for (name, joint) in file["joint"].as_table().unwrap() {
            if let Some(below) = joint.get("parent_held") {
                let below = format!("held {}", below.as_str().unwrap());
                let origin = place(&tree, name) - place(&tree, &below);
                let joint = tree.joints.iter_mut().find(|joint| joint.name == *name).unwrap();
                (joint.parent, joint.origin) = (below, Translation3::from(origin).into());
            }
        }
        tree
    }
}
