//! Shared subscriptions (MQTT 5, section 4.8.2): each message goes to one client of a group. rmqtt leaves the choice of
//! that client to its embedder.

use std::sync::atomic::{AtomicUsize, Ordering};

use async_trait::async_trait;
use rmqtt::context::ServerContext;
use rmqtt::subscribe::SharedSubscription;
use rmqtt::types::{
    ClientId, Id, IsOnline, NodeId, SharedGroup, SubscriptionIdentifier, SubscriptionOptions, TopicName,
};

/// A client of a group, and whether it is connected.
type Member = (NodeId, ClientId, SubscriptionOptions, Option<Vec<SubscriptionIdentifier>>, Option<IsOnline>);

/// Chooses a client of a group in turn: among the connected ones, or among all if none is connected.
#[derive(Debug, Default)]
pub struct Groups {
    turn: AtomicUsize,
}

impl Groups {
    /// Returns the index of the client whose turn it is, and whether it is connected. `are_online` says for each client
    /// whether it is connected. `None` for a group without clients.
    fn next(&self, are_online: &[bool]) -> Option<(usize, bool)> {
        let turn = self.turn.fetch_add(1, Ordering::Relaxed);
        let online: Vec<usize> = (0..are_online.len()).filter(|index| are_online[*index]).collect();
        if online.is_empty() {
            return (!are_online.is_empty()).then(|| (turn % are_online.len(), false));
        }
        Some((online[turn % online.len()], true))
    }
}

#[async_trait]
impl SharedSubscription for Groups {
    fn is_supported(&self) -> bool {
        true
    }

    async fn choice(
        &self,
        _: &ServerContext,
        _: &SharedGroup,
        _: &Id,
        _: &TopicName,
        members: &[Member],
    ) -> Option<(usize, IsOnline)> {
        let are_online: Vec<bool> = members.iter().map(|member| member.4.unwrap_or_default()).collect();
        self.next(&are_online)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clients_take_turns_and_those_that_are_away_wait() {
        let groups = Groups::default();
        let next = |are_online: &[bool]| groups.next(are_online);
        assert_eq!(next(&[true, true]), Some((0, true)));
        assert_eq!(next(&[true, true]), Some((1, true)));
        assert_eq!([next(&[false, true]), next(&[false, true])], [Some((1, true)); 2]);
        assert_eq!(next(&[false, false]), Some((0, false)));
        assert_eq!(next(&[]), None);
    }
}
