//! Messages of robots on their way to the network.

use lightbots_base::Instant;
use lightbots_wire::Topic;

use crate::breakdowns::Breakdowns;
use crate::broker_outages::BrokerOutages;
use crate::forgeries::Forgeries;
use crate::network::{Network, Way};
use crate::record::RehearsalRecord;

/// Sends a message of a robot to the controller. It is not sent if the robot is mute, or if the robot or the controller
/// has no connection to the broker. Records reports of arrival even if they are not sent.
pub(super) fn send(
    network: &mut Network,
    record: &mut RehearsalRecord,
    (breakdowns, broker, forgeries): (&Breakdowns, &BrokerOutages, &mut Forgeries),
    now: Instant,
    (robot, topic, text): (usize, Topic, &[u8]),
) {
    if topic == Topic::Arrival {
        record.arrived(robot, now);
    }
    if !breakdowns.is_mute(robot) && !broker.is_cut(robot) {
        network.send(now, Way::ToController(robot), topic, forgeries.forge(robot, topic, text).into());
    }
}
