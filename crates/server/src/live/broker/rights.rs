//! The topics that a client may publish and subscribe. A robot publishes its own messages and receives those for it.

use lightbots_base::RobotId;
use lightbots_wire::Topic;

use super::users::Role;

/// What stands before a robot's name in its client id.
const ROBOT: &str = "LightBot/";

/// The client of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Who {
    /// One robot.
    Robot(RobotId),
    /// A controller, a tool, or a connection that many robots share: everything is allowed.
    Free,
}

impl Who {
    /// The client that role, user and client id name, or why they contradict each other.
    pub fn of(role: Role, user: &str, client_id: &str) -> Result<Self, String> {
        let named = client_id.strip_prefix(ROBOT);
        let robot = named.and_then(RobotId::new);
        match (role, named, robot) {
            (Role::Controller, ..) | (Role::ByClientId, None, _) => Ok(Self::Free),
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

    /// Whether it may publish this; the reason where not.
    pub fn may_publish(&self, topic: &str, payload: &[u8]) -> Result<(), String> {
        let Self::Robot(own) = self else { return Ok(()) };
        if !matches!(Topic::parse(topic), Some(Topic::Uuid | Topic::Arrival | Topic::Status | Topic::Time)) {
            return Err("a robot publishes on UUID, Arrival, Status and Time only".into());
        }
        let name = payload.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()).unwrap_or_default();
        if name == own.as_str().as_bytes() {
            return Ok(());
        }
        let name = String::from_utf8_lossy(name.get(..36).unwrap_or(name)).into_owned();
        Err(format!("it says it is '{}'", name.escape_debug()))
    }

    /// Whether it may subscribe to this filter; the reason where not.
    pub fn may_subscribe(&self, filter: &str) -> Result<(), String> {
        let Self::Robot(own) = self else { return Ok(()) };
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
    fn roles_say_who_a_client_may_be() {
        let of = |role, user, id| Who::of(role, user, id);
        assert_eq!(of(Role::ByClientId, "", "BotControl/x"), Ok(Who::Free));
        assert_eq!(of(Role::ByClientId, "", "mosq-1"), Ok(Who::Free));
        assert_eq!(of(Role::ByClientId, "", "LightBots/x"), Ok(Who::Free));
        assert!(of(Role::ByClientId, "", "LightBot/a/b").is_err());
        assert!(of(Role::ByClientId, "", "LightBot/").is_err());
        assert_eq!(of(Role::Controller, "me", "LightBot/r8"), Ok(Who::Free));
        assert_eq!(of(Role::Robot, "r7", "LightBot/r7"), Ok(robot()));
        for id in ["LightBot/r8", "BotControl/r7", "r7", ""] {
            assert!(of(Role::Robot, "r7", id).is_err(), "{id}");
        }
        assert_eq!(of(Role::AnyRobot, "default", "LightBot/r7"), Ok(robot()));
        assert!(of(Role::AnyRobot, "default", "BotControl/x").is_err());
        assert_eq!(Who::Free.may_subscribe("#"), Ok(()));
    }
}
