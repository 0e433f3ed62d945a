//! The light of a robot in a file.

use lightbots_base::Rgb;
use lightbots_light::Linear;

use crate::limits::LONGEST_S;

/// Largest number of stretches of light of all robots in a file. A stretch takes 16 bytes of memory.
pub(crate) const STRETCHES_MAX: usize = 4_000_000;

/// Light over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TimedLight {
    /// Whether codes, 0 to 255, are linear light. Otherwise, codes are sRGB.
    pub is_linear: bool,
    /// Codes of red, green and blue at the start of the show, from which a first fade starts.
    pub start: [u8; 3],
    /// Stretches in order. After the last stretch, the codes at its end are kept.
    pub stretches: Vec<CodeStretch>,
}

/// A stretch of a robot's light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CodeStretch {
    /// When the stretch ends, seconds from the start of the show. Not earlier than the end of the previous stretch.
    pub end_s: f64,
    /// Codes of red, green and blue at the end of the stretch.
    pub to: [u8; 3],
    /// Whether codes change linearly to `to` from those at the end of the previous stretch. Otherwise the codes are `to`
    /// during the whole stretch.
    pub fades: bool,
}

impl TimedLight {
    /// A light that never changes, with codes of linear light.
    pub fn constant(code: [u8; 3]) -> Self {
        Self { is_linear: true, start: code, stretches: Vec::new() }
    }

    /// When the last stretch ends, seconds from the start of the show; 0 without stretches.
    pub fn end_s(&self) -> f64 {
        self.stretches.last().map_or(0.0, |stretch| stretch.end_s)
    }

    /// Whether the light is black from the start of the show until `at_s`, seconds from the start of the show.
    pub fn is_dark_until(&self, at_s: f64) -> bool {
        let (mut begin_s, mut from) = (0.0, self.start);
        for stretch in &self.stretches {
            if begin_s >= at_s {
                return true;
            }
            let is_lit = stretch.to != [0; 3] || stretch.fades && from != [0; 3];
            if is_lit && stretch.end_s > begin_s {
                return false;
            }
            (begin_s, from) = (stretch.end_s, stretch.to);
        }
        begin_s >= at_s || from == [0; 3]
    }

    /// Codes at the end of the last stretch, or `start` without stretches.
    pub fn last(&self) -> [u8; 3] {
        self.stretches.last().map_or(self.start, |stretch| stretch.to)
    }

    /// Adds a stretch. A hold after a hold of the same codes only prolongs it. `room` is the number of stretches that
    /// may still follow in the whole file; it is reduced by 1 if the stretch is added. Fails if it is 0, and for a
    /// stretch that ends before the start of the show or more than a day after it.
    pub fn push(&mut self, stretch: CodeStretch, room: &mut usize) -> Result<(), String> {
        if !(0.0..=LONGEST_S).contains(&stretch.end_s) {
            return Err("its light lasts longer than a day; shorten it".into());
        }
        let before = self.stretches.last_mut();
        match before {
            Some(last) if !last.fades && !stretch.fades && last.to == stretch.to => {
                last.end_s = stretch.end_s;
                return Ok(());
            }
            _ => {}
        }
        *room = room.checked_sub(1).ok_or_else(|| {
            format!(
                "the lights of all robots have more than {STRETCHES_MAX} changes; split the show into several"
            )
        })?;
        self.stretches.push(stretch);
        Ok(())
    }

    /// Returns a player of the light. It gives the colours at moments that must not decrease.
    pub fn player(&self) -> CodePlayer<'_> {
        CodePlayer { light: self, next: 0, begin: (0.0, self.start) }
    }

    fn rgb(&self, codes: [f64; 3]) -> Rgb {
        if self.is_linear {
            let [r, g, b] = codes.map(|code| code / 255.0);
            return Linear::new(r, g, b).to_rgb();
        }
        let [r, g, b] = codes.map(|code| code.round() as u8);
        Rgb::new(r, g, b)
    }
}

/// Gives the colours of a light at moments that do not decrease.
#[derive(Clone, Debug)]
pub(crate) struct CodePlayer<'a> {
    light: &'a TimedLight,
    /// Index of the stretch that plays, counted from 0.
    next: usize,
    /// When that stretch began, seconds from the start of the show, and the codes just before.
    begin: (f64, [u8; 3]),
}

impl CodePlayer<'_> {
    /// The colour at `at_s`, seconds from the start of the show. `at_s` must not be less than in the previous call.
    pub fn at(&mut self, at_s: f64) -> Rgb {
        while let Some(stretch) = self.light.stretches.get(self.next) {
            let (begin_s, from) = self.begin;
            if at_s < stretch.end_s {
                let to = stretch.to.map(f64::from);
                if !stretch.fades {
                    return self.light.rgb(to);
                }
                let share = ((at_s - begin_s) / (stretch.end_s - begin_s)).clamp(0.0, 1.0);
                let mixed = std::array::from_fn(|channel| {
                    f64::from(from[channel]).mul_add(1.0 - share, to[channel] * share)
                });
                return self.light.rgb(mixed);
            }
            self.begin = (stretch.end_s, stretch.to);
            self.next += 1;
        }
        self.light.rgb(self.light.last().map(f64::from))
    }
}

/// Converts an sRGB colour into the nearest codes of linear light, 0 to 255.
pub(crate) fn linear_codes(colour: Rgb) -> [u8; 3] {
    let Linear { r, g, b } = Linear::from_rgb(colour);
    [r, g, b].map(|light| (light * 255.0).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_fades_and_steps_are_played() {
        let stretch = |end_s: f64, code: u8, fades| CodeStretch { end_s, to: [code, 0, 0], fades };
        let stretches = vec![stretch(1.0, 10, false), stretch(3.0, 110, true), stretch(3.0, 7, false)];
        let light = TimedLight { is_linear: false, start: [0; 3], stretches };
        let mut player = light.player();
        let codes = [0.0, 0.9, 1.0, 2.0, 2.9, 3.0, 99.0].map(|at_s| player.at(at_s).r);
        assert_eq!(codes, [10, 10, 10, 60, 105, 7, 7]);
        assert_eq!(TimedLight::default().player().at(1.0), Rgb::BLACK);
    }

    #[test]
    fn dark_lights_are_told_from_lit_ones() {
        let stretch = |end_s: f64, code: u8, fades| CodeStretch { end_s, to: [code, 0, 0], fades };
        let dark = |stretches: Vec<CodeStretch>, at_s: f64| {
            TimedLight { stretches, ..TimedLight::default() }.is_dark_until(at_s)
        };
        let late = vec![stretch(2.0, 0, false), stretch(3.0, 9, false)];
        assert!(dark(late.clone(), 2.0) && !dark(late, 2.1));
        assert!(!dark(vec![stretch(2.0, 9, true)], 1.0) && dark(vec![stretch(2.0, 9, true)], 0.0));
        assert!(dark(Vec::new(), 5.0) && !TimedLight::constant([1; 3]).is_dark_until(5.0));
    }

    #[test]
    fn linear_light_costs_at_most_a_few_dark_codes() {
        let back = |code: u8| {
            let light = TimedLight::constant(linear_codes(Rgb::new(code, code, code)));
            light.player().at(0.0).r
        };
        assert_eq!([0, 6, 7, 128, 255].map(back), [0, 0, 13, 128, 255]);
        let worst = (0..=255).map(|code: u8| back(code).abs_diff(code)).max();
        assert_eq!(worst, Some(6));
    }

    #[test]
    fn holds_of_one_code_become_one_and_stretches_are_bounded() {
        let (mut light, mut room) = (TimedLight::default(), 2);
        let mut push =
            |end_s: f64, code: u8| light.push(CodeStretch { end_s, to: [code; 3], fades: false }, &mut room);
        assert_eq!([push(1.0, 5), push(2.0, 5), push(3.0, 6)], [Ok(()), Ok(()), Ok(())]);
        assert!(push(4.0, 7).unwrap_err().contains("split the show"));
        assert!(push(f64::NAN, 6).unwrap_err().contains("a day"));
        assert_eq!(light.stretches.len(), 2);
    }
}
