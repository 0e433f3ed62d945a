//! The topics on which a client may publish, and to which it may subscribe. A robot may publish its own reports, and
//! receive messages to itself and to all robots.

use lightbots_base::RobotId;
use lightbots_wire::Topic;

use super::limits::{self, Rate};
use super::users::Role;
use crate::live::cue_topic::CUE;

/// Prefix of a robot's client id, before the robot's name.
const ROBOT: &str = "LightBot/";
/// Prefix of a controller's client id, before the controller's name.
const CONTROLLER: &str = "BotControl/";
/// Prefix of all topics of the protocol.
const PROTOCOL: &str = "T/LightBot/";

/// Whether a topic belongs to the protocol between controllers and robots.
pub fn is_protocol(topic: &str) -> bool {
    topic.starts_with(PROTOCOL)
}

/// The kind of client that a connection belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Who {
    /// One robot.
    Robot(RobotId),
    /// A controller: everything is allowed but reports that are too long.
    Controller,
    /// A pedal or a desk: it may publish on [`CUE`], the topic of GO, and nothing else.
    Cue,
    /// A tool, or a connection that many robots share. On topics of the protocol, it may publish reports of any robot,
    /// and no commands. On other topics, it may publish everything. It may subscribe to everything.
    Shared,
}

impl Who {
    /// Returns the kind of client for a role, a user and a client id. `Err`: how the three contradict each other.
    pub fn of(role: Role, user: &str, client_id: &str) -> Result<Self, String> {
        let named = client_id.strip_prefix(ROBOT);
        let robot = named.and_then(RobotId::new);
        match (role, named, robot) {
            (Role::Controller, ..) => Ok(Self::Controller),
            (Role::Cue, ..) => Ok(Self::Cue),
            (Role::ByClientId, None, _) if client_id.starts_with(CONTROLLER) => Ok(Self::Controller),
            (Role::ByClientId, None, _) | (Role::Fleet, ..) => Ok(Self::Shared),
            (Role::ByClientId | Role::AnyRobot, _, Some(robot)) => Ok(Self::Robot(robot)),
            (Role::Robot, _, Some(robot)) if robot.as_str() == user => Ok(Self::Robot(robot)),
            (Role::Robot, ..) => {
                Err(format!("user {user} is that robot only: its client id is {ROBOT}{user}"))
            }
            (Role::ByClientId, Some(name), None) => Err(format!("'{name}' cannot be a robot's name")),
            (Role::AnyRobot, ..) => {
                Err(format!("user {user} is for robots: their client ids are {ROBOT}<name>"))
            }
        }
    }

    /// Checks whether the client may publish a message. `Err`: why not.
    pub fn may_publish(&self, topic: &str, payload: &[u8]) -> Result<(), String> {
        let is_report =
            matches!(Topic::parse(topic), Some(Topic::Uuid | Topic::Arrival | Topic::Status | Topic::Time));
        if is_report && payload.len() > limits::REPORT_BYTES {
            let most = limits::REPORT_BYTES;
            return Err(format!("it has {} bytes; a report has {most} at most", payload.len()));
        }
        let own = match self {
            Self::Controller => return Ok(()),
            Self::Cue if topic == CUE => return Ok(()),
            Self::Cue => return Err(format!("a user of the role cue publishes on {CUE} only")),
            Self::Shared if is_report || !is_protocol(topic) => return Ok(()),
            Self::Shared => {
                return Err("only controllers send commands (client id BotControl/<name>, or the role \
                            controller)"
                    .into());
            }
            Self::Robot(own) => own,
        };
        if !is_report {
            return Err("a robot publishes on UUID, Arrival, Status and Time only".into());
        }
        let name = payload.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()).unwrap_or_default();
        if name == own.as_str().as_bytes() {
            return Ok(());
        }
        let name = String::from_utf8_lossy(name.get(..36).unwrap_or(name)).into_owned();
        Err(format!("it says it is '{}'", name.escape_debug()))
    }

    /// Returns the rate at which the client may publish; `None` if there is no limit.
    pub fn rate(&self) -> Option<Rate> {
        match self {
            Self::Robot(_) => Some(limits::ROBOT_RATE),
            Self::Shared => Some(limits::SHARED_RATE),
            Self::Cue => Some(limits::ROBOT_RATE),
            // No limit: a controller sends the routes of ten thousand robots at once, and waits for their answers by
            // itself.
            Self::Controller => None,
        }
    }

    /// Checks whether the client may subscribe to a filter. `Err`: why not.
    pub fn may_subscribe(&self, filter: &str) -> Result<(), String> {
        let own = match self {
            Self::Robot(own) => own,
            Self::Cue => return Err("a user of the role cue hears nothing".into()),
            Self::Shared | Self::Controller => return Ok(()),
        };
        match Topic::parse(filter) {
            Some(Topic::Broadcast) => Ok(()),
            Some(Topic::Robot(id)) if id == *own => Ok(()),
            _ => Err("a robot hears its own topic and Broadcast only".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot() -> Who {
        Who::of(Role::ByClientId, "", "LightBot/r7").unwrap()
    }

    #[test]
    fn a_robot_speaks_for_itself_only() {
        for topic in ["UUID", "Arrival", "Status", "Time"] {
            let topic = format!("T/LightBot/{topic}");
            assert!(robot().may_publish(&topic, b"r7 0.5 1.3 state=idle").is_ok());
            assert!(robot().may_publish(&topic, b" r7 0.5 1.3").is_ok());
            for payload in [&b"r8 0.5 1.3"[..], b"", b"r70 1 1", b"r 1 1", b"\xff\xfe", &[b'x'; 5000]] {
                let why = robot().may_publish(&topic, payload).unwrap_err();
                assert!(why.len() < 400 && !why.contains('\n'), "{why}");
            }
        }
        for topic in
            ["T/LightBot/Broadcast", "T/LightBot/r7", "T/LightBot/r8", "T/LightBot", "", "other", "$SYS/a"]
        {
            assert!(robot().may_publish(topic, b"r7 0.5 1.3").is_err(), "{topic}");
        }
    }

    #[test]
    fn a_pedal_says_go_and_nothing_else() {
        let pedal = Who::of(Role::Cue, "pedal", "anything").unwrap();
        assert!(pedal.may_publish(CUE, b"GO").is_ok());
        for topic in ["T/LightBot/Broadcast", "T/LightBot/r7", "T/LightBot/UUID", "other", ""] {
            assert!(pedal.may_publish(topic, b"GO").is_err(), "{topic}");
        }
        assert!(pedal.may_subscribe("T/LightBot/UUID").is_err() && pedal.may_subscribe("#").is_err());
        let others = [robot(), Who::of(Role::Fleet, "tools", "x").unwrap()];
        assert!(others.iter().all(|one| one.may_publish(CUE, b"GO").is_err()));
    }

    #[test]
    fn a_robot_hears_itself_and_broadcasts_only() {
        for filter in ["T/LightBot/r7", "T/LightBot/Broadcast"] {
            assert!(robot().may_subscribe(filter).is_ok(), "{filter}");
        }
        for filter in [
            "#",
            "+/+/+",
            "T/#",
            "T/LightBot/#",
            "T/LightBot/+",
            "T/LightBot/r8",
            "T/LightBot/UUID",
            "T/LightBot/Arrival",
            "$share/g/T/LightBot/r7",
            "T/LightBot/r7/#",
            "",
        ] {
            assert!(robot().may_subscribe(filter).is_err(), "{filter}");
        }
    }

    #[test]
    fn roles_say_what_a_client_may_be() {
        let of = |role, user, id| Who::of(role, user, id);
        assert_eq!(of(Role::ByClientId, "", "BotControl/x"), Ok(Who::Controller));
        assert_eq!(of(Role::ByClientId, "", "mosq-1"), Ok(Who::Shared));
        assert_eq!(of(Role::ByClientId, "", "LightBots/x"), Ok(Who::Shared));
        assert_eq!(of(Role::Fleet, "me", "BotControl/x"), Ok(Who::Shared));
        assert_eq!(of(Role::Fleet, "me", "LightBot/r8"), Ok(Who::Shared));
        assert!(of(Role::ByClientId, "", "LightBot/a/b").is_err());
        assert!(of(Role::ByClientId, "", "LightBot/").is_err());
        assert_eq!(of(Role::Controller, "me", "LightBot/r8"), Ok(Who::Controller));
        assert_eq!(of(Role::Robot, "r7", "LightBot/r7"), Ok(robot()));
        for id in ["LightBot/r8", "BotControl/r7", "r7", ""] {
            assert!(of(Role::Robot, "r7", id).is_err(), "{id}");
        }
        assert_eq!(of(Role::AnyRobot, "default", "LightBot/r7"), Ok(robot()));
        assert!(of(Role::AnyRobot, "default", "BotControl/x").is_err());
        assert_eq!((Who::Controller.may_subscribe("#"), Who::Shared.may_subscribe("#")), (Ok(()), Ok(())));
    }

    #[test]
    fn commands_are_the_right_of_controllers() {
        for topic in ["T/LightBot/Broadcast", "T/LightBot/r8", "T/LightBot/Controller/Here"] {
            assert_eq!(Who::Controller.may_publish(topic, b"|STOP|"), Ok(()));
            let why = Who::Shared.may_publish(topic, b"|STOP|").unwrap_err();
            assert!(why.contains("BotControl/"), "{why}");
        }
        assert_eq!(Who::Shared.may_publish("T/LightBot/UUID", b"r8 0.5 1.3"), Ok(()));
        assert_eq!(Who::Shared.may_publish("building/door", b"open"), Ok(()));
    }

    #[test]
    fn a_report_of_a_length_that_none_has_is_refused() {
        let report = [&b"r7 0.5 1.3"[..], &[b' '; limits::REPORT_BYTES]].concat();
        for who in [robot(), Who::Shared, Who::Controller] {
            assert!(who.may_publish("T/LightBot/UUID", &report).unwrap_err().contains("4106 bytes"));
        }
    }
}
