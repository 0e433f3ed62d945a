//! The words of incidents: what happened, what the program did about it, and what people can do.

use lightbots_control::Trouble;

/// The three parts of a card.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Card {
    pub title: String,
    pub done: String,
    pub advice: String,
}

impl Card {
    pub fn new(title: impl Into<String>, done: &str, advice: &str) -> Self {
        Self { title: title.into(), done: done.into(), advice: advice.into() }
    }
}

/// Returns the card for robots that dropped out for the same reason. `names` has the first of the `count` robots. `frame` is
/// the frame that robots drive to or show, counted from 0; `None` if there is none yet.
pub fn dropped(why: Trouble, names: &[String], count: usize, frame: Option<usize>) -> Card {
    let place = frame.map_or(String::new(), |frame| format!(" in frame {}", frame + 1));
    let pixels = if count == 1 { "its pixel is left dark" } else { "their pixels are left dark" };
    let title = format!("{} {}{place} – {pixels}.", subject(names, count), happened(why, count));
    let done = if count == 1 {
        "The others go on without it and drive around the place where it stands."
    } else {
        "The others go on without them and drive around the places where they stand."
    };
    Card::new(title, done, advice(why))
}

/// Returns the card for robots that are not listed and want to join. `names` has the first of the `count` robots.
pub fn joining(names: &[String], count: usize) -> Card {
    let wants = if count == 1 { "is new and wants to join" } else { "are new and want to join" };
    let title = format!("{} {wants}.", subject(names, count));
    Card::new(title, "Listed robots take part; others are driven around.", "Let it join if it is yours.")
}

/// Returns the robots as the subject of a sentence: `Robot 7`, `Robots 7, 9 and 12`, `24 robots`.
pub fn subject(names: &[String], count: usize) -> String {
    let short: Vec<&str> = names.iter().map(|name| short(name)).collect();
    match short.as_slice() {
        _ if count > 3 || short.len() < count => format!("{count} robots"),
        [one] => format!("Robot {one}"),
        [before @ .., last] => format!("Robots {} and {last}", before.join(", ")),
        [] => "A robot".into(),
    }
}

/// Shortens a robot's name for people. A long name is random, and its beginning identifies it.
fn short(name: &str) -> &str {
    if name.len() > 12 && name.is_ascii() { &name[..8] } else { name }
}

fn happened(why: Trouble, count: usize) -> &'static str {
    let one = count == 1;
    match why {
        Trouble::Late => "fell behind",
        Trouble::Silent => "fell silent",
        Trouble::Deaf if one => "does not acknowledge its route",
        Trouble::Deaf => "do not acknowledge their routes",
        Trouble::Lost if one => "does not know its place",
        Trouble::Lost => "do not know their places",
        Trouble::Unsure if one => "is not sure of its place",
        Trouble::Unsure => "are not sure of their places",
        Trouble::Faulty if one => "reports a fault",
        Trouble::Faulty => "report a fault",
        Trouble::Cut if one => "was cut off or restarted",
        Trouble::Cut => "were cut off or restarted",
        Trouble::Missed if one => "did not reach its place",
        Trouble::Missed => "did not reach their places",
        Trouble::Blocked if one => "is blocked",
        Trouble::Blocked => "are blocked",
        Trouble::Shared if one => "shares its name with another robot",
        Trouble::Shared => "share their names with other robots",
        Trouble::Clock if one => "is still setting its clock",
        Trouble::Clock => "are still setting their clocks",
    }
}

fn advice(why: Trouble) -> &'static str {
    match why {
        Trouble::Late | Trouble::Missed => {
            "Look whether wheels slip or something lies in the way. Free, it takes part again from the next frame on."
        }
        Trouble::Silent => {
            "Look whether it is on and its battery is charged. Once it reports, it takes part again from the next frame on."
        }
        Trouble::Deaf => {
            "It reports but does not receive. Switch it off and on, or check the rights of its login at the broker."
        }
        Trouble::Lost | Trouble::Unsure => {
            "Look whether something hides it from the positioning system. Once it knows its place, it takes part again."
        }
        Trouble::Faulty => {
            "Look at its wheels and sensors: something holds it, or it was moved by hand. Switch it off and on if it stays."
        }
        Trouble::Cut => {
            "Look at its battery and at the radio link. It takes part again from the next frame on."
        }
        Trouble::Blocked => "Take away what stands in its way. It takes part again from the next frame on.",
        Trouble::Shared => "Switch one of the two off, or give it another name.",
        Trouble::Clock => {
            "The show goes on within half a minute. If this comes back, look at the radio link: its messages are late."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Trouble; 11] = [
        Trouble::Late,
        Trouble::Silent,
        Trouble::Deaf,
        Trouble::Lost,
        Trouble::Unsure,
        Trouble::Faulty,
        Trouble::Cut,
        Trouble::Missed,
        Trouble::Blocked,
        Trouble::Shared,
        Trouble::Clock,
    ];

    fn names(count: usize) -> Vec<String> {
        (7..).take(count).map(|number| number.to_string()).collect()
    }

    #[test]
    fn a_robot_is_named_with_frame_and_cause() {
        let card = dropped(Trouble::Silent, &names(1), 1, Some(2));
        assert_eq!(card.title, "Robot 7 fell silent in frame 3 – its pixel is left dark.");
        let card = dropped(Trouble::Lost, &names(3), 3, None);
        assert_eq!(card.title, "Robots 7, 8 and 9 do not know their places – their pixels are left dark.");
        assert_eq!(subject(&names(24), 24), "24 robots");
        assert_eq!(subject(&["2bbcf978-4fdc-4206-8c2e-b7507af577f6".into()], 1), "Robot 2bbcf978");
    }

    #[test]
    fn each_trouble_has_a_cause_and_a_remedy_of_its_own_words() {
        for why in ALL {
            let card = dropped(why, &names(1), 1, Some(0));
            assert!(card.title.contains("Robot 7") && card.title.contains("frame 1"), "{card:?}");
            assert!(card.advice.len() > 20 && !card.done.is_empty(), "{card:?}");
            assert_ne!(happened(why, 1), "");
        }
    }
}
