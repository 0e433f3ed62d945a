//! Topics of the protocol.

use lightbots_base::RobotId;

/// Text with which all topics begin.
const ROOT: &str = "T/LightBot/";

/// A topic as text; the longest has 47 bytes (R3).
pub type TopicText = heapless::String<56>;

/// Topic of a message, named by its part after `T/LightBot/`. Original topics have to stay; the others are additions of
/// ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Topic {
    /// `UUID`: introductions of robots. Original.
    Uuid,
    /// `Arrival`: reports of robots that have reached their target or the end of their route. Original.
    Arrival,
    /// `Status`: periodic reports, and reports of changes. Ours.
    Status,
    /// `Time`: questions of robots for the show clock. Ours.
    Time,
    /// `Broadcast`: commands for all robots. Original.
    Broadcast,
    /// `<uuid>`: commands for one robot. Original.
    Robot(RobotId),
}

impl Topic {
    /// Reads a topic; `None` if the text is not a topic of the protocol.
    pub fn parse(text: &str) -> Option<Self> {
        Some(match text.strip_prefix(ROOT)? {
            "UUID" => Self::Uuid,
            "Arrival" => Self::Arrival,
            "Status" => Self::Status,
            "Time" => Self::Time,
            "Broadcast" => Self::Broadcast,
            name => Self::Robot(RobotId::new(name)?),
        })
    }

    /// Returns the topic as text.
    pub fn write(self) -> TopicText {
        let mut text = TopicText::new();
        let name = match &self {
            Self::Uuid => "UUID",
            Self::Arrival => "Arrival",
            Self::Status => "Status",
            Self::Time => "Time",
            Self::Broadcast => "Broadcast",
            Self::Robot(id) => id.as_str(),
        };
        // Always fits: 11 bytes of root and at most 36 of the name.
        let _ = text.push_str(ROOT).and_then(|()| text.push_str(name));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topics_go_there_and_back() {
        for text in
            ["UUID", "Arrival", "Status", "Time", "Broadcast", "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8", "r7"]
        {
            let mut full = TopicText::new();
            full.push_str(ROOT).unwrap();
            full.push_str(text).unwrap();
            assert_eq!(Topic::parse(&full).unwrap().write(), full);
        }
        assert_eq!(Topic::parse("T/LightBot/r7"), Some(Topic::Robot(RobotId::new("r7").unwrap())));
    }

    #[test]
    fn other_topics_are_none() {
        for text in ["", "T/LightBot", "T/LightBot/", "T/LightBot/a/b", "t/LightBot/UUID", "T/LightBot/#"] {
            assert_eq!(Topic::parse(text), None, "{text:?}");
        }
    }
}
