//! Calls of functions of multi-view stereo.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::{Key, Value};

impl Calls {
    /// * `scene`: reconstruction of the photos
    pub(super) fn add_dense(&mut self, scene: &Value, photos: &Value) -> Result<(), Failure> {
        let options = record([("maxSizePx", Value::Number(96.0))]);
        let views = self.add(
            "prepareViews",
            &[scene.clone(), photos.clone(), options.clone()],
        )?;
        self.fail("prepareViews", &[scene.clone(), Value::List(Vec::new())])?;
        let maps = self.add("estimateDepthMaps", &[views.clone(), options.clone()])?;
        let given = [views.clone(), maps.clone()];
        let cloud = self.add("fuseDepthMaps", &given)?;
        if doubles(&get(&cloud, "points")).len() < 3000 {
            return Err("depth maps have a thousand points".into());
        }
        let small = record([("minTriangles", Value::Number(20.0))]);
        let mut meshed = given.to_vec();
        meshed.push(small);
        let mesh = self.add("meshDepthMaps", &meshed)?;
        let size = record([("maxSizePx", Value::Number(512.0))]);
        self.add("textureMesh", &[mesh.clone(), views.clone(), size])?;
        let none = record([("vertices", cloud), ("triangles", Value::Indices(vec![]))]);
        self.fail("textureMesh", &[none, views.clone()])?;
        let odd = replaced(&mesh, "triangles", Value::Indices(vec![0, 1]));
        self.fail("textureMesh", &[odd, views.clone()])?;
        let Value::List(mut maps) = maps else {
            return Err("depth maps are a list".into());
        };
        maps[0] = replaced(&maps[0], "numViews", Value::Bytes(vec![1]));
        self.fail("fuseDepthMaps", &[views, Value::List(maps)])
    }
}

/// The same object with another value of a key.
pub(crate) fn replaced(value: &Value, key: &'static str, new: Value) -> Value {
    let Value::Record(entries) = value else {
        return Value::Nothing;
    };
    let kept = entries.iter().filter(|(name, _)| name != key).cloned();
    Value::Record(kept.chain([(Key::from(key), new)]).collect())
}
