//! The fields of Webots' nodes that our files use.
//!
//! Source: the Webots reference manual of R2025a, which has one page per node. The same fields exist in R2023b.

use crate::vrml::{Node, Value};

/// The kind of value that a field holds.
#[derive(Clone, Copy, Debug)]
pub enum Holds {
    /// This many numbers.
    Numbers(usize),
    /// Any number of groups with this many numbers each.
    Lists(usize),
    Text,
    Texts,
    Flag,
    /// One node of any of these kinds, or `USE`.
    One(&'static [&'static str]),
    /// Any count of nodes.
    Nodes,
}

use Holds::{Flag, Lists, Nodes, Numbers, One, Text, Texts};

type Fields = &'static [(&'static str, Holds)];

const POSE: Fields = &[("translation", Numbers(3)), ("rotation", Numbers(4)), ("children", Nodes)];
const BOUNDS: &[&str] = &["Pose", "Shape", "Box", "Cylinder", "Sphere", "Plane", "Group"];
const SOLID: Fields = &[
    ("name", Text),
    ("boundingObject", One(BOUNDS)),
    ("physics", One(&["Physics"])),
    ("contactMaterial", Text),
];
const ROBOT: Fields = &[
    ("controller", Text),
    ("controllerArgs", Texts),
    ("customData", Text),
    ("supervisor", Flag),
    ("synchronization", Flag),
];
const SHAPE: Fields =
    &[("appearance", One(&["PBRAppearance"])), ("geometry", One(&["Cylinder", "Box", "Plane"]))];
const PBR: Fields = &[("baseColor", Numbers(3)), ("roughness", Numbers(1)), ("metalness", Numbers(1))];
const CYLINDER: Fields = &[("height", Numbers(1)), ("radius", Numbers(1)), ("subdivision", Numbers(1))];
const LED: Fields = &[("color", Lists(3)), ("gradual", Flag)];
const HINGE: Fields =
    &[("jointParameters", One(&["HingeJointParameters"])), ("device", Nodes), ("endPoint", One(&["Solid"]))];
const HINGE_PARAMETERS: Fields = &[("axis", Numbers(3)), ("anchor", Numbers(3)), ("position", Numbers(1))];
const MOTOR: Fields = &[("name", Text), ("maxVelocity", Numbers(1)), ("maxTorque", Numbers(1))];
const SENSOR: Fields = &[("name", Text), ("resolution", Numbers(1))];
const PHYSICS: Fields =
    &[("density", Numbers(1)), ("mass", Numbers(1)), ("centerOfMass", Lists(3)), ("inertiaMatrix", Lists(3))];
const DISTANCE: Fields = &[
    ("type", Text),
    ("lookupTable", Lists(3)),
    ("numberOfRays", Numbers(1)),
    ("aperture", Numbers(1)),
    ("gaussianWidth", Numbers(1)),
    ("resolution", Numbers(1)),
    ("redColorSensitivity", Numbers(1)),
];
/// Types of a `DistanceSensor`.
const DISTANCE_TYPES: [&str; 4] = ["generic", "infra-red", "sonar", "laser"];
const WORLD: Fields =
    &[("info", Texts), ("title", Text), ("basicTimeStep", Numbers(1)), ("contactProperties", Nodes)];
const CONTACT: Fields = &[("material1", Text), ("material2", Text), ("coulombFriction", Lists(1))];
const VIEWPOINT: Fields =
    &[("orientation", Numbers(4)), ("position", Numbers(3)), ("fieldOfView", Numbers(1))];
const BACKGROUND: Fields = &[("skyColor", Lists(3)), ("luminosity", Numbers(1))];
const LIGHT: Fields = &[
    ("ambientIntensity", Numbers(1)),
    ("direction", Numbers(3)),
    ("intensity", Numbers(1)),
    ("castShadows", Flag),
];

/// The fields of a kind of node, in groups. `None` for kinds that are not listed here.
fn fields(kind: &str) -> Option<Vec<Fields>> {
    Some(match kind {
        "Group" => vec![&POSE[2..]],
        "Pose" => vec![POSE],
        "Solid" => vec![POSE, SOLID],
        "Robot" => vec![POSE, SOLID, ROBOT],
        "GPS" | "Compass" => vec![POSE, SOLID, SENSOR],
        "DistanceSensor" => vec![POSE, SOLID, DISTANCE],
        "LED" => vec![POSE, SOLID, LED],
        "Shape" => vec![SHAPE],
        "PBRAppearance" => vec![PBR],
        "Cylinder" => vec![CYLINDER],
        "Box" => vec![&[("size", Numbers(3))]],
        "Plane" => vec![&[("size", Numbers(2))]],
        "HingeJoint" => vec![HINGE],
        "HingeJointParameters" => vec![HINGE_PARAMETERS],
        "RotationalMotor" => vec![MOTOR],
        "PositionSensor" => vec![SENSOR],
        "Physics" => vec![PHYSICS],
        "WorldInfo" => vec![WORLD],
        "ContactProperties" => vec![CONTACT],
        "Viewpoint" => vec![VIEWPOINT],
        "Background" => vec![BACKGROUND],
        "DirectionalLight" => vec![LIGHT],
        "USE" => vec![],
        _ => return None,
    })
}

/// Faults of a node and of those below it. `protos` are our own kinds of nodes with their fields.
pub fn faults(node: &Node, protos: &[(&str, Vec<(&str, Holds)>)]) -> Vec<String> {
    let mut faults = Vec::new();
    node.walk(&mut |node| {
        let own = protos.iter().find(|(name, _)| *name == node.kind);
        let known: Vec<(&str, Holds)> = match (own, fields(&node.kind)) {
            (Some((_, known)), _) => known.clone(),
            (None, Some(known)) => known.concat(),
            (None, None) => return faults.push(format!("{} is no node we know", node.kind)),
        };
        for (name, value) in &node.fields {
            match known.iter().find(|(field, _)| field == name) {
                None => faults.push(format!("{} has no field {name}", node.kind)),
                Some((_, holds)) if !fits(value, *holds) => {
                    faults.push(format!("{}.{name} is {value:?}, not {holds:?}", node.kind));
                }
                Some(_) => {}
            }
        }
        faults.extend(distance_faults(node));
    });
    faults
}

/// Faults of a `DistanceSensor` that Webots would report although its fields have the right types.
fn distance_faults(node: &Node) -> Vec<String> {
    let mut faults = Vec::new();
    if node.kind != "DistanceSensor" {
        return faults;
    }
    let kind = node.text("type").unwrap_or("generic");
    if !DISTANCE_TYPES.contains(&kind) {
        faults.push(format!("a DistanceSensor's type is '{kind}'"));
    }
    let rows = node.numbers("lookupTable").unwrap_or_default().chunks(3);
    if !rows.map(|row| row[0]).is_sorted_by(|near, far| near < far) {
        faults.push("the rows of a lookupTable are not in the order of their distances".into());
    }
    let rays = node.numbers("numberOfRays").map_or(1.0, |rays| rays[0]);
    if rays < 1.0 || rays.fract() != 0.0 || (kind == "laser" && rays != 1.0) {
        faults.push(format!("a DistanceSensor of type '{kind}' has {rays} rays"));
    }
    faults
}

/// The kind of value of a PROTO's field, by the name of its type.
pub fn holds(kind: &str) -> Holds {
    match kind {
        "SFVec3f" | "SFColor" => Numbers(3),
        "SFRotation" => Numbers(4),
        "SFVec2f" => Numbers(2),
        "SFFloat" | "SFInt32" => Numbers(1),
        "SFBool" => Flag,
        "SFString" => Text,
        "MFString" => Texts,
        "MFNode" => Nodes,
        "MFVec3f" | "MFColor" => Lists(3),
        other => panic!("{other} is no type of a field that we use"),
    }
}

/// Whether a value can stand in a field. `IS` fits any field.
pub fn fits(value: &Value, holds: Holds) -> bool {
    match (value, holds) {
        (Value::Is(_), _) | (Value::Empty, Lists(_) | Texts | Nodes) => true,
        (Value::Numbers(numbers), Numbers(count)) => numbers.len() == count,
        (Value::Numbers(numbers), Lists(count)) => numbers.len().is_multiple_of(count),
        (Value::Text(_), Text | Texts) => true,
        (Value::Texts(texts), Texts) => texts.iter().all(|text| !text.is_empty()),
        (Value::Flag(_), Flag) | (Value::Nodes(_), Nodes) | (Value::Use(_), Nodes | One(_)) => true,
        (Value::Nodes(nodes), One(kinds)) => nodes.len() == 1 && kinds.contains(&nodes[0].kind.as_str()),
        _ => false,
    }
}
