//! The rules of `docs/protocol.md`, and how each rule can be tested.

/// Which robots a rule concerns, and how a test can see whether they keep it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All robots: the original protocol.
    AllRobots,
    /// Robots whose reports say `can=route`.
    Route,
    /// All robots. Only the light shows whether the rule is kept.
    Light,
    /// Robots whose reports say `can=fade`. Only the light shows whether the rule is kept.
    Fade,
    /// Robots whose reports say `can=light`.
    Ahead,
    /// Robots whose reports say `can=live`.
    Live,
    /// Robots whose reports say `can=blink`. Only the light shows whether the rule is kept.
    Blink,
    /// Robots that report more fields than name and place.
    Details,
    /// The rule cannot be tested from outside. The text is the reason.
    Hidden(&'static str),
}

/// One rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// Number: 7 is R7.
    pub number: u8,
    /// Subject in a few words.
    pub title: &'static str,
    /// Robots that the rule concerns, and how a test can see whether they keep it.
    pub scope: Scope,
}

const fn rule(number: u8, title: &'static str, scope: Scope) -> Rule {
    Rule { number, title, scope }
}

/// Why rules for controllers cannot be tested on a robot.
const CONTROLLER: &str = "the rule concerns the controller";
/// Why rules about power-on cannot be tested.
const POWER: &str = "the test would have to switch the robot off and on";
/// Why rules about a broken link cannot be tested.
const CUT: &str = "the test would have to cut the robot's link";
/// Why rules about obstacles cannot be tested.
const OBSTACLE: &str = "the test would have to put an obstacle in front of the robot";
/// Why rules about wrong sensor values cannot be tested.
const SENSORS: &str = "the test would have to disturb the robot's sensors";

/// All rules in the order of their numbers: `RULES[n - 1]` is Rn.
pub const RULES: [Rule; 63] = {
    use Scope::{Ahead, AllRobots, Blink, Details, Fade, Hidden, Light, Live, Route};
    [
        rule(1, "MQTT 3.1.1, QoS 0, not retained", Hidden("only the broker sees how a robot connects")),
        rule(2, "client id LightBot/<name>", Hidden("only the broker sees client ids")),
        rule(3, "a name that topics and reports can carry", AllRobots),
        rule(4, "payloads are UTF-8 of bounded length", AllRobots),
        rule(5, "subscribes to Broadcast and its own topic only", AllRobots),
        rule(6, "commands between bars, words case-sensitive", AllRobots),
        rule(7, "ignores unknown commands and executes the others", AllRobots),
        rule(8, "reads decimals with a comma or an exponent", AllRobots),
        rule(9, "reports: name, x and y in metres", AllRobots),
        rule(10, "additional fields of reports are key=value", Details),
        rule(11, "robots without can= receive only the original's commands", Hidden(CONTROLLER)),
        rule(12, "state= is correct", Route),
        rule(13, "reports on UUID at once after each UUID command", AllRobots),
        rule(14, "reports after power-on and a lost link", Hidden(POWER)),
        rule(15, "keeps its name", AllRobots),
        rule(16, "a TARGET replaces the previous one at once", AllRobots),
        rule(17, "a target is reached within 0.02 m", AllRobots),
        rule(18, "one Arrival per target", AllRobots),
        rule(19, "an invalid target stops the robot", AllRobots),
        rule(20, "drives at 0.27 m/s or less", AllRobots),
        rule(21, "COLOR shows at once; n = R·65536 + G·256 + B", Light),
        rule(22, "FADE begins at its moment and changes evenly", Fade),
        rule(23, "fades wait for their moment; STOP deletes them", Fade),
        rule(24, "BLINK flashes; then the light is as before", Blink),
        rule(25, "time questions hold microseconds of its own clock", Route),
        rule(26, "time questions are answered at once", Hidden(CONTROLLER)),
        rule(27, "knows the show clock within milliseconds", Route),
        rule(28, "interval of time questions", Route),
        rule(29, "synchronised after four different answers", Route),
        rule(30, "synchronises again after a jump of the show clock", Route),
        rule(31, "PATH with R, L and C pieces", Route),
        rule(32, "keeps a route, reports it, and waits", Route),
        rule(33, "START and a later START count, an earlier START does not", Route),
        rule(34, "a started route replaces the one under way", Route),
        rule(35, "is at the right place of the route at each moment", Route),
        rule(36, "one Arrival at the end of a route", Route),
        rule(37, "aborts a route that is far away", Route),
        rule(38, "HOLD and RESUME change the rate of path time evenly", Route),
        rule(39, "a hold before START does not count", Route),
        rule(40, "STOP: stands, deletes target and routes, reports", Route),
        rule(41, "reports on Status in time", Route),
        rule(42, "several reasons cause one report", Route),
        rule(43, "stands within 2.2 s of silence on a route", Route),
        rule(44, "keeps a target in silence, but not without a link", Hidden(CUT)),
        rule(45, "accepts routes again after it was cut", Route),
        rule(46, "stands while its position is not known", Hidden(SENSORS)),
        rule(47, "stands when sensors or motors are implausible", Hidden(SENSORS)),
        rule(48, "survives every payload", AllRobots),
        rule(49, "brakes for obstacles that it sees", Hidden(OBSTACLE)),
        rule(50, "its light shows why it stands", Hidden(CUT)),
        rule(51, "controllers warn of each other", Hidden(CONTROLLER)),
        rule(
            52,
            "a simulated robot reports sim=1",
            Hidden("messages do not show whether a robot is simulated"),
        ),
        rule(53, "brakes= never falls, near= is a gap in sight", Details),
        rule(54, "GO comes on a topic of its own", Hidden(CONTROLLER)),
        rule(55, "keeps stretches of light and reports the newest", Ahead),
        rule(56, "the time of a stretch stands in a hold", Ahead),
        rule(57, "plays lines, steps and repeats from their moment on", Ahead),
        rule(58, "STOP deletes stretches of light", Ahead),
        rule(59, "keeps its slot and reports it", Live),
        rule(60, "shows the newest LIVE colour of its slot at once", Live),
        rule(61, "shows its own light after RELEASE and after 2.5 s", Live),
        rule(62, "its own light goes on beneath live light", Live),
        rule(63, "live light is sent to all robots at once, at a bounded rate", Hidden(CONTROLLER)),
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
