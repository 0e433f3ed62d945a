//! What a run makes of a robot's report.

use crate::desk::Desk;
use crate::event::{EventKind, Trouble};
use crate::fleet::Heard;
use crate::leg::Kind;
use crate::run::{Phase, Run};
use lightbots_base::Instant;
use lightbots_wire::{Details, Report, RobotState, Topic};

impl Run {
    /// A robot of the fleet reported; the fleet table knows already.
    pub fn hear(&mut self, desk: &mut Desk, now: Instant, heard: Heard, topic: Topic, report: &Report) {
        let seat = desk.fleet.robot(heard.index).seat.map(|seat| seat as usize);
        let Some(seat) = seat.filter(|&seat| !self.seats[seat].out) else {
            if topic == Topic::Arrival {
                unexpected(desk, now, report);
            }
            self.consider_joiner(desk, now, heard.index);
            return;
        };
        let Some(details) = &report.details else {
            self.hear_original(desk, now, seat, topic, report);
            return;
        };
        if topic == Topic::Arrival {
            let drives = |run: &Self| run.current.as_ref().is_some_and(|leg| leg.seq == details.route);
            if self.began_alone(seat, details) {
                self.replan_with(desk, now, seat);
            } else if !matches!(self.phase, Phase::Driving(_)) || drives(self) {
                self.hear_arrival(desk, now, seat, report.at);
            }
            return;
        }
        self.hear_ack(desk, now, seat, details.route);
        self.hear_start(seat, details.route, details.starts);
        match self.phase {
            Phase::Driving(_) => self.judge(desk, now, seat, details),
            Phase::Standing(_) | Phase::Starting(_) => self.hear_standing(desk, now, seat, heard, details),
            Phase::Gathering(_) | Phase::Offline(_) => {}
        }
        if heard.restarted {
            self.seats[seat].starts = None;
            self.relight_seat(desk, seat);
        }
        if matches!(self.phase, Phase::Standing(_)) && self.is_uploaded() {
            self.tick_standing(desk, now);
        }
    }

    fn hear_standing(&mut self, desk: &mut Desk, now: Instant, seat: usize, heard: Heard, details: &Details) {
        match details.state {
            RobotState::Faulty => self.drop_out(desk, now, seat, Trouble::Faulty),
            RobotState::Lost => self.drop_out(desk, now, seat, Trouble::Lost),
            _ if self.began_alone(seat, details) => self.replan_with(desk, now, seat),
            _ if heard.restarted => {
                self.upload_again(now, seat);
                self.pump_upload(desk, now);
            }
            _ => {}
        }
    }

    fn hear_original(&mut self, desk: &mut Desk, now: Instant, seat: usize, topic: Topic, report: &Report) {
        if topic == Topic::Arrival {
            self.hear_arrival(desk, now, seat, report.at);
            return;
        }
        if let Some(at) = report.at
            && self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Targets)
        {
            self.hear_hop(desk, now, seat, at, false);
        }
    }
}

/// An arrival nobody waits for is counted and told, at a bounded rate.
pub(crate) fn unexpected(desk: &mut Desk, now: Instant, report: &Report) {
    desk.unexpected += 1;
    desk.log.tell_limited(now, EventKind::UnexpectedArrival(report.id));
}
