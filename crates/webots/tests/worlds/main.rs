//! Reads PROTOs and worlds as Webots does, and checks what would make a real Webots complain, hang or drive wrongly.

mod nodes;
mod vrml;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use nodes::{Holds, faults, fits, holds};
use vrml::{File, Interface, Node, Value, read};

/// Address of Webots' own PROTOs, pinned to a release, because releases do not contain them.
const WEBOTS: &str = "https://raw.githubusercontent.com/cyberbotics/webots/R2025a/projects/";
/// Webots' Elisa-3: its devices and the fields of its interface (R2025a).
const ELISA_DEVICES: [&str; 13] = [
    "left wheel motor",
    "right wheel motor",
    "left wheel sensor",
    "right wheel sensor",
    "ledrgb",
    "ps0",
    "ps1",
    "ps2",
    "ps3",
    "ps4",
    "ps5",
    "ps6",
    "ps7",
];
const ELISA_FIELDS: [(&str, Holds); 9] = [
    ("translation", Holds::Numbers(3)),
    ("rotation", Holds::Numbers(4)),
    ("name", Holds::Text),
    ("controller", Holds::Text),
    ("controllerArgs", Holds::Texts),
    ("customData", Holds::Text),
    ("supervisor", Holds::Flag),
    ("synchronization", Holds::Flag),
    ("extensionSlot", Holds::Nodes),
];

fn webots() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../webots")
}

/// The files of a folder with this extension, sorted by name.
fn files(folder: &str, ending: &str) -> Vec<(PathBuf, File)> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(webots().join(folder))
        .expect("the folder is there")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    paths.sort();
    assert!(!paths.is_empty());
    paths.into_iter().map(|path| (path.clone(), read(&std::fs::read_to_string(path).unwrap()))).collect()
}

fn proto(file: &File) -> (&str, &Interface) {
    let (name, fields) = file.proto.as_ref().expect("a PROTO");
    (name, fields)
}

/// Names of all devices below a node. A GPS or compass without a name has its default name.
fn devices(node: &Node) -> Vec<String> {
    let mut names = Vec::new();
    node.walk(&mut |node| {
        let default = match node.kind.as_str() {
            "GPS" => "gps",
            "Compass" => "compass",
            "LED" => "led",
            "RotationalMotor" => "rotational motor",
            "PositionSensor" => "position sensor",
            "DistanceSensor" => "distance sensor",
            _ => return,
        };
        names.push(node.text("name").unwrap_or(default).to_owned());
    });
    names
}

#[test]
fn every_file_has_the_header_and_addresses_that_resolve() {
    for (path, file) in files("protos", "proto").into_iter().chain(files("worlds", "wbt")) {
        assert_eq!(file.header, "#VRML_SIM R2025a utf8", "{}", path.display());
        for address in &file.externs {
            let own = path.parent().unwrap().join(address);
            let resolves = address.starts_with(WEBOTS) && address.ends_with(".proto") || own.is_file();
            assert!(resolves, "{}: {address}", path.display());
        }
    }
}

#[test]
fn protos_are_named_after_their_files_and_every_is_names_a_field() {
    for (path, file) in files("protos", "proto") {
        let (name, fields) = proto(&file);
        assert_eq!(Some(name), path.file_stem().and_then(|stem| stem.to_str()));
        for (field, (kind, default)) in fields {
            assert!(fits(default, holds(kind)), "{name}.{field}: {default:?} is no {kind}");
        }
        let mut used = BTreeSet::new();
        file.nodes[0].walk(&mut |node| {
            used.extend(node.fields.values().filter_map(|value| match value {
                Value::Is(field) => Some(field.clone()),
                _ => None,
            }));
        });
        assert_eq!(used, fields.keys().cloned().collect(), "{name}: fields and their uses");
    }
}

#[test]
fn nodes_have_only_fields_that_webots_knows() {
    let protos = files("protos", "proto");
    let known: Vec<(&str, Vec<(&str, Holds)>)> = protos
        .iter()
        .map(|(_, file)| {
            let (name, fields) = proto(file);
            (name, fields.iter().map(|(field, (kind, _))| (field.as_str(), holds(kind))).collect())
        })
        .chain([("Elisa3", ELISA_FIELDS.to_vec())])
        .collect();
    let worlds = files("worlds", "wbt");
    for (path, file) in protos.iter().chain(&worlds) {
        for node in &file.nodes {
            assert_eq!(faults(node, &known), Vec::<String>::new(), "{}", path.display());
        }
        for (_, (_, default)) in file.proto.iter().flat_map(|(_, fields)| fields) {
            if let Value::Nodes(nodes) = default {
                assert!(nodes.iter().all(|node| faults(node, &known).is_empty()), "{}", path.display());
            }
        }
    }
}

#[test]
fn use_comes_after_def() {
    for (path, file) in files("protos", "proto").into_iter().chain(files("worlds", "wbt")) {
        let (mut defined, mut used) = (BTreeSet::new(), BTreeSet::new());
        for node in &file.nodes {
            node.walk(&mut |node| {
                if node.kind == "USE" {
                    used.insert(node.def.clone().unwrap());
                } else if let Some(name) = &node.def {
                    assert!(defined.insert(name.clone()), "{}: DEF {name} twice", path.display());
                }
                used.extend(node.fields.values().filter_map(|value| match value {
                    Value::Use(name) => Some(name.clone()),
                    _ => None,
                }));
            });
        }
        assert!(used.is_subset(&defined), "{}: {used:?} of {defined:?}", path.display());
    }
}

#[test]
fn robots_have_every_device_the_driver_asks_for_once() {
    let quoted = |source: &'static str, before: &str| -> Vec<&str> {
        source.split(before).skip(1).filter_map(|rest| rest.split('"').next()).collect()
    };
    let mut asked = quoted(include_str!("../../src/body.rs"), "find(\"");
    assert!(asked.len() >= 7, "{asked:?}");
    let names =
        include_str!("../../src/distance_sensors.rs").lines().find(|line| line.starts_with("const NAMES"));
    asked.extend(names.expect("it names its sensors").split('"').skip(1).step_by(2));
    assert_eq!(asked.last(), Some(&"ps9"));
    for (path, file) in files("protos", "proto") {
        let (name, fields) = proto(&file);
        let mut found = devices(&file.nodes[0]);
        for slot in ["extensionSlot", "proximity"] {
            if let Some((_, Value::Nodes(slot))) = fields.get(slot) {
                found.extend(slot.iter().flat_map(devices));
            }
        }
        let elisa = file.nodes[0].kind == "Elisa3";
        if elisa {
            found.extend(ELISA_DEVICES.map(str::to_owned));
        }
        // The Elisa-3 has only eight proximity sensors, and the driver works with these.
        for device in asked.iter().filter(|device| !(elisa && ["ps8", "ps9"].contains(device))) {
            let count = found.iter().filter(|name| name == device).count();
            assert_eq!(count, 1, "{}: {name} has {count} '{device}'", path.display());
        }
    }
}

#[test]
fn our_robot_has_the_measures_of_the_elisa() {
    let (_, file) =
        files("protos", "proto").into_iter().find(|(_, file)| proto(file).0 == "LightBot").unwrap();
    let robot = &file.nodes[0];
    let bounds = &robot.nodes("boundingObject")[0].nodes("children")[0];
    assert_eq!(bounds.numbers("radius"), Some(&[0.027][..]));
    let physics = &robot.nodes("physics")[0];
    // Webots rejects a density beside a mass.
    assert_eq!(
        (physics.numbers("mass"), physics.numbers("density")),
        (Some(&[0.039][..]), Some(&[-1.0][..]))
    );
    assert_eq!(physics.numbers("inertiaMatrix").map(<[f64]>::len), Some(6));
    let mut wheels = Vec::new();
    robot.walk(&mut |node| {
        if node.kind == "HingeJoint" {
            let anchor = node.nodes("jointParameters")[0].numbers("anchor").unwrap().to_vec();
            let end = &node.nodes("endPoint")[0];
            // A wheel that is not at its anchor jumps in the first step.
            assert_eq!(end.numbers("translation"), Some(anchor.as_slice()));
            assert_eq!(node.nodes("jointParameters")[0].numbers("axis"), Some(&[0.0, 1.0, 0.0][..]));
            assert!(end.fields.contains_key("physics") && end.fields.contains_key("boundingObject"));
            wheels.push(anchor);
        }
    });
    // Left is +y: the driver's left motor must be the left wheel. The track is 40 mm and the wheels' radius 4.5 mm.
    assert_eq!(wheels, [[0.0, 0.02, 0.0045], [0.0, -0.02, 0.0045]]);
    let first = devices(robot).into_iter().find(|name| name.ends_with("wheel motor"));
    assert_eq!(first.as_deref(), Some("left wheel motor"));
    let limits = lightbots_base::Limits::ELISA_3;
    let mut motors = 0;
    robot.walk(&mut |node| {
        if let (Some(most), "RotationalMotor") = (node.numbers("maxVelocity"), node.kind.as_str()) {
            assert!(most[0] >= limits.wheel_radps, "Webots complains about every rate above {}", most[0]);
            motors += 1;
        }
    });
    assert_eq!((motors, limits.radius_m, limits.wheel_radius_m), (2, 0.027, 0.0045));
}

#[test]
fn our_robot_looks_around_as_the_driver_and_its_tests_take_it() {
    let (_, file) =
        files("protos", "proto").into_iter().find(|(_, file)| proto(file).0 == "LightBot").unwrap();
    // All sensors must be in one field of the PROTO, so that a world can leave them out with their rays.
    let (_, fields) = proto(&file);
    let Some((_, Value::Nodes(sensors))) = fields.get("proximity") else { panic!("a field for sensors") };
    file.nodes[0].walk(&mut |node| assert_ne!(node.kind, "DistanceSensor"));
    assert_eq!(sensors.len(), Controller::proximity::RAYS);
    for (index, sensor) in sensors.iter().enumerate() {
        assert_eq!(sensor.text("name"), Some(format!("ps{index}").as_str()));
        // Sensors are numbered clockwise from the front, 24 mm from the centre, and face away from it.
        let looks = -(index as f64) * std::f64::consts::TAU / sensors.len() as f64;
        let (at, turned) = (sensor.numbers("translation").unwrap(), sensor.numbers("rotation").unwrap());
        assert!((at[0] - 0.024 * looks.cos()).abs() < 1e-5 && (at[1] - 0.024 * looks.sin()).abs() < 1e-5);
        assert_eq!(turned[..3], [0.0, 0.0, 1.0]);
        assert!((turned[3] - looks).sin().abs() < 1e-4 && (turned[3] - looks).cos() > 0.0, "{turned:?}");
        // The ray is within the height of other robots' bounding objects.
        assert!(at[2] > 0.001 && at[2] < 0.031);
        // One ray, which any surface reflects at any angle.
        assert_eq!(sensor.text("type"), Some("generic"));
        assert_eq!(sensor.numbers("numberOfRays"), None);
        let table = sensor.numbers("lookupTable").unwrap();
        assert_eq!(table, Controller::proximity::TABLE.concat());
    }
}

#[test]
fn worlds_stand_as_the_report_has_them() {
    let protos = files("protos", "proto");
    for (path, file) in files("worlds", "wbt") {
        let info = file.nodes.iter().find(|node| node.kind == "WorldInfo").expect("a world has one");
        // At 32 ms curves wander. The default coordinate system is ENU, and northDirection is deprecated.
        assert_eq!(info.numbers("basicTimeStep"), Some(&[16.0][..]), "{}", path.display());
        assert!(!info.fields.contains_key("coordinateSystem") && !info.fields.contains_key("northDirection"));
        let is_robot = |node: &&Node| protos.iter().any(|(_, file)| proto(file).0 == node.kind);
        let robots: Vec<&Node> = file.nodes.iter().filter(is_robot).collect();
        assert_eq!(robots.len(), 30, "{}", path.display());
        for (index, robot) in robots.iter().enumerate() {
            let at = robot.numbers("translation").unwrap();
            let x_m = -1.45 + 0.1 * index as f64;
            assert!((at[0] - x_m).abs() < 1e-6 && at[1] == 1.3 && at[2] == 0.0, "{at:?}");
            // Robots face +y, as in the report.
            let turned = robot.numbers("rotation").unwrap();
            assert_eq!(turned[..3], [0.0, 0.0, 1.0]);
            assert!((turned[3] - std::f64::consts::FRAC_PI_2).abs() < 1e-4, "{turned:?}");
        }
        unique_names(&path, &file);
        all_known(&path, &file);
    }
}

/// Checks that no two nodes of a world have one name. With two robots of one name, Webots waits for ever, and with two
/// solids it complains.
fn unique_names(path: &Path, file: &File) {
    let mut names = BTreeSet::new();
    for name in file.nodes.iter().filter_map(|node| node.text("name")) {
        assert!(names.insert(name), "{}: two '{name}'", path.display());
    }
}

/// Checks that a world uses each of its EXTERNPROTOs, and names our own PROTOs that it uses in an EXTERNPROTO.
fn all_known(path: &Path, file: &File) {
    let used: BTreeSet<&str> = file.nodes.iter().map(|node| node.kind.as_str()).collect();
    for address in &file.externs {
        let name = address.rsplit('/').next().and_then(|name| name.strip_suffix(".proto"));
        assert!(name.is_some_and(|name| used.contains(name)), "{}: {address} is not used", path.display());
    }
    for own in ["LightBot", "LightBotElisa3"].iter().filter(|name| used.contains(*name)) {
        let named = file.externs.iter().any(|address| address.ends_with(&format!("/{own}.proto")));
        assert!(named, "{}: {own} without EXTERNPROTO", path.display());
    }
}

#[test]
fn the_controller_is_the_drivers_program() {
    for (_, file) in files("protos", "proto") {
        let (name, fields) = proto(&file);
        let Some((_, Value::Text(controller))) = fields.get("controller") else { panic!("{name}") };
        // Webots looks for controllers/<name>/<name>; cargo names the program after the manifest.
        assert_eq!(controller, "LightBotFirmware");
        let manifest = include_str!("../../Cargo.toml");
        assert!(manifest.contains(&format!("[[bin]]\nname = \"{controller}\"")));
        assert!(matches!(fields["synchronization"].1, Value::Flag(true)), "{name} must be waited for");
        assert!(matches!(fields["supervisor"].1, Value::Flag(false)), "{name}");
    }
    // Webots would use a Dockerfile there instead of the program.
    assert!(!webots().join("controllers/LightBotFirmware/Dockerfile").exists());
}

#[test]
fn what_webots_would_not_read_is_found() {
    let wrong = read("#VRML_SIM R2025a utf8\nRobot { translation 0 0 wheels 2 children [ Cylindre { } ] }");
    let faults = faults(&wrong.nodes[0], &[]);
    assert_eq!(faults.len(), 3, "{faults:?}");
    let sensor = "DistanceSensor { type \"sonnar\" numberOfRays 0 lookupTable [ 0 9 0 0.1 5 0 0.1 0 0 ] }";
    let wrong = read(&format!("#VRML_SIM R2025a utf8\n{sensor}"));
    let faults = nodes::faults(&wrong.nodes[0], &[]);
    assert_eq!(faults.len(), 3, "{faults:?}");
}
