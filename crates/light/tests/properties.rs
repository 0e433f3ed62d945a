//! Properties of every effect: values within bounds, continuity, period, and use of seeds.

use lightbots_base::Vec2;
use lightbots_base::random::split_mix;
use lightbots_light::*;

/// Number of random settings for each effect.
const DRAWS: u64 = 60;

/// Properties that an effect guarantees.
#[derive(Clone, Copy, PartialEq)]
enum Promise {
    /// Continuous in time and place and periodic.
    Smooth,
    /// Continuous in time and place, but not periodic.
    Continuous,
    /// Periodic, with jumps.
    Periodic,
    /// Neither continuous nor periodic.
    Neither,
}

/// Every effect with its guaranteed properties, and whether its seed matters.
fn effects() -> Vec<(LightEffect, Promise, bool)> {
    use Promise::*;
    let along = || Coordinate::Distance;
    vec![
        (LightEffect::Solid, Smooth, false),
        (LightEffect::Gradient(along()), Continuous, false),
        (LightEffect::Fade, Continuous, false),
        (LightEffect::Pulse, Smooth, false),
        (LightEffect::Strobe, Periodic, false),
        (LightEffect::Twinkle { density: 0.7 }, Continuous, true),
        (LightEffect::Sparkle { density: 0.5 }, Neither, true),
        (LightEffect::Rainbow { along: along(), saturation: 1.0 }, Smooth, false),
        (LightEffect::Wave(along()), Smooth, false),
        (LightEffect::Chase(along()), Periodic, false),
        (LightEffect::Ripple, Periodic, false),
        (LightEffect::Plasma, Smooth, true),
        (LightEffect::Noise { octaves: 2 }, Continuous, true),
        (LightEffect::Fire, Continuous, true),
        (LightEffect::NextFrame, Continuous, false),
        (LightEffect::ByRobot, Continuous, true),
        (LightEffect::BySpeed { top_mps: 0.3 }, Smooth, false),
    ]
}

struct Draw(u64);

impl Draw {
    /// A random number from `least` to `most`.
    fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (split_mix(&mut self.0) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn look(&mut self) -> Look {
        Look {
            place: self.place(),
            angle: self.within(-7.0, 7.0),
            size_m: self.within(0.5, 3.0),
            speed_hz: self.within(0.1, 3.0),
            width: self.within(0.2, 0.8),
            ease: [Ease::Linear, Ease::Smooth, Ease::Sine, Ease::In, Ease::Out]
                [self.within(0.0, 5.0) as usize],
            wrap: Wrap::Mirror,
            seed: split_mix(&mut self.0),
            ..Look::default()
        }
    }

    fn place(&mut self) -> Vec2 {
        Vec2::new(self.within(-2.0, 2.0), self.within(-2.0, 2.0))
    }

    fn robot(&mut self) -> LitRobot {
        let (index, place, speed_mps) = (self.within(0.0, 30.0) as u32, self.place(), self.within(0.0, 0.3));
        LitRobot {
            index,
            count: 30,
            place,
            speed_mps,
            next_colour: Linear::new(1.0, 1.0, 1.0),
            ..LitRobot::default()
        }
    }
}

fn layers(effect: &LightEffect, look: &Look) -> Layers {
    Layers::new(vec![LightLayer::new(effect.clone(), look.clone())]).expect("the layer is valid")
}

fn colour(layers: &Layers, t_s: f64, robot: &LitRobot) -> Linear {
    layers.colour(t_s, robot, &LightContext::default())
}

fn difference(one: Linear, other: Linear) -> f64 {
    let apart = one.zip(other, |one, other| (one - other).abs());
    apart.r.max(apart.g).max(apart.b)
}

#[test]
fn colours_stay_within_bounds_and_the_same_settings_give_the_same_bits() {
    let mut draw = Draw(1);
    for (effect, _, _) in effects() {
        for _ in 0..DRAWS {
            let (look, robot, t_s) = (draw.look(), draw.robot(), draw.within(0.0, 600.0));
            let found = colour(&layers(&effect, &look), t_s, &robot);
            assert!(found == found.clamped(), "{effect:?}: {found:?}");
            assert_eq!(found, colour(&layers(&effect, &look), t_s, &robot), "{effect:?}");
        }
    }
}

#[test]
fn effects_that_promise_continuity_change_little_in_a_little_time_and_space() {
    let mut draw = Draw(2);
    // Steps of a microsecond and a micrometre. The steepest effect changes by 60 per second and 30 per metre.
    let (step_s, step_m, most) = (1e-6, 1e-6, 1e-4);
    for (effect, promise, _) in effects() {
        if !matches!(promise, Promise::Smooth | Promise::Continuous) {
            continue;
        }
        for _ in 0..DRAWS {
            let (look, mut robot) = (draw.look(), draw.robot());
            let layers = layers(&effect, &look);
            // Jumps would be at times near the ends of cycles.
            for t_s in
                [draw.within(0.0, 9.0), 1.0 / look.speed_hz, 3.0 / look.speed_hz, look.width / look.speed_hz]
            {
                let before = colour(&layers, t_s - step_s, &robot);
                let after = colour(&layers, t_s, &robot);
                assert!(difference(before, after) < most, "{effect:?} jumps at {t_s} with {look:?}");
                robot.place.x += step_m;
                let beside = colour(&layers, t_s, &robot);
                assert!(difference(beside, after) < most, "{effect:?} jumps in space with {look:?}");
            }
        }
    }
}

#[test]
fn effects_that_promise_a_period_repeat() {
    let mut draw = Draw(3);
    for (effect, promise, _) in effects() {
        if !matches!(promise, Promise::Smooth | Promise::Periodic) {
            continue;
        }
        for _ in 0..DRAWS {
            let look =
                Look { speed_hz: [0.25, 0.5, 1.0, 2.0][draw.within(0.0, 4.0) as usize], ..draw.look() };
            // Multiples of 1/8 s are exact in binary, so that rounding moves no time across a jump.
            let (robot, t_s) = (draw.robot(), f64::from(draw.within(0.0, 80.0) as u32) / 8.0);
            let layers = layers(&effect, &look);
            let one = colour(&layers, t_s, &robot);
            let later = colour(&layers, t_s + 3.0 / look.speed_hz, &robot);
            assert!(difference(one, later) < 1e-9, "{effect:?} with {look:?} at {t_s}: {one:?}, {later:?}");
        }
    }
}

#[test]
fn another_seed_gives_other_light_where_something_is_random() {
    for (effect, _, random) in effects() {
        let mut draw = Draw(4);
        let look = draw.look();
        let other = Look { seed: look.seed ^ 1, ..look.clone() };
        let (one, second) = (layers(&effect, &look), layers(&effect, &other));
        let differs = (0..200).any(|_| {
            let (robot, t_s) = (draw.robot(), draw.within(0.0, 20.0));
            colour(&one, t_s, &robot) != colour(&second, t_s, &robot)
        });
        assert_eq!(differs, random, "{effect:?}");
    }
}
