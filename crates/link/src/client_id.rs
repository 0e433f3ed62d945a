//! MQTT client ids, and random numbers for them. Those of a robot and of a controller are formed as in the original
//! protocol.

use lightbots_base::RobotId;

/// Returns a new random UUID.
///
/// # Panics
/// If the system gives no random numbers.
pub fn random_id() -> RobotId {
    let mut bytes = [0; 16];
    // Without random numbers, ids would collide on the broker, so the program stops here.
    getrandom::fill(&mut bytes).expect("the system gives no random numbers");
    RobotId::from_random(u128::from_le_bytes(bytes))
}

/// The client id of a robot: `LightBot/<id>`.
pub fn robot_client_id(id: &RobotId) -> String {
    format!("LightBot/{id}")
}

/// A client id for a connection that several robots share: `LightBots/<uuid>`. Each call makes a new UUID. Panics as
/// [`random_id`] does.
pub fn crowd_client_id() -> String {
    format!("LightBots/{}", random_id())
}

/// A client id for a controller: `BotControl/<uuid>`. Each call makes a new UUID. Panics as [`random_id`] does.
pub fn controller_client_id() -> String {
    format!("BotControl/{}", random_id())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn client_ids_are_those_of_the_original() {
        let id = RobotId::from_random(1);
        assert_eq!(robot_client_id(&id), "LightBot/00000000-0000-4000-8000-000000000001");
        assert_ne!(controller_client_id(), controller_client_id());
    }
}
