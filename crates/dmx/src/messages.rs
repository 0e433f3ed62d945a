//! One moment of live light as payloads for all robots (R60, R61, R63).

use lightbots_base::Rgb;
use lightbots_wire::{Command, LiveColours, LiveRelease, MAX_LIVE_COLOURS, MAX_PAYLOAD, encode};

/// Payloads of one moment of live light: the full ones, and the text of the one that is being filled.
#[derive(Debug)]
struct Payloads {
    full: Vec<Vec<u8>>,
    text: String,
}

/// Writes the payloads of the moment of live light with this `number`: colours by slot, and the slots of released robots.
/// Both must be in order of slots. The fewer gaps between slots, the shorter the payloads.
pub(crate) fn write_moment(
    number: u32,
    colours: impl Iterator<Item = (u16, Rgb)>,
    released: impl Iterator<Item = u16>,
) -> Vec<Vec<u8>> {
    let mut payloads = Payloads { full: Vec::new(), text: String::new() };
    let mut live = LiveColours { number, first: 0, colours: heapless::Vec::new() };
    for (slot, colour) in colours {
        let follows = usize::from(slot) == usize::from(live.first) + live.colours.len();
        if (!follows || live.colours.len() == MAX_LIVE_COLOURS) && !live.colours.is_empty() {
            payloads.push(&Command::Live(live.clone()));
            live.colours.clear();
        }
        if live.colours.is_empty() {
            live.first = slot;
        }
        // The colour fits, because a full list was written above.
        let _ = live.colours.push(colour);
    }
    if !live.colours.is_empty() {
        payloads.push(&Command::Live(live));
    }
    let mut release = LiveRelease { number, first: 0, count: 0 };
    for slot in released {
        if release.count > 0 && u32::from(slot) != u32::from(release.first) + u32::from(release.count) {
            payloads.push(&Command::Release(release));
            release.count = 0;
        }
        if release.count == 0 {
            release.first = slot;
        }
        release.count += 1;
    }
    if release.count > 0 {
        payloads.push(&Command::Release(release));
    }
    payloads.finish()
}

impl Payloads {
    fn push(&mut self, command: &Command) {
        let before = self.text.len();
        // Writing to a `String` cannot fail.
        let _ = encode(command, &mut self.text);
        if self.text.len() > MAX_PAYLOAD {
            let last = self.text.split_off(before);
            self.full.push(std::mem::replace(&mut self.text, last).into_bytes());
        }
    }

    fn finish(mut self) -> Vec<Vec<u8>> {
        if !self.text.is_empty() {
            self.full.push(self.text.into_bytes());
        }
        self.full
    }
}

#[cfg(test)]
mod tests {
    use lightbots_wire::commands;

    use super::*;

    fn texts(colours: &[u16], released: &[u16]) -> Vec<String> {
        let colours = colours.iter().map(|&slot| (slot, Rgb::new(slot as u8, 0, 0)));
        let payloads = write_moment(7, colours, released.iter().copied());
        payloads.into_iter().map(|payload| String::from_utf8(payload).unwrap()).collect()
    }

    #[test]
    fn slots_in_a_row_share_a_command() {
        assert_eq!(texts(&[], &[]), [""; 0]);
        assert_eq!(texts(&[0, 1, 3], &[]), ["|LIVE 7 0 AAAAAQAA||LIVE 7 3 AwAA|"]);
        assert_eq!(texts(&[], &[4, 5, 9]), ["|RELEASE 7 4 2||RELEASE 7 9 1|"]);
        assert_eq!(texts(&[65_535], &[65_534, 65_535]), ["|LIVE 7 65535 /wAA||RELEASE 7 65534 2|"]);
    }

    #[test]
    fn no_payload_is_too_long_and_every_slot_is_in_one() {
        for step in [1, 2] {
            let slots: Vec<u16> = (0..10_000).map(|one| one * step).collect();
            let texts = texts(&slots, &slots);
            assert!(texts.iter().all(|text| text.len() <= MAX_PAYLOAD));
            let all = || texts.iter().flat_map(|text| commands(text.as_bytes())).map(Result::unwrap);
            let is_in = |slot: u16| {
                let colour = all().find_map(|command| match command {
                    Command::Live(live) => live.of(slot),
                    _ => None,
                });
                let is_released =
                    all().any(|command| matches!(command, Command::Release(one) if one.covers(slot)));
                colour == Some(Rgb::new(slot as u8, 0, 0)) && is_released
            };
            for slot in [0, 169 * step, 170 * step, 4_081 * step, 9_999 * step] {
                assert!(is_in(slot), "{slot}");
            }
        }
        assert_eq!(texts(&(0..1_000).collect::<Vec<_>>(), &[]).len(), 1, "1,000 robots in one message");
    }
}
