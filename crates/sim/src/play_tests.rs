//! The same run in both orders of turns.

use super::*;
use crate::conditions::Conditions;
use crate::faults::Faults;
use lightbots_show::front_rows;

#[test]
fn robots_that_take_turns_there_and_back_play_the_same_to_the_bit() {
    let show =
        Arc::new(lightbots_exchange::read(include_bytes!("../../../shows/hello.json"), None).unwrap().show);
    let starts = front_rows(&show.stage, 30);
    for faults in ["kill=random", "slip=10%,gps=5mm", "fix-dropout=0.5s"] {
        let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
        let options = RehearsalOptions { seed: 3, conditions, robots: None };
        let play = |cached| {
            let mut play = Play::new(show.clone(), &starts, &[], &options, 30.0);
            play.robots.cached = cached;
            play.run(None, &mut |_| {})
        };
        let (there, back) = (play(starts.len()), play(0));
        assert_eq!(there, back, "{faults}");
        assert_eq!(there.frames_played, show.frames.len(), "{faults}");
    }
}
