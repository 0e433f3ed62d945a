//! The rules of `docs/protocol.md`, and how each can be tested.

/// Whom a rule binds and what shows whether it is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Every robot: the original protocol.
    Everybody,
    /// Robots whose reports say `can=route`.
    Route,
    /// Every robot, by what its light shows.
    Light,
    /// Robots whose reports say `can=fade`, by what their light shows.
    Fade,
    /// Robots whose reports say `can=blink`, by what their light shows.
    Blink,
    /// Robots that report more than the original.
    Details,
    /// No message shows it; the text says why.
    Hidden(&'static str),
}

/// One rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// Its number: 7 is R7.
    pub number: u8,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// Whom it binds.
    pub scope: Scope,
}

const fn rule(number: u8, title: &'static str, scope: Scope) -> Rule {
    Rule { number, title, scope }
}

const POWER: &str = "it takes switching the robot off and on";
const CUT: &str = "it takes cutting the robot's link";
const OBSTACLE: &str = "it takes something to stand in the robot's way";
const SENSORS: &str = "it takes spoiling the robot's sensors";

/// All rules, in order: `RULES[n - 1]` is Rn.
pub const RULES: [Rule; 52] = {
    use Scope::{Blink, Details, Everybody, Fade, Hidden, Light, Route};
    [
        rule(1, "MQTT 3.1.1, QoS 0, not retained", Hidden("only the broker sees how a robot connects")),
        rule(2, "client id LightBot/<name>", Hidden("only the broker sees client ids")),
        rule(3, "a name that topics and reports can carry", Everybody),
        rule(4, "payloads are text of bounded length", Everybody),
        rule(5, "listens on Broadcast and its own topic, on no other", Everybody),
        rule(6, "commands between bars, words case-sensitive", Everybody),
        rule(7, "what it does not know is ignored, the rest obeyed", Everybody),
        rule(8, "decimals with a comma or an exponent", Everybody),
        rule(9, "reports: name, x and y in metres", Everybody),
        rule(10, "further fields of reports are key=value", Details),
        rule(11, "who says no can= is sent only the original's commands", Hidden("it binds the controller")),
        rule(12, "state= says what it does", Route),
        rule(13, "reports on UUID at every UUID command, at once", Everybody),
        rule(14, "introduces itself after power-on and a lost link", Hidden(POWER)),
        rule(15, "keeps its name", Everybody),
        rule(16, "a TARGET replaces the one before, at once", Everybody),
        rule(17, "a target is reached within 0.02 m", Everybody),
        rule(18, "one Arrival for each target", Everybody),
        rule(19, "a target that is no place stops it", Everybody),
        rule(20, "drives at most 0.27 m/s fast", Everybody),
        rule(21, "COLOR shows at once; n = R·65536 + G·256 + B", Light),
        rule(22, "FADE at its moment, evenly", Fade),
        rule(23, "fades wait for their moment; STOP forgets them", Fade),
        rule(24, "BLINK flashes, then the light is as before", Blink),
        rule(25, "asks for the time in microseconds of its own clock", Route),
        rule(26, "time questions are answered at once", Hidden("it binds the controller")),
        rule(27, "knows the show clock within milliseconds", Route),
        rule(28, "pace of time questions", Route),
        rule(29, "synchronised after four different answers", Route),
        rule(30, "begins afresh when the show clock jumps", Route),
        rule(31, "PATH with R, L and C pieces", Route),
        rule(32, "keeps a route, says so, and waits", Route),
        rule(33, "START, and a later START, count; earlier ones do not", Route),
        rule(34, "a started route replaces the one under way", Route),
        rule(35, "is on the route at every moment", Route),
        rule(36, "one Arrival at the end of a route", Route),
        rule(37, "gives up a route it is far from", Route),
        rule(38, "HOLD and RESUME ease path time", Route),
        rule(39, "a hold before START does not count", Route),
        rule(40, "STOP: stands, forgets, says so", Route),
        rule(41, "reports on Status in time", Route),
        rule(42, "several reasons make one report", Route),
        rule(43, "stands after 2 s of silence on a route", Route),
        rule(44, "a target survives silence, not a lost link", Hidden(CUT)),
        rule(45, "is free again after it was cut", Route),
        rule(46, "stands where it does not know its place", Hidden(SENSORS)),
        rule(47, "stands when sensors or motors make no sense", Hidden(SENSORS)),
        rule(48, "no payload harms it", Everybody),
        rule(49, "brakes for what it sees in its way", Hidden(OBSTACLE)),
        rule(50, "its light says why it stands", Hidden(CUT)),
        rule(51, "controllers warn of each other", Hidden("it binds the controller")),
        rule(52, "a simulated robot says so", Hidden("messages do not show whether a robot is simulated")),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_of_the_document_stands_at_its_number() {
        let document = include_str!("../../../docs/protocol.md");
        for (index, rule) in RULES.iter().enumerate() {
            assert_eq!(usize::from(rule.number), index + 1);
            assert!(document.contains(&format!("- **R{}** ", rule.number)), "R{}", rule.number);
        }
        let count = document.lines().filter(|line| line.starts_with("- **R")).count();
        assert_eq!(count, RULES.len());
    }
}
